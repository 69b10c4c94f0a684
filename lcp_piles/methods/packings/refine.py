"""Displacements of a packing whose closed contacts are held, improved in double-double.

All that enters is known to 100 bits: normals n within 4 e of each component, gaps o within their
`gap_error`, loads and stiffnesses E exactly (e = `double_double.ERROR`, the relative error of an
operation). For given displacements U, exact as sums of two floats, the gaps and what the forces
leave unbalanced come out with these errors.

Gaps. A difference of displacements is within e, a component's product with n within 6 e, and the
at most three sums with o add e each, of what is summed in size: with S = sum |n_i du_i| + |o|,

    |error of g| <= 9 e S + gap_error.

Forces and balance. lambda = -E g is within E |error of g| + e |lambda|, and what it pushes along an
axis, lambda n_i, within |n_i| (E |error of g| + 6 e |lambda|). These pushes are added to the loads
as follows. With sigma a power of two above the sum of the sizes of all m terms at a freedom, the
high parts of the terms, rounded to multiples of u sigma, add up without rounding, because the sums
are multiples of u sigma below sigma; the rest is below u sigma a term, and adding that and the low
parts in floats loses at most (m + 1) u of the sum of their sizes (Rump, Ogita and Oishi 2008,
"Accurate floating-point summation", SIAM J. Sci. Comput. 31). The last sum is rounded once.

Each bound is itself computed in floats from non-negative numbers; `UP` covers that, and that B is
within 1.01 u of the normals.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.sparse import csr_array

from ...linear.springs import Springs
from ...numbers.double_double import ERROR, DoubleDouble
from ...numbers.floats import LOST, UNIT, UP, Bounded
from ...numbers.vectors import FloatArray, IntArray, Mask
from ...packings.packing import Packing

_ROUNDS = 12


@dataclass(frozen=True, eq=False)
class Held:
    """A packing with some contacts `closed`, as springs of both signs.

    `B` (contacts, freedoms) are the normals in floats, over the free motions; `active` numbers the
    freedoms that move, the others stay where they are.
    """

    packing: Packing
    B: csr_array
    closed: Mask
    active: IntArray


@dataclass(frozen=True, eq=False)
class Refined:
    """Gaps within bounds of displacements near the true ones, and `rest`, a bound of |D r|.

    r is the unbalanced force of those displacements on every active freedom, D the scaling of the
    springs.
    """

    gaps: Bounded
    rest: float


def refined(held: Held, bound: Springs, U: FloatArray) -> Refined:
    """The displacements of the held contacts from a start U (freedoms), as far as they get."""
    at = DoubleDouble.of(U)
    rest, best = inf, Bounded(np.zeros(0), np.zeros(0))
    for _ in range(_ROUNDS):
        gaps, error = _gaps(held.packing, at)
        force, doubt = _unbalanced(held, gaps, error)
        with np.errstate(all="ignore"):
            sizes = bound.D * (np.abs(force) + doubt)[held.active]
            left = float(np.linalg.norm(sizes)) * UP + LOST
        if not left < rest:
            break
        enough = left > rest / 2  # where rounding is all that is left
        rest = left
        best = Bounded(gaps.high, (error + np.abs(gaps.low)) * UP)
        step = np.zeros_like(U)
        step[held.active] = bound.solve(force[held.active])
        if enough or not np.isfinite(step).all():
            break
        at = at + DoubleDouble.of(step)
    return Refined(best, rest)


def _gaps(packing: Packing, U: DoubleDouble) -> tuple[DoubleDouble, FloatArray]:
    """N . (u_a - u_b) + o of every contact, and bounds of the errors."""
    # One more freedom, and one more disc, that do not move: what is held, and all supports.
    where = np.append(packing.free, np.full((1, packing.dimension), -1), axis=0)
    u = DoubleDouble(np.append(U.high, 0.0)[where], np.append(U.low, 0.0)[where])
    parts = packing.normals * (u[packing.a] - u[packing.b])
    total = packing.gaps
    for axis in range(packing.dimension):
        total = total + parts[:, axis]
    size = np.abs(parts.high).sum(axis=1) + np.abs(packing.gaps.high)
    return total, (9 * ERROR * size + packing.gap_error) * UP + LOST


def _unbalanced(held: Held, gaps: DoubleDouble, error: FloatArray) -> tuple[FloatArray, FloatArray]:
    """B^T lambda + p of the forces of closed contacts, and bounds of the errors."""
    packing, closed = held.packing, np.flatnonzero(held.closed)
    E = packing.stiffness[closed]
    force = -(gaps[closed] * DoubleDouble.of(E))
    doubt = (E * error[closed] + 6 * ERROR * np.abs(force.high)) * UP + LOST
    push = packing.normals[closed] * force[:, None]
    free = packing.free
    ends = (
        free[packing.a[closed]],
        np.where(packing.b[closed, None] >= 0, free[packing.b[closed]], -1),
    )
    freedom = np.concatenate([end.ravel() for end in (*ends, free)])
    high = np.concatenate([push.high.ravel(), -push.high.ravel(), packing.loads.ravel()])
    low = np.concatenate([push.low.ravel(), -push.low.ravel(), np.zeros(free.size)])
    there = freedom >= 0
    total, lost = _sums(freedom[there], high[there], low[there], held.B.shape[1])
    return total, (abs(held.B[closed]).T @ doubt + lost) * UP + LOST


def _sums(
    where: IntArray, high: FloatArray, low: FloatArray, count: int
) -> tuple[FloatArray, FloatArray]:
    """Sums of the terms high + low that belong to each of `count` places, and error bounds."""
    terms = np.bincount(where, minlength=count)
    largest = np.frexp(np.abs(high).max(initial=0.0))[1]
    sigma = np.ldexp(1.0, int(largest) + int(terms.max(initial=0)).bit_length() + 1)
    front = (sigma + high) - sigma
    tail = (high - front) + low
    exact = np.bincount(where, front, count)
    small = np.bincount(where, tail, count)
    size = np.bincount(where, np.abs(tail), count)
    total = np.asarray(exact + small, dtype=np.float64)
    lost = np.asarray((terms + 1) * size + np.abs(total), dtype=np.float64) * UNIT * UP
    return total, lost
