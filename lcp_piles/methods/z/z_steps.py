"""The linear steps of the Z algorithm: a pile with some contacts absent and all others bilateral.

Where the closed contacts leave a mechanism that carries no load, the displacements are not unique.
Both steps take the smallest ones, in the sum of |u|^2 over all discs: a choice that no numbering
of freedoms changes, so that exact and floating-point arithmetic walk the same way.
"""

from __future__ import annotations

from math import lcm

import numpy as np
from flint import fmpq_mat, fmpz, fmpz_mat
from scipy.linalg import lstsq

from ...linear.kernel import times
from ...mechanics.held_set import held_set
from ...mechanics.motions import CollapseError
from ...mechanics.state import State
from ...mechanics.system import ContactSystem
from ...numbers.vectors import ExactVector, FloatArray, Mask
from ..float_state import FloatState
from .z_iteration import LinearStep, Solved


def exact_step(system: ContactSystem) -> LinearStep[State]:
    """The exact linear step of a contact system, by `HeldSet`."""
    weights = _weights(system)

    def step(Z: frozenset[int]) -> Solved[State] | None:
        held = held_set(system, closed_mask(system, Z))
        try:
            state = held.state(system.gap, system.load)
        except CollapseError:
            return None
        motions = held.free.basis
        if motions:
            state = _smallest(system, state, motions, weights)
        forces = np.where(system.bilateral, 0, state.forces.signs()).tolist()
        distances = physical(system, _distances(system, state))
        rank = system.dof - len(motions)
        return Solved(forces, state.gaps.signs(), distances, rank, len(motions), state)

    return step


def _weights(system: ContactSystem) -> list[int]:
    """W with sum_j W_j U_j^2 the sum of |u|^2 over all discs of the whole scene."""
    reduction = system.reduction
    squares = [int((f * f).rational()) for f in system.displacement_factor]
    alive = np.flatnonzero(reduction.sign)
    shares = np.array(squares)[alive % len(squares)]
    weights: list[int] = (
        np.bincount(reduction.freedom[alive], shares, system.dof).astype(int).tolist()
    )
    return weights


def _smallest(
    system: ContactSystem, state: State, motions: list[list[fmpz]], weights: list[int]
) -> State:
    """The state with the smallest displacements among those that differ by free motions.

    With the motions as the rows of N: U - N^T (N W N^T)^-1 N W U, exactly.
    """
    N = fmpz_mat(motions)
    weighted = fmpz_mat(
        [[x * w for x, w in zip(motion, weights, strict=True)] for motion in motions]
    )
    inverse, den = fmpq_mat(weighted * N.transpose()).inv().numer_denom()
    U, gaps, forces = {}, {}, {}
    for r, column in state.displacements.numerators.items():
        amounts = inverse * (weighted * fmpz_mat([[x] for x in column]))
        shift = [-x for x in (N.transpose() * amounts).entries()]
        rates = times(system.B, shift)
        U[r] = [x * den + d for x, d in zip(column, shift, strict=True)]
        gaps[r] = [x * den + d for x, d in zip(state.gaps.numerators[r], rates, strict=True)]
        forces[r] = [x * den for x in state.forces.numerators[r]]
    bottom = state.displacements.denominator * den
    return State(*(ExactVector(v, bottom) for v in (U, gaps, forces)))


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

    def step(Z: frozenset[int]) -> Solved[FloatState] | None:
        closed = closed_mask(system, Z)
        elastic, rigid = closed & (C != 0), closed & (C == 0)
        E = np.zeros_like(C)
        E[elastic] = 1 / C[elastic]
        # As in `equations`: K v + B_R^T y = p - B^T E o, B_R v = -o, with y = -lambda.
        B_R = B[rigid]
        zero = np.zeros((len(B_R), len(B_R)), dtype)
        A = np.block([[B.T @ (E[:, None] * B), B_R.T], [B_R, zero]])
        right = np.concatenate([p - B.T @ (E * o), -o[rigid]])
        if not (np.isfinite(A).all() and np.isfinite(right).all()):
            return None  # beyond the range of these floats nothing can be solved
        small = np.finfo(dtype).eps * max(len(A), 1)
        x, _, rank, _ = lstsq(A, right, cond=small, lapack_driver="gelsy")
        v = x[: len(p)]
        distances = B @ v + o
        forces = -E * distances
        forces[rigid] = -x[len(p) :]
        largest = max(np.abs(forces).max(initial=0), np.abs(p).max(initial=0))
        reach = max(np.abs(v).max(initial=0), np.abs(o).max(initial=0))
        left = np.abs(B.T @ forces + p).max(initial=0)
        apart = np.abs(distances[rigid]).max(initial=0)
        if not (left <= tolerance * largest and apart <= tolerance * reach):
            return None
        gaps = np.where(closed, 0, distances)
        return Solved(
            _signs(np.where(system.bilateral, 0, forces), tolerance * largest),
            _signs(gaps, tolerance * reach),
            distances,
            rank - len(B_R),
            len(A) - rank,
            FloatState(v / length, forces, gaps, closed, 1, float(left / (largest or 1)), True),
        )

    return step


def float_tolerance(arithmetic: str) -> float:
    """The share of the largest that counts as zero: the square root of the machine epsilon."""
    return float(np.finfo(np.dtype(arithmetic)).eps ** 0.5)


def _signs(values: FloatArray, zero: float) -> list[int]:
    signs: list[int] = np.where(np.abs(values) <= zero, 0, np.sign(values)).astype(int).tolist()
    return signs


def closed_mask(system: ContactSystem, Z: frozenset[int]) -> Mask:
    """All contacts but those of Z."""
    closed = np.ones(system.contacts, dtype=bool)
    closed[list(Z)] = False
    return closed


def _distances(system: ContactSystem, state: State) -> ExactVector:
    """B U + o, that is, gap - C lambda, of all contacts."""
    scale = lcm(*(c.denominator for c in system.compliance))
    compliance = [int(c * scale) for c in system.compliance]
    numerators = {
        r: [g * scale - f * c for g, f, c in zip(gaps, forces, compliance, strict=True)]
        for r, gaps, forces in (
            (r, column, state.forces.numerators[r]) for r, column in state.gaps.numerators.items()
        )
    }
    return ExactVector(numerators, state.gaps.denominator * scale)


def physical(system: ContactSystem, gaps: ExactVector) -> ExactVector:
    """Gaps in w tau, which are comparable between directions; those of the system are not."""
    return ExactVector(gaps.numerators, gaps.denominator, system.gap_factor, system.factor_of)
