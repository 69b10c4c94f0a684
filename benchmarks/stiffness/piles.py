"""The piles of `notes/stiffness.md`, and the error of the rigid limit and of the first order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from lcp_piles import FirstOrder, Scene, Solved, deform, first_order, nt30, nt60, solve, tbs, tss

PILES: dict[str, Scene] = {
    "NT30 6": nt30(6),
    "NT30 6, push 20": nt30(6, push=20),
    "NT60 5": nt60(5),
    "TBS 8": tbs(8),
    "TBS 10": tbs(10),
}
"""Stable piles, on which the bars are measured."""
SADDLES: dict[str, Scene] = {
    "NT30 7": nt30(7),
    "NT30 8": nt30(8),
    "TSS 3": tss(3),
    "NT60 3": nt60(3),
}


@dataclass(frozen=True, eq=False)
class Case:
    """A pile with its rigid limit and its first order."""

    name: str
    rigid: Solved
    first: FirstOrder

    @property
    def largest(self) -> float:
        """The largest rigid force (w)."""
        return float(self.rigid.force_array.max())

    def errors(self, forces: np.ndarray, tau: float) -> tuple[float, float]:
        """How far the rigid limit and the first order are from these forces (w)."""
        rigid = self.rigid.force_array
        first = rigid + tau * self.first.force_array
        return float(np.abs(forces - rigid).max()), float(np.abs(forces - first).max())


@cache
def case(name: str) -> Case:
    """The case of this name, solved once."""
    rigid = solve((PILES | SADDLES)[name])
    assert rigid.status == "solved"
    first = first_order(rigid)
    assert first.status == "found"
    return Case(name, rigid, first)


def nonlinear_errors(which: Case, tau: float) -> tuple[float, float]:
    """The errors against the nonlinear pile at tau, not a number where it has no equilibrium."""
    pile = deform(which.first, tau)
    if not pile.converged:
        return float("nan"), float("nan")
    return which.errors(pile.forces, tau)
