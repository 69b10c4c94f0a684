"""The figures of `notes/stability.md`, and the numbers in them.

    python -m benchmarks.failures [NAME ...]

Computes everything anew, prints the numbers and writes notes/figures/fails-NAME.png; all names by
default. The names are those of the functions in `states`, `numbers` and `pivots`, each of
which draws one figure.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
from matplotlib import pyplot as plt

from benchmarks.failures.numbers import (
    collapse,
    condition,
    published_floor,
    pushes,
    stiffness,
    tiny_pushes,
)
from benchmarks.failures.pivots import cycle, grain, pivots, rays
from benchmarks.failures.states import breakpoints, mechanisms, slides, stops, thresholds

FOLDER = Path(__file__).parents[2] / "notes" / "figures"
FIGURES = (
    thresholds,
    stops,
    breakpoints,
    tiny_pushes,
    pushes,
    stiffness,
    condition,
    mechanisms,
    slides,
    collapse,
    cycle,
    grain,
    rays,
    pivots,
    published_floor,
)


def main() -> None:
    mpl.use("Agg")
    plt.rcParams.update({"font.size": 8, "legend.fontsize": 7, "legend.frameon": False})
    FOLDER.mkdir(parents=True, exist_ok=True)
    for draw in FIGURES:
        if sys.argv[1:] and draw.__name__ not in sys.argv[1:]:
            continue
        print(draw.__name__)
        figure, ax = plt.subplots(figsize=(4.6, 2.9), layout="constrained")
        draw(ax)
        figure.savefig(FOLDER / f"fails-{draw.__name__.replace('_', '-')}.png", dpi=110)
        plt.close(figure)


if __name__ == "__main__":
    main()
