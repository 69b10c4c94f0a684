"""The fabric tensor: in which directions the contacts point that carry the force.

F = (1/N_c) sum n n^T over the N_c contacts with force, n their unit normals (Satake 1982; Oda
1982). Its trace is 1, its larger eigenvalue belongs to the direction in which most contacts point,
and the difference of the two is the anisotropy: 0 where all directions are alike, 1 where all
contacts point the same way. Contacts with supports count as the others do.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import InputError
from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .disc_contacts import plane_forces
from .field import Cell, Column, DiscTensors, Field, Table

Tensor = tuple[Surd, Surd, Surd]
"""xx, xy and yy of a symmetric tensor."""


@dataclass(frozen=True, eq=False)
class Fabric:
    """The fabric of the whole pile and of every disc, exact: xx, xy, yy.

    `counts` are the contacts with force of every disc, `count` those of the pile. A disc without
    any has no tensor (None), nor has a pile.

    >>> from lcp_piles import nt60, solve
    >>> found = fabric(solve(nt60(2)))
    >>> [str(x) for x in found.pile], [str(x) for x in found.of((2, 1))]
    (['1/4', '0', '3/4'], ['1/4', '1/4*sqrt(3)', '3/4'])
    """

    scene: Scene
    count: int
    pile: Tensor | None
    counts: IntArray
    discs: tuple[Tensor | None, ...]

    def of(self, disc: DiscId) -> Tensor:
        """The tensor of a disc; `InputError` for one on which no contact pushes."""
        tensor = self.discs[self.scene.disc_index(disc)]
        if tensor is None:
            raise InputError("the disc", disc, "one with a contact that carries a force")
        return tensor

    @cached_property
    def array(self) -> FloatArray:
        """The tensors of all discs as floats, shape (discs, 2, 2), NaN where there is none."""
        nothing = (np.nan,) * 3
        rows = [nothing if t is None else tuple(map(float, t)) for t in self.discs]
        xx, xy, yy = np.array(rows).reshape(-1, 3).T
        return np.stack([xx, xy, xy, yy], axis=1).reshape(-1, 2, 2)


def fabric(solution: Solution) -> Fabric:
    """The fabric tensors of a solved scene of discs, exact whichever arithmetic solved it.

    F = (1/N_c) sum n n^T over the N_c contacts with force, n their unit normals.

    Parameters
    ----------
    solution : Solved
        A solution of a scene of discs.

    Returns
    -------
    Fabric
        The tensors xx, xy, yy of the whole pile and of every disc, without a unit.

    Raises
    ------
    InputError
        For a scene that is not plane; `NotSolvedError` where the solution has no forces.

    References
    ----------
    Satake (1982); Oda (1982).

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> [str(x) for x in fabric(solve(nt60(2))).pile]
    ['1/4', '0', '3/4']
    """
    plane_forces(solution)
    scene = solution.scene
    normals, which = scene.normals
    carrying = np.array([state == "closed" for state in solution.states], dtype=bool)
    a, b = scene.ends
    dyads = [(x * x, x * y, y * y) for x, y in normals]
    # How many contacts of each disc have each normal: a lattice has few of them.
    pairs: dict[tuple[int, int], int] = {}
    for end in (a, b):
        chosen = carrying & (end >= 0)
        for pair in zip(end[chosen].tolist(), which[chosen].tolist(), strict=True):
            pairs[pair] = pairs.get(pair, 0) + 1
    by_disc: list[dict[int, int]] = [{} for _ in scene.discs]
    for (disc, normal), count in pairs.items():
        by_disc[disc][normal] = count
    whole = np.bincount(which[carrying], minlength=len(normals)).tolist()
    return Fabric(
        scene,
        int(carrying.sum()),
        _mean(dyads, {n: count for n, count in enumerate(whole) if count}),
        np.array([sum(counts.values()) for counts in by_disc], dtype=np.int64),
        tuple(_mean(dyads, counts) for counts in by_disc),
    )


def anisotropy(tensor: Tensor) -> float:
    """The difference of the eigenvalues of a fabric tensor, in [0, 1].

    >>> from lcp_piles import nt60, solve
    >>> anisotropy(fabric(solve(nt60(2))).pile)
    0.5
    """
    xx, xy, yy = tensor
    return float(np.hypot(float(xx - yy), float(2 * xy)))


def major_angle(tensor: Tensor) -> float:
    """Where most contacts point: degrees from the x axis, in (-90, 90]; NaN without a direction."""
    xx, xy, yy = tensor
    if xx == yy and not xy:
        return np.nan
    # Adding zero turns -0.0 into 0.0, which keeps a vertical direction at 90 and not at -90.
    return float(np.degrees(np.arctan2(float(2 * xy) + 0.0, float(xx - yy))) / 2)


def _mean(dyads: list[Tensor], counts: dict[int, int]) -> Tensor | None:
    total = sum(counts.values())
    if not total:
        return None
    xx, xy, yy = (
        sum((dyads[n][part] * count for n, count in counts.items()), ZERO) / total
        for part in range(3)
    )
    return xx, xy, yy


def _table(found: Fabric) -> Table:
    columns = (
        Column("disc"),
        Column("contacts"),
        *(Column(name, exact=True) for name in ("xx", "xy", "yy")),
        Column("anisotropy"),
        Column("angle_degrees"),
    )
    rows = [_row("pile", found.count, found.pile)]
    for disc, count, tensor in zip(
        found.scene.discs, found.counts.tolist(), found.discs, strict=True
    ):
        rows.append(_row(end_name(disc.id), count, tensor))
    return Table(columns, rows)


def _row(name: str, count: int, tensor: Tensor | None) -> list[Cell]:
    if tensor is None:
        return [name, count, None, None, None, None, None]
    return [name, count, *tensor, anisotropy(tensor), major_angle(tensor)]


def _shape(found: Fabric) -> DiscTensors:
    return DiscTensors(found.scene, found.array, "negative", "share of contacts", 1)


FIELD = Field(
    "fabric",
    "the mean of n n^T over the contacts with force, of the pile and of every disc",
    fabric,
    _table,
    _shape,
)
