"""Pictures of packings in floats, with their forces or the motion along which they fall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ..errors import InputError
from ..methods.contact_proof import ContactProof
from ..numbers.vectors import FloatArray, IntArray
from ..packings.packing import Geometry, Packing
from .drawing import (
    check_plane,
    draw_arrows,
    draw_discs,
    draw_legend,
    draw_surface,
    frame,
    held_handles,
)
from .plotting import draw_contacts


def draw_packing(proof: ContactProof, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """The forces of a packing: contacts between disc centres, as wide as their forces.

    As `draw_network`, with lengths in the mean radius; contacts that could not be told are dotted.
    A contact across the period is drawn at both ends. Raises `InputError` for spheres, and for
    contacts without positions.

    >>> from lcp_piles import packing, prove_packing
    >>> draw_packing(prove_packing(packing([(0, 1)], 1, supports={"floor": 0}))).get_title()
    'packing, 1 disc'
    """
    packing = proof.scene
    if not isinstance(packing, Packing):
        raise InputError("the packing", packing, "one with positions")
    stage = packing_stage(packing, ax)
    handles: list[Artist] = []
    if proof.collapse is None:
        states = np.where(proof.loaded, "closed", "open").astype("U10")
        states[list(proof.unproved)] = "unproved"
        force = np.abs(proof.forces.middle)
        which = stage.which
        handles += draw_contacts(
            stage.ax, stage.segments, states[which], force[which], stage.unit, force_unit=""
        )
    else:
        label = "collapse motion (arbitrary scale)"
        handles += draw_arrows(stage.ax, stage.positions, proof.collapse, "collapse", label)
    title = stage.title if proof.collapse is None else stage.title + ": no forces"
    stage.ax.set_title(title, fontsize=11)
    if legend:
        draw_legend(stage.ax, [*handles, *stage.handles])
    return stage.ax


@dataclass(frozen=True, eq=False)
class Stage:
    """Discs and walls of a packing, drawn, and what there is to draw on them.

    Lengths are in the mean radius. `segments` (n, 2, 2) are those of the contacts `which`.
    """

    ax: Axes
    unit: float
    positions: FloatArray
    which: IntArray
    segments: FloatArray
    handles: list[Artist]
    title: str


def packing_stage(packing: Packing, ax: Axes | None) -> Stage:
    """Draw the discs and walls of a packing; `InputError` for one that is not plane or placed."""
    if packing.geometry is None:
        raise InputError("the packing", packing, "one with positions")
    check_plane(packing.dimension)
    geometry = packing.geometry
    scale = float(geometry.radii.mean())
    positions, radii = geometry.centres / scale, geometry.radii / scale
    ax, unit = frame(positions, ax, radii)
    held = [any(motions) for motions in packing.held.tolist()]
    draw_discs(ax, positions, radii, unit, held)
    for name, wall in geometry.walls.items():
        n = np.array(wall.normal) / np.linalg.norm(wall.normal)
        foot = np.array(wall.point) / scale
        draw_surface(ax, name, foot, n, positions, unit)
    which, segments = _segments(packing, geometry)
    count = len(packing.ids)
    title = f"packing, {count} disc{'' if count == 1 else 's'}"
    return Stage(ax, unit, positions, which, segments / scale, held_handles(held), title)


def _segments(packing: Packing, geometry: Geometry) -> tuple[IntArray, FloatArray]:
    """The two ends of contacts, and which contact each is of: those across the period stand twice.

    From a centre to the other, or to the foot on a wall.
    """
    a, b, n = packing.a, packing.b, packing.normals.high
    between = b >= 0
    other = np.where(between, geometry.radii[b], 0.0)
    reach = geometry.radii[a] + other + packing.gaps.high
    start = geometry.centres[a]
    segments = np.stack([start, start - n * reach[:, None]], axis=1)
    far = np.flatnonzero(geometry.image)
    end = geometry.centres[b[far]]
    again = np.stack([end, end + n[far] * reach[far, None]], axis=1)
    return np.append(np.arange(len(a)), far), np.concatenate([segments, again])
