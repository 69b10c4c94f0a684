"""A complementary basis of an LCP, proposed in floating point: nothing here is a proof.

Newton's method on min(z, w) = 0: with the z of a set B basic, M_BB z_B = -q_B, and every variable
that comes out negative changes sides. That ends after a few steps on most problems, whatever their
size, and cycles on some; where the number of negative variables has not fallen for a while, only
the last of them changes sides, which for a P-matrix ends in finite time (Kostreva 1978, "Block
pivot methods for solving the complementarity problem", Linear Algebra Appl. 21; Júdice and Pires
1994, "A block principal pivoting algorithm for large-scale strictly monotone linear
complementarity problems", Comput. Oper. Res. 21).

Where M_BB is singular, as it may be for a semidefinite M, there is no next step: such problems are
for `interior_point`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csc_array, issparse

from ..linear.factors import sparse_factors
from ..numbers.vectors import FloatArray, IntArray, Mask

_MOST = 200
_PATIENCE = 10
_NOISE_Z, _NOISE_W = 1e-9, 1e-12
"""What counts as zero, relative to the largest z, and to the terms of a w."""
_OFF = 1e-9
"""The residual of a solved system, relative to its right-hand side, that is more than rounding."""


def newton_min(M: Any, q: FloatArray, free: Mask) -> Mask | None:
    """The basic z of a basis that seems to solve w = M z + q, z >= 0, w >= 0, z . w = 0.

    `M` (n, n) is an array or a sparse matrix of entries about one; `free` marks the z that have any
    sign, whose w are zero. None where the method does not come to an end.

    >>> M, q = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([-5.0, -1.0])
    >>> newton_min(M, q, np.array([False, False])).tolist()
    [True, False]
    """
    sizes = abs(M)
    basic = free | (q < 0)
    best, patience = len(q) + 1, _PATIENCE
    for _ in range(_MOST):
        z = basic_solution(M, q, np.flatnonzero(basic))
        if z is None:
            return None
        w = M @ z + q
        noise = _NOISE_W * (sizes @ np.abs(z) + np.abs(q))
        low = -_NOISE_Z * float(np.abs(z).max(initial=0.0))
        wrong = ~free & np.where(basic, z < low, w < -noise)
        count = int(wrong.sum())
        if not count:
            return basic
        if count < best:
            best, patience = count, _PATIENCE
        elif patience:
            patience -= 1
        else:
            wrong[: np.flatnonzero(wrong)[-1]] = False
        basic = basic ^ wrong
    return None


def basic_solution(M: Any, q: FloatArray, places: IntArray) -> FloatArray | None:
    """The z of a basis; None where its matrix is singular, or too near to it."""
    z = np.zeros(len(q))
    if len(places):
        block, right = M[places][:, places], -q[places]
        found = solved(block, right)
        # Where rounding hides that it is singular, the solution is none.
        if found is None or not np.abs(block @ found - right).max() <= _OFF * np.abs(right).max():
            return None
        z[places] = found
    return z


def solved(A: Any, b: FloatArray) -> FloatArray | None:
    """A^-1 b in floats; None where A is singular to rounding."""
    try:
        x = sparse_factors(csc_array(A)).solve(b) if issparse(A) else np.linalg.solve(A, b)
    except (RuntimeError, np.linalg.LinAlgError):
        return None
    return x if np.isfinite(x).all() else None
