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
from flint import fmpz

from ..errors import SolveError
from ..linear.kernel import times
from ..mechanics.held_set import HeldSet
from ..mechanics.motions import Motions, free_motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem, contact_system
from ..methods.proved import prove_or_repair
from ..methods.regular_set import Guess
from ..numbers.exact import ONE
from ..numbers.vectors import ExactVector, Mask, combination
from ..solution.partition import Partition, partition
from ..solution.solution import Solved
from ..solution.stability import Stability, stability
from .expansion import (
    Components,
    Joints,
    joints_of,
    lengthening,
    product,
    some_of,
    spread,
    turned_load,
)


@dataclass(frozen=True, eq=False)
class Base:
    """A rigid solution as the first order needs it.

    `displacements` and `gaps` are those of the whole scene, without factors; `held` holds the
    contacts of its symmetric half that carry a force, where it is symmetric, and `free` are the
    motions that leave all touching ones at rest. `joints` are the half's contacts between discs,
    among `all_joints` of the scene, and `forces` the f0 of these. `touching` is a mask of the
    half's contacts.
    """

    rigid: Solved
    displacements: ExactVector
    gaps: ExactVector
    held: HeldSet
    free: Motions
    touching: Mask
    all_joints: Joints
    joints: Joints
    forces: ExactVector

    @property
    def system(self) -> ContactSystem:
        """The contact system of the half, or of the whole."""
        return self.held.system


@dataclass(frozen=True, eq=False)
class Term:
    """f1, u1 and g1 of the whole scene, and the motions of the system that u1 is determined up to.

    The motions move no contact that touches to first order. `stability` is that of the whole pile
    for small tau, where osculatory contacts have closed or opened.
    """

    forces: ExactVector
    displacements: ExactVector
    gaps: ExactVector
    motions: Motions
    stability: Stability


def base_of(solution: Solved) -> Base:
    """The base of an exact solution."""
    u, f, g = (_plain(v) for v in (solution.displacements, solution.forces, solution.gaps))
    system = contact_system(solution.scene)
    if not _is_symmetric(system, u, f):
        system = contact_system(solution.scene, "whole")
    representative = system.reduction.representative
    states = np.array(solution.states)[representative]
    every = joints_of(solution.scene)
    own = np.isin(every.contacts, representative, assume_unique=True)
    joints = some_of(every, np.flatnonzero(own))
    forces = _rows(f, joints.contacts)
    closed, touching = (states == "closed") | system.bilateral, states != "open"
    # The solution counts its mechanisms: where it has none, they need not be looked for.
    assert solution.stability is not None
    none = [Motions(system, set_, [], []) for set_ in (closed, touching)]
    known = none if not solution.stability.mechanisms else []
    held = HeldSet(system, free_motions(system, closed, known))
    free = free_motions(system, touching, [held.free, *known])
    return Base(solution, u, g, held, free, touching, every, joints, forces)


def turned_by(base: Base, s: Components) -> ExactVector:
    """The load on the system of the rigid forces when discs slide by s."""
    return turned_load(base.system, base.joints, [product(base.forces, x) for x in s])


def term_of(base: Base, s: Components) -> Term:
    """The first order where u0 slides the discs by s (which has to balance along free motions)."""
    system = base.system
    at = system.reduction.contact[base.joints.contacts]
    longer = spread(lengthening(base.joints, s), at, system.contacts)
    scales = tuple(1 / factor for factor in system.gap_factor)
    longer = replace(longer, factors=scales, factor_of=system.factor_of).plain()
    load = turned_by(base, s)
    if (base.touching & ~base.held.closed).any():
        state, motions, verdict = _with_ties(base, longer, load)
    else:
        assert base.rigid.stability is not None  # solved exactly
        state, motions, verdict = base.held.state(longer, load), base.free, base.rigid.stability
    return Term(
        system.whole_forces(state.forces).plain(),
        system.whole_displacements(state.displacements, prescribed=False).plain(),
        system.whole_gaps(state.gaps).plain(),
        motions,
        verdict,
    )


def _with_ties(
    base: Base, longer: ExactVector, load: ExactVector
) -> tuple[State, Motions, Stability]:
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
    strain = {r: times(system.B[away], column) for r, column in U.numerators.items()}
    rates = combination([(ONE, ExactVector(strain, U.denominator)), (ONE, _rows(longer, away))])
    gaps = [(ONE, spread(state.gaps, rows, system.contacts))]
    gaps.append((ONE, spread(rates, away, system.contacts)))
    whole = State(U, combination(gaps), spread(state.forces, rows, system.contacts))

    # What is closed and open for small tau, and what presses: f0, or f1 on contacts that touch.
    closed, opened = base.held.closed.copy(), ~base.touching
    closed[rows], opened[rows] = solved.closed, solved.open
    f0, f1 = np.zeros(system.contacts, dtype=np.int64), np.array(whole.forces.signs())
    f0[system.reduction.contact[base.joints.contacts]] = base.forces.signs()
    signs = np.where(base.held.closed, f0, f1).tolist()
    pressing = replace(whole, forces=ExactVector({1: [fmpz(x) for x in signs]}, fmpz(1)))
    mechanisms = free_motions(system, closed, [base.held.free])
    verdict, _ = stability(system, Partition(closed, opened, mechanisms, pressing))
    return whole, free_motions(system, ~opened, [mechanisms]), verdict


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
        B=system.B[rows],
        compliance=tuple(system.compliance[k] for k in rows.tolist()),
        gap=_rows(gap, rows),
        load=load,
        bilateral=base.held.closed[rows],
        factor_of=system.factor_of[rows],
    )


def _rows(vector: ExactVector, rows: np.ndarray) -> ExactVector:
    return vector.take(rows, np.ones(len(rows), dtype=np.int64))


def _plain(vector: object) -> ExactVector:
    assert isinstance(vector, ExactVector)
    return vector.plain()


def _is_symmetric(system: ContactSystem, u: ExactVector, f: ExactVector) -> bool:
    """Whether displacements and forces are their own mirror image (a choice, for mechanisms)."""
    image = system.symmetry
    if image is None:
        return True
    dimension = system.scene.dimension
    freedoms = np.arange(len(u))
    axis = freedoms % dimension
    places = image.discs[freedoms // dimension] * dimension + axis
    mirrored = u.take(places, np.where(axis == 0, -1, 1))
    return (
        mirrored.numerators == u.numerators and _rows(f, image.contacts).numerators == f.numerators
    )
