"""The tables of notes/paper.md: what the paper claims and what it left open, computed.

    python -m benchmarks.paper [TABLE ...]

Without names it prints all tables, in a few minutes. All forces, gaps and counts are exact, and
decimals those of exact numbers, except for the eigenvalues of the last table.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Sequence

from benchmarks.paper import piles, push
from benchmarks.paper.tables import TABLES

MODULES = (piles, push)  # importing them enters their tables


def main(names: Sequence[str]) -> None:
    """Print the tables named, or all."""
    for name in names or TABLES:
        if name not in TABLES:
            raise SystemExit(f"the table is {name!r}, expected one of " + ", ".join(TABLES))
        print(f"\n## {name}\n\n{inspect.getdoc(TABLES[name])}\n", flush=True)
        TABLES[name]()


if __name__ == "__main__":
    main(sys.argv[1:])
