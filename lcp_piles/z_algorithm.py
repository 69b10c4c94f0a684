"""The Z algorithm of the paper on a scene, in exact or in floating-point arithmetic.

The iteration is that of `z_iteration`; here are its two linear steps. Oron and Herrmann, section
"Resolution steps", with what the paper leaves open settled so:

* "the closest couple of separated discs" is the contact of Z with the smallest |gap| in the last
  state that was solved (before there is one: in the undisplaced pile); ties go to the contact that
  comes first in the scene. Contacts go back one at a time.
* Where the contacts left closed are a mechanism that carries no load, the displacements are not
  unique, and the gaps that decide what returns depend on the choice. Both steps keep those freedoms
  at zero that depend on earlier ones (as `BilateralPile` does), so both walk the same way.
* Contacts with force zero stay, contacts of Z with gap zero return.

A fixed point solves the scene: what is absent has a positive gap, what is present does not pull.
That the iteration gets there is not promised: it may cycle.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np
from scipy.linalg import lstsq

from .bilateral import BilateralPile, CollapseError, Mask, State
from .errors import InputError
from .float_solution import float_solution
from .scene import Scene
from .solution import Solution
from .solve import collapsed, finished, make_record
from .system import ContactSystem, contact_system
from .vectors import ExactVector, FloatArray
from .z_iteration import LinearStep, Outcome, Solved, ZStatus, ZStep, iterate

ARITHMETICS = ("exact", "float64", "float32")
DEFAULT_LIMIT = 1000


@dataclass(frozen=True, eq=False)
class ZResult:
    """What the Z algorithm did with a scene.

    `status` is "solved", "cycle" (then `cycle` are the sets Z that repeat, in order), "limit", or
    "unstable" (the pile does not stand with all contacts closed). `solution` is of the kind that
    `solve` returns, verified where it is exact; None for a cycle, a limit, and a scene that
    floating point found unstable. In `trace` and `cycle` contacts are numbered as in
    `scene.contacts`; where the symmetric half was solved, the first of a mirror pair stands for both.
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
    ('solved', [0, 8, 9, 10])
    """
    clock = perf_counter()
    if arithmetic not in ARITHMETICS:
        raise InputError("the arithmetic", arithmetic, "one of " + ", ".join(ARITHMETICS))
    system = contact_system(scene, "whole" if whole else None)
    Z = _numbers(system, start)
    if arithmetic == "exact":
        outcome = iterate(exact_step(system), Z, system.physical_gaps(system.gap), limit)
        return _result(system, outcome, _exact_solution(system, outcome, clock))
    steps = FloatSteps(system, arithmetic)
    found = iterate(steps, Z, steps.gap_factor * steps.o, limit)
    return _result(system, found, _float_solution(system, found, arithmetic, clock))
