"""Rigorous bounds of A^-1 r for a principal submatrix A of the matrix of an LCP.

Three ways, each with its own reason why no inverse is larger (the first that holds is taken):

* A is diagonally dominant after scaling: |A^-1 r|_i <= d_i max_j |r_j| / c_j (`dominance`);
* its symmetric part has no eigenvalue below mu > 0: |x| |A x| >= x . A x >= mu |x|^2, so that
  |A^-1 r| <= |r| / mu in Euclidean norms (`linear.definite`);
* R is an inverse of A in floats with F = |R A - 1| < 1 in the norm of largest row sums:
  |A^-1 r| <= |R| |r| / (1 - F) in that norm (Rump 2010, "Verification methods", Acta Numerica 19).

Sums of n products in floats are off by at most n u / (1 - n u) times the sum of their sizes, and
`UP` covers the rounding of non-negative sums of fewer than 2^28 terms.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from flint import fmpz

from ..errors import SolveError
from ..linear.definite import least_eigenvalue
from ..linear.threads import one_thread
from ..numbers.floats import LOST, UNIT, UP, FloatArray
from ..numbers.vectors import ExactVector
from ..pivoting.rows import RationalRows
from .dominance import dominating
from .matrix_class import symmetric_part

_LARGEST = 1500  # rows of a matrix that is inverted in floats


@dataclass(frozen=True, eq=False)
class InverseBound:
    """`way` says how A^-1 is bounded; `of(r)` are upper bounds of |A^-1 r|, r in sizes."""

    way: str
    of: Callable[[FloatArray], FloatArray]


def sizes(numbers: Sequence[fmpz], den: fmpz) -> FloatArray:
    """Upper bounds in floats of the sizes of some fractions."""
    bounded = ExactVector({1: [abs(x) for x in numbers]}, den).bounded()
    return (bounded.middle + bounded.radius) * UP


def inverse_bound(rows: RationalRows, places: Sequence[int]) -> InverseBound:
    """A bound of the inverse of the part of rows.A in these rows and columns.

    Raises `SolveError` where none is found.

    >>> from lcp_piles.pivoting.rows import rational_rows
    >>> bound = inverse_bound(rational_rows([[2, 1, 0], [1, 2, 0], [0, 0, 0]]), [0, 1])
    >>> bound.of(np.array([1.0, 0.0])) >= [2 / 3, 1 / 3]
    array([ True,  True])
    """
    part = rows.part(places)
    found = dominating(part.A)
    if found is not None:
        d, c = (np.array([float(x) for x in each]) for each in found)
        return InverseBound(
            "diagonal dominance", lambda r: d * float((r / c).max(initial=0.0)) * UP + LOST
        )
    symmetric = symmetric_part(part)
    least = 0.0 if symmetric is None else least_eigenvalue(symmetric) / 2
    if least > 0:
        ups = np.array([float(part.common // den) for den in part.denominators])
        return InverseBound(
            "least eigenvalue",
            lambda r: np.full(len(r), float(np.linalg.norm(ups * r)) / least * UP + LOST),
        )
    norm = _inverse_norm(part)
    if norm is None:
        raise SolveError("no bound of the inverse was found for the proposed basis: use solve_lcp")
    return InverseBound(
        "approximate inverse",
        lambda r: np.full(len(r), float(r.max(initial=0.0)) * norm * UP + LOST),
    )


@one_thread()
def _inverse_norm(part: RationalRows) -> float | None:
    """An upper bound of the largest row sum of |A^-1|; None where none is found."""
    size = len(part)
    if size > _LARGEST:
        return None
    with np.errstate(all="ignore"):
        A = RationalRows(part.A, (fmpz(1),) * size).floats().toarray()
        try:
            R = np.linalg.inv(A)
        except np.linalg.LinAlgError:
            return None
        off = np.abs(R @ A - np.eye(size)).sum(axis=1)
        lost = np.abs(R) @ np.abs(A).sum(axis=1) * ((size + 8) * UNIT)
        defect = float((off + lost).max(initial=0.0)) * UP + LOST * size
        norm = float(np.abs(R).sum(axis=1).max(initial=0.0)) * UP
        return norm / (1 - defect) * UP if defect < 0.5 and np.isfinite(norm) else None
