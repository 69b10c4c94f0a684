"""The linear steps of the Z algorithm: a pile with some contacts absent and all others bilateral.

Where the closed contacts leave a mechanism that carries no load, the displacements are not unique,
and where closed rigid contacts depend on each other the forces are not. Both steps take the
smallest ones, in the sum of |u|^2 over all discs and of f^2 over all contacts: a choice that no
numbering changes, so that exact and floating-point arithmetic walk the same way. Rigid contacts
whose gaps disagree have no solution: one of them would have to overlap, or to stand open. But one
with a gap that no freedom changes is taken as what it is, and leaves.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

import numpy as np
from flint import fmpq_mat, fmpz, fmpz_mat
from scipy.linalg import lstsq

from ...linear.integer_product import times
from ...linear.kernel import kernel
from ...linear.rearrangement import rows_of, transposed
from ...mechanics.held_set import held_set, independent_rigid
from ...mechanics.motions import CollapseError
from ...mechanics.state import State
from ...mechanics.system import ContactSystem
from ...numbers.exact import ONE, Surd
from ...numbers.vectors import ExactVector, FloatArray, IntArray, Mask, combination
from ..float_state import FloatState
from .z_iteration import LinearStep, Solved


def exact_step(system: ContactSystem) -> LinearStep[State]:
    """The exact linear step of a contact system, by `HeldSet`.

    Raises `ContradictionError` where rigid contacts that are held closed contradict each other.
    """
    reduction, axes = system.reduction, system.scene.dimension
    alive = np.flatnonzero(reduction.sign)
    of_discs = _squares(system.displacement_factor, alive % axes)
    of_freedoms = [0] * system.dof
    for freedom, weight in zip(reduction.freedom[alive].tolist(), of_discs, strict=True):
        of_freedoms[freedom] += weight
    squares = _squares(system.force_factor, system.factor_of)
    of_contacts = [n * w for n, w in zip(reduction.weight.tolist(), squares, strict=True)]
    apart = _apart(system)

    def step(Z: frozenset[int]) -> Solved[State] | None:
        closed = closed_mask(system, Z | apart)
        held = held_set(system, independent_rigid(system, closed))
        try:
            state = held.state(system.gap, system.load)
        except CollapseError:
            return None
        signs = state.gaps.signs()
        if any(signs[k] for k in np.flatnonzero(closed & ~held.closed).tolist()):
            return None
        motions = held.free.basis
        if motions:
            state = _with_least_displacements(system, state, motions, of_freedoms)
        stresses: list[list[fmpz]] = []
        rigid = np.flatnonzero(closed & system.rigid)
        if held.closed.sum() < closed.sum():
            stresses = kernel(transposed(rows_of(system.B, rigid)))[0]
            state = _with_least_forces(state, rigid, stresses, of_contacts)
        forces = np.where(system.bilateral, 0, state.forces.signs())
        forces[list(apart - Z)] = -1
        distances = physical(system, _distances(system, state))
        nullity = len(motions) + len(stresses)
        rank = system.dof + len(rigid) - nullity
        return Solved(forces.tolist(), state.gaps.signs(), distances, rank, nullity, state)

    return step


def _apart(system: ContactSystem) -> frozenset[int]:
    """The rigid contacts whose gap no freedom changes and is positive: no force closes them."""
    fixed = system.rigid & ~system.bilateral & (abs(system.floats()[0]).sum(axis=1) == 0)
    return frozenset(np.flatnonzero(fixed & (np.array(system.gap.signs()) > 0)).tolist())


def _squares(factors: Sequence[Surd], which: IntArray) -> list[int]:
    """The squares of some of these factors, all times one integer."""
    squares = [(f * f).rational() for f in factors]
    common = lcm(*(x.denominator for x in squares))
    return [int(squares[k] * common) for k in which.tolist()]


def _with_least_displacements(
    system: ContactSystem, state: State, motions: list[list[fmpz]], weights: list[int]
) -> State:
    """The state with the least sum_j W_j U_j^2 among those that differ by free motions."""
    spare = _along(state.displacements, motions, weights)
    rates = _gap_rates(system, spare)
    return State(
        _difference(state.displacements, spare), _difference(state.gaps, rates), state.forces
    )


def _with_least_forces(
    state: State, rigid: IntArray, stresses: list[list[fmpz]], weights: list[int]
) -> State:
    """The state with the least sum_k W_k lambda_k^2 among those that differ by these self-stresses.

    `rigid` are the contacts that they act on.
    """
    spread = []
    for stress in stresses:
        spread.append([fmpz(0)] * len(state.forces))
        for k, x in zip(rigid.tolist(), stress, strict=True):
            spread[-1][k] = x
    forces = _difference(state.forces, _along(state.forces, spread, weights))
    return State(state.displacements, state.gaps, forces)


def _along(vector: ExactVector, basis: list[list[fmpz]], weights: list[int]) -> ExactVector:
    """The projection of a vector on the span of a basis, orthogonal in sum_j W_j x_j^2.

    With the basis as the rows of N: N^T (N W N^T)^-1 N W x, exactly.
    """
    N = fmpz_mat(basis)
    weighted = fmpz_mat([[x * w for x, w in zip(row, weights, strict=True)] for row in basis])
    inverse, den = fmpq_mat(weighted * N.transpose()).inv().numer_denom()
    parts = {
        r: (N.transpose() * (inverse * (weighted * fmpz_mat(len(x), 1, x)))).entries()
        for r, x in vector.numerators.items()
    }
    return ExactVector(parts, vector.denominator * den)


def _difference(one: ExactVector, other: ExactVector) -> ExactVector:
    return combination([(ONE, one), (-ONE, other)])


def _gap_rates(system: ContactSystem, U: ExactVector) -> ExactVector:
    """B U of every contact."""
    parts = {r: times(system.B, column) for r, column in U.numerators.items()}
    return ExactVector(parts, U.denominator)


def float_step(system: ContactSystem, arithmetic: str) -> LinearStep[FloatState]:
    """The linear step in "float64" or "float32": dense least squares, all in that type."""
    dtype = np.dtype(arithmetic)
    tolerance = float_tolerance(arithmetic)
    sparse, *vectors = system.floats()
    # How many discs move with a freedom: so that the unknowns v = length U have |v| = |u|.
    moved = system.reduction.freedom[np.flatnonzero(system.reduction.sign)]
    length = np.sqrt(np.bincount(moved, minlength=system.dof)).astype(dtype)
    B = sparse.toarray().astype(dtype) / length
    C, o, p = (vector.astype(dtype) for vector in vectors)
    p = p / length
    # How many contacts one stands for: the same for the forces of rigid contacts.
    share = np.sqrt(system.reduction.weight).astype(dtype)
    apart = _apart(system)
    load = np.abs(p).max(initial=0)
    softest = np.abs(C).max(initial=0) or 1

    def step(Z: frozenset[int]) -> Solved[FloatState] | None:
        closed = closed_mask(system, Z | apart)
        elastic, rigid = closed & (C != 0), closed & (C == 0)
        E = np.zeros_like(C)
        E[elastic] = 1 / C[elastic]
        # As in `equations`: K v + B_R^T y = p - B^T E o, B_R v = -o, with y = -lambda / share.
        B_R = share[rigid, None] * B[rigid]
        zero = np.zeros((len(B_R), len(B_R)), dtype)
        A = np.block([[B.T @ (E[:, None] * B), B_R.T], [B_R, zero]])
        right = np.concatenate([p - B.T @ (E * o), -share[rigid] * o[rigid]])
        if not (np.isfinite(A).all() and np.isfinite(right).all()):
            return None  # beyond the range of these floats nothing can be solved
        small = np.finfo(dtype).eps * max(len(A), 1)
        x, _, rank, _ = lstsq(A, right, cond=small, lapack_driver="gelsy")
        v = x[: len(p)]
        distances = B @ v + o
        forces = -E * distances
        forces[rigid] = -share[rigid] * x[len(p) :]
        # Forces that are all zero are to be compared with those that the gaps would have made,
        # displacements that are all zero with those that the forces would have.
        largest = max(np.abs(forces).max(initial=0), load or np.abs(E * o).max(initial=0) or 1)
        reach = max(np.abs(v).max(initial=0), np.abs(o).max(initial=0), softest * largest)
        left = np.abs(B.T @ forces + p).max(initial=0)
        strayed = np.abs(distances[rigid]).max(initial=0)
        if not (left <= tolerance * largest and strayed <= tolerance * reach):
            return None
        gaps = np.where(closed, 0, distances)
        signs = _signs(np.where(system.bilateral, 0, forces), tolerance * largest)
        signs[list(apart - Z)] = -1
        return Solved(
            signs.tolist(),
            _signs(gaps, tolerance * reach).tolist(),
            distances,
            rank,
            len(A) - rank,
            FloatState(v / length, forces, gaps, closed, 1, float(left / largest), True),
        )

    return step


def float_tolerance(arithmetic: str) -> float:
    """The share of the largest that counts as zero: the square root of the machine epsilon."""
    return float(np.finfo(np.dtype(arithmetic)).eps ** 0.5)


def _signs(values: FloatArray, zero: float) -> IntArray:
    return np.where(np.abs(values) <= zero, 0, np.sign(values)).astype(np.int64)


def closed_mask(system: ContactSystem, Z: frozenset[int]) -> Mask:
    """All contacts but those of Z."""
    closed = np.ones(system.contacts, dtype=bool)
    closed[list(Z)] = False
    return closed


def _distances(system: ContactSystem, state: State) -> ExactVector:
    """B U + o, that is, gap - C lambda, of all contacts."""
    return combination([(ONE, _gap_rates(system, state.displacements)), (ONE, system.gap)])


def physical(system: ContactSystem, gaps: ExactVector) -> ExactVector:
    """Gaps in w tau, which are comparable between directions; those of the system are not."""
    return ExactVector(gaps.numerators, gaps.denominator, system.gap_factor, system.factor_of)
