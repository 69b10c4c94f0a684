"""What the pile puts on each of its supports, one by one, and on what holds its discs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numbers.exact import Surd
from ..numbers.vectors import FloatArray
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .disc_contacts import Number, disc_contacts, number, plane_forces, pushed
from .field import Column, DiscVectors, Field, Table


@dataclass(frozen=True, slots=True)
class SupportForce:
    """The force (w) of the pile on one support at one disc, `x` to the right and `y` upwards.

    `support` is its name and `normal` the force into it along its own normal; both are None for
    what holds the disc along the axes on which its motion is prescribed. Numbers are `Surd` for
    exact solutions, else floats.
    """

    disc: DiscId
    support: str | None
    x: Number
    y: Number
    normal: Number | None


def support_forces(solution: Solution) -> tuple[SupportForce, ...]:
    """The forces on all supports: contacts with supports, then the holder.

    A contact with a support (a floor, a wall) is one entry, and what holds a disc another, a floor
    under a held disc included. A disc's own weight is in: a held corner stone weighs on what holds
    it with its own w (the fixed discs of TBS weigh nothing). So the entries add up exactly to the
    load on all discs.

    Parameters
    ----------
    solution : Solved
        A solution of a scene of discs.

    Returns
    -------
    tuple of SupportForce
        The forces `x` to the right and `y` upwards (w), in the order of discs.

    Raises
    ------
    InputError
        For a scene that is not plane; `NotSolvedError` where the solution has no forces.

    Examples
    --------
    >>> from lcp_piles import nt30, solve
    >>> pile = support_forces(solve(nt30(2)))
    >>> [(p.disc, str(p.x), str(p.y)) for p in pile if p.support is None]
    [((2, 1), '-1/6*sqrt(3)', '-1'), ((2, 4), '1/6*sqrt(3)', '-1')]
    """
    forces = plane_forces(solution)
    scene = solution.scene
    found = []
    for disc in scene.discs:
        contacts = disc_contacts(scene, disc.id)
        for contact in contacts:
            if not contact.with_disc:
                x, y = (pushed(solution, [contact], axis) for axis in (0, 1))
                support = str(scene.contacts[contact.index].b)
                found.append(SupportForce(disc.id, support, x, y, forces[contact.index]))
        if disc.held != (None, None):
            x, y = (
                number(solution, disc.load[axis]) - pushed(solution, contacts, axis)
                if disc.held[axis] is not None
                else number(solution, Surd(()))
                for axis in (0, 1)
            )
            found.append(SupportForce(disc.id, None, x, y, None))
    return tuple(found)


def _of_solution(solution: Solution) -> tuple[Scene, tuple[SupportForce, ...]]:
    return solution.scene, support_forces(solution)


def _table(found: tuple[Scene, tuple[SupportForce, ...]]) -> Table:
    columns = (
        Column("disc"),
        Column("support"),
        *(Column(name, exact=True) for name in ("force_x", "force_y", "normal")),
    )
    rows = [[end_name(p.disc), p.support or "holder", p.x, p.y, p.normal] for p in found[1]]
    return Table(columns, rows)


def _shape(found: tuple[Scene, tuple[SupportForce, ...]]) -> DiscVectors:
    scene, forces = found
    discs = np.array([scene.disc_index(p.disc) for p in forces], dtype=np.int64)
    vectors: FloatArray = np.array([[float(p.x), float(p.y)] for p in forces]).reshape(-1, 2)
    return DiscVectors(scene, discs, vectors, "force on the support", "w")


FIELD = Field(
    "support",
    "forces on every support and on what holds discs, one by one (w)",
    _of_solution,
    _table,
    _shape,
)
