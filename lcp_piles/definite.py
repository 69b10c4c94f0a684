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

import numpy as np
from scipy.sparse import csc_array, csr_array, eye_array

_U = 2.0**-53
_ALPHAS = (1e-7, 1e-10)


def is_positive_definite(A: csr_array) -> bool:
    """Whether the integer matrix A, symmetric, is proved positive definite; False proves nothing.

    >>> is_positive_definite(csr_array(np.array([[2, -1], [-1, 2]])))
    True
    >>> is_positive_definite(csr_array(np.array([[1, -1], [-1, 1]])))
    False
    """
    n = A.shape[0]
    if n == 0:
        return True
    largest = float(abs(A).max()) if A.nnz else 0.0
    if largest == 0 or largest > 2.0**52:  # its entries have to be floats without rounding
        return False
    return any(_proved(csc_array(A.astype(np.float64)), alpha * largest) for alpha in _ALPHAS)


def _proved(A: csc_array, alpha: float) -> bool:
    from scipy.sparse.linalg import splu

    n = A.shape[0]
    shifted = csc_array(A - alpha * eye_array(n))
    try:
        lu = splu(
            shifted,
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError:
        return False
    diagonal = lu.U.diagonal()
    # Rows and columns have to be permuted alike for the factors to be those of a symmetric matrix.
    inverse = np.empty(n, dtype=np.int64)
    inverse[lu.perm_c] = np.arange(n)
    if not (np.array_equal(lu.perm_r[inverse], np.arange(n)) and (diagonal > 0).all()):
        return False
    L, U = csr_array(lu.L), csr_array(lu.U)
    terms = int(max(np.diff(L.indptr).max(), np.diff(csc_array(lu.U).indptr).max())) + 2
    gamma = terms * _U / (1 - terms * _U)
    ones = np.ones(n)
    abs_L, abs_U = abs(L), abs(U)
    product = csr_array(L.T) * diagonal[:, None]  # D L^T, rounded
    rest = abs(U - csr_array(product)) @ ones + 4 * _U * (abs_U @ ones + abs(product) @ ones)
    bound = gamma * (abs_L @ (abs_U @ ones)) + abs_L @ rest
    # Rounding of A - alpha I on its diagonal, and of the sums above (n terms of one sign).
    total = float(bound.max()) * (1 + 4 * (n + 4) * _U) + 2 * _U * (float(abs(A).max()) + alpha)
    return bool(total < alpha)
