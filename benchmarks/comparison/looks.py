"""How methods look in all charts: a colour and a mark a group, and names where curves end."""

from __future__ import annotations

from typing import Any

from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

Label = tuple[float, float, str, str]
"""Where a curve ends (x, y), its name and its colour."""
LOOKS = {
    "ours, exact": ("#08306b", "s"),
    "other exact arithmetic": ("#7f7f7f", "D"),
    "ours, in floats": ("#56b4e9", "o"),
    "optimisers": ("#d55e00", "^"),
    "LCP codes": ("#009e73", "v"),
    "molecular dynamics": ("#cc79a7", "*"),
}
_MEMBERS = {
    "ours, exact": "proved/float start/lemke/lemke alone/z/continuation/contacts",
    "other exact arithmetic": "FLINT dense/Fractions/gmpy2",
    "ours, in floats": "newton/lemke-float64/lemke-float32/z-float64/z-float32/gauss-seidel/fire",
    "optimisers": "nnls/daqp/quadprog/clarabel/piqp/osqp/proxqp/highs",
    "LCP codes": "quantecon/lemkelcp/drake",
    "molecular dynamics": "lammps/lammps, tau to 0",
}
GROUP = {name: group for group, names in _MEMBERS.items() for name in names.split("/")}
"""The group of every method."""


def style(name: str) -> dict[str, Any]:
    """The line of a method."""
    colour, mark = LOOKS[GROUP[name]]
    return {"color": colour, "marker": mark, "markersize": 4, "lw": 1}


def finish(figure: Any, named: list[tuple[Any, list[Label]]], more: Any = ()) -> None:
    """The legend of the groups below all panels, and names at the ends of their curves."""
    handles = [
        Line2D([], [], color=colour, marker=mark, label=group)
        for group, (colour, mark) in LOOKS.items()
    ]
    figure.legend(handles=[*handles, *more], loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.6 / figure.get_size_inches()[1], 1, 1))
    figure.canvas.draw()
    for axis, labels in named:
        _name(axis, labels)


def _name(axis: Any, labels: list[Label]) -> None:
    """Names beside the ends of curves, moved up where they would lie over one another."""
    taken: list[tuple[float, float, float]] = []
    scale = axis.figure.dpi / 72
    width, height = 4.6 * scale, 8.5 * scale
    for x_end, y_end, name, colour in sorted(labels, key=lambda label: (label[1], label[0])):
        x, y = axis.transData.transform((x_end, y_end))
        left, up = x + 6 * scale, y + 5 * scale
        right = left + width * len(name)
        while any(left < r and right > k and abs(up - v) < height for k, r, v in taken):
            up += height / 4
        taken.append((left, right, up))
        axis.annotate(
            name,
            (x_end, y_end),
            ((left - x) / scale, (up - y) / scale),
            textcoords="offset points",
            fontsize=7.5,
            color=colour,
            va="center",
            path_effects=[withStroke(linewidth=1.8, foreground="white")],
        )
