"""The contacts of one disc: which they are, where they point, with what force they push."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import ExactVector
from ..scenes.names import DiscId
from ..scenes.scene import Scene
from ..solution.solution import Solution, Vector

Number = Surd | float
Direction = tuple[Surd, ...]


@dataclass(frozen=True, slots=True)
class DiscContact:
    """A contact as one of its discs sees it.

    `index` is its place in `scene.contacts`, `direction` the unit vector from the disc's centre to
    the contact point, `with_disc` whether another disc is on the other side (and not a support).
    """

    index: int
    direction: Direction
    with_disc: bool


def disc_contacts(scene: Scene, disc: DiscId) -> tuple[DiscContact, ...]:
    """All contacts of a disc, in the scene's order.

    >>> from lcp_piles import nt60
    >>> [tuple(map(str, c.direction)) for c in disc_contacts(nt60(2), (1, 1))]
    [('-1/2', '-1/2*sqrt(3)'), ('1/2', '-1/2*sqrt(3)')]
    """
    index = scene.disc_index(disc)
    a, b = scene.ends
    found = []
    for k in np.flatnonzero((a == index) | (b == index)).tolist():
        normal = scene.contacts[k].normal  # from b to a
        direction = tuple(-n for n in normal) if a[k] == index else normal
        found.append(DiscContact(k, direction, bool(b[k] >= 0)))
    return tuple(found)


def plane_forces(solution: Solution) -> Vector:
    """The contact forces of a solved scene of discs; `InputError` where there are none."""
    if solution.scene.dimension != 2:
        raise InputError("the dimension", solution.scene.dimension, "2, for a scene of discs")
    return solution.forces


def number(solution: Solution, value: Surd) -> Number:
    """An exact number of the scene in the solution's arithmetic."""
    return value if isinstance(solution.forces, ExactVector) else float(value)


def pushed(solution: Solution, contacts: Iterable[DiscContact], axis: int) -> Number:
    """The force (w) of a disc on what is across these contacts of it, along one axis."""
    forces = plane_forces(solution)
    total = number(solution, ZERO)
    for contact in contacts:
        total = total + number(solution, contact.direction[axis]) * forces[contact.index]
    return total
