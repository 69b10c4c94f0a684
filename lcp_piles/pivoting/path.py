"""The path of Lemke's method: from basis to basis, each pivot decided by proof.

Floats with bounds decide a pivot wherever they can (`near_basis`), from the basis alone; where a
tie, a ray or too near a race leaves them in doubt, an exact tableau is founded on that basis and
goes on for some pivots, twice as many every time, so that a problem full of ties costs little
more than it would without floats. The bases are those of exact pivots in either case. At the end
of the path z is computed exactly, and checked on the LCP itself.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal

from ..errors import SolveError
from ..numbers.vectors import ExactVector
from .basic_solution import basic_z
from .checks import checked_w, solved_w
from .direction import Direction
from .lcp import LCP
from .near_basis import NearColumns, first_to_leave
from .tableau import Tableau

End = Literal["solved", "ray", "limit"]


@dataclass(frozen=True, eq=False)
class LemkePath:
    """Where the pivots ended.

    `active` are the basic z and z0, `left` the i of which w_i is not basic. `solution` is the z and
    the w of an LCP that is solved, `ray` the tableau of a secondary ray with its direction.
    """

    end: End
    pivots: int
    active: list[int]
    left: list[int]
    solution: tuple[ExactVector, ExactVector] | None = None
    ray: tuple[Tableau, Direction] | None = None


def lemke_path(
    problem: LCP,
    cover: list[int],
    max_pivots: int | None = None,
    progress: Callable[[int], None] | None = None,
    *,
    stop_at_tie: bool,
) -> LemkePath:
    """Lemke's pivots; with `stop_at_tie` z0 leaves as soon as it can, whatever the rule says."""
    active: list[int] = []
    left: list[int] = []
    problem = replace(problem, column=cache(problem.column))  # for every table that is founded
    table = Tableau(problem, cover)
    z0 = table.z0
    if min(problem.q.signs(), default=0) >= 0:
        z = table.vector(len(problem), z0)
        return LemkePath("solved", 0, active, left, (z, checked_w(problem, z)))
    near = NearColumns(problem, cover)
    entering = z0
    direction = table.direction(entering)
    leaving: int | None = table.first_row(cover)
    solution: tuple[ExactVector, ExactVector] | None = None
    pivots, exact, patience = 0, 0, 1
    while leaving is not None:
        if pivots == max_pivots:
            return LemkePath("limit", pivots, active, left)
        if exact:
            table.pivot(entering, leaving, direction)
            exact -= 1
        _exchange(active, left, entering, leaving, near.size)
        pivots += 1
        if progress is not None:
            progress(pivots)
        if leaving == z0:
            if solution is None:
                z = basic_z(problem, [v - near.size for v in active])
                solution = z, checked_w(problem, z)
            return LemkePath("solved", pivots, active, left, solution)
        entering = table.complement(leaving)
        if not exact:
            first = first_to_leave(near, active, left, entering)
            if len(first) == 1:
                leaving = first[0]
                continue
            if stop_at_tie and z0 in first:
                # z0 falls to zero in time if what is left is a solution, on the way to which no
                # basic variable becomes negative.
                solution = _without_cover(problem, active, entering)
                if solution is not None:
                    leaving = z0
                    continue
            table = Tableau(problem, cover, active, left)
            exact, patience = patience, 2 * patience
        direction = table.direction(entering)
        leaving = table.blocking(direction, stop_at_tie=stop_at_tie)
    return LemkePath("ray", pivots, active, left, ray=(table, direction))


def _without_cover(
    problem: LCP, active: list[int], entering: int
) -> tuple[ExactVector, ExactVector] | None:
    """The solution where z0 leaves the basis for the entering variable, if that is one."""
    size = len(problem)
    basic = [v - size for v in (*active, entering) if size <= v < 2 * size]
    try:
        z = basic_z(problem, basic)
    except SolveError:
        return None
    w = solved_w(problem, z)
    return None if w is None else (z, w)


def _exchange(active: list[int], left: list[int], entering: int, leaving: int, size: int) -> None:
    if leaving < size:
        left.append(leaving)
    else:
        active.remove(leaving)
    if entering < size:
        left.remove(entering)
    else:
        active.append(entering)
