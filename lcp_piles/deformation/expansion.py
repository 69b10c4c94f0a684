"""The geometry of round discs to second order, in exact vectors.

Two discs whose centres stand L n apart at rest, and whose relative displacement is tau D, stand

    |L n + tau D| = L + tau n . D + tau^2 |s|^2 / (2 L) + O(tau^3),      s = D - (n . D) n,

apart, and the direction between them is n + tau s / L + O(tau^2). A support is a plane: its
distance has no second order and its normal does not turn, so only contacts between discs are here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from flint import fmpz

from ..errors import InputError
from ..mechanics.system import ContactSystem
from ..numbers.exact import ONE, Surd
from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector, IntArray, combination, distinct, exact_vector
from ..scenes.scene import Scene

Components = list[ExactVector]
"""A vector a contact: for each axis its components, one a contact."""


@dataclass(frozen=True, eq=False)
class Joints:
    """Contacts between discs: which of the scene's they are, their normals, and 1 / L."""

    scene: Scene
    contacts: IntArray
    normals: Components
    inverse_lengths: ExactVector


def joints_of(scene: Scene) -> Joints:
    """What the second order needs of the contacts that join two discs.

    >>> from lcp_piles import nt60
    >>> [str(x) for x in joints_of(nt60(2)).inverse_lengths]
    ['1/2', '1/2']
    """
    if not scene.geometric:
        raise InputError(
            "geometric", False, "True", "finite stiffness asks how discs really stand to each other"
        )
    contacts = np.flatnonzero(scene.ends[1] >= 0)
    normals = normals_of(scene, contacts)
    positions = shared_vector([x for disc in scene.discs for x in disc.position])
    lengths = along(normals, relative(scene, contacts, positions))
    inverse: dict[tuple[int, ...], Surd] = {}
    columns = list(zip(*lengths.numerators.values(), strict=True))
    for k, key in enumerate(columns):
        if key not in inverse:
            inverse[key] = 1 / lengths[k]
    return Joints(scene, contacts, normals, shared_vector([inverse[key] for key in columns]))


def some_of(joints: Joints, kept: IntArray) -> Joints:
    """The joints at these places of the list."""
    ones = np.ones(len(kept), dtype=np.int64)
    return Joints(
        joints.scene,
        joints.contacts[kept],
        [n.take(kept, ones) for n in joints.normals],
        joints.inverse_lengths.take(kept, ones),
    )


def normals_of(scene: Scene, contacts: IntArray) -> Components:
    """The normals of contacts."""
    values, which = scene.normals
    ones = np.ones(len(contacts), dtype=np.int64)
    return [
        exact_vector([n[axis] for n in values]).take(which[contacts], ones)
        for axis in range(scene.dimension)
    ]


def shared_vector(values: Sequence[Surd | Fraction]) -> ExactVector:
    """`exact_vector` of many numbers of which few differ."""
    different, which = distinct(values)
    return exact_vector(different).take(which, np.ones(len(which), dtype=np.int64))


def relative(scene: Scene, contacts: IntArray, vectors: ExactVector) -> Components:
    """The vector of disc a less that of b (zero for a support), of one vector a disc, flat.

    The vectors are without factors (`ExactVector.plain`), as everywhere in this module.
    """
    a, b = (ends[contacts].tolist() for ends in scene.ends)
    components = []
    for axis in range(scene.dimension):
        parts = {r: x[axis :: scene.dimension] for r, x in vectors.numerators.items()}
        numerators = {1: [fmpz(0)] * len(contacts)}
        for r, column in parts.items():
            if any(column):
                moved = [*column, fmpz(0)]  # a support stands at the end, where b = -1 leads
                numerators[r] = [moved[i] - moved[j] for i, j in zip(a, b, strict=True)]
        components.append(ExactVector(numerators, vectors.denominator))
    return components


def along(normals: Components, vectors: Components) -> ExactVector:
    """The scalar products, one a contact."""
    return combination([(ONE, product(n, v)) for n, v in zip(normals, vectors, strict=True)])


def sliding(joints: Joints, displacements: ExactVector) -> Components:
    """s, the relative displacement across the normal, for displacements of all discs, flat."""
    apart = relative(joints.scene, joints.contacts, displacements)
    stretch = along(joints.normals, apart)
    return [
        combination([(ONE, d), (-ONE, product(n, stretch))])
        for n, d in zip(joints.normals, apart, strict=True)
    ]


def lengthening(joints: Joints, s: Components) -> ExactVector:
    """|s|^2 / (2 L), one a contact."""
    squares = combination([(ONE / 2, product(x, x)) for x in s])
    return product(squares, joints.inverse_lengths)


def turned_load(system: ContactSystem, joints: Joints, forces: Components) -> ExactVector:
    """The load on the freedoms of a system of `forces` / L, which act on discs a, and b opposite.

    With forces f s it is what f does because its direction turns by s / L. The joints are
    representatives of the system's contacts, and the load is in the system's units.
    """
    scene, reduction = joints.scene, system.reduction
    weight = reduction.weight[reduction.contact[joints.contacts]].tolist()
    numerators: dict[int, list[fmpz]] = {1: [fmpz(0)] * system.dof}
    common = fmpz(1)
    parts = [product(joints.inverse_lengths, force) for force in forces]
    for part in parts:
        common = common.lcm(part.denominator)
    a, b = (ends[joints.contacts] * scene.dimension for ends in scene.ends)
    for axis, part in enumerate(parts):
        up = common // part.denominator
        for r, column in part.numerators.items():
            if not any(column):
                continue
            total = numerators.setdefault(r, [fmpz(0)] * system.dof)
            for ends, side in ((a, up), (b, -up)):
                freedom, sign = reduction.freedom[ends + axis], reduction.sign[ends + axis]
                rows = zip(freedom.tolist(), sign.tolist(), weight, column, strict=True)
                for j, moves, v, x in rows:
                    if moves:
                        total[j] += x * (moves * v * side)
    axis_of = np.zeros(system.dof, dtype=np.int64)
    moving = np.flatnonzero(reduction.sign)
    axis_of[reduction.freedom[moving]] = moving % scene.dimension
    return ExactVector(numerators, common, system.displacement_factor, axis_of).plain()


def product(v: ExactVector, w: ExactVector) -> ExactVector:
    """The products of the entries of two vectors without factors.

    >>> v = exact_vector(["sqrt(3)", "1/2"])
    >>> [str(x) for x in product(v, v)]
    ['3', '1/4']
    """
    numerators: dict[int, list[fmpz]] = {}
    right = [(s, y) for s, y in w.numerators.items() if any(y)]
    for r, x in v.numerators.items():
        if not any(x):
            continue
        for s, y in right:
            factor, root = root_product(r, s)
            part = [p * q for p, q in zip(x, y, strict=True)]
            if factor > 1:
                part = [p * factor for p in part]
            before = numerators.get(root)
            numerators[root] = (
                [p + q for p, q in zip(before, part, strict=True)] if before else part
            )
    numerators.setdefault(1, [fmpz(0)] * len(v))
    return ExactVector(numerators, v.denominator * w.denominator)


def spread(vector: ExactVector, places: IntArray, size: int) -> ExactVector:
    """The entries of a vector without factors at these places of a longer one, zero elsewhere.

    >>> [str(x) for x in spread(exact_vector([7]), np.array([1]), 3)]
    ['0', '7', '0']
    """
    numerators = {}
    for r, column in vector.numerators.items():
        numerators[r] = [fmpz(0)] * size
        for k, x in zip(places.tolist(), column, strict=True):
            numerators[r][k] = x
    return ExactVector(numerators, vector.denominator)
