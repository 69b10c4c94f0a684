"""How long `solve_lcp`, `prove_lcp`, `nash` and `quadratic_program` take: tables for the notes.

    python -m benchmarks.lcp.speed

Medians of wall-clock seconds in one process with one thread, after a first run to warm up;
what takes longer than some seconds is run once. CGAL, the one peer that is exact, is compared
where it can be built.
"""

from __future__ import annotations

import statistics
import sys
from collections.abc import Callable
from time import perf_counter
from typing import Any

from benchmarks.lcp import cgal
from benchmarks.lcp import random_problems as drawn
from benchmarks.speed.measure import machine
from lcp_piles import nash, prove_lcp, quadratic_program, solve_lcp
from lcp_piles.linear.threads import one_thread

_RUNS, _LONG = 5, 3.0

DENSE = [
    ("definite", 100, lambda: drawn.definite(100), ""),
    ("definite", 300, lambda: drawn.definite(300), "2"),
    ("definite", 1000, lambda: drawn.definite(1000), "60"),
    ("rank 50, z of two digits", 100, lambda: drawn.semidefinite(100, 50), ""),
    ("rank 150, z of two digits", 300, lambda: drawn.semidefinite(300, 150), "2"),
    ("rank 500, z of two digits", 1000, lambda: drawn.semidefinite(1000, 500), "60"),
    ("dominant diagonal, not symmetric", 100, lambda: drawn.dominant(100), "0.3"),
    ("dominant diagonal, not symmetric", 300, lambda: drawn.dominant(300), ""),
    ("dominant diagonal, not symmetric", 1000, lambda: drawn.dominant(1000), ""),
]
SPARSE = [
    ("tridiagonal", 1000, lambda: drawn.tridiagonal(1000), ""),
    ("membrane 17 x 17", 289, lambda: drawn.membrane(17, 10), "0.1"),
    ("membrane 32 x 32", 1024, lambda: drawn.membrane(32, 30), ""),
    ("membrane 50 x 50", 2500, lambda: drawn.membrane(50, 70), ""),
    ("grid 17 x 17, z of two digits", 289, lambda: drawn.grid(17), "0.1"),
    ("grid 100 x 100, z of two digits", 10_000, lambda: drawn.grid(100), ""),
]
PROVED = [*SPARSE, ("membrane 100 x 100", 10_000, lambda: drawn.membrane(100, 270), "")]


@one_thread()
def main() -> None:
    """Print all tables."""
    print(f"{machine()}\n")
    print("| LCP | unknowns | `solve_lcp`, s | wanted | road | M is | digits of z |")
    print("|---|---:|---:|---|---|---|---:|")
    for name, n, make, wanted in (*DENSE, *SPARSE):
        M, q = make()
        seconds, found = timed(lambda M=M, q=q: solve_lcp(M, q))
        digits = _digits(found)
        print(f"| {name} | {n} | {seconds:.3g} | {wanted} | {found.road} |", end=" ")
        print(f"{found.matrix.name} | {digits} |", flush=True)
    print("\n| LCP | unknowns | `prove_lcp`, s | proved | z > 0 |")
    print("|---|---:|---:|---|---:|")
    for name, n, make, _ in PROVED:
        M, q = make()
        seconds, proof = timed(lambda M=M, q=q: prove_lcp(M, q))
        told = "yes" if proof.proved else f"all but {len(proof.unproved)}"
        print(f"| {name} | {n} | {seconds:.3g} | {told} | {proof.support.sum()} |", flush=True)
    print("\n| game | `nash`, s | wanted |")
    print("|---|---:|---|")
    for n, wanted in ((50, ""), (100, ""), (150, "20")):
        A, B = drawn.game(n)
        seconds, _ = timed(lambda A=A, B=B: nash(A, B))
        print(f"| {n} x {n} | {seconds:.3g} | {wanted} |", flush=True)
    print("\n| programme | variables, rows | `quadratic_program`, s | CGAL, s |")
    print("|---|---|---:|---:|")
    for n in (10, 30, 60, 100, 200):
        given = drawn.programme(n)
        seconds, ours = timed(lambda given=given: quadratic_program(**given))
        other = "not built"
        if cgal.present() and n <= 100:
            numbers = _words(given)
            taken, x = timed(lambda n=n, numbers=numbers: cgal.exact(n, n // 2, numbers))
            assert tuple(x) == ours.x, "two exact answers, and a strictly convex programme"
            other = f"{taken:.3g}"
        print(f"| drawn | {n}, {n // 2} | {seconds:.3g} | {other} |", flush=True)


def timed(run: Callable[[], Any]) -> tuple[float, Any]:
    """The median of the seconds, and the last result."""
    taken = []
    for _ in range(_RUNS + 1):
        start = perf_counter()
        found = run()
        taken.append(perf_counter() - start)
        if sum(taken) > _LONG:
            break
    return statistics.median(taken[1:] or taken), found


def _digits(found: Any) -> int:
    """Of the longest number in z."""
    sys.set_int_max_str_digits(0)
    return max(len(str(max(x.numerator, x.denominator))) for x in found.z)


def _words(given: dict[str, Any]) -> list[Any]:
    """The numbers in the order that CGAL's program asks for."""
    P, n = given["P"], len(given["c"])
    parts = [P[i, : i + 1].tolist() for i in range(n)]
    parts += [given["c"].tolist(), given["G"].ravel().tolist(), given["h"].tolist()]
    return [x for part in parts for x in part] + [0, None] * n


if __name__ == "__main__":
    main()
