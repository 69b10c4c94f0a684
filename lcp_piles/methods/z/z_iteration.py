"""The iteration of the paper's Z algorithm, without the linear algebra.

Z is the set of removed contacts. A linear step, given Z, solves the system with the contacts of Z
absent and all others bilateral; this module does the rest: what leaves, what returns, what is put
back where there is no solution, and when it is over (Oron and Herrmann, section "Resolution
steps"). The same loop runs on exact and on floating-point piles (`z_algorithm`) and on any LCP
(`z_lcp`); it is known as Newton-min or primal-dual active set, without a safeguard.

Why a set seen twice ends it: the next set follows from the state, and the state from the set that
was solved. So the first *solved* set that comes again comes again for ever, and the loop ends,
since there are finitely many. A set that had no solution may come again by another way and be
mended by other contacts; it does not count.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, Generic, Literal, Protocol, TypeVar

from ...errors import InputError

ZStatus = Literal["solved", "cycle", "limit", "unstable"]
State = TypeVar("State")


class Distances(Protocol):
    """One number a contact, of a type that knows abs and <."""

    def __getitem__(self, k: int, /) -> Any:
        """The number of contact k."""


@dataclass(frozen=True, eq=False)
class Solved(Generic[State]):
    """The solution of one linear system, as the iteration needs it.

    `force_signs` and `gap_signs` have one entry a contact; the force of an absent contact and the
    gap of a present one are 0, and so is the force of a contact that may pull. `distances` say how
    far the two sides of a contact are from touching unloaded, in one unit for all contacts and of
    any sign: the gap of an absent one, less than zero the overlap of a loaded one, more than zero
    the stretch of one that pulls. `rank` and `nullity` are those of its matrix: how many unknowns
    the system determines and how many it leaves undetermined. `state` is for the caller.
    """

    force_signs: Sequence[int]
    gap_signs: Sequence[int]
    distances: Distances
    rank: int
    nullity: int
    state: State


LinearStep = Callable[[frozenset[int]], Solved[State] | None]
"""The system with a set Z of contacts absent: its solution, or None where it has none."""


@dataclass(frozen=True)
class ZStep:
    """One iteration: the system that was solved and what follows from its solution.

    `Z` are the contacts absent from the system; `reintroduced` those that had to be put back, in
    this order, before there was a solution; `removed` those that pull and leave; `returned` those
    of Z that overlap or touch, and return. `nullity` is positive for a singular system that has
    solutions all the same: a mechanism that carries no load, or rigid contacts of which some say
    what the others say. `seconds` is wall time.
    """

    Z: tuple[int, ...]
    reintroduced: tuple[int, ...]
    removed: tuple[int, ...]
    returned: tuple[int, ...]
    rank: int
    nullity: int
    seconds: float

    @property
    def singular(self) -> bool:
        """Whether the system was singular but solvable."""
        return self.nullity > 0


@dataclass(frozen=True, eq=False)
class Iteration(Generic[State]):
    """How the iteration ended; `last` is the last system solved, None where there was none.

    `cycle` are the sets Z that follow each other for ever, the first after the last; it is empty
    unless the status is "cycle". The trace of a cycle ends with its first set, solved again.
    """

    status: ZStatus
    trace: tuple[ZStep, ...]
    last: Solved[State] | None
    cycle: tuple[tuple[int, ...], ...] = ()


def iterate(
    step: LinearStep[State], start: Iterable[int], distances: Distances, limit: int
) -> Iteration[State]:
    """Repeat the linear step until Z stays, comes again, or `limit` systems have been solved.

    `start` is the first Z. Where a system has no solution, the contact of Z with the smallest
    |distance| in the last solved state is put back, of several the one with the smallest number;
    `distances` serve while no system has been solved. The status is "unstable" where nothing is
    left in Z to put back and there is still no solution.
    """
    if not isinstance(limit, int) or isinstance(limit, bool) or limit < 0:
        raise InputError("the limit on iterations", limit, "a whole number of at least 0")
    Z = frozenset(start)
    solved_at: dict[frozenset[int], int] = {}
    trace: list[ZStep] = []
    last: Solved[State] | None = None
    while len(trace) < limit:
        clock = perf_counter()
        back: list[int] = []
        solved = step(Z)
        while solved is None and Z:
            closest = min(Z, key=lambda k: (abs(distances[k]), k))
            back.append(closest)
            Z = Z - {closest}
            solved = step(Z)
        if solved is None:
            return Iteration("unstable", tuple(trace), last)
        last, distances = solved, solved.distances
        removed = tuple(k for k, sign in enumerate(solved.force_signs) if sign < 0)
        returned = tuple(k for k in sorted(Z) if solved.gap_signs[k] <= 0)
        seconds = perf_counter() - clock
        trace.append(
            ZStep(
                tuple(sorted(Z)),
                tuple(back),
                removed,
                returned,
                solved.rank,
                solved.nullity,
                seconds,
            )
        )
        if not removed and not returned:
            return Iteration("solved", tuple(trace), solved)
        if Z in solved_at:
            cycle = tuple(entry.Z for entry in trace[solved_at[Z] : -1])
            return Iteration("cycle", tuple(trace), solved, cycle)
        solved_at[Z] = len(trace) - 1
        Z = (Z | set(removed)) - set(returned)
    return Iteration("limit", tuple(trace), last)
