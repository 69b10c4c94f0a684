"""What HiGHS proposes: the basis in which floating point ends. Nothing here is a proof.

Rows and columns are scaled by powers of two first, so that entries of any size become floats of
ordinary size: HiGHS drops those that are tiny and refuses those that are huge.

scipy tells the point, the reduced costs and the multipliers, not the basis. Columns outside it
stand at zero exactly and those inside have no reduced cost, so columns that are not zero are in,
and what is missing is among those where both are zero and the idle columns of rows without a
multiplier. With N = [columns that are in | random columns] the last rows of N^-1 are what the basis
still lacks; seen through them, a pivoted QR factorisation picks columns that are independent of all
that are in.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.linalg import qr
from scipy.sparse import coo_array, csc_array, hstack

from ..linear.factors import sparse_factors
from ..numbers.exact import Surd
from ..numbers.vectors import ExactVector, FloatArray, IntArray
from .constraints import StandardForm

_PASSES = 4
_OPTIONS = {
    "presolve": False,  # what it puts back at the end need not be a vertex
    "primal_feasibility_tolerance": 1e-9,
    "dual_feasibility_tolerance": 1e-9,
}
Claim = Literal["optimal", "infeasible", "nothing"]


class Proposal(NamedTuple):
    """What HiGHS claims, and its last basis: j for column j, n + i for an idle row i."""

    claim: Claim
    basis: list[int] | None


class Proposer:
    """HiGHS on one set of constraints in floating point."""

    def __init__(self, problem: StandardForm) -> None:
        shape = problem.rows, len(problem.columns)
        rows, columns, mantissas, exponents = _floats(problem)
        row_shift, self._column_shift = _scaling(rows, columns, exponents, shape)
        values = np.ldexp(mantissas, exponents + row_shift[rows] + self._column_shift[columns])
        self._matrix = csc_array(coo_array((values, (rows, columns)), shape=shape))
        self._b = _vector(problem.b, row_shift)

    def propose(self, c: ExactVector) -> Proposal:
        """The end of the simplex method in floating point for the (scaled) objective c."""
        from scipy.optimize import linprog  # here, since it is slow to import

        if not all(self._matrix.shape):
            return Proposal("nothing", None)
        cost = _vector(c, self._column_shift)
        end = linprog(cost, A_eq=self._matrix, b_eq=self._b, method="highs-ds", options=_OPTIONS)
        if end.status == 0:
            multipliers, reduced = end.eqlin.marginals, end.lower.marginals
            return Proposal("optimal", _basis(self._matrix, end.x, multipliers, reduced))
        return Proposal("infeasible" if end.status == 2 else "nothing", None)


def _basis(
    A: csc_array, x: FloatArray, multipliers: FloatArray, reduced: FloatArray
) -> list[int] | None:
    """The basis where HiGHS ended, or one of the same vertex; None where it is no vertex."""
    m, n = A.shape
    known = np.flatnonzero(x)
    open_, idle = np.flatnonzero((x == 0) & (reduced == 0)), np.flatnonzero(multipliers == 0)
    missing = m - len(known)
    if not 0 <= missing <= len(open_) + len(idle):
        return None
    if not missing:
        return [int(k) for k in known]
    random = np.random.default_rng(0).standard_normal((m, missing))
    units = np.eye(m)[:, len(known) :]
    try:
        lacks = sparse_factors(csc_array(hstack([A[:, known], random]))).solve(units, trans="T")
    except RuntimeError:  # a singular matrix
        return None
    seen = np.hstack([(A[:, open_].T @ lacks).T, lacks[idle].T])
    chosen = qr(seen, mode="r", pivoting=True)[1][:missing]
    return sorted(int(k) for k in [*known, *np.append(open_, n + idle)[chosen]])


def _floats(problem: StandardForm) -> tuple[IntArray, IntArray, FloatArray, IntArray]:
    """Row, column, mantissa and exponent of every entry of the scaled matrix."""
    terms: dict[tuple[int, int], list[tuple[int, Fraction]]] = {}
    for j, column in enumerate(problem.columns):
        for i, r, x in column:
            terms.setdefault((i, j), []).append((r, Fraction(x)))
    known: dict[Any, tuple[float, int]] = {}
    parts = []
    for sum_ in terms.values():
        key = tuple(sum_)
        if key not in known:
            known[key] = _split(Surd(tuple(sorted(sum_))))
        parts.append(known[key])
    places = np.array(list(terms), dtype=np.int64).reshape(-1, 2)
    mantissas = np.array([m for m, _ in parts], dtype=np.float64)
    exponents = np.array([e for _, e in parts], dtype=np.int64)
    return places[:, 0], places[:, 1], mantissas, exponents


def _split(x: Surd) -> tuple[float, int]:
    """(m, e) with x near m 2^e and 1/2 <= |m| < 1, whatever the size of x."""
    if not x:
        return 0.0, 0
    size = max(c.numerator.bit_length() - c.denominator.bit_length() for _, c in x.terms)
    scale = Fraction(1, 1 << size) if size > 0 else Fraction(1 << -size)
    mantissa, exponent = np.frexp(float(x * scale))
    return float(mantissa), int(exponent) + size


def _scaling(
    rows: IntArray, columns: IntArray, exponents: IntArray, shape: tuple[int, int]
) -> tuple[IntArray, IntArray]:
    """Exponents of powers of two for rows and columns that bring the entries near one."""
    row, column = np.zeros(shape[0], dtype=np.int64), np.zeros(shape[1], dtype=np.int64)
    for _ in range(_PASSES):
        for mine, places in ((row, rows), (column, columns)):
            size = exponents + row[rows] + column[columns]
            most = np.full(len(mine), np.iinfo(np.int64).min)
            least = np.full(len(mine), np.iinfo(np.int64).max)
            np.maximum.at(most, places, size)
            np.minimum.at(least, places, size)
            touched = most >= least
            mine[touched] -= (most[touched] + least[touched]) // 2
    return row, column


def _vector(values: ExactVector, shift: IntArray) -> FloatArray:
    """Floats of the values times powers of two, the largest brought near one."""
    parts = [_split(x) for x in values]
    mantissas = np.array([m for m, _ in parts], dtype=np.float64)
    exponents = np.array([e for _, e in parts], dtype=np.int64) + shift
    exponents -= max(exponents[mantissas != 0].tolist(), default=0)
    floats: FloatArray = np.ldexp(mantissas, np.maximum(exponents, -2000))
    return floats
