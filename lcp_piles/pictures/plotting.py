"""Pictures of piles and force networks, as the paper draws them.

Every function draws on the matplotlib Axes that it is given, or on those of a new figure, and
returns them. Nothing here needs a screen: no window is opened and no global setting is changed.
Discs stand on their lattice points; lengths are in disc radii R, forces in disc weights w.

Widths of lines are in points and fitted to the size of the axes at the time of drawing, so a
figure gets its size first and its picture then.
"""

from __future__ import annotations

from io import BytesIO
from math import log1p
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..errors import InputError
from ..files.safe_write import write_bytes
from ..numbers.vectors import FloatArray
from ..scenes.names import end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution, Solved
from .drawing import (
    BLACK,
    BLUE,
    GREEN,
    RED,
    Dashes,
    between,
    contact_segments,
    disc_positions,
    disc_radii,
    draw_arrows,
    draw_legend,
    draw_pile,
    draw_segments,
    drawable,
    frame,
    line_handle,
    round_down,
    scene_title,
)

if TYPE_CHECKING:
    import os

_DATELESS = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "svgz": {"Date": None}}

HAIRLINE = 0.25
"""Width in points of the thinnest line of a force: thinner ones would not be seen."""
USUAL = 10.0
"""Forces above so many medians share the widest line, unless another limit is given."""


def draw_network(
    solution: Solution,
    ax: Axes | None = None,
    *,
    log_width: bool = False,
    clip: float | None = None,
    legend: bool = True,
) -> Axes:
    """The force network of a solution: contacts between disc centres, as wide as their forces.

    Full lines are contacts with force, dashed ones open contacts, dash-dot ones osculatory ones;
    discs with a prescribed motion are grey, and contacts with a support end on its surface. The
    width grows with the force f, or with log(1 + f/w) if `log_width`, from `HAIRLINE` up; the
    legend shows the width of a known force. Forces above `clip` (w) are all drawn as wide as that
    one, so that a single strong chain does not thin out all others; without it, those above `USUAL`
    times the median are, and infinity clips none. Negative forces, which only a bilateral contact
    has, are red. An unstable scene has no forces: arrows show how it gives way. A second line of
    the title names a saddle, and how many gaps are not the only possible ones.

    Raises `InputError` for a scene that is not plane. Source: Oron and Herrmann, section 4.

    >>> from lcp_piles import nt60, solve
    >>> draw_network(solve(nt60(3))).get_title()
    'NT60, $N = 3$'
    """
    scene = solution.scene
    positions = disc_positions(scene)
    ax, unit = frame(positions, ax, disc_radii(scene))
    handles: list[Artist] = []
    title = scene_title(scene)
    if solution.status == "solved":
        segments, states = contact_segments(scene, positions), np.array(solution.states)
        forces = solution.force_array
        handles += draw_contacts(ax, segments, states, forces, unit, log_width, clip)
        title = "\n".join([title, *_remark(solution)])
    else:
        title += f": {solution.status}"
    if solution.status == "unstable":
        handles += draw_arrows(
            ax,
            positions,
            solution.collapse.array().reshape(-1, 2),
            "collapse",
            "collapse motion (arbitrary scale)",
        )
    handles += draw_pile(ax, scene, positions, unit)
    ax.set_title(title, fontsize=11)
    if legend:
        draw_legend(ax, handles)
    return ax


def draw_scene(scene: Scene, ax: Axes | None = None, *, labels: bool = True) -> Axes:
    """The discs of a scene with their indices (i, j) on them, the held ones grey.

    Raises `InputError` for a scene that is not plane. Source: Oron and Herrmann, section 2.

    >>> from lcp_piles import tbs
    >>> [text.get_text() for text in draw_scene(tbs(1)).texts]
    ['(1,1)', '(2,1)', '(2,2)', '(3,1)', '(3,2)', '(3,3)']
    """
    positions = disc_positions(scene)
    ax, unit = frame(positions, ax, disc_radii(scene))
    draw_legend(ax, draw_pile(ax, scene, positions, unit))
    ax.set_title(scene_title(scene), fontsize=11)
    if labels:
        names = [end_name(disc.id) for disc in scene.discs]
        # A character is about 0.55 of the font size wide, and the longest name gets 1.7 radii.
        size = min(1.7 * unit / (0.55 * max(map(len, names))), 11)
        for name, (x, y) in zip(names, positions.tolist(), strict=True):
            ax.text(x, y, name, size=size, ha="center", va="center_baseline", zorder=6)
    return ax


def save(picture: Axes | Figure, path: str | os.PathLike[str], dpi: float = 150) -> None:
    """Write the figure of a picture to a file: PNG, PDF, SVG or what else matplotlib writes.

    The ending of `path` says which; `dpi` matters for pixels only. The file is there whole or not
    at all, and the same picture makes the same bytes: PDF and SVG get no date. Raises `InputError`
    for an ending that matplotlib cannot write and for a path that cannot be written.
    """
    figure = picture.get_figure(root=True) if isinstance(picture, Axes) else picture
    if not isinstance(figure, Figure):
        raise InputError("the picture", picture, "matplotlib Axes or a Figure")
    endings = figure.canvas.get_supported_filetypes()
    ending = Path(path).suffix.removeprefix(".").lower()
    if ending not in endings:
        raise InputError("the path of the picture", str(path), "an ending of " + ", ".join(endings))
    if not 0 < dpi <= 1200:
        raise InputError("dpi", dpi, "a number above 0, up to 1200")
    page = BytesIO()
    try:
        with rc_context({"svg.hashsalt": "lcp-piles"}):
            figure.savefig(
                page, dpi=dpi, format=ending, bbox_inches="tight", metadata=_DATELESS.get(ending)
            )
    except (RuntimeError, ValueError) as fault:
        raise InputError(
            "the picture", "one that matplotlib cannot draw", "another size or ending", str(fault)
        ) from fault
    write_bytes(path, page.getvalue())


def draw_contacts(
    ax: Axes,
    segments: FloatArray,
    states: np.ndarray,
    force_of: FloatArray,
    unit: float,
    log_width: bool = False,
    clip: float | None = None,
    force_unit: str = " $w$",
) -> list[Artist]:
    """Lines for contacts by their states; the handles that explain them.

    Shapes: `segments` (contacts, 2, 2), `states` and `force_of` (contacts,).
    """
    forces = drawable(force_of, "a force")[states == "closed"].tolist()
    strongest = max(map(abs, forces), default=0.0)
    largest = strongest if log_width else min(strongest, _limit(forces, clip))
    widest = between(0.7 * unit, 0.8, 10)

    def width(force: float) -> float:
        if not largest:  # all forces are too small to be floats
            return HAIRLINE
        share = log1p(force) / log1p(largest) if log_width else min(force / largest, 1.0)
        return max(widest * share, HAIRLINE)

    handles: list[Artist] = []
    if forces:
        colours = [BLACK if f > 0 else RED for f in forces]
        widths = [width(abs(f)) for f in forces]
        draw_segments(ax, segments[states == "closed"], "closed", widths, colours, round_ends=True)
        for f in _reference_forces(largest, log_width) if largest else ():
            handles.append(line_handle(f"force {f:g}{force_unit}", BLACK, width(f)))
        if largest < strongest:
            label = f"force {largest:.3g} to {strongest:.3g}{force_unit}"
            handles.append(line_handle(label, BLACK, width(largest)))
        if RED in colours:
            handles.append(line_handle("tension", RED, 2))
    thin = between(0.06 * unit, 0.35, 1.1)
    # Pieces of dashes as parts of the distance of two centres: alike in pictures of every size.
    looks: tuple[tuple[str, str, str, Dashes], ...] = (
        ("open", "open contact", RED, (0.12, 0.08)),
        ("osculatory", "osculatory contact", BLUE, (0.18, 0.06, 0.03, 0.06)),
        ("unproved", "contact not told", GREEN, (0.03, 0.06)),
    )
    for state, label, colour, parts in looks:
        if (states == state).any():
            dashes = tuple(part * 2 * unit / thin for part in parts)
            draw_segments(ax, segments[states == state], state, thin, colour, dashes)
            handles.append(line_handle(label, colour, 1.1, tuple(part * 32 for part in parts)))
    return handles


def _limit(forces: list[float], clip: float | None) -> float:
    """The force from which on lines are equally wide; `InputError` for one that is not positive."""
    if clip is not None and not clip > 0:
        raise InputError("clip", clip, "a force above 0, in disc weights")
    return USUAL * float(np.median(np.abs(forces or [0.0]))) if clip is None else clip


def _remark(solution: Solved) -> list[str]:
    """What the network alone does not show: that it is no minimum, or not the only one."""
    parts = []
    if solution.stability is not None and solution.stability.verdict == "saddle":
        parts.append("a saddle of the energy")
    moving = solution.gap_unique.count(False)
    if moving:
        parts.append(f"{moving} gaps not unique")
    return [", ".join(parts)] if parts else []


def _reference_forces(largest: float, log_width: bool) -> list[float]:
    """Round forces for the legend: w where its line is wide enough to see, else a multiple."""
    shown = 1.0 if 1 <= largest <= 5 else round_down(largest / 2 if largest > 1 else largest)
    return [1.0, shown] if log_width and shown > 1 else [shown]
