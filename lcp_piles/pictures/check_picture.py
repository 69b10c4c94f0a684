"""The picture of a check: where given forces are larger or smaller than ours."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_hex

from ..checking.check import Check
from ..errors import InputError
from ..packings.packing import Packing
from ..scenes.scene import Scene
from .drawing import (
    BLACK,
    between,
    contact_segments,
    disc_positions,
    disc_radii,
    draw_legend,
    draw_pile,
    draw_segments,
    drawable,
    frame,
    line_handle,
    page,
    scene_title,
)
from .packing_picture import Stage, packing_stage

_SHOWN = 1e-3  # of the largest difference: what is less is drawn as nothing


def draw_check(check: Check, ax: Axes | None = None) -> Axes:
    """Every contact in the colour of its difference, given minus ours, as wide as its size.

    Contacts that are named wrongly have a black rim, all others that differ by nothing to speak of
    are thin and grey. Raises `InputError` for a scene that is not plane or has no forces.

    >>> from lcp_piles import check, nt60
    >>> forces = {((1, 1), (2, 1)): 0.5, ((1, 1), (2, 2)): 0.6}
    >>> draw_check(check(nt60(2), forces)).get_title()
    'NT60, $N = 2$: given forces minus ours'
    """
    if check.verdict == "nothing to compare":
        raise InputError("the verdict of the check", check.verdict, "forces on both sides")
    stage = _stage(check.scene, ax)
    ax, unit, segments, which = stage.ax, stage.unit, stage.segments, stage.which
    difference = drawable(check.difference, "a difference")[which]
    largest = check.largest
    seen = np.abs(difference) > _SHOWN * largest
    thin, widest = between(0.06 * unit, 0.35, 1.1), between(0.7 * unit, 1.5, 10)
    widths = np.maximum(widest * np.abs(difference) / (largest or 1.0), 2 * thin)
    norm, colours = Normalize(-largest or -1.0, largest or 1.0), colormaps["RdBu_r"]
    draw_segments(ax, segments[~seen], "equal", thin, "#8a8a8a")
    rim = np.isin(which, check.wrong)
    if rim.any():
        around = (widths[rim] + 2 * between(0.1 * unit, 0.8, 1.6)).tolist()
        draw_segments(ax, segments[rim], "named wrongly", around, BLACK)
    shades = [to_hex(colour) for colour in colours(norm(difference[seen]))]
    draw_segments(ax, segments[seen], "differences", widths[seen].tolist(), shades)
    handles = [*stage.handles, line_handle("no difference", "#8a8a8a", thin)]
    if rim.any():
        handles.append(line_handle("open or closed wrongly", BLACK, 4))
    ax.set_title(f"{stage.title}: given forces minus ours", fontsize=11)
    bar = page(ax).colorbar(ScalarMappable(norm, colours), ax=ax, shrink=0.7, pad=0.02)
    own = isinstance(check.scene, Packing)
    bar.set_label("difference of the force" + ("" if own else " ($w$)"))
    draw_legend(ax, handles)
    return ax


def _stage(scene: Scene | Packing, ax: Axes | None) -> Stage:
    """Discs and supports, drawn, of either."""
    if isinstance(scene, Packing):
        return packing_stage(scene, ax)
    positions = disc_positions(scene)
    ax, unit = frame(positions, ax, disc_radii(scene))
    handles = draw_pile(ax, scene, positions, unit)
    segments = contact_segments(scene, positions)
    which = np.arange(len(segments))
    return Stage(ax, unit, positions, which, segments, handles, scene_title(scene))
