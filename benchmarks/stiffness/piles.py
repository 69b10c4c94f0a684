"""The piles of `notes/stiffness.md`, and the error of the rigid limit and of the first order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from benchmarks.comparison.molecular import settle
from lcp_piles import FirstOrder, Scene, Solved, deform, first_order, nt30, nt60, solve, tbs, tss
from lcp_piles.numbers.vectors import FloatArray

PILES: dict[str, Scene] = {
    "NT30 6": nt30(6),
    "NT30 6, push 20": nt30(6, push=20),
    "NT60 5": nt60(5),
    "TBS 8": tbs(8),
    "TBS 10": tbs(10),
    "TSS 2": tss(2),
}
"""Stable piles. (TSS is stable with up to two layers.)"""
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

    def errors(self, forces: FloatArray, tau: float) -> tuple[float, float]:
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


def nonlinear(which: Case, tau: float) -> FloatArray:
    """The forces of the nonlinear pile at tau, not numbers where it has no equilibrium."""
    pile = deform(which.first, tau)
    return pile.forces if pile.converged else np.full(len(pile.forces), np.nan)


def molecular(scene: Scene, tau: float, stop: float, *, hertz: bool = False) -> FloatArray:
    """The forces that LAMMPS ends with, from the lattice, to an unbalanced force of `stop`."""
    places, _ = settle(scene, tau, stop, hertz=hertz)
    a, b = scene.ends
    apart = np.linalg.norm(places[a] - places[np.maximum(b, 0)], axis=1) - 2
    overlaps = np.maximum(-np.where(b >= 0, apart, places[a, 1]) / tau, 0)
    return np.asarray(overlaps**1.5 if hertz else overlaps)
