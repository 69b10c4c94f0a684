"""The kernel of an integer matrix, exactly: which motions change no gap.

Floating point proposes the columns P that are independent, exact arithmetic decides:

* B_P^T B_P is proved positive definite with error bounds (`definite`), so the rank is at least |P|;
* each other column has to be a combination of those of P, which one exact sparse solve of the
  normal equations gives and an exact product checks, so the rank is no more.

Where the proposal fails, elimination modulo a prime takes its place (a rank modulo a prime is never
too large, so the same check makes it exact). Where B^T B is too long for int64, that elimination
comes first, and the rows that it names take the place of the normal equations: B_RP is regular
modulo the prime, so it is regular. At last there is elimination over the rationals.
"""

from __future__ import annotations

from functools import reduce
from math import lcm

import numpy as np
from flint import fmpz
from scipy.sparse import csc_array, csr_array

from ..numbers.vectors import FloatArray, IntArray, content
from .banded import band_order, cholesky, lower_band, vanishing_pivots
from .definite import has_independent_columns, is_positive_definite
from .elimination import pivots
from .integer_matrix import IntegerMatrix, dense
from .integer_product import product, product_fits, times
from .rearrangement import columns_of, rows_of, transposed
from .sparse_exact import ExactSolver, SingularError
from .threads import one_thread

_ROUNDING = 1e-10  # relative error of floating point that a fraction read off it may have
_REFINEMENTS = 2
_DENOMINATOR = 4096  # the largest that is read off
SHOWN = 2**30  # numerators and common denominators below this come out of floats exactly
_TOGETHER = 256  # vectors read off at a time: their floats are a dense table


@one_thread()
def kernel(B: IntegerMatrix) -> tuple[list[list[fmpz]], list[int]]:
    """A basis of {u : B u = 0} in integers, and the columns that make the rest independent.

    Vector k of the basis is not zero in column `pinned[k]` and zero in the other pinned ones.

    >>> kernel(csr_array(np.array([[1, -1, 0], [0, 1, -1]])))
    ([[1, 1, 1]], [0])
    """
    if has_independent_columns(B):
        return [], []
    if not product_fits(transposed(B), B):
        return _kernel_by_rows(B) or _kernel_by_elimination(B)
    K = product(transposed(B), B)
    dependent = _dependent_columns(K)
    if dependent is not None:
        basis = _combinations(B, K, dependent)
        if basis is not None:
            return basis, dependent
    dependent = sorted(set(range(B.shape[1])) - set(pivots(B).columns))
    basis = _combinations(B, K, dependent)
    return (basis, dependent) if basis is not None else _kernel_by_elimination(B)


def _dependent_columns(K: csr_array) -> list[int] | None:
    """Columns of B whose removal leaves provably independent ones; None where it is not proved.

    They are those at which eliminating K = B^T B in floating point leaves nothing.
    """
    if not K.shape[0]:
        return []
    order = band_order(K)
    band = lower_band(K, order)
    if band is None:
        return None
    places = vanishing_pivots(band)
    if places is None:
        return None
    dependent = sorted(order[places].tolist())
    kept = np.setdiff1d(np.arange(len(order)), dependent)
    K_P = csr_array(K[kept][:, kept]) if dependent else K
    return dependent if is_positive_definite(K_P) else None


def _combinations(B: csr_array, K: csr_array, dependent: list[int]) -> list[list[fmpz]] | None:
    """The kernel vectors that are one dependent column less its expression in the others.

    None where a dependent column does not depend on the others, or those are not independent.
    """
    if not dependent:
        return []
    kept = np.setdiff1d(np.arange(B.shape[1]), dependent)
    K_kept = csr_array(K[kept])
    K_P, sides = csr_array(K_kept[:, kept]), csc_array(-K_kept[:, dependent])
    basis = _read_off(B, K_P, sides, kept, dependent)
    long = [k for k, vector in enumerate(basis) if vector is None]
    try:
        solver = ExactSolver(K_P, symmetric=True)
        solutions = solver.solve_many(sides[:, long].toarray().T.tolist()) if long else []
    except SingularError:
        return None
    for k, solution in zip(long, solutions, strict=True):
        basis[k] = _kernel_vector(B, kept.tolist(), dependent[k], *solution)
    return _all_of(basis)


def _kernel_vector(
    B: IntegerMatrix, kept: list[int], column: int, numerators: list[fmpz], den: fmpz
) -> list[fmpz] | None:
    """The vector of a column less its expression in those that are kept; None if B sees it."""
    vector = [fmpz(0)] * B.shape[1]
    for j, x in zip(kept, numerators, strict=True):
        vector[j] = x
    vector[column] = den
    if any(x != 0 for x in times(B, vector)):
        return None
    common = content(vector, den)
    return [x // common for x in vector]


def _all_of(basis: list[list[fmpz] | None]) -> list[list[fmpz]] | None:
    found = [vector for vector in basis if vector is not None]
    return found if len(found) == len(basis) else None


def _read_off(
    B: csr_array, K_P: csr_array, sides: csc_array, kept: IntArray, dependent: list[int]
) -> list[list[fmpz] | None]:
    """The same, each None where its entries are not fractions that floating point shows.

    Mechanisms of piles mostly have short ones. An exact product has the last word.
    """
    order = band_order(K_P)
    band = lower_band(K_P, order)
    factors = None if band is None else cholesky(band, order)
    row = float(abs(B).sum(axis=1).max(initial=0))
    if factors is None or row * SHOWN > 2.0**62:
        return [None] * len(dependent)
    zero = fmpz(0)
    basis: list[list[fmpz] | None] = []
    for first in range(0, len(dependent), _TOGETHER):
        some = slice(first, first + _TOGETHER)
        rights = sides[:, some].toarray().astype(np.float64)
        X = factors.solve(rights)
        for _ in range(_REFINEMENTS):
            X += factors.solve(rights - K_P @ X)
        common = common_denominators(X)
        X *= common
        shown = (common > 0) & (np.abs(X).max(axis=0, initial=0.0) < SHOWN)
        vectors = np.zeros((B.shape[1], len(common)), dtype=np.int64)
        vectors[kept] = np.rint(np.where(shown, X, 0.0))
        vectors[dependent[some], np.arange(len(common))] = np.where(shown, common, 1)
        shown &= ~(B @ vectors).any(axis=0)
        vectors //= np.gcd.reduce(vectors, axis=0)
        for vector, good in zip(vectors.T, shown.tolist(), strict=True):
            entries = [zero] * len(vector)
            for j in np.flatnonzero(vector).tolist():
                entries[j] = fmpz(int(vector[j]))
            basis.append(entries if good else None)
    return basis


def common_denominators(X: FloatArray) -> IntArray:
    """For each column a denominator that all its entries seem to have, 0 where none is seen.

    Every entry is expanded in a continued fraction until that is as near as rounding allows.

    >>> common_denominators(np.array([[1 / 3, 0.0, 2**0.5], [-5 / 2, 7.0, 1.0]])).tolist()
    [6, 1, 0]
    """
    places = np.nonzero(X)
    x = np.abs(X[places])
    # Convergents p / q, those before, and what is left of the expansion.
    p, p_before, q, q_before = np.floor(x), np.ones_like(x), np.ones_like(x), np.zeros_like(x)
    with np.errstate(all="ignore"):  # what is no number is near nothing, and not read off
        rest = x - p
        while True:
            far = ~(np.abs(x - p / q) <= _ROUNDING * np.maximum(x, 1.0)) & (q <= _DENOMINATOR)
            if not far.any():
                break
            inverse = 1 / rest
            whole = np.floor(inverse)
            p, p_before = np.where(far, whole * p + p_before, p), np.where(far, p, p_before)
            q, q_before = np.where(far, whole * q + q_before, q), np.where(far, q, q_before)
            rest = np.where(far, inverse - whole, rest)
    found = np.ones(X.shape, dtype=np.int64)
    found[places] = np.where(q <= _DENOMINATOR, q, 0)
    denominators = [lcm(*np.unique(column).tolist()) for column in found.T]
    return np.array([d if d < SHOWN else 0 for d in denominators], dtype=np.int64)


def _kernel_by_rows(B: IntegerMatrix) -> tuple[list[list[fmpz]], list[int]] | None:
    """The same from rows and columns that are independent modulo a prime.

    None where that misled, and the other columns do not all depend on those.
    """
    rows, kept = pivots(B)
    dependent = sorted(set(range(B.shape[1])) - set(kept))
    independent = rows_of(B, rows)
    sides = dense(columns_of(independent, dependent)).transpose().tolist()
    solver = ExactSolver(columns_of(independent, kept))
    solutions = solver.solve_many([[-x for x in side] for side in sides])
    basis = _all_of(
        [
            _kernel_vector(B, kept, column, *solution)
            for column, solution in zip(dependent, solutions, strict=True)
        ]
    )
    return None if basis is None else (basis, dependent)


def _kernel_by_elimination(B: IntegerMatrix) -> tuple[list[list[fmpz]], list[int]]:
    """The same by exact elimination over the rationals, where the prime misled."""
    columns = B.shape[1]
    reduced, den, rank = dense(B).rref()
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
