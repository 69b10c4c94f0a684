"""What the first order costs beside the rigid solve."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import process_time

from lcp_piles import Scene, first_order, nt30, nt60, solve, tbs, tss

_TIMES = 11
COSTS: dict[str, Callable[[], Scene]] = {
    "NT30 6": lambda: nt30(6),
    "NT30 6, push 20": lambda: nt30(6, push=20),
    "NT30 8": lambda: nt30(8),
    "NT30 10": lambda: nt30(10),
    "NT30 20": lambda: nt30(20),
    "NT60 5": lambda: nt60(5),
    "NT60 20": lambda: nt60(20),
    "TBS 8": lambda: tbs(8),
    "TBS 10": lambda: tbs(10),
    "TBS 30": lambda: tbs(30),
    "TBS 60": lambda: tbs(60),
    "TSS 6": lambda: tss(6),
    "TSS 10": lambda: tss(10),
    "TSS 20": lambda: tss(20),
}


def cost_table() -> list[str]:
    """Medians of processor time of both, each on a new scene in turns, in lines of Markdown."""
    lines = [
        "| pile | contacts | rigid solve (ms) | first order (ms) | ratio |",
        "|---|---|---|---|---|",
    ]
    for name, build in COSTS.items():
        rigid, first, ratios = [], [], []
        for _ in range(_TIMES + 1):
            scene = build()
            start = process_time()
            solution = solve(scene)
            middle = process_time()
            assert solution.status == "solved"
            first_order(solution)
            rigid.append(middle - start)
            first.append(process_time() - middle)
            ratios.append(first[-1] / rigid[-1])
        row = [name, str(len(scene.contacts)), f"{1e3 * median(rigid[1:]):.1f}"]
        row += [f"{1e3 * median(first[1:]):.1f}", f"{median(ratios[1:]):.2f}"]
        lines.append("| " + " | ".join(row) + " |")
    return lines
