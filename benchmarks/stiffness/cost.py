"""What the first order costs beside the rigid solve."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import process_time

from benchmarks.stiffness.piles import PILES
from lcp_piles import Scene, first_order, nt30, nt60, solve, tbs

_TIMES = 11
LARGE: dict[str, Scene] = {
    "NT30 8": nt30(8),
    "NT30 10": nt30(10),
    "NT30 20": nt30(20),
    "NT60 20": nt60(20),
    "TBS 30": tbs(30),
    "TBS 60": tbs(60),
}


def cost_table() -> list[str]:
    """Medians of processor time, in turns, in lines of Markdown."""
    lines = [
        "| pile | contacts | rigid solve (ms) | first order (ms) | ratio |",
        "|---|---|---|---|---|",
    ]
    for name, scene in (PILES | LARGE).items():
        solution = solve(scene)
        assert solution.status == "solved"
        rigid, first, ratios = [], [], []
        for _ in range(_TIMES):
            rigid.append(_time(lambda s=scene: solve(s)))
            first.append(_time(lambda s=solution: first_order(s)))
            ratios.append(first[-1] / rigid[-1])
        row = [name, str(len(scene.contacts)), f"{1e3 * median(rigid):.1f}"]
        row += [f"{1e3 * median(first):.1f}", f"{median(ratios):.2f}"]
        lines.append("| " + " | ".join(row) + " |")
    return lines


def _time(work: Callable[[], object]) -> float:
    start = process_time()
    work()
    return process_time() - start
