"""The pictures of notes/paper.md.

python -m benchmarks.paper.pictures DIRECTORY
"""

from __future__ import annotations

import sys
from pathlib import Path

from matplotlib.figure import Figure

from lcp_piles import base_pressure, nt30, solve
from lcp_piles.paper.figures_fields import size_plate
from lcp_piles.paper.figures_push import apex_pressure_plate
from lcp_piles.pictures import save

_LOOKS = {6: ("#1f6fb4", "-", "o"), 10: ("#2e8b57", "--", "s"), 20: ("#c8102e", "-.", "")}
_LOOKS[40] = ("#1a1a1a", "-", "")


def nt30_profiles() -> Figure:
    """The force on the floor over the number of layers, against x over the reach of the base."""
    figure = Figure(figsize=(6.4, 3.8), layout="constrained")
    ax = figure.add_subplot()
    for layers, (colour, style, marker) in _LOOKS.items():
        profile = base_pressure(solve(nt30(layers)))
        reach = 3 * layers - 3
        x = [float(p.x) / reach for p in profile]
        y = [float(p.normal) / layers for p in profile]
        label = f"$N = {layers}$"
        ax.plot(x, y, style, marker=marker, ms=3, lw=1.1, color=colour, label=label)
    ax.set_ylim(bottom=0)
    ax.set_xlabel("$x$ / distance of a corner stone")
    ax.set_ylabel("force on the floor / $N$  ($w$)")
    ax.set_title("NT30, floor compliance $1$, no push", fontsize=11)
    ax.legend(frameon=False)
    return figure


def main(directory: Path) -> None:
    """Write the three pictures."""
    directory.mkdir(parents=True, exist_ok=True)
    sizes = (*range(2, 31), *range(35, 91, 5), *range(90, 121, 6))
    pictures = {
        "tbs-saturation": size_plate("tbs", "adef", sizes).picture,
        "apex-pressure": apex_pressure_plate(6).picture,
        "nt30-profiles": nt30_profiles(),
    }
    for name, picture in pictures.items():
        assert picture is not None
        save(picture, directory / f"{name}.png", dpi=110)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
