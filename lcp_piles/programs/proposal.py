"""What HiGHS proposes: the basis in which floating point ends. Nothing here is a proof.

Rows and columns are scaled by powers of two first, so that entries of any size become floats of
ordinary size: HiGHS drops those that are tiny and refuses those that are huge.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.sparse import coo_array, csc_array

from ..numbers.exact import Surd
from ..numbers.vectors import ExactVector, FloatArray, IntArray
from .constraints import StandardForm

_PASSES = 4
_TOLERANCE = 1e-9
Claim = Literal["optimal", "infeasible", "unbounded", "nothing"]


class Proposal(NamedTuple):
    """What HiGHS claims, and its last basis: j for column j, n + i for an idle row i."""

    claim: Claim
    basis: list[int] | None


class Proposer:
    """HiGHS on one set of constraints; each objective starts where the last one ended."""

    def __init__(self, problem: StandardForm) -> None:
        import highspy  # here, since it is slow to import

        m, n = problem.rows, len(problem.columns)
        rows, columns, mantissas, exponents = _floats(problem)
        row_shift, self._column_shift = _scaling(rows, columns, exponents, (m, n))
        values = np.ldexp(mantissas, exponents + row_shift[rows] + self._column_shift[columns])
        matrix = csc_array(coo_array((values, (rows, columns)), shape=(m, n)))
        b = _vector(problem.b, row_shift)
        self._n = n
        self._highs: Any = highspy.Highs()
        for name, value in (
            ("output_flag", False),
            ("presolve", "off"),
            ("solver", "simplex"),
            ("threads", 1),
            ("primal_feasibility_tolerance", _TOLERANCE),
            ("dual_feasibility_tolerance", _TOLERANCE),
            ("small_matrix_value", 1e-12),
        ):
            self._highs.setOptionValue(name, value)
        lp = highspy.HighsLp()
        lp.num_row_, lp.num_col_ = m, n
        lp.col_cost_ = np.zeros(n)
        lp.col_lower_, lp.col_upper_ = np.zeros(n), np.full(n, highspy.kHighsInf)
        lp.row_lower_ = lp.row_upper_ = b
        lp.a_matrix_.format_ = highspy.MatrixFormat.kColwise
        lp.a_matrix_.start_ = matrix.indptr
        lp.a_matrix_.index_ = matrix.indices
        lp.a_matrix_.value_ = matrix.data
        self._highs.passModel(lp)

    def propose(self, c: ExactVector) -> Proposal:
        """The end of the simplex method in floating point for the (scaled) objective c."""
        import highspy

        cost = _vector(c, self._column_shift)
        n = self._n
        self._highs.changeColsCost(n, np.arange(n, dtype=np.int32), cost)
        self._highs.run()
        status = highspy.HighsModelStatus
        claims: dict[Any, Claim] = {
            status.kOptimal: "optimal",
            status.kInfeasible: "infeasible",
            status.kUnbounded: "unbounded",
            status.kUnboundedOrInfeasible: "unbounded",
        }
        claim = claims.get(self._highs.getModelStatus(), "nothing")
        found = self._highs.getBasis()
        if not found.valid:
            return Proposal(claim, None)
        basic = highspy.HighsBasisStatus.kBasic
        everything = [*found.col_status, *found.row_status]
        basis = [k for k, state in enumerate(everything) if state == basic]
        return Proposal(claim, basis)


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
