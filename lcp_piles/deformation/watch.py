"""Whom discs may meet when they move far: all pairs that are near, and the supports below them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import InputError
from ..numbers.vectors import FloatArray, IntArray, Mask
from ..scenes.scene import Scene
from .shape import Shape, shape_of

NEAR = 0.5
"""Discs whose surfaces are nearer than this (radii) are watched."""
_ON_LATTICE = 1e-9


@dataclass(frozen=True, eq=False)
class Crowd:
    """Equal discs of one compliance: the contacts of a scene, and what others may be made.

    `planes` are the supports: the normal, the level of a disc's centre that rests there, the
    compliance, and which discs the scene lets rest on it.
    """

    shape: Shape
    positions: FloatArray
    fixed: Mask
    compliance: float
    planes: list[tuple[FloatArray, float, float, IntArray]]


def crowd_of(scene: Scene) -> Crowd:
    """The discs of a scene as a crowd; `InputError` where they are not equal."""
    shape = shape_of(scene)
    between = shape.b >= 0
    soft = np.unique(shape.compliance[between])
    equal = all(disc.radius == 1 for disc in scene.discs)
    equal = equal and not (np.abs(shape.reach[between] - 2) > 1e-12).any()
    if shape.bilateral.any() or len(soft) > 1 or not equal:
        raise InputError(
            "the scene",
            scene,
            "discs of radius 1 and of one compliance, whose contacts may all open",
            "only such discs can be followed while they meet others",
        )
    positions = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    rests: dict[tuple[object, ...], list[int]] = {}
    for k in np.flatnonzero(~between).tolist():
        normal = shape.apart[k]
        level = round(float(normal @ positions[shape.a[k]]), 9)
        key = (scene.contacts[k].b, *normal.tolist(), level, shape.compliance[k])
        rests.setdefault(key, []).append(k)
    planes = [
        (
            shape.apart[rows[0]],
            float(shape.apart[rows[0]] @ positions[shape.a[rows[0]]]),
            float(shape.compliance[rows[0]]),
            shape.a[rows],
        )
        for rows in rests.values()
    ]
    fixed = np.array([disc.fixed for disc in scene.discs], dtype=bool)
    return Crowd(shape, positions, fixed, float(soft[0]) if len(soft) else 1.0, planes)


def watched(crowd: Crowd, u: FloatArray, tau: float) -> Shape:
    """The contacts of the scene, and those that discs displaced by u (w tau, flat) are near to."""
    from scipy.spatial import cKDTree  # slow to import, needed for slides only

    shape, X = crowd.shape, crowd.positions
    now = X + tau * u.reshape(X.shape)
    pairs = cKDTree(now).query_pairs(2 + NEAR, output_type="ndarray").reshape(-1, 2)
    low, high = np.minimum(shape.a, shape.b), np.maximum(shape.a, shape.b)
    known = set((low * len(X) + high)[shape.b >= 0].tolist())
    new = [int(i) * len(X) + int(j) not in known for i, j in pairs]
    pairs = pairs[np.array(new, dtype=bool) & ~crowd.fixed[pairs].all(axis=1)]
    apart = X[pairs[:, 0]] - X[pairs[:, 1]]
    excess = (apart**2).sum(axis=1) - 4
    one, two = pairs[:, 0], pairs[:, 1]
    found = [shape, _rows(shape, one, two, apart, 2.0, excess, crowd.compliance)]
    for normal, level, compliance, resting in crowd.planes:
        near = np.flatnonzero((now @ normal - level < NEAR) & ~crowd.fixed)
        near = np.setdiff1d(near, resting)
        none, normals = np.full(len(near), -1), np.tile(normal, (len(near), 1))
        height = X[near] @ normal - level
        found.append(_rows(shape, near, none, normals, 1.0, height, compliance))
    return _joined(found)


def _rows(
    shape: Shape,
    a: IntArray,
    b: IntArray,
    apart: FloatArray,
    reach: float,
    excess: FloatArray,
    compliance: float,
) -> Shape:
    """A shape of the same discs with these contacts."""
    size = len(a)
    return replace(
        shape,
        a=a,
        b=b,
        apart=apart,
        reach=np.full(size, reach),
        excess=np.where(np.abs(excess) < _ON_LATTICE, 0.0, excess),
        compliance=np.full(size, compliance),
        gap=np.zeros(size),
        bilateral=np.zeros(size, dtype=bool),
    )


def _joined(shapes: list[Shape]) -> Shape:
    """One shape with the contacts of all, in order."""
    return replace(
        shapes[0],
        a=np.concatenate([s.a for s in shapes]),
        b=np.concatenate([s.b for s in shapes]),
        apart=np.concatenate([s.apart for s in shapes]),
        reach=np.concatenate([s.reach for s in shapes]),
        excess=np.concatenate([s.excess for s in shapes]),
        compliance=np.concatenate([s.compliance for s in shapes]),
        gap=np.concatenate([s.gap for s in shapes]),
        bilateral=np.concatenate([s.bilateral for s in shapes]),
    )
