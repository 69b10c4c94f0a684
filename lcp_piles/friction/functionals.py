"""Linear functionals of the forces on contacts: what `force_bounds` bounds.

A functional is a mapping from contacts, given as (a, b), to the weight of the normal force, or to a
pair: the weights of the normal and of the tangential force (along t = (-n_y, n_x), on disc a).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import InputError
from ..numbers.exact import ZERO, Exact, Surd, surd
from ..scenes.names import DiscId, contact_name
from ..scenes.scene import Scene

Ends = tuple[DiscId, DiscId]
Functional = Mapping[Ends, Exact | tuple[Exact, Exact]]


def weights(scene: Scene, what: Functional) -> dict[int, tuple[Surd, Surd]]:
    """The weights of normal and tangential force by the number of the contact.

    >>> from lcp_piles import tbs
    >>> weights(tbs(1), {((1, 1), (3, 2)): 2})
    {2: (Surd('2'), Surd('0'))}
    """
    if not isinstance(what, Mapping):
        raise InputError("what to bound", what, "a mapping from contacts (a, b) to weights")
    found: dict[int, tuple[Surd, Surd]] = {}
    for ends, weight in what.items():
        pair: Any = weight if isinstance(weight, tuple) else (weight, 0)
        if len(pair) != 2:
            raise InputError(f"the weight of {ends}", weight, "a number, or a pair of numbers")
        found[contact_number(scene, ends)] = surd(pair[0]), surd(pair[1])
    return found


def contact_number(scene: Scene, ends: Ends) -> int:
    """The number of the contact with these ends, in either order."""
    numbers = [k for k, c in enumerate(scene.contacts) if {c.a, c.b} == set(ends)]
    if len(numbers) != 1:
        raise InputError("the contact", contact_name(ends), "the two ends of one contact")
    return numbers[0]


def average_stress(
    scene: Scene, i: int, j: int, discs: Sequence[DiscId] = ()
) -> dict[Ends, tuple[Surd, Surd]]:
    """Component ij of pi times the stress, averaged over some discs (by default all that move).

    sigma = 1 / (pi R^2) sum F_i r_j over the forces F on a disc at the points r from its centre, in
    w/R, compression negative, as in `stress`. A contact adds -(f_n n_i + f_t t_i) n_j to each of
    its discs; where torques balance, sigma is symmetric.

    >>> from lcp_piles import tbs
    >>> {ends[1]: str(n) for ends, (n, t) in average_stress(tbs(1), 1, 1).items()}
    {(2, 1): '-1/4', (2, 2): '-1/4', (3, 2): '-1'}
    """
    if not {i, j} <= {0, 1}:
        raise InputError("the axes of a stress", (i, j), "0 (x) or 1 (y) each")
    chosen = set(discs) or {disc.id for disc in scene.discs if not disc.fixed}
    for id in chosen:
        scene.disc_index(id)
    found = {}
    for contact in scene.contacts:
        count = len({contact.a, contact.b} & chosen)
        if count:
            n = contact.normal
            t = (-n[1], n[0])
            share = surd(-count) * n[j] / len(chosen)
            found[contact.a, contact.b] = share * n[i], share * t[i]
    return found


def force_on(scene: Scene, disc: DiscId, axis: int) -> dict[Ends, tuple[Surd, Surd]]:
    """The sum of all contact forces on a disc along an axis: what a held disc has to bear.

    >>> from lcp_piles import tbs
    >>> [(str(n), str(t)) for n, t in force_on(tbs(1), (2, 1), 1).values()]
    [('-1/2', '-1/2*sqrt(3)')]
    """
    scene.disc_index(disc)
    found = {}
    for contact in scene.contacts:
        if disc in (contact.a, contact.b):
            sign = 1 if disc == contact.a else -1
            n = contact.normal
            t = (-n[1], n[0])
            found[contact.a, contact.b] = sign * n[axis], sign * t[axis]
    return found


def combined(parts: Sequence[tuple[Exact, Functional]]) -> dict[Ends, tuple[Surd, Surd]]:
    """The sum of multiples of functionals, such as a difference of two forces.

    >>> from lcp_piles import tbs
    >>> one, two = {((1, 1), (2, 1)): 1}, {((1, 1), (2, 2)): 1}
    >>> [str(n) for n, t in combined([(1, one), (-1, two)]).values()]
    ['1', '-1']
    """
    total: dict[Ends, tuple[Surd, Surd]] = {}
    for factor, functional in parts:
        for ends, weight in functional.items():
            pair: Any = weight if isinstance(weight, tuple) else (weight, 0)
            old = total.get(ends, (ZERO, ZERO))
            n, t = (x + surd(factor) * surd(y) for x, y in zip(old, pair, strict=True))
            total[ends] = n, t
    return total
