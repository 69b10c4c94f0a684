"""Which of many displacements a pile of finite stiffness takes, where the rigid limit leaves many.

The rigid limit leaves u0 undetermined by the free motions V: combinations of motions that change no
gap of a touching contact. A pile of finite stiffness must balance along them too, and there balance
is of first order: the load p1 of the turned forces, linear in the displacements, has to do no work
on any free motion,

    (p1(u) + sum_j y_j p1(v_j)) . v_i = 0 for all i,     p1(v_j) . v_i = sum f s(v_j) . s(v_i) / L.

The matrix is a Gram matrix weighted by the forces: it is regular on the motions that slide loaded
contacts, and motions that slide none (neutral ones) are left where they are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from flint import fmpz

from ..mechanics.motions import Motions
from ..mechanics.system import ContactSystem
from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import ExactVector

Load = Callable[[ExactVector], ExactVector]
"""From displacements of the whole (flat, without factors) to the load of turned forces."""


@dataclass(frozen=True)
class Mix:
    """A combination of motions, y; `regular` where no other would do."""

    weights: list[Surd]
    regular: bool


def balancing_mix(motions: Motions, load: ExactVector, turned: Load) -> Mix:
    """The y for which `load` + sum_j y_j `turned`(v_j) does no work on any of the motions.

    Where neutral motions leave a choice, some weights are zero.
    """
    loads = [turned(whole_motion(motions.system, motion)) for motion in motions.basis]
    rows = [[work(p, motion) for p in loads] for motion in motions.basis]
    return _solve(rows, [-work(load, motion) for motion in motions.basis])


def whole_motion(system: ContactSystem, motion: list[fmpz]) -> ExactVector:
    """The displacements of all discs in a motion of the system, flat and without factors."""
    freedoms = ExactVector({1: motion}, fmpz(1))
    return system.whole_displacements(freedoms, prescribed=False).plain()


def work(load: ExactVector, motion: list[fmpz]) -> Surd:
    """The work of a load of the system on a motion of it."""
    total = ZERO
    for r, column in load.numerators.items():
        amount = sum((p * u for p, u in zip(column, motion, strict=True) if u != 0), fmpz(0))
        total += ExactVector({1: [fmpz(0)], r: [amount]}, load.denominator)[0]
    return total


def _solve(rows: list[list[Surd]], right: list[Surd]) -> Mix:
    """A solution of a symmetric positive semidefinite system, zero where it leaves a choice.

    Gaussian elimination down the diagonal: a row whose pivot is zero is a zero row.
    """
    rows = [[*row, b] for row, b in zip(rows, right, strict=True)]
    size = len(rows)
    pivots = []
    for i in range(size):
        pivot = rows[i][i]
        if not pivot:
            continue
        pivots.append(i)
        rows[i] = [x / pivot if x else x for x in rows[i]]
        for k in range(size):
            factor = rows[k][i]
            if k != i and factor:
                rows[k] = [
                    x - factor * y if y else x for x, y in zip(rows[k], rows[i], strict=True)
                ]
    weights = [rows[i][size] if i in pivots else ZERO for i in range(size)]
    return Mix(weights, len(pivots) == size)
