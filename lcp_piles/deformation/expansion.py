"""The geometry of round discs to second order, in exact vectors.

Two discs whose centres stand L n apart at rest, and whose relative displacement is tau D, stand

    |L n + tau D| = L + tau n . D + tau^2 |s|^2 / (2 L) + O(tau^3),      s = D - (n . D) n,

apart, and the direction between them is n + tau s / L + O(tau^2). A support is a plane: its
distance has no second order and its normal does not turn, so only contacts between discs are here.
All vectors are without factors (`ExactVector.plain`).
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import fmpz

from ..errors import InputError
from ..numbers.exact import ONE, Surd
from ..numbers.vectors import ExactVector, IntArray, Mask, combination, exact_vector
from ..scenes.scene import Scene
from .columns import at, few_values, product, scaled, spread_values

Components = list[ExactVector]
"""A vector a contact: for each axis its components, one a contact."""


@dataclass(frozen=True, eq=False)
class Joints:
    """Contacts between discs: which of the scene's they are, their normals, and 1 / L.

    `inverse_lengths` are the few numbers that 1 / L is, and which of them for each contact.
    """

    scene: Scene
    contacts: IntArray
    normals: Components
    inverse_lengths: tuple[list[Surd], IntArray]

    def __len__(self) -> int:
        return len(self.contacts)


def joints_of(scene: Scene, contacts: IntArray) -> Joints:
    """What the second order needs of those of the contacts that join two discs.

    >>> from lcp_piles import nt60
    >>> import numpy as np
    >>> [str(x) for x in joints_of(nt60(2), np.arange(2)).inverse_lengths[0]]
    ['1/2']
    """
    if not scene.geometric:
        raise InputError(
            "geometric", False, "True", "finite stiffness asks how discs really stand to each other"
        )
    contacts = contacts[scene.ends[1][contacts] >= 0]
    normals = normals_of(scene, contacts)
    positions = spread_values(few_values([x for disc in scene.discs for x in disc.position]))
    lengths = along(normals, relative(scene, contacts, positions))
    inverse: dict[tuple[int, ...], Surd] = {}
    keys = list(zip(*lengths.numerators.values(), strict=True))
    for k, key in enumerate(keys):
        if key not in inverse:
            inverse[key] = 1 / lengths[k]
    return Joints(scene, contacts, normals, few_values([inverse[key] for key in keys]))


def some_of(joints: Joints, kept: IntArray) -> Joints:
    """The joints at these places of the list."""
    values, which = joints.inverse_lengths
    return Joints(
        joints.scene,
        joints.contacts[kept],
        [at(n, kept) for n in joints.normals],
        (values, which[kept]),
    )


def at_discs(scene: Scene, contacts: IntArray, discs: Mask) -> Mask:
    """Which of the contacts join some of these discs to anything."""
    a, b = (ends[contacts] for ends in scene.ends)
    mask: Mask = discs[a] | (discs[b] & (b >= 0))
    return mask


def normals_of(scene: Scene, contacts: IntArray) -> Components:
    """The normals of contacts."""
    values, which = scene.normals
    return [
        at(exact_vector([n[axis] for n in values]), which[contacts])
        for axis in range(scene.dimension)
    ]


def relative(scene: Scene, contacts: IntArray, vectors: ExactVector) -> Components:
    """The vector of disc a less that of b (zero for a support), of one vector a disc, flat."""
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


def across(normals: Components, vectors: Components, stretch: ExactVector) -> Components:
    """The part of vectors across the normals, of those whose part along them is `stretch`."""
    return [
        combination([(ONE, v), (-ONE, product(n, stretch))])
        for n, v in zip(normals, vectors, strict=True)
    ]


def sliding(joints: Joints, displacements: ExactVector) -> Components:
    """s, the relative displacement across the normal, for displacements of all discs, flat."""
    apart = relative(joints.scene, joints.contacts, displacements)
    return across(joints.normals, apart, along(joints.normals, apart))


def lengthening(joints: Joints, s: Components) -> ExactVector:
    """|s|^2 / (2 L), one a contact."""
    squares = combination([(ONE / 2, product(x, x)) for x in s])
    return scaled(squares, joints.inverse_lengths)


def turned(joints: Joints, forces: Components) -> ExactVector:
    """What `forces` / L at the joints add up to on every disc, flat: on a as they are, b opposite.

    With forces f s it is what f does because its direction turns by s / L.
    """
    parts = [scaled(force, joints.inverse_lengths) for force in forces]
    return summed(joints.scene, joints.contacts, parts)


def summed(scene: Scene, contacts: IntArray, forces: Components) -> ExactVector:
    """The sums of forces at contacts on every disc, flat: on a as they are, on b opposite."""
    a, b = (ends[contacts].tolist() for ends in scene.ends)
    common = fmpz(1)
    for part in forces:
        common = common.lcm(part.denominator)
    size = len(scene.discs)
    numerators: dict[int, list[fmpz]] = {1: [fmpz(0)] * (size * scene.dimension)}
    for axis, part in enumerate(forces):
        up = common // part.denominator
        for r, column in part.numerators.items():
            if not any(column):
                continue
            total = [fmpz(0)] * (size + 1)  # supports stand at the end
            for i, j, x in zip(a, b, column, strict=True):
                if x:
                    total[i] += x
                    total[j] -= x
            flat = numerators.setdefault(r, [fmpz(0)] * (size * scene.dimension))
            flat[axis :: scene.dimension] = [x * up for x in total[:-1]] if up != 1 else total[:-1]
    return ExactVector(numerators, common)
