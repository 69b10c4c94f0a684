"""The first-order problem: the touching contacts of a pile under turned forces and longer gaps.

With displacements to second order (`expansion`) Hooke's law and balance of order tau read

    c f1 = -(n . D1 + |s0|^2 / (2 L))              on contacts that touch,
    B^T f1 + p1 = 0,   p1 = sum of f0 s0 / L       on every freedom:

the equations of the rigid pile with other gaps and another load, and with the same matrix. A
contact that carries a force stays closed for small tau and is held closed here; one with a gap
stays open and is left out; one that just touches (osculatory) may do either, f1 >= 0, g1 >= 0 and
f1 g1 = 0, so this is again a linear complementarity problem.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import SolveError
from ..linear.integer_product import times
from ..linear.rearrangement import rows_of
from ..mechanics.motions import Motions, free_motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..methods.proved import prove_or_repair
from ..methods.regular_set import Guess
from ..numbers.exact import ONE
from ..numbers.vectors import ExactVector, combination
from ..solution.partition import Partition, partition
from .base import Base, pressing_signs
from .columns import at, product, spread
from .expansion import (
    Components,
    lengthening,
    sliding,
    turned,
)


@dataclass(frozen=True, eq=False)
class Start:
    """The pile at tau = 0, and what its geometry does at order tau.

    `displacements` and `gaps` are u0 and g0 of the whole scene. `slid` are the s0 of the base's
    joints, `longer` is |s0|^2 / (2 L) of these, and `load` the p1 on the discs of the half, flat.
    """

    displacements: ExactVector
    gaps: ExactVector
    slid: Components
    longer: ExactVector
    load: ExactVector


@dataclass(frozen=True, eq=False)
class Term:
    """f1, u1 and g1 of the whole scene, and the motions of the system that u1 is determined up to.

    The motions move no contact that touches to first order. `partition` has the states for small
    tau, where osculatory contacts have closed or opened; of the forces it has the signs.
    """

    forces: ExactVector
    displacements: ExactVector
    gaps: ExactVector
    motions: Motions
    partition: Partition


def start_of(base: Base, u0: ExactVector, g0: ExactVector) -> Start:
    """The start from displacements that balance along free motions."""
    joints = base.joints
    s = sliding(joints, u0)
    load = turned(joints, [product(base.pressing, x) for x in s])
    return Start(u0, g0, s, lengthening(joints, s), load)


def load_on_freedoms(system: ContactSystem, load: ExactVector) -> ExactVector:
    """A load on the discs of the half, flat, as one on the freedoms that stand for the whole."""
    half, dimension = system.reduction, system.scene.dimension
    alive = np.flatnonzero(half.sign)
    leaders = np.zeros(system.dof, dtype=np.int64)
    leaders[half.freedom[alive[::-1]]] = alive[::-1]  # the first that a freedom stands for
    counted = np.bincount(half.freedom[alive], minlength=system.dof)
    factors = tuple(x * int(n) for x in system.displacement_factor for n in (1, 2))
    taken = at(load, leaders)
    factor_of = 2 * (leaders % dimension) + counted - 1
    return ExactVector(taken.numerators, taken.denominator, factors, factor_of).plain()


def term_of(base: Base, start: Start) -> Term:
    """The first order from a start (which has to balance along free motions)."""
    system = base.system
    places = system.reduction.contact[base.joints.contacts]
    longer = spread(start.longer, places, system.contacts)
    scales = tuple(1 / factor for factor in system.gap_factor)
    longer = replace(longer, factors=scales, factor_of=system.factor_of).plain()
    load = load_on_freedoms(system, start.load)
    if (base.touching & ~base.held.closed).any():
        state, motions, states = _with_ties(base, longer, load)
    else:
        # The rigid solution has the denominator of the same matrix.
        state = base.held.state(longer, load, likely=base.forces.denominator)
        motions, states = base.free, base.partition
    return Term(
        system.whole_forces(state.forces).plain(),
        system.whole_displacements(state.displacements, prescribed=False).plain(),
        system.whole_gaps(state.gaps).plain(),
        motions,
        states,
    )


def _with_ties(
    base: Base, longer: ExactVector, load: ExactVector
) -> tuple[State, Motions, Partition]:
    """The same where osculatory contacts decide whether they close or open."""
    system = base.system
    rows, away = np.flatnonzero(base.touching), np.flatnonzero(~base.touching)
    touching = _touching(base, longer, load)
    state = prove_or_repair(touching, Guess(touching.bilateral, np.zeros(len(rows)))).state
    if not isinstance(state, State):
        raise SolveError(
            "the first-order problem of the contacts that just touch was not solved: negative "
            "compliances make it indefinite"
        )
    solved = partition(touching, state)
    state = solved.state
    U = state.displacements
    strain = {r: times(rows_of(system.B, away), column) for r, column in U.numerators.items()}
    rates = combination([(ONE, ExactVector(strain, U.denominator)), (ONE, at(longer, away))])
    gaps = [(ONE, spread(state.gaps, rows, system.contacts))]
    gaps.append((ONE, spread(rates, away, system.contacts)))
    whole = State(U, combination(gaps), spread(state.forces, rows, system.contacts))

    # What is closed and open for small tau, and what presses: f0, or f1 on contacts that touch.
    closed, opened = base.held.closed.copy(), ~base.touching
    closed[rows], opened[rows] = solved.closed, solved.open
    f0 = np.array(at(base.forces, system.reduction.representative).signs())
    f1 = np.array(whole.forces.signs())
    signs = np.where(base.held.closed, f0, f1).tolist()
    mechanisms = free_motions(system, closed, [base.held.free])
    states = Partition(closed, opened, mechanisms, pressing_signs(signs))
    return whole, free_motions(system, ~opened, [mechanisms]), states


def _touching(base: Base, gap: ExactVector, load: ExactVector) -> ContactSystem:
    """The system of the touching contacts, the closed ones bilateral, with other gaps and load."""
    system = base.system
    rows = np.flatnonzero(base.touching)
    number = np.full(system.contacts + 1, -1, dtype=np.int64)
    number[rows] = np.arange(len(rows))
    reduction = replace(
        system.reduction,
        contact=number[system.reduction.contact],
        representative=system.reduction.representative[rows],
        weight=system.reduction.weight[rows],
    )
    return replace(
        system,
        reduction=reduction,
        B=rows_of(system.B, rows),
        compliance=tuple(system.compliance[k] for k in rows.tolist()),
        gap=at(gap, rows),
        load=load,
        bilateral=base.held.closed[rows],
        factor_of=system.factor_of[rows],
    )
