"""What every place on the base bears, in two and in three dimensions.

Down is along the last axis. Places on the base are discs on a floor that points up, and held discs
that free ones rest on. Where no wall bears a part, their loads add up to the weight of the free
discs, a map of the pressure under a pile.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import ExactVector
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution, Vector
from .disc_contacts import Number
from .field import Column, Field, Table


@dataclass(frozen=True, slots=True)
class BasePlace:
    """A place on the base: its disc, and the contacts that press on it with their share down."""

    disc: DiscId
    contacts: tuple[tuple[int, Surd], ...]

    def load(self, forces: Vector) -> Number:
        """The load (w) on it from the forces of all contacts of the scene."""
        if isinstance(forces, ExactVector):
            return sum((n * forces[k] for k, n in self.contacts), ZERO)
        return float(sum(float(n) * forces[k] for k, n in self.contacts))


@dataclass(frozen=True, slots=True)
class BaseLoad:
    """The `load` downwards (w) on a place of the base, and the position of its disc there.

    `across` has the coordinates but the last one, exact, in disc radii. Loads are `Surd` for exact
    solutions, else floats.
    """

    disc: DiscId
    across: tuple[Surd, ...]
    load: Number


def base_places(scene: Scene) -> tuple[BasePlace, ...]:
    """The places on the base of a scene, by their coordinates from the first to the last.

    >>> from lcp_piles import tbs
    >>> [place.disc for place in base_places(tbs(1))]
    [(2, 1), (3, 2), (2, 2)]
    """
    on: dict[DiscId, list[tuple[int, Surd]]] = {}
    for k, contact in enumerate(scene.contacts):
        upper, lower, up = contact.a, contact.b, contact.normal[-1]
        if up < ZERO and lower not in scene.supports:
            upper, lower, up = lower, contact.a, -up
        if up <= ZERO or scene.disc(upper).fixed:
            continue
        if lower in scene.supports:
            on.setdefault(upper, []).append((k, up))
        elif scene.disc(lower).fixed:
            on.setdefault(lower, []).append((k, up))
    places = sorted(on, key=lambda id: scene.disc(id).position[:-1])
    return tuple(BasePlace(id, tuple(on[id])) for id in places)


def base_load(solution: Solution) -> tuple[BaseLoad, ...]:
    """The load on every place of the base of a solved scene.

    Parameters
    ----------
    solution : Solved
        A solution of a scene of discs or spheres.

    Returns
    -------
    tuple of BaseLoad
        The `disc`, its place `across` (disc radii) and the `load` downwards (w) of every place, in
        the order of `base_places`. Loads are Surd for exact solutions, else floats.

    Raises
    ------
    NotSolvedError
        Where the solution has no forces.

    Examples
    --------
    >>> from lcp_piles import pyramid, solve
    >>> [str(place.load) for place in base_load(solve(pyramid(1)))]
    ['1/4', '1/4', '1/4', '1/4']
    """
    forces, scene = solution.forces, solution.scene
    return tuple(
        BaseLoad(place.disc, scene.disc(place.disc).position[:-1], place.load(forces))
        for place in base_places(scene)
    )


def _table(found: Sequence[BaseLoad]) -> Table:
    axes = ("x", "y")[: len(found[0].across)] if found else ()
    columns = (Column("disc"), *(Column(name, exact=True) for name in (*axes, "load")))
    return Table(columns, [[end_name(p.disc), *p.across, p.load] for p in found])


FIELD = Field("base", "what every place on the base bears, downwards (w)", base_load, _table, None)
