"""Sparse symmetric matrices as narrow bands, and their Cholesky factors in floating point.

Piles are long and thin for a matrix: with the freedoms in the order of Cuthill and McKee (1969,
"Reducing the bandwidth of sparse symmetric matrices") a pile of N layers has a band about N wide,
and LAPACK factors n rows of width b in n b^2 operations, at the speed of dense blocks.

A band is an array (width, n) in column order: entry [d, j] is the matrix's [j + d, j].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..numbers.vectors import FloatArray, IntArray

_MOST = 2**27  # entries of a band: a gigabyte
_SOFT, _SMALL = 1e-12, 1e-7
"""Regularisation, and a pivot of a dependent row, relative to the largest entry.

What such a pivot is grows with the square of the entries of the dependence.
"""
Solve = Callable[[FloatArray], FloatArray]
"""From right-hand sides, of shape (n,) or (n, k), to solutions."""


def band_order(A: csr_array) -> IntArray:
    """The rows of a symmetric matrix in an order that makes its band narrow."""
    from scipy.sparse.csgraph import reverse_cuthill_mckee  # slow to import, like lapack below

    if A.shape[0] == 0:
        return np.empty(0, dtype=np.int64)
    return np.asarray(reverse_cuthill_mckee(A, symmetric_mode=True), dtype=np.int64)


def lower_band(A: csr_array, order: IntArray, most: int = _MOST) -> FloatArray | None:
    """The lower half of a symmetric matrix as a band; None if that has more than `most` entries."""
    n = len(order)
    place = np.argsort(order)
    i, j = place[np.repeat(np.arange(n), np.diff(A.indptr))], place[A.indices]
    lower = i >= j
    i, j = i[lower], j[lower]
    width = int((i - j).max(initial=0)) + 1
    if width * n > most:
        return None
    flat = np.bincount(j * width + (i - j), A.data[lower], n * width)  # integers where empty
    return np.asarray(flat, dtype=np.float64).reshape(n, width).T


@dataclass(frozen=True, eq=False)
class Cholesky:
    """A = L L^T of a band: the band of L, and the order of the rows of A in it."""

    L: FloatArray
    order: IntArray

    def solve(self, b: FloatArray) -> FloatArray:
        """A^-1 b, for b of shape (n,) or (n, k)."""
        from scipy.linalg import lapack

        x = np.empty(b.shape)
        if not len(self.order):
            return x
        x[self.order] = lapack.dpbtrs(self.L, b[self.order], lower=1)[0]
        return x


def cholesky(band: FloatArray, order: IntArray) -> Cholesky | None:
    """The Cholesky factors of a band, which is overwritten; None where a pivot is not positive.

    >>> A = csr_array(np.array([[2.0, 1.0], [1.0, 2.0]]))
    >>> order = band_order(A)
    >>> factors = cholesky(lower_band(A, order, most=4), order)
    >>> factors.solve(np.array([3.0, 3.0])).round(12).tolist()
    [1.0, 1.0]
    """
    from scipy.linalg import lapack

    L, info = lapack.dpbtrf(band, lower=1, overwrite_ab=1)
    # What is not a number passes some libraries' test of the pivots.
    return Cholesky(L, order) if info == 0 and np.isfinite(L[0]).all() else None


def vanishing_pivots(band: FloatArray) -> IntArray | None:
    """The places of a semidefinite band at which elimination leaves nothing but rounding.

    A row that depends on those before it in the band leaves nothing on the diagonal; a little
    regularisation keeps the rest going. None where the band is not semidefinite to rounding.

    >>> vanishing_pivots(np.array([[1.0, 1.0, 2.0], [1.0, 0.0, 0.0]])).tolist()
    [1]
    """
    largest = float(band[0].max(initial=0.0)) or 1.0
    softened = band.copy(order="F")
    softened[0] += _SOFT * largest
    factors = cholesky(softened, np.arange(band.shape[1]))
    return None if factors is None else np.flatnonzero(factors.L[0] ** 2 < _SMALL * largest)
