"""The kernel of an integer matrix, exactly: which motions change no gap.

Floating point proposes the columns P that are independent, exact arithmetic decides:

* B_P^T B_P is proved positive definite with error bounds (`definite`), so the rank is at least |P|;
* each other column has to be a combination of those of P, which one exact sparse solve of the
  normal equations gives and an exact product checks, so the rank is no more.

Where the proposal fails, elimination modulo one large prime takes its place (a rank modulo a prime
is never too large, so the same check makes it exact), and at last elimination over the rationals.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from itertools import pairwise
from math import lcm

import numpy as np
from flint import fmpz, fmpz_mat, nmod_mat
from scipy.sparse import csr_array

from ..numbers.vectors import IntArray, content
from .banded import band_order, cholesky, lower_band
from .definite import is_positive_definite
from .sparse_exact import ExactSolver, SingularError

PRIME = 9223372036854775783
_SOFT = 1e-11  # regularisation, relative to the largest entry
_FEW = 64  # different values, largest value and denominator of entries that are small fractions
_SHORT = 2**31
_SMALL = 1e-8  # a pivot below this, relative to the largest entry, is one of a dependent column


def independent_rows(B: csr_array) -> list[int]:
    """Numbers of linearly independent rows of B, as many as there are (but for a bad prime).

    >>> independent_rows(csr_array(np.array([[1, 1], [2, 2], [0, 1]])))
    [0, 2]
    """
    return _pivots(csr_array(B.T))


def kernel(B: csr_array) -> tuple[list[list[fmpz]], list[int]]:
    """A basis of {u : B u = 0} in integers, and the columns that make the rest independent.

    Vector k of the basis is not zero in column `pinned[k]` and zero in the other pinned ones.

    >>> kernel(csr_array(np.array([[1, -1, 0], [0, 1, -1]])))
    ([[1, 1, 1]], [0])
    """
    K = csr_array(B.T @ B)
    dependent = _dependent_columns(K)
    if dependent is not None:
        basis = _combinations(B, K, dependent)
        if basis is not None:
            return basis, dependent
    dependent = sorted(set(range(B.shape[1])) - set(_pivots(B)))
    basis = _combinations(B, K, dependent)
    return (basis, dependent) if basis is not None else _kernel_by_elimination(B)


def _dependent_columns(K: csr_array) -> list[int] | None:
    """Columns of B whose removal leaves provably independent ones; None where it is not proved.

    Eliminating K = B^T B in floating point, a column that depends on those eliminated before it
    leaves nothing but rounding on the diagonal; a little regularisation keeps the rest going.
    """
    if not K.shape[0]:
        return []
    order = band_order(K)
    band = lower_band(K, order)
    if band is None:
        return None
    largest = float(band[0].max()) or 1.0
    band[0] += _SOFT * largest
    factors = cholesky(band, order)
    if factors is None:
        return None
    dependent = sorted(order[factors.L[0] ** 2 < _SMALL * largest].tolist())
    kept = np.setdiff1d(np.arange(len(order)), dependent)
    K_P = csr_array(K[kept][:, kept]) if dependent else K
    return dependent if is_positive_definite(K_P) else None


def _pivots(B: csr_array) -> list[int]:
    rows, columns = B.shape
    if rows == 0 or columns == 0:
        return []
    entries = [int(x) % PRIME for x in B.toarray().ravel()]
    return pivot_columns(nmod_mat(rows, columns, entries, PRIME))


def pivot_columns(matrix: nmod_mat) -> list[int]:
    """The columns where a row echelon form has its pivots: independent, as many as there are."""
    reduced, rank = matrix.rref()
    pivots, at = [], 0
    for i in range(rank):
        while int(reduced[i, at]) == 0:
            at += 1
        pivots.append(at)
    return pivots


def _combinations(B: csr_array, K: csr_array, dependent: list[int]) -> list[list[fmpz]] | None:
    """The kernel vectors that are one dependent column less its expression in the others."""
    if not dependent:
        return []
    pivots = np.setdiff1d(np.arange(B.shape[1]), dependent).tolist()
    K_kept = csr_array(K[pivots])
    K_P, rights = csr_array(K_kept[:, pivots]), -K_kept[:, dependent].toarray().T
    basis = _small_combinations(B, K_P, rights, pivots, dependent)
    if basis is not None:
        return basis
    solver = ExactSolver(K_P, symmetric=True)
    try:
        solutions = solver.solve_many([[int(x) for x in right] for right in rights])
    except SingularError:
        return None
    basis = []
    for f, (numerators, den) in zip(dependent, solutions, strict=True):
        vector = [fmpz(0)] * B.shape[1]
        for j, x in zip(pivots, numerators, strict=True):
            vector[j] = x
        vector[f] = den
        if any(x != 0 for x in times(B, vector)):
            return None
        common = content(vector, den)
        basis.append([x // common for x in vector])
    return basis


def _small_combinations(
    B: csr_array, K_P: csr_array, rights: IntArray, pivots: list[int], dependent: list[int]
) -> list[list[fmpz]] | None:
    """The same where all entries are small fractions, which floating point then shows.

    Mechanisms of regular piles are of this kind. An exact product has the last word.
    """
    order = band_order(K_P)
    band = lower_band(K_P, order)
    factors = None if band is None else cholesky(band, order)
    if factors is None:
        return None
    X = factors.solve(rights.T.astype(np.float64))
    values = np.unique(np.abs(X).round(6))
    if len(values) > _FEW or values.max(initial=0.0) > _FEW:
        return None
    common = lcm(*(Fraction(x).limit_denominator(_FEW).denominator for x in values.tolist()))
    vectors = np.zeros((B.shape[1], len(dependent)), dtype=np.int64)
    reach = _FEW * common * float(abs(B).sum(axis=1).max(initial=0))
    if reach > 2.0**52:
        return None
    vectors[pivots] = np.rint(X * common)
    vectors[dependent, np.arange(len(dependent))] = common
    if (B @ vectors).any():
        return None
    vectors //= np.gcd.reduce(vectors, axis=0)
    return [[fmpz(x) for x in vector] for vector in vectors.T.tolist()]


def _kernel_by_elimination(B: csr_array) -> tuple[list[list[fmpz]], list[int]]:
    """The same by exact elimination over the rationals, where the prime misled."""
    rows, columns = B.shape
    reduced, den, rank = fmpz_mat(rows, columns, [int(x) for x in B.toarray().ravel()]).rref()
    pivots, at = [], 0
    for i in range(rank):
        while reduced[i, at] == 0:
            at += 1
        pivots.append(at)
    pinned = sorted(set(range(columns)) - set(pivots))
    basis = []
    for f in pinned:
        vector = [fmpz(0)] * columns
        vector[f] = fmpz(abs(den))
        for i, j in enumerate(pivots):
            vector[j] = -reduced[i, f] if den > 0 else reduced[i, f]
        common = reduce(lambda a, b: a.gcd(b), vector)
        basis.append([x // common for x in vector])
    return basis, pinned


def times(B: csr_array, vector: list[fmpz]) -> list[fmpz]:
    """B v in integers of any size."""
    short = all(-_SHORT < x < _SHORT for x in vector)
    if short and B.shape[1] * float(abs(B.data).max(initial=0)) * _SHORT < 2.0**62:
        return [fmpz(x) for x in (B @ np.array(list(map(int, vector)), dtype=np.int64)).tolist()]
    indptr, indices, data = B.indptr.tolist(), B.indices.tolist(), B.data.tolist()
    return [
        sum((data[k] * vector[indices[k]] for k in range(a, b)), fmpz(0))
        for a, b in pairwise(indptr)
    ]
