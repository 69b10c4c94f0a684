"""Of which class the matrix of an LCP is, where exact arithmetic tells so quickly.

What a class means for the LCP is in Cottle, Pang and Stone, "The Linear Complementarity Problem"
(1992): theorem 3.3.7 for P-matrices, 3.11.6 for Z-matrices, section 4.4 for the rays of the others.
Of a copositive M a ray gives u = dz with u . M u = 0, M u >= 0 and q . u < 0, which proves that
there is no solution only where M^T u <= 0, as follows for semidefinite ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from flint import fmpz_mat
from scipy.sparse import csr_array

from ..linear.definite import is_positive_definite
from ..linear.integer_matrix import BigMatrix, IntegerMatrix, diagonal, entries, largest_entry
from ..linear.integer_product import product
from ..linear.threads import one_thread
from ..pivoting.lcp import LCP
from ..pivoting.rows import RationalRows
from .dominance import dominating

_SMALL = 100  # rows of a matrix whose characteristic polynomial is computed
_LARGEST = 2**50
_NOISE = 1e-9


@dataclass(frozen=True)
class MatrixClass:
    """A class of matrices, and what it says of an LCP.

    `unique` says that there is exactly one solution for every q. `of_limit` and `of_ray` are what
    is known where Lemke's method has ended on its limit, or on a ray without a certificate, which
    cannot be where `of_ray` is empty.
    """

    name: str
    unique: bool
    of_limit: str
    of_ray: str = ""


_ONE = "There is exactly one solution, since M is {}: a larger limit on pivots finds it."
_DEFINITE = MatrixClass("positive definite", True, _ONE.format("positive definite"))
_P = MatrixClass("P", True, _ONE.format("a P-matrix"))
_SEMIDEFINITE = MatrixClass(
    "positive semidefinite",
    False,
    "M is positive semidefinite: a larger limit on pivots finds a solution, or a proof of none.",
)
_STRICTLY_COPOSITIVE = MatrixClass(
    "strictly copositive",
    False,
    "There is a solution, since M is strictly copositive: a larger limit on pivots finds one.",
)
_Z = MatrixClass(
    "Z",
    False,
    "M is a Z-matrix: there is a solution if any z >= 0 has M z + q >= 0, which is not known.",
    "M is a Z-matrix: there is a solution if any z >= 0 has M z + q >= 0, which the ray leaves "
    "open.",
)
_COPOSITIVE = MatrixClass(
    "copositive",
    False,
    "M is copositive: a larger limit on pivots may find a solution, or a ray.",
    "M is copositive: a solution would exist if u . q >= 0 for all u >= 0 with M u >= 0 and "
    "u . M u = 0, and the ray's dz is such a u with u . q < 0; there may be one all the same.",
)
_UNKNOWN = MatrixClass(
    "unknown",
    False,
    "Nothing is known: the class of M was not recognised, and the pivots were stopped.",
    "Nothing is known: the class of M was not recognised, and a ray by itself proves nothing.",
)


def matrix_class(problem: LCP) -> MatrixClass:
    """The first class of these that M is proved to be of; "unknown" proves nothing.

    An LCP that gives its matrix by columns only is not looked at.

    >>> from lcp_piles import lcp
    >>> [matrix_class(lcp(M, [0, 0])).name for M in ([[2, 1], [1, 2]], [[1, 3], [0, 1]])]
    ['positive definite', 'P']
    """
    if problem.rows is None:
        return _UNKNOWN
    symmetric = symmetric_part(problem.rows)
    A = problem.rows.A  # rows over positive denominators: signs and dominance stay
    if _definite(symmetric):
        return _DEFINITE
    if dominating(A) is not None:
        return _P
    if _semidefinite(symmetric):
        return _SEMIDEFINITE
    beside, on = _signs(A)
    if min(beside, default=0) >= 0 and min(on, default=0) >= 0:
        return _STRICTLY_COPOSITIVE if min(on, default=0) > 0 else _COPOSITIVE
    return _Z if max(beside, default=0) <= 0 else _UNKNOWN


def symmetric_part(rows: RationalRows) -> csr_array | None:
    """M + M^T times a positive integer; None where its entries are too long for floats."""
    A: IntegerMatrix = rows.A
    if set(rows.denominators) != {rows.common}:
        A = product(diagonal([rows.common // den for den in rows.denominators]), A)
    if isinstance(A, BigMatrix) or largest_entry(A) > _LARGEST:
        return None
    return csr_array(A + A.T)


def _definite(symmetric: csr_array | None) -> bool:
    return symmetric is not None and is_positive_definite(symmetric)


@one_thread()
def _semidefinite(symmetric: csr_array | None) -> bool:
    """By the signs of the characteristic polynomial, which has real roots only (Descartes)."""
    if symmetric is None or symmetric.shape[0] > _SMALL:
        return False
    full = symmetric.toarray()
    values = np.linalg.eigvalsh(full.astype(np.float64))
    if values[0] < -_NOISE * max(float(np.abs(values).max()), 1.0):
        return False
    coefficients = fmpz_mat(full.tolist()).charpoly().coeffs()[::-1]
    return all(x >= 0 if k % 2 == 0 else x <= 0 for k, x in enumerate(coefficients))


def _signs(A: IntegerMatrix) -> tuple[list[int], list[int]]:
    """The signs of the entries beside the diagonal that stand, and those of the diagonal."""
    values = [(x > 0) - (x < 0) for x in entries(A)]
    rows = np.repeat(np.arange(A.shape[0]), np.diff(A.indptr))
    on_diagonal = rows == A.indices
    on = [0] * A.shape[0]
    beside = []
    for sign, row, here in zip(values, rows.tolist(), on_diagonal.tolist(), strict=True):
        if here:
            on[row] = sign
        else:
            beside.append(sign)
    return beside, on
