"""The check of a first-order term: the identities of order tau, contact by contact, disc by disc.

No gauge and no linear system. u0 has to fit Hooke's law of the rigid pile, and the numbers of
order tau follow from the sliding of u0 (`Start`) by their own laws. Of a pile that was solved by
its symmetric half the term has to be its own mirror image, and then identities at the discs of that
half are identities everywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

import numpy as np

from ..numbers.exact import ONE
from ..numbers.vectors import ExactVector, combination
from ..scenes.names import end_name
from .base import Base, is_mirrored
from .columns import at, few_values, product, scaled, spread, spread_values
from .expansion import along, normals_of, relative, summed
from .problem import Start, Term

_SHOWN = 10


def faults(base: Base, start: Start, term: Term) -> list[str]:
    """Every identity of order tau that fails, in words; the first ten."""
    return list(islice(_faults(base, start, term), _SHOWN))


def _faults(base: Base, start: Start, term: Term) -> Iterator[str]:
    rigid, scene = base.rigid, base.rigid.scene
    u0, g0 = start.displacements, start.gaps
    u1, g1, f1 = term.displacements, term.gaps, term.forces
    if not is_mirrored(base.system, (u0, u1), (g0, g1, f1)):
        yield "the pile is its own mirror image, but the term is not"
    signs = zip(g0.signs(), f1.signs(), g1.signs(), strict=True)
    for k, (apart, *change) in enumerate(signs):
        state, contact = rigid.states[k], scene.contacts[k]
        if apart != (state == "open") or not _fits(state, contact.bilateral, *change):
            yield f"{contact.name}: a {state} one cannot change so"

    near = base.near
    given = few_values([scene.contacts[k].gap for k in near.tolist()])
    soft = few_values([scene.contacts[k].compliance for k in near.tolist()])
    normals = normals_of(scene, near)
    hooke0 = [
        (ONE, along(normals, relative(scene, near, u0))),
        (ONE, spread_values(given)),
        (ONE, scaled(at(base.forces, near), soft)),
        (-ONE, at(g0, near)),
    ]
    for k in _not_zero(combination(hooke0)):
        yield f"{scene.contacts[near[k]].name}: Hooke's law of order 0 fails"

    places = np.flatnonzero(scene.ends[1][near] >= 0)  # of the joints among those near
    changed = at(f1, near)
    hooke = combination(
        [
            (ONE, along(normals, relative(scene, near, u1))),
            (ONE, scaled(changed, soft)),
            (ONE, spread(start.longer, places, len(near))),
            (-ONE, at(g1, near)),
        ]
    )
    for k in _not_zero(hooke):
        yield f"{scene.contacts[near[k]].name}: Hooke's law of order tau fails"

    pushes = summed(scene, near, [product(n, changed) for n in normals])
    unbalanced = set(_not_zero(combination([(ONE, pushes), (ONE, start.load)])))
    moves = u1.signs()
    for k in np.flatnonzero(base.discs).tolist():
        disc = scene.discs[k]
        for axis, held in enumerate(disc.held):
            place = k * scene.dimension + axis
            if held is None and place in unbalanced:
                yield f"disc {end_name(disc.id)}: axis {axis} is not balanced at order tau"
            if held is not None and (moves[place] or u0[place] != held):
                yield f"disc {end_name(disc.id)}: axis {axis} is held, but it moves"


def _fits(state: str, bilateral: bool, force: int, gap: int) -> bool:
    """Whether signs of f1 and g1 are those that a contact of this state may have."""
    if state == "open":
        return force == 0
    if state == "closed" or bilateral:
        return gap == 0
    return force >= 0 and gap >= 0 and force * gap == 0


def _not_zero(vector: ExactVector) -> list[int]:
    """Where the entries of a vector without factors are not zero."""
    return sorted({k for x in vector.numerators.values() for k, y in enumerate(x) if y})
