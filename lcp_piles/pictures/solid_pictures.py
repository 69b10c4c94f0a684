"""Pictures of piles of spheres: the force network in space, and what the base bears, from above.

Lengths are in sphere radii R, forces in sphere weights w.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Line3DCollection  # type: ignore[import-untyped]

from ..errors import InputError
from ..fields.base_load import base_load
from ..numbers.vectors import FloatArray
from ..scenes.scene import Scene
from ..solution.solution import Solution, Solved
from .drawing import BLACK, BLUE, GREY, RED, between, drawable, page, scene_title

_COLOURS = "viridis"
_MOST_NUMBERS = 60
"""Loads are written on the places of a base map where there are no more than these."""


def draw_solid(solution: Solution) -> Figure:
    """The force network of a pile of spheres beside the map of its base.

    Spheres are dots, the held ones grey. An unstable scene has no forces: arrows show its collapse.
    Raises `InputError` for a scene that is not in three dimensions.

    >>> from lcp_piles import pyramid, solve
    >>> len(draw_solid(solve(pyramid(2))).axes)
    3
    """
    scene = solution.scene
    positions = _positions(scene)
    solved = solution.status == "solved"
    figure = Figure(figsize=(10 if solved else 6, 5.2), layout="constrained")
    ax: Any = figure.add_subplot(1, 2 if solved else 1, 1, projection="3d")
    title = scene_title(scene)
    if solution.status == "solved":
        draw_forces(solution, ax)
        draw_base_map(solution, figure.add_subplot(1, 2, 2))
    else:
        _frame(ax, scene, positions)
        title += f": {solution.status}"
    if solution.status == "unstable":
        moves = drawable(solution.collapse.array(), "a motion").reshape(-1, 3)
        longest = np.sqrt((moves**2).sum(axis=1)).max()
        moving = moves.any(axis=1)
        starts, arrows = positions[moving], moves[moving] * (2 / longest)
        ax.quiver(*starts.T, *arrows.T, color=RED, linewidths=1.2, arrow_length_ratio=0.35)
        ax.set_title("collapse motion (arbitrary scale)", fontsize=10)
    figure.suptitle(title, fontsize=11)
    return figure


def draw_forces(solution: Solved, ax: Any) -> Any:
    """The contacts with force between the centres, as wide as their forces, on 3D axes."""
    scene = solution.scene
    positions = _positions(scene)
    _frame(ax, scene, positions)
    forces = drawable(solution.force_array, "a force")
    a, b = scene.ends
    normals, which = scene.normals
    directions = np.array([[float(n) for n in normal] for normal in normals]).reshape(-1, 3)
    feet = np.where(b[:, None] >= 0, positions[b], positions[a] - directions[which])
    segments = np.stack([positions[a], feet], axis=1)
    loaded = np.array(solution.states, dtype=object) == "closed"
    size = np.abs(forces[loaded])
    # Thinner in larger piles, whose lines would cover one another.
    widest = between(32 / np.ptp(positions, axis=0).max(), 0.8, 4)
    widths = np.maximum(widest * size / size.max(initial=1e-300), 0.15)
    colours = np.where(forces[loaded] > 0, BLACK, RED)
    lines = Line3DCollection(segments[loaded], linewidths=widths, colors=colours.tolist())
    ax.add_collection3d(lines, autolim=False)
    if size.size:
        ax.set_title(f"contact forces, the largest {size.max():.4g} $w$", fontsize=10)
    return ax


def draw_base_map(solution: Solved, ax: Axes) -> Axes:
    """What every place of the base bears, seen from above, in colours and, if few, in numbers."""
    places = base_load(solution)
    if not places or len(places[0].across) != 2:
        raise InputError("the scene", solution.scene, "one of spheres on a base")
    loads = drawable([float(p.load) for p in places], "a load")
    centres = np.array([[float(x) for x in p.across] for p in places])
    diameter = [2.0] * len(places)
    discs = EllipseCollection(
        diameter,
        diameter,
        [0.0] * len(places),
        units="xy",
        offsets=centres,
        offset_transform=ax.transData,
        array=loads,
        cmap=_COLOURS,
        edgecolors="white",
        linewidths=0.5,
    )
    ax.add_collection(discs, autolim=False)
    low, high = centres.min(axis=0) - 1.3, centres.max(axis=0) + 1.3
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    ax.set_xlabel("$x$  ($R$)")
    ax.set_ylabel("$y$  ($R$)")
    ax.set_title("load on the base", fontsize=10)
    page(ax).colorbar(discs, ax=ax, shrink=0.75, label="load  ($w$)")
    if len(places) <= _MOST_NUMBERS:
        middle = (loads.min() + loads.max()) / 2
        size = between(60 / np.sqrt(len(places)), 6, 10)
        for (x, y), load in zip(centres.tolist(), loads.tolist(), strict=True):
            colour = "white" if load <= middle else "black"
            ax.text(x, y, f"{load:.3g}", size=size, color=colour, ha="center", va="center")
    return ax


def _positions(scene: Scene) -> FloatArray:
    if scene.dimension != 3:
        raise InputError("the number of axes", scene.dimension, "3, for a pile of spheres")
    return drawable([[float(x) for x in disc.position] for disc in scene.discs], "a position")


def _frame(ax: Any, scene: Scene, positions: FloatArray) -> None:
    """A view of all spheres from the side: dots at their centres, the held ones larger and grey."""
    low, high = positions.min(axis=0) - 1, positions.max(axis=0) + 1
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.set_box_aspect(tuple((high - low).tolist()), zoom=1.25)
    ax.view_init(elev=16, azim=-66)
    ax.set_axis_off()
    held = np.array([disc.fixed for disc in scene.discs])
    size = between(2000 / len(held), 3, 60)
    for chosen, colour, area, name in (
        (~held, BLUE, size / 2, "centre of a sphere"),
        (held, GREY, size, "held sphere"),
    ):
        if chosen.any():
            dots = ax.scatter(*positions[chosen].T, s=area, c=colour, depthshade=False, label=name)
            dots.set_linewidth(0)
    ax.legend(loc="lower left", bbox_to_anchor=(0, -0.06), frameon=False, fontsize=8)
