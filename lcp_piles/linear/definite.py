"""A proof, in floating point with error bounds, that a sparse matrix is positive definite.

If the Cholesky factorisation of a symmetric matrix A' runs to its end in floating point, its result
R satisfies R^T R = A' + Delta with |Delta_ij| <= eps sqrt(a'_ii a'_jj), eps = gamma / (1 - gamma),
gamma = k u / (1 - k u), where k - 1 is the largest number of terms in a sum (Demmel 1989; Higham,
"Accuracy and Stability of Numerical Algorithms", theorem 10.5; the order of summation is free). In
a band no sum has more terms than the band is wide, and Delta has no entries outside the band. So

    |Delta|_2 <= |Delta|_inf <= eps (2 width - 1) max a'_ii,

and since R^T R has no negative eigenvalue, A = A' + alpha I has none below alpha - |Delta|_2. (The
idea: Rump 2006, "Verification of positive definiteness", BIT 46.) The proof costs one factorisation
of a band, and fails only for matrices that are nearly singular.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from ..numbers.vectors import FloatArray, IntArray
from .banded import band_order, cholesky, lower_band
from .integer_matrix import BigMatrix, IntegerMatrix, largest_entry

_UNIT = 2.0**-53
_ALPHAS = (1e-7, 1e-10)
_SMALL = 150


def is_positive_definite(A: csr_array) -> bool:
    """Whether the integer matrix A, symmetric, is proved positive definite; False proves nothing.

    >>> is_positive_definite(csr_array([[2, -1], [-1, 2]]))
    True
    >>> is_positive_definite(csr_array([[1, -1], [-1, 1]]))
    False
    """
    return least_eigenvalue(A) > 0


def has_independent_columns(B: IntegerMatrix) -> bool:
    """Whether the columns of B are proved independent, by B^T B; False proves nothing.

    For matrices so small that a band is no gain: as `least_eigenvalue`, the whole width long.

    >>> has_independent_columns(csr_array([[1, 1], [1, -1]]))
    True
    """
    n = B.shape[1]
    if isinstance(B, BigMatrix) or n > _SMALL:
        return False
    if B.shape[0] * largest_entry(B) ** 2 > 2**52:  # sums in floats are those of integers
        return False
    if not n:
        return True
    filled = B.toarray().astype(np.float64)
    K = filled.T @ filled
    largest = float(K.diagonal().max())
    alpha = _ALPHAS[0] * largest
    K[np.diag_indices(n)] -= alpha
    try:
        factors = np.linalg.cholesky(K)
    except np.linalg.LinAlgError:
        return False
    return bool(np.isfinite(factors).all()) and alpha > (_rounding(n) * n + 2 * _UNIT) * largest


def _rounding(width: int) -> float:
    """The eps above, for sums of at most so many terms."""
    terms = 2 * (width + 4)  # twice, for libraries that multiply by rounded reciprocals
    gamma = terms * _UNIT / (1 - terms * _UNIT)
    return gamma / (1 - gamma)


def least_eigenvalue(A: csr_array, alphas: tuple[float, ...] = _ALPHAS) -> float:
    """A proved lower bound of the least eigenvalue of A: 0 if none is, infinite without any.

    A is a symmetric integer matrix. The bound is just below the first of `alphas`, fractions of the
    largest entry of the diagonal, that is below the least eigenvalue by more than rounding.
    """
    if not A.shape[0]:
        return float("inf")
    diagonal = A.diagonal()
    # Entries have to be floats without rounding.
    if not (diagonal > 0).all() or not 0 < float(abs(A).max()) <= 2.0**52:
        return 0.0
    order = band_order(A)
    band = lower_band(A, order)
    return 0.0 if band is None else band_bound(band, order, alphas)


def band_bound(band: FloatArray, order: IntArray, alphas: tuple[float, ...] = _ALPHAS) -> float:
    """As `least_eigenvalue`, for a band (`banded`) whose floats are taken for exact.

    Its diagonal is positive.
    """
    largest = float(band[0].max(initial=0.0))
    eps = _rounding(len(band))
    for fraction in alphas:
        alpha = fraction * largest
        shifted = band.copy(order="F")
        shifted[0] -= alpha
        if cholesky(shifted, order) is not None:
            # Plus the rounding of a_ii - alpha, at most u a_ii.
            lost = (eps * (2 * len(band) - 1) + 2 * _UNIT) * largest
            return max((alpha - lost) * (1 - 4 * _UNIT), 0.0)
    return 0.0
