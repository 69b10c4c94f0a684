"""Coordination numbers: how many contacts a disc has, and how many of them carry a force."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from ..numbers.exact import surd
from ..numbers.vectors import IntArray
from ..scenes.names import end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .disc_contacts import plane_forces
from .field import Cell, Column, DiscScalars, Field, Table


@dataclass(frozen=True, eq=False)
class Coordination:
    """Of every disc of a scene: `loaded` contacts carry a force, `touching` ones touch.

    Contacts with supports count as the others do. Those that touch without a force are the
    osculatory ones of the optimal partition.
    """

    scene: Scene
    loaded: IntArray
    touching: IntArray

    @property
    def mean(self) -> Fraction | None:
        """The mean of `loaded` over the discs that are free to move; None where there is none.

        >>> from lcp_piles import nt60, solve
        >>> coordination(solve(nt60(2))).mean
        Fraction(2, 1)
        """
        free = [not disc.fixed for disc in self.scene.discs]
        count = sum(free)
        return Fraction(int(self.loaded[free].sum()), count) if count else None


def coordination(solution: Solution) -> Coordination:
    """The coordination numbers of a solved scene of discs.

    Parameters
    ----------
    solution : Solved
        A solution of a scene of discs.

    Returns
    -------
    Coordination
        Of every disc how many contacts carry a force (`loaded`) and how many touch (`touching`).

    Raises
    ------
    InputError
        For a scene that is not plane; `NotSolvedError` where the solution has no forces.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> coordination(solve(nt60(2))).loaded.tolist()
    [2, 1, 1]
    """
    plane_forces(solution)
    states = np.array(solution.states, dtype=object)
    loaded = states == "closed"
    return Coordination(
        solution.scene,
        _per_disc(solution.scene, loaded),
        _per_disc(solution.scene, loaded | (states == "osculatory")),
    )


def _per_disc(scene: Scene, chosen: np.ndarray[Any, np.dtype[np.bool_]]) -> IntArray:
    counts = np.zeros(len(scene.discs), dtype=np.int64)
    for end in scene.ends:
        np.add.at(counts, end[chosen & (end >= 0)], 1)
    return counts


def _table(found: Coordination) -> Table:
    facts: list[tuple[str, Cell]] = []
    if found.mean is not None:
        facts.append(("mean over the free discs", surd(found.mean)))
    for number, discs in sorted(Counter(found.loaded.tolist()).items()):
        facts.append((f"discs with {number}", discs))
    columns = (
        Column("disc"),
        *(Column(name, exact=True) for name in ("x", "y")),
        Column("loaded"),
        Column("touching"),
    )
    rows: list[list[Cell]] = [
        [end_name(disc.id), *disc.position, loaded, touching]
        for disc, loaded, touching in zip(
            found.scene.discs, found.loaded.tolist(), found.touching.tolist(), strict=True
        )
    ]
    return Table(columns, rows, facts)


def _shape(found: Coordination) -> DiscScalars:
    return DiscScalars(found.scene, found.loaded.astype(float), "contacts with force")


FIELD = Field(
    "coordination",
    "how many contacts of every disc carry a force, and how many touch",
    coordination,
    _table,
    _shape,
)
