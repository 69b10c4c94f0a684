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

from dataclasses import dataclass

import numpy as np
from flint import fmpz

from ..linear.integer_product import times
from ..mechanics.motions import Motions
from ..mechanics.system import ContactSystem
from ..numbers.exact import ONE, ZERO, Surd
from ..numbers.vectors import ExactVector, Mask, combination
from .base import Base
from .columns import at, product
from .expansion import Components, Joints, at_discs, sliding, some_of, turned
from .problem import load_on_freedoms


@dataclass(frozen=True)
class Mix:
    """A combination of motions, y; `regular` where no other would do."""

    weights: list[Surd]
    regular: bool


@dataclass(frozen=True, eq=False)
class Moving:
    """Motions of a base, each as displacements of all discs, and the joints at discs that move.

    Of the load of turned forces only what acts there does work. `pressing` are the f0 of the
    joints.
    """

    base: Base
    motions: Motions
    displacements: list[ExactVector]
    joints: Joints
    pressing: ExactVector


def moving(base: Base, motions: Motions) -> Moving:
    """What balance along some motions needs."""
    scene = base.rigid.scene
    ways = [whole_motion(base.system, motion) for motion in motions.basis]
    columns = [column for way in ways for column in way.numerators.values()]
    moves = np.array([any(entries) for entries in zip(*columns, strict=True)], dtype=bool)
    discs: Mask = np.any(moves.reshape(-1, scene.dimension), axis=1)
    kept = np.flatnonzero(at_discs(scene, base.joints.contacts, discs))
    return Moving(base, motions, ways, some_of(base.joints, kept), at(base.pressing, kept))


def balancing_mix(where: Moving, forces: Components) -> Mix:
    """The y for which forces / L at the joints, plus sum_j y_j p1(v_j), do no work on any motion.

    Where neutral motions leave a choice, some weights are zero.
    """
    system, joints = where.base.system, where.joints
    slid = [sliding(joints, way) for way in where.displacements]
    loads = [
        load_on_freedoms(system, turned(joints, components))
        for components in (forces, *([product(where.pressing, x) for x in s] for s in slid))
    ]
    basis = where.motions.basis
    rows = [[work(p, motion) for p in loads[1:]] for motion in basis]
    return _solve(rows, [-work(loads[0], motion) for motion in basis])


def moved(
    where: Moving, mix: Mix, u: ExactVector, g: ExactVector
) -> tuple[ExactVector, ExactVector]:
    """Displacements and gaps after a mix of the motions."""
    system = where.base.system
    displacements, gaps = [(ONE, u)], [(ONE, g)]
    ways = zip(mix.weights, where.motions.basis, where.displacements, strict=True)
    for y, motion, way in ways:
        if y:
            rates = ExactVector({1: times(system.B, motion)}, fmpz(1))
            displacements.append((y, way))
            gaps.append((y, system.whole_gaps(rates).plain()))
    return combination(displacements), combination(gaps)


def whole_motion(system: ContactSystem, motion: list[fmpz]) -> ExactVector:
    """The displacements of all discs in a motion of the system, flat and without factors."""
    freedoms = ExactVector({1: motion}, fmpz(1))
    return system.whole_displacements(freedoms, prescribed=False).plain()


def work(load: ExactVector, motion: list[fmpz]) -> Surd:
    """The work of a load of the system on a motion of it."""
    total = ZERO
    for r, column in load.numerators.items():
        amount = sum((p * u for p, u in zip(column, motion, strict=True) if u), fmpz(0))
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
