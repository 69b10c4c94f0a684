"""The optimal partition: which contacts are closed, open or osculatory over all solutions.

Forces are unique, but a pile with mechanisms has many displacements. A contact is `closed` where
its force is positive, `open` where some solution has a positive gap, `osculatory` where neither is
so in any (formulation notes). Given one solution, only its contacts without force and gap are in
doubt: each is open exactly if a motion in the kernel of the closed contacts opens it while it
closes none of the others in doubt.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from flint import fmpz, fmpz_mat

from ..errors import VerificationError
from ..linear.integer_product import times
from ..linear.rearrangement import rows_of
from ..mechanics.motions import Motions, free_motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector, Mask
from ..pivoting.lcp import LCP, IntegerColumn
from ..pivoting.lemke import lemke


@dataclass(frozen=True, eq=False)
class Partition:
    """The contacts of a system by state, and its mechanisms.

    `closed` and `open` are masks, the rest is osculatory; `mechanisms` are the motions that leave
    every contact with force at rest. `state` is a solution in which every open contact
    has a gap, so that states can be read off its signs.
    """

    closed: Mask
    open: Mask
    mechanisms: Motions
    state: State

    @property
    def touching(self) -> Mask:
        """The contacts that have no gap in any solution: closed and osculatory."""
        return ~self.open


def partition(system: ContactSystem, state: State, known: Motions | None = None) -> Partition:
    """The optimal partition of a system from one of its solutions.

    `known` are the motions of some contact set, which serve where it is the right one.
    """
    force = np.array(state.forces.signs())
    gap = np.array(state.gaps.signs())
    closed = (force > 0) | system.bilateral
    opened = gap > 0
    mechanisms = free_motions(system, closed, [known])
    motions = mechanisms.basis
    doubtful = np.flatnonzero(~closed & ~opened)
    if motions and len(doubtful):
        rates = [times(rows_of(system.B, doubtful), motion) for motion in motions]
        rows = [list(row) for row in zip(*rates, strict=True)]
        moving, mix = openable(rows)
        if moving:
            opened[doubtful[moving]] = True
            state = _moved(system, state, motions, mix)
    return Partition(closed, opened, mechanisms, state)


def openable(P: list[list[fmpz]]) -> tuple[list[int], list[fmpz]]:
    """The rows k with (P y)_k > 0 for some y with P y >= 0, and one y that serves all of them.

    The direction c = P^T 1, the sum of the rows in doubt, is projected on the cone P y >= 0: with
    y = c + P^T mu this is the LCP w = P c + P P^T mu. Either y = 0, and then c . y <= 0 for every
    y of the cone, so all rows in doubt are zero there; or c . y = |y|^2 > 0, so some row opens.
    Those rows are in doubt no more, and small steps along y keep them open, so the rest is asked
    again without them. (Projection on a polar cone: Hiriart-Urruty and Lemarechal, A.III.3.2.)

    >>> openable([[fmpz(1), fmpz(0)], [fmpz(0), fmpz(1)], [fmpz(0), fmpz(-1)]])
    ([0], [1, 0])
    """
    size = len(P[0])
    doubt = [k for k, row in enumerate(P) if any(x != 0 for x in row)]
    found: list[int] = []
    total = [fmpz(0)] * size
    while doubt:
        A = fmpz_mat(len(doubt), size, [x for k in doubt for x in P[k]])
        y = _pressed(A, _projection(A)).entries()
        rates = (A * fmpz_mat(size, 1, y)).entries()
        opening = [k for k, rate in zip(doubt, rates, strict=True) if rate > 0]
        if not opening:
            break
        total = _together(P, found, total, y)
        found += opening
        doubt = [k for k in doubt if k not in set(opening)]
    return sorted(found), total


def balancing_weights(P: list[list[fmpz]]) -> list[fmpz]:
    """Integers v > 0 with P^T v = 0: the proof that no y has P y >= 0 but those with P y = 0.

    With v = 1 + mu they are what the projection of `openable` ends with where no row opens.
    Raises `VerificationError` where one does.

    >>> balancing_weights([[fmpz(1)], [fmpz(-2)], [fmpz(0)]])
    [2, 1, 1]
    """
    A = fmpz_mat(P)
    mu = _projection(A)
    if any(_pressed(A, mu).entries()):
        raise VerificationError("a contact that is said to touch for good opens along a motion")
    return [x + mu.denominator for x in mu.numerators[1]]


def _projection(A: fmpz_mat) -> ExactVector:
    """The mu >= 0 with which c + A^T mu is the projection of c = A^T 1 on the cone A y >= 0."""
    c = A.transpose() * fmpz_mat(A.nrows(), 1, [1] * A.nrows())
    rows = (A * A.transpose()).tolist()
    q = ExactVector({1: (A * c).entries()}, fmpz(1))
    mu = lemke(LCP(q, partial(_column, rows))).z_vector
    if mu is None:
        raise VerificationError("no projection on a cone was found, and one always exists")
    return mu


def _pressed(A: fmpz_mat, mu: ExactVector) -> fmpz_mat:
    """A^T (1 + mu), times the denominator of mu."""
    weights = [x + mu.denominator for x in mu.numerators[1]]
    return A.transpose() * fmpz_mat(A.nrows(), 1, weights)


def _column(rows: list[list[fmpz]], j: int) -> IntegerColumn:
    return rows[j], fmpz(1)


def _together(
    P: list[list[fmpz]], found: list[int], first: list[fmpz], second: list[fmpz]
) -> list[fmpz]:
    """A multiple of `first` plus `second` under which the rows of `found` stay positive."""
    factor = fmpz(1)
    for k in found:
        gain = sum((p * x for p, x in zip(P[k], first, strict=True)), fmpz(0))
        loss = -sum((p * x for p, x in zip(P[k], second, strict=True)), fmpz(0))
        if loss > 0:
            factor = max(factor, loss // gain + 1)
    return [factor * x + y for x, y in zip(first, second, strict=True)]


def _moved(
    system: ContactSystem, state: State, motions: list[list[fmpz]], mix: list[fmpz]
) -> State:
    """The state after a step along a mix of motions, so short that no gap is lost."""
    U = [
        sum((c * motion[j] for c, motion in zip(mix, motions, strict=True)), fmpz(0))
        for j in range(system.dof)
    ]
    rates = times(system.B, U)
    gaps = state.gaps
    halvings = safe_halvings(gaps, rates)
    scale = fmpz(1) << halvings
    return State(shifted(state.displacements, U, scale), shifted(gaps, rates, scale), state.forces)


def safe_halvings(vector: ExactVector, change: list[fmpz]) -> int:
    """An h such that no positive entry is lost by adding change / 2^h to the vector."""
    shrinking = [k for k, x in enumerate(change) if x < 0]
    # At most a unit at the fastest entry; powers of two keep the numbers short.
    h = max((int(x.bit_length()) for x in change), default=0)
    while True:
        moved = shifted(vector, change, fmpz(1) << h).take(shrinking, [1] * len(shrinking))
        if min(moved.signs(), default=1) > 0:
            return h
        h += 4


def shifted(vector: ExactVector, change: list[fmpz], scale: fmpz) -> ExactVector:
    """The vector plus change / scale."""
    numerators = {r: [x * scale for x in column] for r, column in vector.numerators.items()}
    den = vector.denominator
    numerators[1] = [x + d * den for x, d in zip(numerators[1], change, strict=True)]
    return ExactVector(numerators, den * scale)
