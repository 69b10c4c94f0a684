"""Bounds of every contact of the four piles, size by size, and whether each is proved.

    python -m benchmarks.friction.sweep [SIZE]

Goes on where `results/sweep.csv` stops, up to the size (default 10); a row is added as soon as a
pile is done. A bound that could not be certified would be an error, and end the program.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from time import perf_counter

from lcp_piles import contact_bounds, pile

FILE = Path(__file__).parent / "results" / "sweep.csv"
HEADER = ("kind", "layers", "mu", "contacts", "unbounded", "exact_pivots", "seconds")
KINDS = ("tbs", "tss", "nt60", "nt30")
FRICTIONS = ("0", "1/10*sqrt(3)", "1/2*sqrt(3)", "3/10")


def rows() -> list[dict[str, str]]:
    """What is done."""
    return list(csv.DictReader(FILE.open(encoding="utf-8"))) if FILE.exists() else []


def bounded(most: int) -> Iterator[tuple[str, int, str, int, int, int, str]]:
    """A row for each pile that is not done yet."""
    done = {(row["kind"], int(row["layers"]), row["mu"]) for row in rows()}
    for layers, kind, mu in product(range(1, most + 1), KINDS, FRICTIONS):
        if (kind, layers, mu) in done or (layers == 1 and kind != "tbs"):
            continue
        start = perf_counter()
        found = contact_bounds(pile(kind, layers), mu)
        seconds = f"{perf_counter() - start:.2f}"
        free = found.largest.count(None)
        yield kind, layers, mu, len(found.least), free, found.exact_pivots, seconds


def main() -> None:
    """Bound what is left, and write it down."""
    FILE.parent.mkdir(exist_ok=True)
    new = not FILE.exists()
    with FILE.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(HEADER)
        for row in bounded(int(sys.argv[1]) if len(sys.argv) > 1 else 10):
            writer.writerow(row)
            file.flush()
            print(*row, flush=True)


if __name__ == "__main__":
    main()
