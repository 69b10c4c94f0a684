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

from ..numbers.exact import ONE, surd
from ..numbers.vectors import (
    ExactVector,
    FloatArray,
    IntArray,
    combination,
    distinct,
    exact_vector,
)
from ..scenes.names import end_name
from ..solution.solution import Solved
from ..solution.verify import verify
from .expansion import (
    Components,
    Joints,
    along,
    normals_of,
    product,
    relative,
    shared_vector,
    spread,
)

_SHOWN = 10


def faults(
    rigid: Solved,
    joints: Joints,
    start: tuple[ExactVector, ExactVector],
    terms: tuple[ExactVector, ExactVector, ExactVector],
) -> list[str]:
    """Every identity of order tau that fails, in words; the first ten.

    `joints` are all contacts between discs, `start` are u0 and g0, `terms` are u1, g1 and f1, all
    of the whole scene and without factors.
    """
    return list(islice(_faults(rigid, joints, start, terms), _SHOWN))


def _faults(
    rigid: Solved,
    joints: Joints,
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

    contacts, between = np.arange(len(scene.contacts)), joints.contacts
    f0 = _plain(rigid.forces)
    gap = shared_vector([c.gap for c in scene.contacts])
    hooke0 = [(ONE, g0), (-ONE, gap), (-ONE, _overlaps(rigid, f0))]
    along0 = _at(combination(hooke0), between)  # n . D0
    apart = relative(scene, between, u0)
    squares = [(ONE, product(d, d)) for d in apart]
    slid = combination([*squares, (-ONE, product(along0, along0))])
    longer = combination([(ONE / 2, product(slid, joints.inverse_lengths))])
    normals = normals_of(scene, contacts)
    hooke = combination(
        [
            (ONE, g1),
            (-ONE, along(normals, relative(scene, contacts, u1))),
            (-ONE, spread(longer, between, len(contacts))),
            (-ONE, _overlaps(rigid, f1)),
        ]
    )
    for k in _not_zero(hooke):
        yield f"{scene.contacts[k].name}: Hooke's law of order tau fails"

    # f1 n + f0 s0 / L with s0 = D0 - (n . D0) n, along n and along D0.
    turning = product(_at(f0, between), joints.inverse_lengths)
    lost = spread(product(turning, along0), between, len(contacts))
    sides = combination([(ONE, f1), (-ONE, lost)])
    pushes = [
        combination(
            [(ONE, product(n, sides)), (ONE, spread(product(turning, d), between, len(contacts)))]
        )
        for n, d in zip(normals, apart, strict=True)
    ]
    yield from _balance_faults(rigid, pushes, u1)


def _overlaps(rigid: Solved, forces: ExactVector) -> ExactVector:
    """C f of every contact."""
    compliances, which = distinct([c.compliance for c in rigid.scene.contacts])
    if len(compliances) == 1:
        return combination([(surd(compliances[0]), forces)])
    return product(_at(exact_vector(compliances), which), forces)


def _at(vector: ExactVector, places: IntArray) -> ExactVector:
    return vector.take(places, np.ones(len(places), dtype=np.int64))


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


def _plain(vector: ExactVector | FloatArray) -> ExactVector:
    assert isinstance(vector, ExactVector)
    return vector.plain()


def _equal(vector: ExactVector, other: ExactVector | FloatArray) -> bool:
    plain = _plain(other)
    return (vector.numerators, vector.denominator) == (plain.numerators, plain.denominator)


def _not_zero(vector: ExactVector) -> list[int]:
    return sorted({k for x in vector.numerators.values() for k, y in enumerate(x) if y != 0})
