"""The Z algorithm of the paper on a scene, in exact or in floating-point arithmetic.

The iteration is that of `z_iteration`, the linear algebra that of `z_steps`. Oron and Herrmann,
section "Resolution steps", with what the paper leaves open settled so:

* "The closest couple of separated discs" is the contact of Z with the smallest
  |n . (u_a - u_b) + o| in the last state that was solved (before there is one: in the undisplaced
  pile). For a contact that was absent in that state this is its gap; for one that has only just
  been removed, whose gap as a closed contact was zero, the length by which it was stretched. Ties
  go to the contact that comes first in the scene. Contacts go back one at a time.
* Where the closed contacts leave a mechanism without load, the smallest displacements are taken,
  and the smallest forces where rigid contacts that are closed depend on each other.
* Contacts with force zero stay, contacts of Z with gap zero return.

A fixed point solves the scene: what is absent has a positive gap, what is present does not pull.
That the iteration gets there is not promised. It may cycle as any Newton-min method may, and also
in a way of its own: a contact that pulls leaves, the rest has no solution, and the closest contact,
put back, is the same one. Nor can it go on where rigid contacts have gaps that do not let all of
them be closed at once, with no contact in Z to put back.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import perf_counter
from typing import get_args

import numpy as np

from ...errors import InputError
from ...linear.threads import one_thread
from ...mechanics.system import ContactSystem, contact_system
from ...scenes.scene import Scene
from ...solution.solution import Solution
from ..method import Arithmetic, answer
from .z_iteration import ZStatus, ZStep
from .z_method import DEFAULT_LIMIT, Z_METHODS, z_iteration, z_outcome


@dataclass(frozen=True, eq=False, repr=False)
class ZResult:
    """What the Z algorithm did with a scene.

    `status` is "solved", "cycle" (then `cycle` are the sets Z that repeat, in order), "limit", or
    "unstable" (the pile does not stand with all contacts closed). `solution` is what `solve`
    returns, verified where it is exact: for an end without forces "unstable" if a motion that no
    contact resists is loaded, else "unresolved". In `trace` and `cycle` contacts are numbered as in
    `scene.contacts`; where the symmetric half was solved, the first of a mirror pair stands for
    both.
    """

    status: ZStatus
    solution: Solution
    trace: tuple[ZStep, ...]
    cycle: tuple[tuple[int, ...], ...]

    @property
    def Z(self) -> tuple[int, ...]:
        """The contacts absent from the last system that was solved."""
        return self.trace[-1].Z if self.trace else ()

    @property
    def reintroductions(self) -> int:
        """How many contacts were put back because a system had no solution."""
        return sum(len(step.reintroduced) for step in self.trace)

    @property
    def singular(self) -> int:
        """How many systems were singular but solvable."""
        return sum(step.singular for step in self.trace)

    def __repr__(self) -> str:
        return f"<ZResult {self.status} after {len(self.trace)} systems: {self.solution!r}>"


@one_thread()
def z_algorithm(
    scene: Scene,
    start: Iterable[int] = (),
    *,
    arithmetic: Arithmetic = "exact",
    whole: bool = False,
    limit: int = DEFAULT_LIMIT,
) -> ZResult:
    """Solve a scene by the Z algorithm of the paper.

    In floating point everything is relative to the square root of the machine epsilon: an
    unbalanced force above that share of the largest means that a system has no solution, and
    forces and gaps below it count as zero.

    Parameters
    ----------
    scene : Scene
        Any scene.
    start : iterable of int, optional
        The contacts removed at first, by their numbers in `scene.contacts`; on a symmetric half
        their mirror images go with them.
    arithmetic : {"exact", "float64", "float32"}, default "exact"
        What it computes with.
    whole : bool, default False
        Whether to solve the whole pile where its symmetric half would do.
    limit : int, optional
        The most systems to solve.

    Returns
    -------
    ZResult
        The `status`, the `solution`, the sets passed (`trace`), and those that repeat (`cycle`).

    Raises
    ------
    InputError
        For another arithmetic, and a contact that is none.
    ContradictionError
        Where it is exact and no displacements fit the rigid contacts.

    References
    ----------
    Oron and Herrmann (1997), "Exact calculation of force networks in granular piles".

    Examples
    --------
    >>> from lcp_piles import nt30
    >>> result = z_algorithm(nt30(4))
    >>> result.status, [len(step.Z) for step in result.trace]
    ('solved', [0, 6, 5, 4])
    """
    clock = perf_counter()
    if arithmetic not in get_args(Arithmetic):
        raise InputError("the arithmetic", arithmetic, "one of " + ", ".join(get_args(Arithmetic)))
    system = contact_system(scene, "whole" if whole else None)
    ended = z_iteration(system, arithmetic, _local(system, start), limit)
    outcome = z_outcome(system, arithmetic, ended)
    names = system.reduction.representative.tolist()
    return ZResult(
        ended.status,
        answer(system, Z_METHODS[arithmetic], outcome, clock),
        tuple(_named(entry, names) for entry in ended.trace),
        tuple(tuple(names[k] for k in Z) for Z in ended.cycle),
    )


def _local(system: ContactSystem, start: Iterable[int]) -> frozenset[int]:
    """The system's numbers of contacts given by the scene's."""
    numbers = set(start)
    count = len(system.scene.contacts)
    for k in numbers:
        if not isinstance(k, int | np.integer) or not 0 <= k < count:
            raise InputError("a contact of the start", k, f"a number from 0 to {count - 1}")
        if system.scene.contacts[k].bilateral:
            raise InputError("a contact of the start", k, "one that is not held closed")
    return frozenset(system.reduction.contact[sorted(numbers)].tolist())


def _named(entry: ZStep, names: list[int]) -> ZStep:
    """The step with contacts numbered as in the scene."""
    return replace(
        entry,
        Z=tuple(names[k] for k in entry.Z),
        reintroduced=tuple(names[k] for k in entry.reintroduced),
        removed=tuple(names[k] for k in entry.removed),
        returned=tuple(names[k] for k in entry.returned),
    )
