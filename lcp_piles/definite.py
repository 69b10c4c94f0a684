"""A proof, in floating point with error bounds, that a sparse matrix is positive definite.

Factor A - alpha I = L U without pivoting in symmetric mode, and let S = L D L^T with
D = diag(U) > 0, which is positive definite as it stands, whatever rounding did to its entries.
Then A = S + alpha I + Delta with

    Delta = (A - alpha I - L U) + L (U - D L^T),

symmetric, so |Delta|_2 <= |Delta|_inf. The first part is at most gamma |L| |U| (Higham, "Accuracy
and Stability of Numerical Algorithms", theorem 9.3), the second is computed. If the sum is below
alpha, A is positive definite. (The idea: Rump 2006, "Verification of positive definiteness",
BIT 46.) The proof costs one more sparse factorisation, and fails only for matrices that are nearly
singular.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array, eye_array

_UNIT = 2.0**-53
_ALPHAS = (1e-7, 1e-10)
SYMMETRIC: dict[str, Any] = {
    "permc_spec": "MMD_AT_PLUS_A",
    "diag_pivot_thresh": 0.0,
    "options": {"SymmetricMode": True},
}
"""SuperLU's options for a symmetric matrix that needs no pivoting."""


def is_positive_definite(A: csr_array) -> bool:
    """Whether the integer matrix A, symmetric, is proved positive definite; False proves nothing.

    >>> is_positive_definite(csr_array(np.array([[2, -1], [-1, 2]])))
    True
    >>> is_positive_definite(csr_array(np.array([[1, -1], [-1, 1]])))
    False
    """
    largest = float(abs(A).max()) if A.nnz else 0.0
    return A.shape[0] == 0 or any(least_eigenvalue(A, a * largest) > 0 for a in _ALPHAS)


def least_eigenvalue(A: csr_array, alpha: float) -> float:
    """A proved lower bound, just below alpha, of the least eigenvalue of A; 0 if not proved.

    A is a symmetric integer matrix. Any alpha > 0 below the least eigenvalue by more than rounding
    will do.
    """
    from scipy.sparse.linalg import splu

    n = A.shape[0]
    largest = float(abs(A).max()) if A.nnz else 0.0
    if not 0 < largest <= 2.0**52 or alpha <= 0:  # entries have to be floats without rounding
        return 0.0
    try:
        lu = splu(csc_array(A.astype(np.float64) - alpha * eye_array(n)), **SYMMETRIC)
    except RuntimeError:
        return 0.0
    diagonal = lu.U.diagonal()
    # Rows and columns have to be permuted alike for the factors to be those of a symmetric matrix.
    if not (np.array_equal(lu.perm_r, lu.perm_c) and (diagonal > 0).all()):
        return 0.0
    L, U = csr_array(lu.L), csr_array(lu.U)
    terms = int(max(np.diff(L.indptr).max(), np.diff(lu.U.indptr).max())) + 2
    gamma = terms * _UNIT / (1 - terms * _UNIT)
    ones = np.ones(n)
    product = csr_array(csr_array(L.T) * diagonal[:, None])  # D L^T, rounded
    abs_L, abs_U = abs(L), abs(U) @ ones
    rest = abs(U - product) @ ones + 4 * _UNIT * (abs_U + abs(product) @ ones)
    bound = abs_L @ (gamma * abs_U + rest)
    # The last terms: rounding of A - alpha I on its diagonal, and of the sums above, of n terms
    # of one sign each.
    total = float(bound.max()) * (1 + 4 * (n + 4) * _UNIT) + 2 * _UNIT * (largest + alpha)
    return max(float(alpha - total) * (1 - 4 * _UNIT), 0.0)
