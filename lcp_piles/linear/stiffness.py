"""The stiffness matrix B^T D B + e I of one B and many D, factored fast in floating point.

The entries of its band (`banded`) are fixed combinations of the entries of D, so the order and the
pattern are found once, and one sparse product fills the band for each D. Where the band would be
too wide, or D has negative entries, SuperLU takes over. What is small is written out instead
(`filled_stiffness`): there the calls are what takes time, not the entries that are zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from ..numbers.vectors import FloatArray, IntArray
from .banded import Solve, band_order, cholesky
from .factors import sparse_factors

_LARGEST_BAND = 6_000_000
_LARGEST_FILLED = 16_000  # places of B
_NOT_DEFINITE = "the stiffness matrix is not positive definite to rounding"


@dataclass(frozen=True, eq=False)
class Stiffness:
    """B^T D B for any D: `entries` times the diagonal of D is the band, flat, column by column.

    `order` lists the freedoms in the order of the band; `entries` is None where there is no band.
    B may be written out with all its zeros.
    """

    B: csr_array | FloatArray
    transposed: csr_array | FloatArray
    order: IntArray
    entries: csc_array | None


def stiffness(B: csr_array) -> Stiffness:
    """What all B^T D B share, for a sparse B of shape (contacts, freedoms)."""
    n = B.shape[1]
    transposed = csr_array(B.T)
    order = band_order(csr_array(transposed @ B))
    place = np.argsort(order)
    # All pairs of entries in one row of B: where they stand in the band, and their product.
    lengths = np.diff(B.indptr).astype(np.int64)
    first = np.repeat(np.arange(B.nnz), np.repeat(lengths, lengths))
    row = np.repeat(np.arange(len(lengths)), lengths * lengths)
    squares = np.cumsum(lengths * lengths)
    within = np.arange(len(first)) - (squares - lengths * lengths)[row]
    second = B.indptr[row] + within % lengths[row]
    i, j = place[B.indices[first]], place[B.indices[second]]
    lower = i >= j
    i, j, first, second = i[lower], j[lower], first[lower], second[lower]
    width = int((i - j).max(initial=0)) + 1
    if n * width > _LARGEST_BAND:
        return Stiffness(B, transposed, order, None)
    ends = np.append(0, np.cumsum(lengths * (lengths + 1) // 2))
    pairs = (B.data[first] * B.data[second], j * width + (i - j), ends)
    return Stiffness(B, transposed, order, csc_array(pairs, shape=(n * width, B.shape[0])))


def filled_stiffness(B: csr_array) -> Stiffness | None:
    """The same with B written out; None where it is too large for that to be quicker."""
    if B.shape[0] * B.shape[1] > _LARGEST_FILLED:
        return None
    filled = B.toarray()
    return Stiffness(filled, np.ascontiguousarray(filled.T), np.arange(B.shape[1]), None)


def factor(matrix: Stiffness, D: FloatArray, soft: float) -> Solve:
    """A solver for B^T D B + soft I; `RuntimeError` where that is not regular to rounding."""
    if isinstance(matrix.B, np.ndarray):
        K = (matrix.transposed * D) @ matrix.B
        K[np.diag_indices(len(K))] += soft
        if D.min(initial=0.0) < 0:
            indefinite: Solve = sparse_factors(csr_array(K), symmetric=True).solve
            return indefinite
        return _filled_factors(K)
    if matrix.entries is None or D.min(initial=0.0) < 0:
        K = matrix.transposed @ (diags_array(D) @ matrix.B)
        softened = K + diags_array(np.full(K.shape[0], soft))
        factors = sparse_factors(softened, symmetric=True)
        solve: Solve = factors.solve
        return solve
    band = (matrix.entries @ D).reshape(len(matrix.order), -1).T
    band[0] += soft
    found = cholesky(band, matrix.order)
    if found is None:
        raise RuntimeError(_NOT_DEFINITE)
    return found.solve


def _filled_factors(K: FloatArray) -> Solve:
    from scipy.linalg import lapack  # slow to import

    if not len(K):
        return np.zeros_like
    factors, info = lapack.dpotrf(K, lower=1)
    if info != 0 or not np.isfinite(factors.diagonal()).all():
        raise RuntimeError(_NOT_DEFINITE)

    def solve(b: FloatArray) -> FloatArray:
        solution: FloatArray = lapack.dpotrs(factors, b, lower=1)[0]
        return solution

    return solve
