"""Stability of the solved pile: mechanisms of the whole, and what they do to the energy.

A motion that leaves all touching contacts at rest costs no energy at first order. Every loaded
contact between discs is in compression, so moving it across its normal lowers the energy at second
order, by f/(2R) times half the square of the sliding; contacts with the floor have no such term.
A pile with such a motion is a saddle, and a real pile slides off it.

The symmetric half hides antisymmetric motions, so both halves are asked.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from flint import fmpz

from ..linear.integer_product import times
from ..linear.rearrangement import columns_of, rows_of, rows_reaching
from ..mechanics.motions import free_motions
from ..mechanics.system import ContactSystem
from ..numbers.vectors import IntArray, Mask
from .partition import Partition

Verdict = Literal["stable", "saddle", "neutral", "undecided"]


@dataclass(frozen=True)
class Stability:
    """How many independent mechanisms the whole pile has, and the verdict.

    `mechanisms` counts motions of the whole pile that leave every contact with force at rest.
    `free` of them also leave the osculatory contacts at rest, which else hold them back. The
    verdict is "stable" without free ones, "saddle" where a free one slides a loaded contact
    between discs, "neutral" where all free ones slide none (the energy does not change at second
    order), and "undecided" for a scene whose energy is not convex to begin with, or where a free
    motion slides a bilateral contact in tension, which raises the energy.
    """

    mechanisms: int
    free: int
    verdict: Verdict

    @property
    def stable(self) -> bool | None:
        """Whether a real pile keeps this equilibrium; None where that is not decided."""
        return None if self.verdict == "undecided" else self.verdict == "stable"


def stability(system: ContactSystem, solved: Partition) -> tuple[Stability, Mask]:
    """The stability of a solved scene, and for each whole contact whether its gap is unique.

    A gap is one of several exactly where a free motion of the whole pile changes it: in a solution
    with every open contact open, small steps along a free motion lead to other solutions.
    """
    scene = system.scene
    unique = np.ones(len(scene.contacts), dtype=bool)
    counted, free, slides, hangs = 0, 0, False, False
    signs = np.array(solved.state.forces.signs(), dtype=int)[system.reduction.contact]
    for part in (system, system.odd):
        if part is None:
            continue
        # A contact has the state of the one of the solved part that stands for it.
        states = system.reduction.contact[part.reduction.representative]
        closed, touching = solved.closed[states], solved.touching[states]
        mechanisms = free_motions(part, closed, [solved.mechanisms])
        counted += len(mechanisms)
        basis: list[list[fmpz]] = []
        if len(mechanisms):  # the closed contacts touch too
            basis = free_motions(part, touching, [mechanisms]).basis
        free += len(basis)
        for motion in basis:
            # Most motions move a few discs of many: only what is near them is looked at.
            moved = np.array([x != 0 for x in motion])
            near = rows_reaching(part.B, moved)
            rates = times(columns_of(rows_of(part.B, near), moved), [x for x in motion if x != 0])
            moving = np.zeros(part.contacts + 1, dtype=bool)
            moving[near] = [x != 0 for x in rates]
            unique &= ~moving[part.reduction.contact]
            slides = slides or _slides(part, motion, moved, signs > 0)
            hangs = hangs or _slides(part, motion, moved, signs < 0)
    verdict: Verdict = "saddle" if slides else "neutral" if free else "stable"
    if not scene.definite or hangs:
        verdict = "undecided"
    return Stability(counted, free, verdict), unique


def _slides(part: ContactSystem, motion: list[fmpz], moved: Mask, loaded: Mask) -> bool:
    """Whether a motion moves the discs of a loaded contact against each other.

    `moved` marks the freedoms where it is not zero.
    """
    if not loaded.any():
        return False
    a, b = part.scene.ends
    parts, dimension = part.reduction, part.scene.dimension
    freedom, sign = (x.reshape(-1, dimension) for x in (parts.freedom, parts.sign))
    discs = (moved[freedom] & (sign != 0)).any(axis=1)
    between: IntArray = np.flatnonzero(loaded & (b >= 0) & (discs[a] | discs[b]))

    def move(disc: int) -> list[fmpz]:
        axes = zip(freedom[disc].tolist(), sign[disc].tolist(), strict=True)
        return [s * motion[j] for j, s in axes]

    return any(move(int(a[k])) != move(int(b[k])) for k in between)
