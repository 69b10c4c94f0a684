"""The paper's Z algorithm against Lemke's method, both exact: pivots, failures, cycles.

Over the four piles and their sizes, over piles of nearly equal discs (random gaps), and over random
starts of the Z algorithm. One row a run; `agree` says whether both found the same exact forces.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from time import perf_counter
from typing import Any

from benchmarks.comparison import csv_rows
from benchmarks.comparison.judge import exact_hash
from benchmarks.comparison.scenes import build
from benchmarks.comparison.worker import Say, in_own_process
from lcp_piles import SolveError, solve, z_algorithm

FIELDS = [
    "study",
    "scene",
    "start",
    "contacts",
    "z_status",
    "z_iterations",
    "reintroductions",
    "singular",
    "z_seconds",
    "lemke_status",
    "lemke_pivots",
    "lemke_seconds",
    "agree",
    "versions",
    "machine",
    "commit",
]
SIZES = {"nt30": (3, 4, 6, 8, 10), "nt60": (4, 8, 12, 16), "tss": (4, 7, 10, 13), "tbs": (4, 8, 13)}
_RANDOM_GAPS = {"nt30": 5, "nt60": 7, "tss": 7, "tbs": 6}
_RANDOM_STARTS = {"nt30": 6, "nt60": 8, "tss": 8, "tbs": 8}


def cases(quick: bool) -> list[tuple[str, str, int]]:
    """(study, scene, start): start 0 is the empty set Z, others seed a random one."""
    found = []
    for kind, sizes in SIZES.items():
        found += [("sizes", f"{kind} {n}", 0) for n in (sizes[:2] if quick else sizes)]
    for kind, n in _RANDOM_GAPS.items():
        found += [("gaps", f"{kind} {n} discs={seed}", 0) for seed in range(1, 3 if quick else 9)]
    for kind, n in _RANDOM_STARTS.items():
        found += [("starts", f"{kind} {n}", seed) for seed in range(1, 3 if quick else 9)]
    return found


def study(out: Path, quick: bool, seconds: float) -> None:
    """Fill z_against_lemke.csv with what is not in it yet."""
    path = out / "z_against_lemke.csv"
    rows = csv_rows.read(path)
    known = {(row["study"], row["scene"], row["start"]) for row in rows}
    where = csv_rows.surroundings()
    for case in cases(quick):
        if (case[0], case[1], str(case[2])) in known:
            continue
        said, reason = in_own_process(_one, case, seconds=seconds)
        head: dict[str, Any] = dict(zip(FIELDS, case, strict=False)) | where
        if reason:
            said = [*said, {}]
            said[0].setdefault("z_status", reason)
        csv_rows.append(path, [head | said[0]], FIELDS)


def _one(case: tuple[str, str, int], say: Say) -> None:
    _, name, start = case
    scene = build(name)
    row: dict[str, Any] = {"contacts": len(scene.contacts)}
    clock = perf_counter()
    try:
        exact = solve(scene, "lemke")
        row |= {"lemke_status": exact.status, "lemke_pivots": exact.record.pivots}
    except SolveError as error:
        exact = None
        row["lemke_status"] = f"error: {error}"
    row["lemke_seconds"] = perf_counter() - clock
    random = Random(start)
    count = len(scene.contacts)
    Z = random.sample(range(count), random.randint(1, count // 2)) if start else ()
    clock = perf_counter()
    result = z_algorithm(scene, Z, limit=300)
    row |= {
        "z_status": result.status,
        "z_iterations": len(result.trace),
        "reintroductions": result.reintroductions,
        "singular": result.singular,
        "z_seconds": perf_counter() - clock,
    }
    if exact and exact.status == result.solution.status == "solved":
        row["agree"] = exact_hash(result.solution.forces) == exact_hash(exact.forces)  # type: ignore[arg-type]
    say(row)
