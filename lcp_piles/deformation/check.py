"""The check of a first-order term from the scene and the rigid solution alone.

No gauge, no symmetry, no linear system: the identities of order tau, contact by contact and disc by
disc, on the whole scene. The sliding is not computed anew but follows from Hooke's law of the rigid
pile, n . D0 = g0 - o - c f0 and |s0|^2 = |D0|^2 - (n . D0)^2: another way to the same numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

import numpy as np
from flint import fmpz

from ..numbers.exact import ONE
from ..numbers.vectors import ExactVector, FloatArray, combination
from ..scenes.names import end_name
from ..solution.solution import Solved
from ..solution.verify import verify
from .expansion import (
    Components,
    along,
    joints_of,
    normals_of,
    product,
    relative,
    shared_vector,
    spread,
)

_SHOWN = 10


def faults(
    rigid: Solved,
    start: tuple[ExactVector, ExactVector],
    terms: tuple[ExactVector, ExactVector, ExactVector],
) -> list[str]:
    """Every identity of order tau that fails, in words; the first ten.

    `start` are u0 and g0, `terms` are u1, g1 and f1, all of the whole scene and without factors.
    """
    found = _faults(rigid, start, terms)
    return list(islice(found, _SHOWN))


def _faults(
    rigid: Solved,
    start: tuple[ExactVector, ExactVector],
    terms: tuple[ExactVector, ExactVector, ExactVector],
) -> Iterator[str]:
    u0, g0 = start
    u1, g1, f1 = terms
    scene = rigid.scene
    if not (_equal(u0, rigid.displacements) and _equal(g0, rigid.gaps)):
        moved = verify(scene, replace(rigid, displacements=u0, gaps=g0))
        yield from (f"order 0: {fault}" for fault in moved.faults)
    for k, signs in enumerate(zip(f1.signs(), g1.signs(), strict=True)):
        if not _fits(rigid.states[k], scene.contacts[k].bilateral, *signs):
            yield f"{scene.contacts[k].name}: a {rigid.states[k]} one cannot change so"
    contacts = np.arange(len(scene.contacts))
    forces = rigid.forces
    assert isinstance(forces, ExactVector)
    f0 = forces.plain()
    compliance = shared_vector([c.compliance for c in scene.contacts])
    gap = shared_vector([c.gap for c in scene.contacts])
    stretch = combination([(ONE, g0), (-ONE, gap), (-ONE, product(compliance, f0))])

    joints = joints_of(scene, contacts)
    ones = np.ones(len(joints.contacts), dtype=np.int64)
    apart = relative(scene, joints.contacts, u0)
    along0 = stretch.take(joints.contacts, ones)
    squares = combination(
        [*((ONE / 2, product(d, d)) for d in apart), (-ONE / 2, product(along0, along0))]
    )
    longer = spread(product(squares, joints.inverse_lengths), joints.contacts, len(contacts))
    normals = normals_of(scene, contacts)
    hooke = combination(
        [
            (ONE, g1),
            (-ONE, along(normals, relative(scene, contacts, u1))),
            (-ONE, longer),
            (-ONE, product(compliance, f1)),
        ]
    )
    for k in _not_zero(hooke):
        yield f"{scene.contacts[k].name}: Hooke's law of order tau fails"

    turning = product(f0.take(joints.contacts, ones), joints.inverse_lengths)
    turned = [
        product(turning, combination([(ONE, d), (-ONE, product(n, along0))]))
        for d, n in zip(apart, joints.normals, strict=True)
    ]
    pushes = [
        combination([(ONE, product(n, f1)), (ONE, spread(t, joints.contacts, len(contacts)))])
        for n, t in zip(normals, turned, strict=True)
    ]
    yield from _balance_faults(rigid, pushes, u1)


def _fits(state: str, bilateral: bool, force: int, gap: int) -> bool:
    """Whether signs of f1 and g1 are those that a contact of this state may have."""
    if state == "open":
        return force == 0
    if state == "closed" or bilateral:
        return gap == 0
    return force >= 0 and gap >= 0 and force * gap == 0


def _balance_faults(rigid: Solved, pushes: Components, u1: ExactVector) -> Iterator[str]:
    """The discs on which the vectors that act at the contacts do not add up to zero."""
    scene = rigid.scene
    a, b = (ends.tolist() for ends in scene.ends)
    moved = u1.signs()
    for axis, push in enumerate(pushes):
        sums = {}
        for r, column in push.numerators.items():
            total = [fmpz(0)] * (len(scene.discs) + 1)  # supports stand at the end
            for i, j, x in zip(a, b, column, strict=True):
                if x != 0:
                    total[i] += x
                    total[j] -= x
            sums[r] = total[:-1]
        for k in _not_zero(ExactVector(sums, push.denominator)):
            disc = scene.discs[k]
            if disc.held[axis] is None:
                yield f"disc {end_name(disc.id)}: axis {axis} is not balanced at order tau"
        for k, disc in enumerate(scene.discs):
            if disc.held[axis] is not None and moved[k * scene.dimension + axis]:
                yield f"disc {end_name(disc.id)}: axis {axis} is held, but u1 moves it"


def _equal(vector: ExactVector, other: ExactVector | FloatArray) -> bool:
    assert isinstance(other, ExactVector)
    plain = other.plain()
    return (vector.numerators, vector.denominator) == (plain.numerators, plain.denominator)


def _not_zero(vector: ExactVector) -> list[int]:
    return sorted({k for x in vector.numerators.values() for k, y in enumerate(x) if y != 0})
