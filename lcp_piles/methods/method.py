"""What a method is: a way from a contact system to an outcome, exact or in floating point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, Protocol

from flint import fmpz

from ..mechanics.motions import Motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..solution.finish import collapsed, finished, timed
from ..solution.record import make_record
from ..solution.solution import Solution, Status, Unresolved
from .float_state import FloatState, float_solution

Arithmetic = Literal["exact", "float64", "float32"]
Progress = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Outcome:
    """What a method ended with, in the units of the contact system.

    `state` is exact or floating point, None where there is none. `motion` proves that no forces
    balance the load: a collapse in integers, one entry a freedom. `steps` counts what the method
    counts (pivots, linear systems, sweeps), `proof` says in words why the answer is one, and
    `guess_errors` how many contacts a floating-point guess had named wrongly. `free` are motions of
    some contact set that were found on the way, and that a later stage may have use for.
    """

    steps: int
    proof: str
    state: State | FloatState | None = None
    motion: list[fmpz] | None = None
    guess_errors: int | None = None
    free: Motions | None = None

    @property
    def claim(self) -> Status:
        """What the method says of the scene; a state that did not converge is "unresolved"."""
        if self.motion is not None:
            return "unstable"
        if self.state is None or (isinstance(self.state, FloatState) and not self.state.converged):
            return "unresolved"
        return "solved"

    @property
    def residual(self) -> float | None:
        """What is left relative to the largest force: 0 for an exact state, None without one."""
        if self.state is None:
            return None
        return self.state.residual if isinstance(self.state, FloatState) else 0.0


def float_outcome(state: FloatState) -> Outcome:
    """The outcome of a floating-point method that ended in a state."""
    proof = "none: floating point"
    if not state.converged:
        proof = f"none: no convergence, {state.residual:.1e} of the largest force is left"
    return Outcome(state.steps, proof, state)


class Run(Protocol):
    """How a method is called."""

    def __call__(self, system: ContactSystem, progress: Progress | None = None, /) -> Outcome:
        """The outcome for a contact system; `progress` is called with a line of text at times."""


@dataclass(frozen=True)
class Method:
    """One way from a contact system to its forces.

    `title` says in half a line what it does; `run` does it. Where the arithmetic is not exact,
    `resolution` is the share of the largest force, or displacement, that counts as zero when
    states of contacts are read off.
    """

    name: str
    title: str
    arithmetic: Arithmetic
    run: Run
    resolution: float = 0.0


def answer(system: ContactSystem, method: Method, outcome: Outcome, start: float) -> Solution:
    """The solution of the whole scene that an outcome is, verified where it is exact.

    `start` is the clock (`perf_counter`) from which the record counts its seconds.
    """
    record = make_record(
        system, method.name, method.arithmetic, outcome.steps, outcome.proof, outcome.guess_errors
    )
    state = outcome.state
    if outcome.motion is not None:
        return timed(collapsed(system, outcome.motion, record), start)
    if isinstance(state, State):
        return timed(finished(system, state, record, outcome.free), start)
    if state is None or not state.converged:
        return timed(Unresolved(system.scene, record), start)
    return timed(float_solution(system, state, record, method.resolution), start)
