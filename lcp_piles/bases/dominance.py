"""Proof that a matrix is diagonally dominant after a scaling of its columns.

The comparison matrix <A> has |A_ii| on the diagonal and -|A_ij| beside it. Where some d > 0 has
c = <A> d > 0, A is an H-matrix, every principal submatrix too, with the same d, and

    |A^-1 r|_i <= d_i max_j |r_j| / c_j.

With a positive diagonal A is a P-matrix. (Berman and Plemmons, "Nonnegative Matrices in the
Mathematical Sciences" (1994), chapter 6; Cottle, Pang and Stone, "The Linear Complementarity
Problem" (1992), section 3.3.)
"""

from __future__ import annotations

import numpy as np
from flint import fmpz
from scipy.sparse import csc_array, csr_array

from ..linear.factors import sparse_factors
from ..linear.integer_matrix import BigMatrix, IntegerMatrix
from ..linear.integer_product import times
from ..linear.threads import one_thread

_BITS = 30


@one_thread()
def dominating(A: IntegerMatrix) -> tuple[list[fmpz], list[fmpz]] | None:
    """(d, <A> d), both positive, for a square matrix with a positive diagonal; None proves nothing.

    >>> dominating(csr_array(np.array([[2, 1], [1, 2]])))
    ([1, 1], [1, 1])
    >>> d, c = dominating(csr_array(np.array([[1, 3], [0, 1]])))
    >>> min(*d, *c) > 0
    True
    >>> dominating(csr_array(np.array([[1, 1], [1, 1]])))
    """
    if isinstance(A, BigMatrix) or not (A.diagonal() > 0).all():
        return None
    size = A.shape[0]
    rows = np.repeat(np.arange(size), np.diff(A.indptr))
    data = np.where(rows == A.indices, A.data, -np.abs(A.data))
    comparison = csr_array((data, A.indices, A.indptr), shape=A.shape)
    d = [fmpz(1)] * size
    c = times(comparison, d)
    if min(c, default=1) > 0:
        return d, c
    try:
        # Each row is divided by its diagonal, so that c is about as large as those.
        near = sparse_factors(csc_array(comparison)).solve(A.diagonal().astype(np.float64))
    except RuntimeError:  # singular
        return None
    if not (np.isfinite(near).all() and (near > 0).all()):
        return None
    whole = np.rint(near / near.max() * 2.0**_BITS).astype(np.int64)
    d = [fmpz(x) for x in np.maximum(whole, 1).tolist()]
    c = times(comparison, d)
    return (d, c) if min(c) > 0 else None
