"""The parts that pictures are made of: frame, discs, supports, lines, legend and title.

`plotting` puts them together. A `unit` here is the number of points that one disc radius has on
the page, from which every width of a line is chosen.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import floor, log10

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike

from ..errors import InputError
from ..numbers.vectors import FloatArray
from ..scenes.names import DiscId
from ..scenes.scene import Scene

BLACK, RED, BLUE, GREEN, GREY = "#1a1a1a", "#c8102e", "#1f6fb4", "#2e8b57", "#9a9a9a"
ORANGE = "#e69f00"
"""Beside `RED` in place of `GREEN`, which not everyone can tell from it."""
_RIM, _HELD, _GROUND = GREY, "#c9c9c9", "#e4e4e4"
_INCH = 72  # points
_WIDEST = 33.1  # the shorter side of A0 in inches

Dashes = tuple[float, ...]


def between(value: float, low: float, high: float) -> float:
    """The value, or the limit that it exceeds."""
    return min(max(value, low), high)


def drawable(numbers: ArrayLike, what: str) -> FloatArray:
    """The numbers as floats; `InputError` where one is too large to be one. NaN passes."""
    found = np.asarray(numbers, dtype=np.float64)
    if np.isinf(found).any():
        raise InputError(what, "beyond the range of floats", "numbers that can be drawn")
    return found


def disc_positions(scene: Scene) -> FloatArray:
    """Lattice points of all discs, shape (discs, 2), in their mean radius.

    Raises `InputError` for a scene that is not plane.
    """
    check_plane(scene.dimension)
    places = drawable([[float(x) for x in disc.position] for disc in scene.discs], "a position")
    return drawable(places / _real_radii(scene).mean(), "a position")


def disc_radii(scene: Scene) -> FloatArray:
    """Radii of all discs, in their mean."""
    radii = _real_radii(scene)
    return drawable(radii / radii.mean(), "a radius")


def _real_radii(scene: Scene) -> FloatArray:
    return drawable([float(disc.radius) for disc in scene.discs], "a radius")


def check_plane(dimension: int) -> None:
    """`InputError` for what is not plane."""
    if dimension != 2:
        raise InputError("the number of axes", dimension, "2: only what is plane is drawn")


def frame(
    positions: FloatArray, ax: Axes | None, radii: FloatArray | float = 1.0
) -> tuple[Axes, float]:
    """Axes of equal scale around all discs and their supports, and the unit."""
    size = np.broadcast_to(radii, len(positions))[:, None]
    low = (positions - size).min(axis=0) - np.array([1.0, 0.6])
    high = (positions + size).max(axis=0) + np.array([1.0, 0.2])
    width, height = (high - low).tolist()
    if ax is None:
        # Inches a radius: small piles are not blown up, and the page grows with large ones as far
        # as paper is made.
        scale = min(between(min(7 / width, 8 / height), 0.12, 0.6), _WIDEST / max(width, height))
        page = (max(scale * width + 0.3, 5.2), scale * height + 0.9)
        across, up = scale * width / page[0], scale * height / page[1]
        corner = (1 - across) / 2, 0.5 / page[1]
        ax = Figure(figsize=page).add_axes((*corner, across, up))
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    ax.set_axis_off()
    across, up = _size(ax)
    return ax, min(across / width, up / height) * _INCH


def page(ax: Axes) -> Figure:
    """The figure that axes are on."""
    figure = ax.get_figure(root=True)
    assert figure is not None, "axes belong to a figure until they are removed from it"
    return figure


def _size(ax: Axes) -> tuple[float, float]:
    """Width and height in inches of the place that the axes have."""
    box, figure = ax.get_window_extent(), page(ax)
    return box.width / figure.dpi, box.height / figure.dpi


def draw_discs(
    ax: Axes,
    positions: FloatArray,
    radii: FloatArray,
    unit: float,
    held: Sequence[bool] = (),
) -> None:
    """A thin circle a disc, grey inside where the disc is held."""
    diameter = 2 * radii
    discs = EllipseCollection(
        diameter,
        diameter,
        [0.0] * len(positions),
        units="xy",
        offsets=positions,
        offset_transform=ax.transData,
        facecolors=[_HELD if h else "white" for h in held] or "white",
        edgecolors=_RIM,
        linewidths=between(0.04 * unit, 0.2, 0.7),
        zorder=1,
    )
    discs.set_label("discs")
    ax.add_collection(discs, autolim=False)


def draw_pile(ax: Axes, scene: Scene, positions: FloatArray, unit: float) -> list[Artist]:
    """Discs and supports of a scene; the handles that explain them."""
    held = [any(h is not None for h in disc.held) for disc in scene.discs]
    draw_discs(ax, positions, disc_radii(scene), unit, held)
    _draw_supports(ax, scene, positions, unit)
    return held_handles(held)


def held_handles(held: Sequence[bool]) -> list[Artist]:
    """What explains the grey of held discs, where there are some."""
    if not any(held):
        return []
    return [
        Line2D(
            [],
            [],
            linestyle="none",
            marker="o",
            markersize=8,
            markerfacecolor=_HELD,
            markeredgecolor=_RIM,
            label="held disc",
        )
    ]


def _draw_supports(ax: Axes, scene: Scene, positions: FloatArray, unit: float) -> None:
    """The surface of every support, where discs touch it."""
    radii = disc_radii(scene)
    on_support: dict[tuple[DiscId, tuple[float, ...]], int] = {}
    for contact, disc in zip(scene.contacts, scene.ends[0].tolist(), strict=True):
        if contact.b in scene.supports:
            on_support[contact.b, tuple(float(n) for n in contact.normal)] = disc
    for (name, normal), disc in on_support.items():
        n = np.array(normal)
        draw_surface(ax, name, positions[disc] - radii[disc] * n, n, positions, unit)


def draw_surface(
    ax: Axes, name: DiscId, foot: FloatArray, n: FloatArray, positions: FloatArray, unit: float
) -> None:
    """A straight surface through a point, as long as the pile, with a band of ground behind it.

    The band also hides the round ends of the force lines, so it is drawn over them.
    """
    along = np.array([n[1], -n[0]])
    reach = (positions - foot) @ along
    ends = foot + np.outer([reach.min() - 1.3, reach.max() + 1.3], along)
    corners = np.concatenate([ends, ends[::-1] - 0.5 * n])
    ax.add_patch(Polygon(corners, color=_GROUND, linewidth=0, zorder=4))
    width = between(0.08 * unit, 0.5, 1.2)
    surface = Line2D(ends[:, 0], ends[:, 1], color=BLACK, linewidth=width, zorder=5)
    surface.set_label(f"_{name}")
    ax.add_line(surface)


def contact_segments(scene: Scene, positions: FloatArray) -> FloatArray:
    """The two ends of every contact: centre and centre, or centre and foot on the support."""
    a, b = scene.ends
    normals, which = scene.normals
    directions = np.array([[float(n) for n in normal] for normal in normals]).reshape(-1, 2)
    foot = positions[a] - disc_radii(scene)[a, None] * directions[which]
    return np.stack([positions[a], np.where(b[:, None] >= 0, positions[b], foot)], axis=1)


def draw_segments(
    ax: Axes,
    segments: FloatArray,
    label: str,
    widths: Sequence[float] | float,
    colours: Sequence[str] | str,
    dashes: Dashes = (),
    round_ends: bool = False,
) -> None:
    """Segments of shape (n, 2, 2) as one collection; `dashes` in multiples of the width."""
    lines = LineCollection(
        list(segments),
        linewidths=widths,
        colors=colours,
        linestyles=[(0.0, dashes)] if dashes else "solid",
        capstyle="round" if round_ends else "butt",
        zorder=2 if dashes else 3,
    )
    lines.set_label(label)
    ax.add_collection(lines, autolim=False)


def draw_arrows(
    ax: Axes, starts: FloatArray, vectors: FloatArray, name: str, label: str
) -> list[Artist]:
    """Arrows from the starts, the longest of 1.6 radii; the handle that explains them."""
    length = np.hypot(*drawable(vectors, "a vector").T)
    seen = length > 0
    arrows = vectors[seen] * (1.6 / length.max(initial=0.0) if seen.any() else 0.0)
    quiver = ax.quiver(
        starts[seen, 0],
        starts[seen, 1],
        arrows[:, 0],
        arrows[:, 1],
        angles="xy",
        scale_units="xy",
        scale=1,
        units="xy",
        width=0.1,
        minlength=0,
        color=RED,
        zorder=6,
    )
    quiver.set_label(name)
    arrow = Line2D([], [], linestyle="none", marker=r"$\rightarrow$", markersize=14, label=label)
    arrow.set_color(RED)
    return [arrow]


def line_handle(label: str, colour: str, width: float, dashes: Dashes = ()) -> Line2D:
    """A line for the legend."""
    return Line2D(
        [],
        [],
        color=colour,
        linewidth=width,
        linestyle=(0.0, dashes) if dashes else "solid",
        solid_capstyle="butt",
        label=label,
    )


def draw_legend(ax: Axes, handles: Sequence[Artist]) -> None:
    """The legend below the picture, in as many columns as have room there."""
    if handles:
        room = int(_size(ax)[0] / 1.4)  # inches an entry, about
        ax.legend(
            handles=handles,
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            borderaxespad=0.2,
            ncols=min(len(handles), max(room, 2)),
            frameon=False,
            fontsize=9,
            handlelength=2.6,
            columnspacing=1.8,
        )


def scene_title(scene: Scene) -> str:
    """Kind, N, and the parameters that are not at their defaults, in mathtext."""
    if scene.origin is None:
        return f"own scene, {len(scene.discs)} discs"
    changed = [p.title.format(mathtext(value)) for p, value in scene.origin.changed]
    return ", ".join([scene.origin.kind.title, *changed])


def mathtext(number: object) -> str:
    r"""An exact number as mathtext: 1/3*sqrt(3) is 1/3\sqrt{3}, and a sum is in brackets."""
    text = re.sub(r"\*?sqrt\((\d+)\)", r"\\sqrt{\1}", str(number))
    return f"({text})" if " " in text else text


def round_down(value: float) -> float:
    """The largest of ..., 0.5, 1, 2, 5, 10, 20, ... that is not above the value."""
    power = 10.0 ** floor(log10(value))
    return max(m for m in (1, 2, 5) if m * power <= value or m == 1) * power
