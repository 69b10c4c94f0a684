"""Why contacts that just touch do so in every solution: a stress that presses, a motion that opens.

Let N be a basis of the motions that leave the contacts with forces at rest. Where none of them
opens a contact in doubt (rows P of B N), there are weights v > 0 on those with P^T v = 0 (see
`partition.balancing_weights`). B^T v then does no work on any motion of N, so forces of the other
contacts balance it, and make it a self-stress. With self-stresses in the place of motions the same
gives a motion that opens every rigid contact in doubt.
"""

from __future__ import annotations

import numpy as np
from flint import fmpz

from ..linear.integer_product import product, times
from ..linear.kernel import kernel
from ..linear.rearrangement import rows_of, transposed
from ..linear.sparse_exact import ExactSolver
from ..mechanics.held_set import held_set, independent_rigid
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector, IntArray, Mask
from ..solution.partition import balancing_weights

Motions = list[list[fmpz]]


def pressing_stress(
    system: ContactSystem, held: Mask, idle: IntArray, mechanisms: Motions
) -> ExactVector:
    """A self-stress that is positive on all idle contacts and lives on them and the held ones.

    One entry a contact, in the units of forces; `mechanisms` leave the held contacts at rest.
    """
    weights = [fmpz(1)] * len(idle)
    if mechanisms:
        rates = [times(rows_of(system.B, idle), motion) for motion in mechanisms]
        weights = balancing_weights([list(row) for row in zip(*rates, strict=True)])
    load = times(transposed(rows_of(system.B, idle)), weights)
    nothing = ExactVector({1: [fmpz(0)] * system.contacts}, fmpz(1))
    firm = held_set(system, independent_rigid(system, held))
    answer = firm.state(nothing, ExactVector({1: load}, fmpz(1))).forces
    stress = list(answer.numerators[1])
    for k, weight in zip(idle.tolist(), weights, strict=True):
        stress[k] = weight * answer.denominator
    return system.whole_forces(ExactVector({1: stress}, answer.denominator))


def opening_motion(system: ContactSystem, held: Mask, idle: IntArray) -> ExactVector:
    """A motion that opens all idle rigid contacts, and leaves the held rigid ones at rest.

    One entry a disc and axis. `idle` are rigid ones that no self-stress of rigid contacts loads
    without pulling at another.
    """
    rigid = np.concatenate([np.flatnonzero(system.rigid & held), idle])
    B = rows_of(system.B, rigid)
    stresses, dependent = kernel(transposed(B))
    weights = [fmpz(1)] * len(idle)
    if stresses:
        weights = balancing_weights([[s[k] for s in stresses] for k in range(-len(idle), 0)])
    wanted = [fmpz(0)] * (len(rigid) - len(idle)) + weights
    # Independent rows R reach every rate: U = R^T (R R^T)^-1 of it; the others follow.
    chosen = np.delete(np.arange(len(rigid)), dependent)
    R = rows_of(B, chosen)
    S, den = ExactSolver(product(R, transposed(R)), symmetric=True).solve(
        [wanted[k] for k in chosen.tolist()]
    )
    U = ExactVector({1: times(transposed(R), S)}, den)
    return system.whole_displacements(U, prescribed=False)
