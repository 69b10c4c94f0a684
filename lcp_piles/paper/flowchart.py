"""The paper's flowchart of its Z algorithm, with what one run did at every box."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from matplotlib.axes import Axes

from ..methods.z.z_iteration import ZStep
from ..pictures.drawing import BLACK, BLUE, GREY, ORANGE, RED

_WIDTH, _HEIGHT = 2.25, 0.62
_ARROW = {"arrowstyle": "-|>", "color": GREY, "shrinkA": 0, "shrinkB": 0}
_PLACES = {
    "start": (0.0, 4.0),
    "solve": (0.0, 3.0),
    "back": (3.3, 3.0),
    "pulls": (0.0, 2.0),
    "overlaps": (0.0, 1.0),
    "end": (0.0, 0.0),
}


def draw_flowchart(ax: Axes, trace: Sequence[ZStep]) -> None:
    """The boxes of the algorithm and the ways between them, and how often a run took each."""
    without = [k for k, step in enumerate(trace, 1) if step.reintroduced]
    removed = sum(len(step.removed) for step in trace)
    returned = sum(len(step.returned) for step in trace)
    put_back = sum(len(step.reintroduced) for step in trace)
    texts = {
        "start": ("all contacts present: $Z = \\emptyset$", BLACK),
        "solve": (f"solve the linear system without $Z$\n{len(trace)} times", BLACK),
        "back": (f"put back the closest contacts of $Z$\n{put_back}, {_when(without)}", BLUE),
        "pulls": (f"forces that pull: into $Z$\n{removed} in all", RED),
        "overlaps": (f"contacts of $Z$ that overlap: out of it\n{returned} in all", ORANGE),
        "end": (f"$Z$ as before: solved\n{len(trace[-1].Z)} absent", BLACK),
    }
    for name, (text, colour) in texts.items():
        x, y = _PLACES[name]
        box = {"boxstyle": "round,pad=0.4", "facecolor": "white", "edgecolor": colour}
        ax.text(x, y, text, ha="center", va="center", fontsize=8, bbox=box, zorder=3)
    down = ("start", "solve", "pulls", "overlaps", "end")
    for above, below in pairwise(down):
        (x, y), (_, z) = _PLACES[above], _PLACES[below]
        _arrow(ax, (x, y - _HEIGHT / 2), (x, z + _HEIGHT / 2))
    across = _WIDTH / 2
    (x, y), (right, _) = _PLACES["solve"], _PLACES["back"]
    _arrow(ax, (x + across, y + 0.15), (right - across, y + 0.15), "no solution")
    _arrow(ax, (right - across, y - 0.15), (x + across, y - 0.15))
    low = _PLACES["overlaps"][1]
    ax.plot([x - across, x - across - 0.7], [low, low], color=GREY, linewidth=1)
    ax.plot([x - across - 0.7] * 2, [low, y], color=GREY, linewidth=1)
    _arrow(ax, (x - across - 0.7, y), (x - across, y))
    ax.text(x - across - 0.8, (low + y) / 2, "$Z$ changed", fontsize=8, rotation=90, va="center")
    ax.set(xlim=(-2.6, 5.0), ylim=(-0.6, 4.5))
    ax.set_axis_off()


def _arrow(ax: Axes, start: tuple[float, float], end: tuple[float, float], text: str = "") -> None:
    ax.annotate("", end, start, arrowprops=_ARROW, zorder=2)
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    ax.text(middle[0], middle[1] + 0.08, text, fontsize=7, ha="center", va="bottom")


def _when(iterations: Sequence[int]) -> str:
    """The iterations in words."""
    if not iterations:
        return "never"
    return "in iteration " + ", ".join(map(str, iterations))
