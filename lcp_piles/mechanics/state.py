"""States of a contact system, and the states on the line through two of them."""

from __future__ import annotations

from dataclasses import dataclass

from ..numbers.exact import ONE, Surd
from ..numbers.vectors import ExactVector, combination


@dataclass(frozen=True, eq=False, repr=False)
class State:
    """Displacements U, gaps and multipliers lambda of a contact system, over one denominator."""

    displacements: ExactVector
    gaps: ExactVector
    forces: ExactVector

    def __repr__(self) -> str:
        return f"<State of {len(self.displacements)} freedoms, {len(self.gaps)} contacts>"


def state_between(start: State, end: State, t: Surd) -> State:
    """The state start + t (end - start)."""
    return State(
        _between(start.displacements, end.displacements, t),
        _between(start.gaps, end.gaps, t),
        _between(start.forces, end.forces, t),
    )


def _between(start: ExactVector, end: ExactVector, t: Surd) -> ExactVector:
    """The vector start + t (end - start)."""
    return combination([(ONE - t, start), (t, end)])
