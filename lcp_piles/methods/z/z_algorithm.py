"""The Z algorithm of the paper on a scene, in exact or in floating-point arithmetic.

The iteration is that of `z_iteration`, the linear algebra that of `z_steps`. Oron and Herrmann,
section "Resolution steps", with what the paper leaves open settled so:

* "The closest couple of separated discs" is the contact of Z with the smallest
  |n . (u_a - u_b) + o| in the last state that was solved (before there is one: in the undisplaced
  pile). For a contact that was absent in that state this is its gap; for one that has only just
  been removed, whose gap as a closed contact was zero, the length by which it was stretched. Ties
  go to the contact that comes first in the scene. Contacts go back one at a time.
* Where the closed contacts leave a mechanism without load, the smallest displacements are taken.
* Contacts with force zero stay, contacts of Z with gap zero return.

A fixed point solves the scene: what is absent has a positive gap, what is present does not pull.
That the iteration gets there is not promised. It may cycle as any Newton-min method may, and also
in a way of its own: a contact that pulls leaves, the rest has no solution, and the closest contact,
put back, is the same one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from ...errors import InputError
from ...mechanics.bilateral import BilateralPile, CollapseError, State
from ...mechanics.system import ContactSystem, contact_system
from ...scenes.scene import Scene
from ...solution.finish import collapsed, finished
from ...solution.record import make_record
from ...solution.solution import Solution
from ..float_solution import float_solution
from .z_iteration import Distances, LinearStep, Outcome, ZStatus, ZStep, iterate
from .z_steps import FloatState, closed_mask, exact_step, float_step, float_tolerance, physical

ARITHMETICS = ("exact", "float64", "float32")
DEFAULT_LIMIT = 1000


@dataclass(frozen=True, eq=False)
class ZResult:
    """What the Z algorithm did with a scene.

    `status` is "solved", "cycle" (then `cycle` are the sets Z that repeat, in order), "limit", or
    "unstable" (the pile does not stand with all contacts closed). `solution` is of the kind that
    `solve` returns, verified where it is exact; None for a cycle, a limit, and a scene that
    floating point found unstable. In `trace` and `cycle` contacts are numbered as in
    `scene.contacts`; where the symmetric half was solved, the first of a mirror pair stands for
    both.
    """

    status: ZStatus
    solution: Solution | None
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


def z_algorithm(
    scene: Scene,
    start: Iterable[int] = (),
    *,
    arithmetic: str = "exact",
    whole: bool = False,
    limit: int = DEFAULT_LIMIT,
) -> ZResult:
    """Solve a scene by the Z algorithm of the paper.

    Parameters: `start`, the contacts removed at first, by their numbers in `scene.contacts` (on a
    symmetric half their mirror images go with them); `arithmetic`, "exact", "float64" or "float32";
    `whole`, to solve the whole pile where its symmetric half would do; `limit` on the number of
    systems solved. Raises `SolveError` where rigid contacts depend on each other in exact
    arithmetic: their bilateral forces are not unique.

    In floating point everything is relative to the square root of the machine epsilon: an
    unbalanced force above that share of the largest means that a system has no solution, and
    forces and gaps below it count as zero.

    >>> from lcp_piles import nt30
    >>> result = z_algorithm(nt30(4))
    >>> result.status, [len(step.Z) for step in result.trace]
    ('solved', [0, 6, 5, 4])
    """
    clock = perf_counter()
    if arithmetic not in ARITHMETICS:
        raise InputError("the arithmetic", arithmetic, "one of " + ", ".join(ARITHMETICS))
    system = contact_system(scene, "whole" if whole else None)
    exact = arithmetic == "exact"
    step: LinearStep[Any] = exact_step(system) if exact else float_step(system, arithmetic)
    o = physical(system, system.gap)
    distances: Distances = o if exact else o.array()
    outcome = iterate(step, _local(system, start), distances, limit)
    make = _exact_solution if exact else _float_solution
    names = system.reduction.representative.tolist()
    return ZResult(
        outcome.status,
        make(system, outcome, arithmetic, clock),
        tuple(_named(entry, names) for entry in outcome.trace),
        tuple(tuple(names[k] for k in Z) for Z in outcome.cycle),
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


def _exact_solution(
    system: ContactSystem, outcome: Outcome[State], arithmetic: str, clock: float
) -> Solution | None:
    steps = len(outcome.trace)
    if outcome.status == "solved" and outcome.last is not None:
        proof = "fixed point of the Z iteration, verified"
        return finished(system, outcome.last.state, "z", steps, proof, clock)
    if outcome.status == "unstable":
        try:
            BilateralPile(system, closed_mask(system, frozenset())).state()
        except CollapseError as collapse:
            proof = "a free motion of the pile with all contacts closed is loaded"
            record = make_record(system, "z", arithmetic, steps, proof, clock)
            return collapsed(system, collapse.motion, record)
    return None


def _float_solution(
    system: ContactSystem, outcome: Outcome[FloatState], arithmetic: str, clock: float
) -> Solution | None:
    if outcome.status != "solved" or outcome.last is None:
        return None
    state = outcome.last.state
    return float_solution(
        system,
        state.U.astype(np.float64),
        state.forces.astype(np.float64),
        state.gaps.astype(np.float64),
        method="z",
        arithmetic=arithmetic,
        steps=len(outcome.trace),
        tolerance=float_tolerance(arithmetic),
        start=clock,
    )
