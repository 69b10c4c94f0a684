"""Cold Lemke against a tableau of gmpy2 rationals, and small piles against DAQP, in one run.

    python -m benchmarks.speed.beside_others

CPU milliseconds, medians; needs the extra `peers`. DAQP is given the arrays that we make.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from time import process_time
from typing import Any

from benchmarks.comparison.fraction_tableau import lemke_tableau
from benchmarks.comparison.methods import method
from benchmarks.comparison.problem import problem
from benchmarks.speed.measure import machine
from lcp_piles import contact_lcp, contact_system, lemke, pile, prove_contacts, solve

COLD = [("nt30", 6), ("nt30", 8), ("tbs", 11), ("tss", 13)]
SMALL = [(k, n) for k, sizes in (
    ("nt30", (5, 6)), ("nt60", (8, 10)), ("tss", (8, 10)), ("tbs", (8, 9))
) for n in sizes]  # fmt: skip


def main() -> None:
    """Print both tables."""
    from gmpy2 import mpq

    print(f"Beside others ({machine()}), CPU milliseconds\n")
    print("| pile | contacts | tableau | lemke | ratio | gmpy2 from scene | ours | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    for kind, layers in COLD:
        given = contact_lcp(contact_system(pile(kind, layers))).problem
        M, q = given.M, [x.rational() for x in given.q]
        table = _median(lambda M=M, q=q: lemke_tableau(M, q, mpq), 3)
        own = _median(lambda given=given: lemke(given), 7)
        other = _median(_from_scene("gmpy2", kind, layers), 3)
        ours = _median(lambda k=kind, n=layers: solve(pile(k, n), "lemke"), 7)
        print(f"| {kind.upper()} {layers} | {len(q)} | {table:.1f} | {own:.1f} |", end=" ")
        print(f"{table / own:.1f} | {other:.1f} | {ours:.1f} | {other / ours:.1f} |", flush=True)
    print("\n| pile | contacts | DAQP from the scene | solve | ratio | prove_contacts | ratio |")
    print("|---|---|---|---|---|---|---|")
    for kind, layers in SMALL:
        peer = _median(_from_scene("daqp", kind, layers), 15)
        ours = _median(lambda k=kind, n=layers: solve(pile(k, n)), 15)
        proof = _median(lambda k=kind, n=layers: prove_contacts(pile(k, n)), 15)
        count = contact_system(pile(kind, layers)).contacts
        print(f"| {kind.upper()} {layers} | {count} | {peer:.2f} | {ours:.2f} |", end=" ")
        print(f"{ours / peer:.2f} | {proof:.2f} | {proof / peer:.2f} |", flush=True)


def _from_scene(name: str, kind: str, layers: int) -> Callable[[], Any]:
    chosen = method(name)
    return lambda: chosen.run(problem(pile(kind, layers)), None)


def _median(run: Callable[[], Any], repeats: int) -> float:
    """The median of the processor's milliseconds, after one run to warm up."""
    run()
    taken = []
    for _ in range(repeats):
        start = process_time()
        run()
        taken.append(process_time() - start)
    return statistics.median(taken) * 1000


if __name__ == "__main__":
    main()
