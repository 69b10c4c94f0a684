"""The linear complementarity problem as a value: find z, w >= 0 with w = M z + q and z . w = 0.

An `LCP` gives its matrix a column at a time, because the matrix of a pile is dense and Lemke's
method looks at few of its columns. The whole matrix is there for whoever asks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import lcm
from typing import Any

import numpy as np
from flint import fmpz, fmpz_mat
from scipy.sparse import csc_array

from ..errors import InputError
from ..numbers.exact import ONE, Exact, rational
from ..numbers.vectors import ExactVector, FloatArray, combination, exact_vector

IntegerColumn = tuple[list[fmpz], fmpz]
"""Integers over one positive denominator."""


@dataclass(frozen=True, eq=False, repr=False)
class LCP:
    """An exact LCP: `column(j)` is column j of M as integers over one denominator.

    `product` and `transposed` are M z and M^T y, where there is a quicker way to them than by the
    columns.

    >>> problem = lcp([[2, 1], [1, 2]], [-5, -6])
    >>> problem.M[0], [str(x) for x in problem.q]
    ([Fraction(2, 1), Fraction(1, 1)], ['-5', '-6'])
    """

    q: ExactVector
    column: Callable[[int], IntegerColumn]
    product: Callable[[ExactVector], ExactVector] | None = None
    transposed: Callable[[ExactVector], ExactVector] | None = None

    def __repr__(self) -> str:
        return f"<LCP of {len(self)} variables>"

    def __len__(self) -> int:
        return len(self.q)

    @property
    def M(self) -> list[list[Fraction]]:
        """The dense matrix, exact; every column is computed."""
        columns = []
        for j in range(len(self)):
            numerators, den = self.column(j)
            columns.append([Fraction(int(x), int(den)) for x in numerators])
        return [list(row) for row in zip(*columns, strict=True)]

    def times(self, z: ExactVector) -> ExactVector:
        """M z, exactly; only the columns where z is not zero are asked for."""
        if self.product is not None:
            return self.product(z)
        size = len(self)
        plain = z.plain()
        parts = list(plain.numerators.values())
        support = [j for j in range(size) if any(part[j] != 0 for part in parts)]
        columns = [self.column(j) for j in support]
        common = fmpz(1)
        for _, den in columns:
            common = common.lcm(den)
        weights = [
            part[j] * (common // den)
            for part in parts
            for j, (_, den) in zip(support, columns, strict=True)
        ]
        M = fmpz_mat(len(support), size, [x for numbers, _ in columns for x in numbers])
        product = (fmpz_mat(len(parts), len(support), weights) * M).tolist()
        numerators = dict(zip(plain.numerators, product, strict=True))
        return ExactVector(numerators, plain.denominator * common)

    def transpose_times(self, y: ExactVector) -> ExactVector:
        """M^T y, exactly.

        >>> [str(x) for x in lcp([[2, 1], [0, 2]], [0, 0]).transpose_times(exact_vector([1, 2]))]
        ['2', '5']
        """
        if self.transposed is not None:
            return self.transposed(y)
        plain = y.plain()
        parts = list(plain.numerators.values())
        columns = [self.column(j) for j in range(len(self))]
        common = fmpz(1)
        for _, den in columns:
            common = common.lcm(den)
        rows = fmpz_mat(len(self), len(self), [x * (common // d) for c, d in columns for x in c])
        weights = fmpz_mat(len(parts), len(self), [x for part in parts for x in part])
        product = (weights * rows.transpose()).tolist()
        numerators = dict(zip(plain.numerators, product, strict=True))
        return ExactVector(numerators, plain.denominator * common)

    def w(self, z: ExactVector) -> ExactVector:
        """M z + q, exactly.

        >>> [str(x) for x in lcp([[2, 1], [1, 2]], [-5, -6]).w(exact_vector([1, 2]))]
        ['-1', '-1']
        """
        return combination([(ONE, self.times(z)), (ONE, self.q.plain())])

    def floats(self) -> tuple[FloatArray, FloatArray]:
        """(M, q) as dense numpy arrays."""
        columns = [ExactVector({1: n}, d).array() for n, d in map(self.column, range(len(self)))]
        return np.array(columns).T.reshape(len(self), len(self)), self.q.array()

    def sparse(self) -> tuple[csc_array, FloatArray]:
        """(M, q) with M in scipy's sparse form, zeros left out."""
        M, q = self.floats()
        return csc_array(M), q


def lcp(M: Any, q: Sequence[Exact]) -> LCP:
    """The LCP of a square matrix and a vector of exact numbers.

    Entries may be int, Fraction, text ("3/7"), flint or sympy rationals; q may also hold surds
    ("1 - sqrt(3)"). Nested lists, numpy arrays of integers and sympy or flint matrices will do.
    """
    rows = _rows(M)
    size = len(rows)
    for i, row in enumerate(rows):
        if len(row) != size:
            raise InputError(f"the length of row {i} of M", len(row), f"{size}, as M has rows")
    vector = exact_vector(entries_of(q, "q"))
    if len(vector) != size:
        raise InputError("the length of q", len(vector), f"{size}, the size of M")
    exact = [[rational(x, "an entry of M") for x in row] for row in rows]
    return LCP(vector, partial(_column, exact))


def _column(rows: list[list[Fraction]], j: int) -> IntegerColumn:
    den = lcm(*(row[j].denominator for row in rows))
    return [fmpz(row[j].numerator * (den // row[j].denominator)) for row in rows], fmpz(den)


def _rows(M: Any) -> list[list[Any]]:
    if isinstance(M, str) or not (hasattr(M, "__iter__") or hasattr(M, "tolist")):
        raise InputError("M", M, "a square matrix")
    if hasattr(M, "tolist"):
        M = M.tolist()
    return [entries_of(row, "a row of M") for row in M]


def entries_of(values: Any, what: str) -> list[Any]:
    """The entries of a vector in whatever form; `InputError` where it is none."""
    expected = "a sequence of exact numbers"
    if isinstance(values, str):
        raise InputError(what, values, expected)
    try:
        return list(values.entries() if hasattr(values, "entries") else values)
    except TypeError as error:
        raise InputError(what, values, expected) from error
