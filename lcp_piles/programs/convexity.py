"""Whether a rational symmetric matrix is positive semidefinite, and a witness where it is not."""

from __future__ import annotations

import numpy as np
from flint import fmpq, fmpq_mat
from scipy.sparse import csr_array

from ..linear.definite import is_positive_definite


def negative_direction(P: fmpq_mat) -> fmpq_mat | None:
    """A column d with d . P d < 0; None if P, symmetric, is positive semidefinite.

    Most definite matrices are proved so in floating point with bounds (`linear.definite`); exact
    elimination decides the rest. While all pivots are positive, the rest S of the matrix is the
    Schur complement of the rows K done, and e . S e = d . P d for d = e - P_KK^-1 P_K e.

    >>> negative_direction(fmpq_mat(2, 2, [1, 2, 2, 1])).entries()
    [-2, 1]
    """
    numbers, _ = P.numer_denom()
    if max((abs(x) for x in numbers.entries()), default=0) < 2**52 and is_positive_definite(
        csr_array(np.array(numbers.tolist(), dtype=np.int64).reshape(P.nrows(), P.ncols()))
    ):
        return None
    n = P.nrows()
    S = P.tolist()
    done: list[int] = []
    for k in range(n):
        if S[k][k] < 0:
            return _lifted(P, done, {k: fmpq(1)})
        if S[k][k] == 0:
            for j in range(k + 1, n):
                if S[k][j] != 0:  # (a e_k + e_j) . S (a e_k + e_j) = 2 a S_kj + S_jj = -1
                    return _lifted(P, done, {k: -(S[j][j] + 1) / (2 * S[k][j]), j: fmpq(1)})
            continue
        done.append(k)
        for i in range(k + 1, n):
            if S[i][k] != 0:
                factor = S[i][k] / S[k][k]
                for j in range(k + 1, n):
                    S[i][j] -= factor * S[k][j]
    return None


def _lifted(P: fmpq_mat, done: list[int], e: dict[int, fmpq]) -> fmpq_mat:
    """The direction d = e - P_KK^-1 P_K e, K the rows done."""
    d = fmpq_mat(P.nrows(), 1)
    for i, x in e.items():
        d[i, 0] = x
    if done:
        size = len(done)
        right = fmpq_mat(size, 1, [(P * d)[i, 0] for i in done])
        block = fmpq_mat(size, size, [P[i, j] for i in done for j in done])
        for i, x in zip(done, block.solve(right).entries(), strict=True):
            d[i, 0] = -x
    return d
