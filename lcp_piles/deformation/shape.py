"""A pile of round discs as it is: exact geometry in floating point, its energy and derivatives.

The unknowns are displacements u in units of w tau, positions being X + tau u, so that nothing
drowns for small tau: with Y = X_a - X_b, D = u_a - u_b and the distance d = |Y + tau D|, the gap of
two discs that touch at a distance S is, in units of w tau,

    gap = (d - S) / tau + o = (e + 2 Y . D + tau |D|^2) / (d + S) + o,     e = (|Y|^2 - S^2) / tau,

where e is exactly zero for contacts of the scene, which touch at rest but for their gap o. Energy
is counted in w times w tau, and its derivatives by u are forces in w.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import coo_array, csr_array

from ..errors import InputError
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.scene import Scene
from .laws import Law


@dataclass(frozen=True, eq=False)
class Shape:
    """Contacts that may be made, in floats: one row a contact, one freedom a disc and axis, flat.

    `apart` is Y (for a support the normal), `reach` is S, `excess` |Y|^2 - S^2 (for a support the
    height above it) in radii; `b` is -1 for a support. `free` marks freedoms, `held` are the
    displacements of the others (w tau).
    """

    scene: Scene
    a: IntArray
    b: IntArray
    apart: FloatArray
    reach: FloatArray
    excess: FloatArray
    compliance: FloatArray
    gap: FloatArray
    bilateral: np.ndarray[Any, np.dtype[np.bool_]]
    load: FloatArray
    free: np.ndarray[Any, np.dtype[np.bool_]]
    held: FloatArray


@dataclass(frozen=True, eq=False)
class Strained:
    """A shape under displacements u at a tau: gaps (w tau), forces (w), directions, energy.

    `directions` are unit vectors from b to a, `distances` those of the centres (infinite for
    supports); `stiffness` is what a contact's force grows by a unit of overlap; `unbalanced` is the
    force that is left on every freedom, flat, zero where it is held.
    """

    shape: Shape
    tau: float
    gaps: FloatArray
    forces: FloatArray
    directions: FloatArray
    distances: FloatArray
    stiffness: FloatArray
    energy: float
    unbalanced: FloatArray

    @property
    def residual(self) -> float:
        """The largest unbalanced force over the largest force or load."""
        largest = max(
            np.abs(self.forces).max(initial=0.0), np.abs(self.shape.load).max(initial=0.0)
        )
        return float(np.abs(self.unbalanced).max(initial=0.0) / (largest or 1.0))


def shape_of(scene: Scene) -> Shape:
    """The contacts of a scene as a shape. Rigid contacts are refused: they have no tau."""
    rigid = [c for c in scene.contacts if c.compliance == 0]
    if rigid:
        raise InputError(
            f"the compliance of {rigid[0].name}",
            0,
            "another number",
            "the nonlinear pile has no rigid contacts",
        )
    if not scene.geometric:
        raise InputError("geometric", False, "True", "round discs need real positions")
    a, b = scene.ends
    values, which = scene.normals
    dimension = scene.dimension
    normals = np.array([[float(x) for x in n] for n in values]).reshape(-1, dimension)[which]
    positions = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    between = b >= 0
    lengths = np.where(
        between, (normals * (positions[a] - positions[np.maximum(b, 0)])).sum(axis=1), 1.0
    )
    contacts = scene.contacts
    held = [h for disc in scene.discs for h in disc.held]
    return Shape(
        scene,
        a,
        b,
        normals * lengths[:, None],
        lengths,
        np.zeros(len(a)),
        np.array([float(c.compliance) for c in contacts]),
        np.array([float(c.gap) for c in contacts]),
        np.array([c.bilateral for c in contacts], dtype=bool),
        np.array([float(p) for disc in scene.discs for p in disc.load]),
        np.array([h is None for h in held], dtype=bool),
        np.array([float(h) if h else 0.0 for h in held]),
    )


def strained(shape: Shape, u: FloatArray, tau: float, law: Law) -> Strained:
    """The shape under displacements u (w tau, flat) at a compliance tau (radii a disc weight)."""
    dimension = shape.scene.dimension
    places = u.reshape(-1, dimension)
    between = shape.b >= 0
    D = places[shape.a] - np.where(between[:, None], places[np.maximum(shape.b, 0)], 0.0)
    now = shape.apart + tau * D
    distances = np.sqrt((now**2).sum(axis=1))
    along = (shape.apart * D).sum(axis=1)
    round_ = (shape.excess / tau + 2 * along + tau * (D**2).sum(axis=1)) / (distances + shape.reach)
    gaps = np.where(between, round_, along + shape.excess / tau) + shape.gap
    directions = np.where(between[:, None], now / distances[:, None], shape.apart)
    x = -gaps / shape.compliance
    one_sided = law.force(x), law.stiffness(x), law.energy(x)
    forces, stiffness, energy = (
        np.where(shape.bilateral, linear, single)
        for linear, single in zip((x, np.ones_like(x), x * x / 2), one_sided, strict=True)
    )
    pushes = forces[:, None] * directions
    total = shape.load.reshape(-1, dimension).copy()
    for axis in range(dimension):
        total[:, axis] += np.bincount(shape.a, pushes[:, axis], len(places))
        total[:, axis] -= np.bincount(shape.b[between], pushes[between, axis], len(places))
    return Strained(
        shape,
        tau,
        gaps,
        forces,
        directions,
        np.where(between, distances, np.inf),
        stiffness / shape.compliance,
        float((shape.compliance * energy).sum() - shape.load @ u),
        np.where(shape.free, total.ravel(), 0.0),
    )


def hessian(state: Strained) -> csr_array:
    """The second derivative of the energy by the free displacements.

    A contact adds (df/d overlap) e e^T - (f tau / d) (1 - e e^T) to its relative displacement: its
    stiffness along the normal, and across it what its force loses as the discs slide past each
    other.
    """
    shape = state.shape
    dimension = shape.scene.dimension
    acting = np.flatnonzero((state.stiffness != 0) | (state.forces != 0))
    e = state.directions[acting]
    across = state.forces[acting] * state.tau / state.distances[acting]
    along = state.stiffness[acting] + across
    blocks = along[:, None, None] * e[:, :, None] * e[:, None, :]
    blocks -= across[:, None, None] * np.eye(dimension)
    a, b = shape.a[acting], shape.b[acting]
    number = np.cumsum(shape.free) - 1
    rows, columns, data = [], [], []
    for one, two, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
        there = np.flatnonzero((one >= 0) & (two >= 0))
        for i in range(dimension):
            for j in range(dimension):
                row, column = one[there] * dimension + i, two[there] * dimension + j
                both = shape.free[row] & shape.free[column]
                rows.append(number[row[both]])
                columns.append(number[column[both]])
                data.append(sign * blocks[there[both], i, j])
    size = int(shape.free.sum())
    entries = (np.concatenate(data), (np.concatenate(rows), np.concatenate(columns)))
    return csr_array(coo_array(entries, shape=(size, size)))
