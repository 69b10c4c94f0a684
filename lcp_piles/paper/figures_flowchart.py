"""The paper's flowchart, as one run of its Z algorithm (section 4): a small pile an iteration."""

from __future__ import annotations

from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..files.tables import csv_text
from ..methods.z.z_algorithm import z_algorithm
from ..methods.z.z_iteration import ZStep
from ..numbers.vectors import FloatArray
from ..pictures.drawing import (
    BLACK,
    BLUE,
    ORANGE,
    RED,
    disc_positions,
    draw_segments,
    frame,
    line_handle,
)
from ..scenes.kinds import pile
from ..scenes.names import end_name
from ..scenes.scene import Scene
from ..scenes.symmetry import mirror
from .flowchart import draw_flowchart
from .plate import PAPERS_FLOOR, Plate, extent, panel_title

_COLUMNS = 2
_CHART = 3.4  # inches of the chart above the iterations
_LOOKS = {
    "present": (BLACK, 0.8, ()),
    "absent": ("#b0b0b0", 0.8, (2.0, 2.0)),
    "pulls: removed": (RED, 2.2, ()),
    "overlaps: returned": (ORANGE, 2.2, ()),
    "closest: put back for balance": (BLUE, 2.2, ()),
}


def flowchart_plate(kind: str, layers: int, floor_compliance: str = PAPERS_FLOOR) -> Plate:
    """The flowchart of the Z algorithm with a run on it, and below every iteration of that run."""
    scene = pile(kind, layers, floor_compliance=floor_compliance)
    result = z_algorithm(scene)
    across, up = extent(scene)
    width = 4.2
    height = width * (up + 2.8) / (across + 4) + 0.3
    lines = ceil(len(result.trace) / _COLUMNS)
    size = (width * _COLUMNS, height * lines + 1.0 + _CHART)
    figure = Figure(figsize=size, layout="constrained")
    grid = figure.add_gridspec(lines + 1, _COLUMNS, height_ratios=[_CHART, *[height] * lines])
    draw_flowchart(figure.add_subplot(grid[0, :]), result.trace)
    rows = []
    for number, step in enumerate(result.trace, 1):
        ax = figure.add_subplot(grid[1 + (number - 1) // _COLUMNS, (number - 1) % _COLUMNS])
        _draw_step(ax, scene, step)
        ax.set_title(_caption(number, step, result.status, number == len(result.trace)), fontsize=9)
        rows.append([number, *_row(scene, step)])
    handles = [line_handle(label, *look) for label, look in _LOOKS.items()]
    handles.append(Line2D([], [], linestyle="none", label="counts are those of one half"))
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False, fontsize=9)
    figure.suptitle(f"The Z algorithm on {panel_title(scene)}", fontsize=11)
    header = ["iteration", "absent", "put_back", "removed", "returned", "rank", "nullity"]
    return Plate(figure, {".csv": csv_text(header, rows)})


def _caption(number: int, step: ZStep, status: str, last: bool) -> str:
    parts = [f"{number}: {len(step.Z)} absent"]
    if step.reintroduced:
        parts.append(f"no solution: {len(step.reintroduced)} put back")
    if step.singular:
        parts.append(f"{step.nullity} free")
    if last:
        parts.append("nothing changes" if status == "solved" else status)
    else:
        parts.append(f"{len(step.removed)} removed, {len(step.returned)} returned")
    return "; ".join(parts)


def _draw_step(ax: Axes, scene: Scene, step: ZStep) -> None:
    """The contacts of the pile by what the step does with them."""
    segments = _segments(scene)
    image = mirror(scene)
    kind = np.full(len(scene.contacts), "present", dtype=object)
    for label, contacts in (
        ("absent", step.Z),
        ("closest: put back for balance", step.reintroduced),
        ("pulls: removed", step.removed),
        ("overlaps: returned", step.returned),
    ):
        for k in contacts:
            kind[k] = label
            if image is not None:
                kind[int(image.contacts[k])] = label
    frame(disc_positions(scene), ax)
    for label, (colour, width, dashes) in _LOOKS.items():
        if (kind == label).any():
            draw_segments(ax, segments[kind == label], label, width, colour, dashes)


def _segments(scene: Scene) -> FloatArray:
    """The two ends of every contact: centres, or a centre and the point one radius on."""
    positions = disc_positions(scene)
    a, b = scene.ends
    normals = np.array([[float(x) for x in contact.normal] for contact in scene.contacts])
    foot = positions[a] - normals
    return np.stack([positions[a], np.where(b[:, None] >= 0, positions[b], foot)], axis=1)


def _row(scene: Scene, step: ZStep) -> list[object]:
    def names(contacts: tuple[int, ...]) -> str:
        found = (scene.contacts[k] for k in contacts)
        return " ".join(f"{end_name(c.a)}-{end_name(c.b)}" for c in found)

    return [
        len(step.Z),
        names(step.reintroduced),
        names(step.removed),
        names(step.returned),
        step.rank,
        step.nullity,
    ]
