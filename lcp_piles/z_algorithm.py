"""The Z algorithm of the paper on a scene, in exact or in floating-point arithmetic.

The iteration is that of `z_iteration`; here are its two linear steps. Oron and Herrmann, section
"Resolution steps", with what the paper leaves open settled so:

* "the closest couple of separated discs" is the contact of Z with the smallest |n . (u_a - u_b) + o|
  in the last state that was solved (before there is one: in the undisplaced pile); ties go to the
  contact that comes first in the scene. For a contact that was absent in that state this is its
  gap, for one that has only just been removed the length by which it was stretched. Contacts go
  back one at a time.
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
from math import lcm
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
    exact = arithmetic == "exact"
    step: LinearStep[Any] = exact_step(system) if exact else float_step(system, arithmetic)
    o = _physical(system, system.gap)
    outcome = iterate(step, _local(system, start), o if exact else o.array(), limit)
    make = _exact_solution if exact else _float_solution
    names = system.reduction.representative.tolist()
    return ZResult(
        outcome.status,
        make(system, outcome, arithmetic, clock),
        tuple(_named(entry, names) for entry in outcome.trace),
        tuple(tuple(names[k] for k in Z) for Z in outcome.cycle),
    )


def exact_step(system: ContactSystem) -> LinearStep[State]:
    """The exact linear step of a contact system, by `BilateralPile`."""

    def step(Z: frozenset[int]) -> Solved[State] | None:
        pile = BilateralPile(system, _closed(system, Z))
        try:
            state = pile.state()
        except CollapseError:
            return None
        forces = np.where(system.bilateral, 0, state.forces.signs()).tolist()
        nullity = len(pile.pinned)
        distances = _physical(system, _distances(system, state))
        return Solved(forces, state.gaps.signs(), distances, system.dof - nullity, nullity, state)

    return step


@dataclass(frozen=True, eq=False)
class FloatState:
    """Displacements, gaps and multipliers of a contact system in floating point."""

    U: FloatArray
    gaps: FloatArray
    forces: FloatArray


def float_step(system: ContactSystem, arithmetic: str) -> LinearStep[FloatState]:
    """The linear step in "float64" or "float32": dense least squares, all in that type."""
    dtype = np.dtype(arithmetic)
    tolerance = _tolerance(arithmetic)
    sparse, *vectors = system.floats()
    B = sparse.toarray().astype(dtype)
    C, o, p = (vector.astype(dtype) for vector in vectors)
    factor = np.array([float(f) for f in system.gap_factor], dtype=dtype)[system.factor_of]

    def step(Z: frozenset[int]) -> Solved[FloatState] | None:
        closed = _closed(system, Z)
        pinned = _dependent_columns(B[closed], tolerance)
        free = np.setdiff1d(np.arange(system.dof), pinned)
        elastic, rigid = closed & (C != 0), closed & (C == 0)
        # As in `bilateral`: K U + B_R^T y = p - B^T E o, B_R U = -o, with y = -lambda.
        E = np.zeros_like(C)
        E[elastic] = 1 / C[elastic]
        K = B[:, free].T @ (E[:, None] * B[:, free])
        B_R = B[np.ix_(rigid, free)]
        rigids = len(B_R)
        A = np.block([[K, B_R.T], [B_R, np.zeros((rigids, rigids), dtype)]])
        right = np.concatenate([(p - B.T @ (E * o))[free], -o[rigid]])
        x = lstsq(A, right, cond=np.finfo(dtype).eps * max(len(A), 1), lapack_driver="gelsy")[0]
        U = np.zeros(system.dof, dtype)
        U[free] = x[: len(free)]
        distance = B @ U + o
        forces = -E * distance
        forces[rigid] = -x[len(free) :]
        largest = max(np.abs(forces).max(initial=0), np.abs(p).max(initial=0))
        reach = max(np.abs(U).max(initial=0), np.abs(o).max(initial=0))
        unbalanced = np.abs(B.T @ forces + p).max(initial=0) > tolerance * largest
        if unbalanced or np.abs(distance[rigid]).max(initial=0) > tolerance * reach:
            return None
        gaps = np.where(closed, 0, distance)
        return Solved(
            _signs(np.where(system.bilateral, 0, forces), tolerance * largest),
            _signs(gaps, tolerance * reach),
            distance * factor,
            len(free),
            len(pinned),
            FloatState(U, gaps, forces),
        )

    return step


def _tolerance(arithmetic: str) -> float:
    return float(np.finfo(arithmetic).eps) ** 0.5


def _signs(values: FloatArray, zero: float) -> list[int]:
    signs: list[int] = np.where(np.abs(values) <= zero, 0, np.sign(values)).astype(int).tolist()
    return signs


def _dependent_columns(B: FloatArray, tolerance: float) -> list[int]:
    """The columns that are combinations of earlier ones: Gram-Schmidt, each column twice."""
    directions = np.empty_like(B.T)
    rank = 0
    dependent = []
    for j, column in enumerate(B.T):
        known = directions[:rank]
        rest = column - known.T @ (known @ column)
        rest -= known.T @ (known @ rest)
        length = np.linalg.norm(rest)
        if length <= tolerance * np.linalg.norm(column):
            dependent.append(j)
        else:
            directions[rank] = rest / length
            rank += 1
    return dependent


def _closed(system: ContactSystem, Z: frozenset[int]) -> Mask:
    closed = np.ones(system.contacts, dtype=bool)
    closed[list(Z)] = False
    return closed


def _distances(system: ContactSystem, state: State) -> ExactVector:
    """B U + o, that is, gap - C lambda, of all contacts."""
    scale = lcm(*(c.denominator for c in system.compliance))
    compliance = [int(c * scale) for c in system.compliance]
    numerators = {
        r: [g * scale - f * c for g, f, c in zip(gaps, forces, compliance, strict=True)]
        for r, gaps, forces in (
            (r, column, state.forces.numerators[r]) for r, column in state.gaps.numerators.items()
        )
    }
    return ExactVector(numerators, state.gaps.denominator * scale)


def _physical(system: ContactSystem, gaps: ExactVector) -> ExactVector:
    """Gaps in w tau, which are comparable between directions; those of the system are not."""
    return ExactVector(gaps.numerators, gaps.denominator, system.gap_factor, system.factor_of)


def _local(system: ContactSystem, start: Iterable[int]) -> frozenset[int]:
    """The system's numbers of contacts given by the scene's."""
    numbers = set(start)
    count = len(system.scene.contacts)
    for k in numbers:
        if not isinstance(k, int) or not 0 <= k < count:
            raise InputError("a contact of the start", k, f"a number from 0 to {count - 1}")
        if system.scene.contacts[k].bilateral:
            raise InputError("a contact of the start", k, "one that is not held closed")
    return frozenset(system.reduction.contact[sorted(numbers)].tolist())


def _named(entry: ZStep, names: list[int]) -> ZStep:
    """The step with contacts numbered as in the scene."""
    lists = ("Z", "reintroduced", "removed", "returned")
    return replace(entry, **{name: tuple(names[k] for k in getattr(entry, name)) for name in lists})


def _exact_solution(
    system: ContactSystem, outcome: Outcome[State], arithmetic: str, clock: float
) -> Solution | None:
    steps = len(outcome.trace)
    if outcome.status == "solved" and outcome.last is not None:
        proof = "fixed point of the Z iteration, verified"
        return finished(system, outcome.last.state, "z", steps, proof, clock)
    if outcome.status == "unstable":
        try:
            BilateralPile(system, _closed(system, frozenset())).state()
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
        tolerance=_tolerance(arithmetic),
        start=clock,
    )
