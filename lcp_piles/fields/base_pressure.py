"""What the pile puts on its support, disc by disc.

Everywhere here a force is that of the pile ON what carries it: `normal` is positive downwards and
`shear` positive to the right.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..numbers.exact import ZERO, Surd
from ..scenes.scene import DiscId
from ..solution.solution import Solution
from .disc_contacts import DiscContact, Number, disc_contacts, number, plane_forces


@dataclass(frozen=True, slots=True)
class BaseForce:
    """A force on the base at one disc: `normal` downwards and `shear` to the right, in w.

    `x` is the disc's lattice point (exact). `held` tells whether a motion of the disc is
    prescribed: it marks the corner stones. Forces are `Surd` for exact solutions, else floats.
    """

    disc: DiscId
    x: Surd
    normal: Number
    shear: Number
    held: bool


def base_pressure(solution: Solution) -> tuple[BaseForce, ...]:
    """The pressure profile as the paper plots it, from left to right.

    What each disc of the lowest row of movable discs puts on the discs and the floor below it. On a
    floor these are the floor forces: no shear, and no held corner stones (for those see
    `support_forces`). For TBS it is row N: "we show the normal and shear forces on the last layer
    of discs, ignoring those on the layer N-1" (the paper, Sec. Results, TBS), and so their sum is
    less than the weight of the pile.

    >>> from lcp_piles import nt30, solve
    >>> [(str(p.x), str(p.normal)) for p in base_pressure(solve(nt30(2)))]
    [('-1', '3/2'), ('1', '3/2')]
    """
    movable = [disc for disc in solution.scene.discs if not disc.fixed]
    bottom = min((disc.position[1] for disc in movable), default=ZERO)
    row = [disc for disc in movable if disc.position[1] == bottom]
    row.sort(key=lambda disc: disc.position[0])
    return force_to_below(solution, [disc.id for disc in row])


def support_forces(solution: Solution) -> tuple[BaseForce, ...]:
    """The whole force on the support at every disc that it carries, in the scene's order of discs.

    Along a held axis: what holds the disc against its own load and the discs that touch it. Along
    a free axis: the forces of its contacts with floors. So this lists the floor forces and the
    corner stones of the smooth piles, and all discs of both fixed rows of TBS. A disc's own weight
    is included: a held corner stone weighs on its support with its own w (the fixed discs of TBS
    weigh nothing). Then `normal` sums exactly to the weight of all discs, and `shear` to zero.

    >>> from lcp_piles import nt30, solve
    >>> pile = support_forces(solve(nt30(2)))
    >>> [(p.disc, str(p.normal), str(p.shear)) for p in pile if p.held]
    [((2, 1), '1', '-1/6*sqrt(3)'), ((2, 4), '1', '1/6*sqrt(3)')]
    """
    scene = solution.scene
    on_floor = {contact.a for contact in scene.contacts if isinstance(contact.b, str)}
    carried = []
    for disc in scene.discs:
        if disc.id not in on_floor and disc.held == (None, None):
            continue
        contacts = disc_contacts(scene, disc.id)
        discs = [contact for contact in contacts if contact.with_disc]
        floors = [contact for contact in contacts if not contact.with_disc]
        x, y = (
            _push(solution, floors, axis)
            if disc.held[axis] is None
            else number(solution, disc.load[axis]) - _push(solution, discs, axis)
            for axis in (0, 1)
        )
        carried.append(_base_force(solution, disc.id, -y, x))
    return tuple(carried)


def force_to_below(solution: Solution, discs: Iterable[DiscId]) -> tuple[BaseForce, ...]:
    """What each of these discs puts on lower discs and on floors, in the order given."""
    return tuple(_across(solution, disc, -1) for disc in discs)


def force_from_above(solution: Solution, discs: Iterable[DiscId]) -> tuple[BaseForce, ...]:
    """What each of these discs receives from higher discs, in the order given.

    On a smooth floor this shows the shear that arrives at the base row, which its horizontal
    contacts hand on to the corner stones.

    >>> from lcp_piles import nt60, solve
    >>> pile = solve(nt60(3, floor_compliance=0))
    >>> [str(p.shear) for p in force_from_above(pile, [(3, 1), (3, 2), (3, 3)])]
    ['-1/3*sqrt(3)', '0', '1/3*sqrt(3)']
    """
    return tuple(_across(solution, disc, 1) for disc in discs)


def _across(solution: Solution, disc: DiscId, side: int) -> BaseForce:
    """The force handed down through the contacts above (side 1) or below (-1) a disc."""
    contacts = disc_contacts(solution.scene, disc)
    crossed = [contact for contact in contacts if contact.direction[1].sign() == side]
    x, y = (_push(solution, crossed, axis) for axis in (0, 1))
    # The disc pushes what is below along the direction, and is itself pushed against it.
    return _base_force(solution, disc, side * y, -side * x)


def _push(solution: Solution, contacts: Iterable[DiscContact], axis: int) -> Number:
    """The force of a disc on what is across these contacts, along one axis."""
    forces = plane_forces(solution)
    total = number(solution, ZERO)
    for contact in contacts:
        total = total + number(solution, contact.direction[axis]) * forces[contact.index]
    return total


def _base_force(solution: Solution, disc: DiscId, normal: Number, shear: Number) -> BaseForce:
    where = solution.scene.disc(disc)
    held = where.held != (None, None)
    return BaseForce(disc, where.position[0], normal, shear, held)
