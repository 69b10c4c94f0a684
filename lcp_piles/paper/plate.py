"""A figure of the paper made again: its picture, and the numbers behind it as CSV.

What the modules `figures_*` have in common: `Plate` is what they return and `reproduce` writes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..fields.disc_contacts import Number
from ..pictures.drawing import disc_positions, scene_title
from ..scenes.kinds import kind_named
from ..scenes.parameters import FLOOR_COMPLIANCE
from ..scenes.scene import Scene

PHYSICAL_FLOOR = "1"
"""The compliance of a floor as soft as the discs."""

PAPERS_FLOOR = "-1/2"
"""The floor compliance with which the printed values of Table 1 come out."""


_INCHES_A_RADIUS = 0.22
"""So wide that lines of contacts next to each other do not run together."""


@dataclass(frozen=True, eq=False)
class Plate:
    """A picture (None for a table) and the texts beside it, by the ending of their file names."""

    picture: Figure | None
    texts: Mapping[str, str]


def floors(kind: str) -> list[dict[str, str]]:
    """The floor parameters that a figure of this kind of pile shows: none where it has no floor.

    >>> floors("tbs"), floors("tss")
    ([{}], [{'floor_compliance': '1'}, {'floor_compliance': '-1/2'}])
    """
    if FLOOR_COMPLIANCE not in kind_named(kind).parameters:
        return [{}]
    return [{FLOOR_COMPLIANCE.name: floor} for floor in (PHYSICAL_FLOOR, PAPERS_FLOOR)]


def panel_title(scene: Scene) -> str:
    """The title of a scene, and whether its floor is the paper's."""
    title = scene_title(scene)
    origin = scene.origin
    changed = {} if origin is None else {p.name: str(value) for p, value in origin.changed}
    paper = changed.get(FLOOR_COMPLIANCE.name) == PAPERS_FLOOR
    return f"{title} (the paper's floor)" if paper else title


def floor_title(floor: Mapping[str, str]) -> str:
    r"""How a title names a floor: its compliance, and whether it is the paper's.

    >>> floor_title({"floor_compliance": "-1/2"})
    "floor compliance $-1/2\\,\\tau$ (the paper's)"
    """
    label = floor_label(floor)
    return f"floor compliance ${label}\\,\\tau$" + " (the paper's)" * (label == PAPERS_FLOOR)


def floor_label(floor: Mapping[str, str]) -> str:
    """What the column `floor` of a table holds: the compliance, or "bumpy" for TBS."""
    return floor.get(FLOOR_COMPLIANCE.name, "bumpy")


def both(value: Number) -> tuple[Number, float]:
    """An exact number and its float: two fields of a table."""
    return value, float(value)


def extent(scene: Scene) -> tuple[float, float]:
    """How far apart the outermost disc centres are, across and up.

    >>> from lcp_piles import nt60
    >>> extent(nt60(2))[0]
    2.0
    """
    places = disc_positions(scene)
    across, up = (places.max(axis=0) - places.min(axis=0)).tolist()
    return across, up


def stacked(scenes: Sequence[Scene]) -> list[Axes]:
    """Axes of a new figure, one below the other, each with the proportions of its scene.

    The figure grows with the piles; every panel gets room for a title and a legend.
    """
    width = max(7.0, *(_INCHES_A_RADIUS * extent(scene)[0] for scene in scenes))
    heights = []
    for scene in scenes:
        across, up = extent(scene)
        heights.append(max(width * (up + 3) / (across + 4), 1.5))
    total = sum(height + 1.0 for height in heights)
    figure = Figure(figsize=(width, total))
    axes, top = [], total
    for height in heights:
        top -= height + 0.35
        axes.append(figure.add_axes((0, top / total, 1, height / total)))
        top -= 0.65
    return axes
