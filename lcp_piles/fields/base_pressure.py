"""What the pile puts on its support, disc by disc.

Everywhere here a force is that of the pile ON what carries it: `normal` is positive downwards and
`shear` positive to the right.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..numbers.exact import ZERO, Surd
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .disc_contacts import Number, disc_contacts, pushed
from .field import Column, Field, Profile, Table


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
    of discs, ignoring those on the layer N-1" (the paper), and so their sum is less than the weight
    of the pile.

    Parameters
    ----------
    solution : Solved
        A solution of a pile of discs.

    Returns
    -------
    tuple of BaseForce
        The place `x` (disc radii), and the `normal` and `shear` force (w) of every disc.

    Raises
    ------
    InputError
        For a scene that is not plane; `NotSolvedError` where the solution has no forces.

    References
    ----------
    Oron and Herrmann (1997), "Exact calculation of force networks in granular piles", Sec. Results,
    TBS.

    Examples
    --------
    >>> from lcp_piles import nt30, solve
    >>> [(str(p.x), str(p.normal)) for p in base_pressure(solve(nt30(2)))]
    [('-1', '3/2'), ('1', '3/2')]
    """
    return force_to_below(solution, base_row(solution.scene))


def base_row(scene: Scene) -> list[DiscId]:
    """The lowest row of movable discs, from left to right."""
    movable = [disc for disc in scene.discs if not disc.fixed]
    bottom = min((disc.position[1] for disc in movable), default=ZERO)
    row = [disc for disc in movable if disc.position[1] == bottom]
    row.sort(key=lambda disc: disc.position[0])
    return [disc.id for disc in row]


def base_parts(scene: Scene) -> list[tuple[DiscId, list[tuple[int, Surd]]]]:
    """The discs of the base row, each with the contacts below it and what they point downwards.

    The normal force of a disc is the sum over these of that part times the force.
    """
    return [
        (
            disc,
            [
                (contact.index, -contact.direction[1])
                for contact in disc_contacts(scene, disc)
                if contact.direction[1].sign() < 0
            ],
        )
        for disc in base_row(scene)
    ]


def base_map(scene: Scene) -> csr_array:
    """What forces, one a contact, make of the normal forces of the base row, in floats."""
    row = [parts for _, parts in base_parts(scene)]
    values = np.array([float(down) for parts in row for _, down in parts])
    where = [(i, contact) for i, parts in enumerate(row) for contact, _ in parts]
    places = np.array(where, dtype=np.int64).reshape(-1, 2).T
    return csr_array((values, places), shape=(len(row), len(scene.contacts)))


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
    x, y = (pushed(solution, crossed, axis) for axis in (0, 1))
    # The disc pushes what is below along the direction, and is itself pushed against it.
    return _base_force(solution, disc, side * y, -side * x)


def _base_force(solution: Solution, disc: DiscId, normal: Number, shear: Number) -> BaseForce:
    where = solution.scene.disc(disc)
    held = where.held != (None, None)
    return BaseForce(disc, where.position[0], normal, shear, held)


def _table(profile: tuple[BaseForce, ...]) -> Table:
    columns = (
        Column("disc"),
        *(Column(name, exact=True) for name in ("x", "normal", "shear")),
        Column("held"),
    )
    rows = [[end_name(p.disc), p.x, p.normal, p.shear, "held" if p.held else ""] for p in profile]
    return Table(columns, rows)


def base_profile(
    profile: Sequence[BaseForce],
    marks: Mapping[str, Sequence[tuple[float, float]]] | None = None,
) -> Profile:
    """The profile as something to draw: normal and, where there is any, shear over x."""
    series = {"normal": [float(p.normal) for p in profile]}
    if any(p.shear for p in profile):
        series["shear"] = [float(p.shear) for p in profile]
    x = [float(p.x) for p in profile]
    return Profile(x, series, "force on the base  ($w$)", marks or {})


FIELD = Field(
    "pressure",
    "what the lowest row of movable discs puts on what is below it (w)",
    base_pressure,
    _table,
    base_profile,
)
