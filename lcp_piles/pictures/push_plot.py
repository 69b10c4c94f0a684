"""The pressure under the apex against the push, with the rearrangements marked."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..errors import InputError
from ..fields.base_pressure import base_pressure
from ..push.push_path import PushPath, force_curve
from ..scenes.parameters import FLOOR_COMPLIANCE
from .drawing import RED, drawable, scene_title


def draw_apex_pressure(path: PushPath, ax: Axes | None = None) -> Axes:
    """Draw the normal force on the base under the apex (w) against the push (w tau).

    It is the sum of forces from above on the disc, or the mean of the two discs, nearest to the
    axis; the curve is exact between its corners, since all forces are linear there. Raises
    `InputError` for a pile that has no movable disc on its base.
    """
    first = path.path.segments[0].first
    profile = base_pressure(path.solution(path.start + first * path.unit))
    nearest = min((abs(p.x) for p in profile), default=None)
    discs = [p.disc for p in profile if abs(p.x) == nearest]
    supports = path.scene.supports
    floor = [k for k, c in enumerate(path.scene.contacts) if c.a in discs and c.b in supports]
    if not floor:
        raise InputError("the number of movable discs on the floor", 0, "some", "add layers")
    if ax is None:
        ax = Figure(figsize=(8, 5), layout="constrained").add_subplot()
    pushes, curves = force_curve(path, floor)
    x = drawable([float(p) for p in pushes], "a push")
    y = drawable([[float(f) for f in curve] for curve in curves], "a force").mean(axis=0)
    ax.plot(x, y, color="black", linewidth=1.2)
    inner = slice(1, -1)
    # Ticks along the axis: points on the curve would lie over one another.
    at_axis = ax.get_xaxis_transform()
    ax.plot(
        *(x[inner], np.full(len(x[inner]), 0.02)),
        "|",
        color=RED,
        transform=at_axis,
        label="network changes",
    )
    scene = path.solution(path.start).scene
    title = scene_title(scene)
    if scene.origin is not None and FLOOR_COMPLIANCE not in dict(scene.origin.changed):
        title += ", " + FLOOR_COMPLIANCE.title.format(FLOOR_COMPLIANCE.default)
    ax.set_title(title, fontsize=11)
    ax.set_xlabel(r"push of each corner stone ($w\tau$)")
    ax.set_ylabel(r"force on the floor under the apex ($w$)")
    if len(x) > 2:
        ax.legend(frameon=False)
    return ax
