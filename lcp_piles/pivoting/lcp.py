"""The linear complementarity problem as a value: find z, w >= 0 with w = M z + q and z . w = 0.

An `LCP` gives its matrix a column at a time, because the matrix of a pile is dense and Lemke's
method looks at few of its columns. The whole matrix is there for whoever asks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpz, fmpz_mat
from scipy.sparse import csc_array

from ..errors import InputError
from ..numbers.exact import ONE, Exact
from ..numbers.floats import ENTRY, LOST, Bounded
from ..numbers.vectors import ExactVector, FloatArray, combination, exact_vector
from .rows import RationalRows, entries_of, rational_rows

IntegerColumn = tuple[list[fmpz], fmpz]
"""Integers over one positive denominator."""


@dataclass(frozen=True, eq=False, repr=False)
class LCP:
    """An exact LCP w = M z + q, z, w >= 0, z . w = 0; `lcp` makes one of a matrix.

    All but `q` and `column` are quicker ways to what follows from those, where there are such.

    Attributes
    ----------
    q : ExactVector, shape (n,)
        The w of z = 0.
    column : callable
        Column j of M as integers over one denominator.
    product : callable, optional
        M z of an ExactVector z.
    transposed : callable, optional
        M^T y of an ExactVector y.
    rows : RationalRows, optional
        The matrix by rows.
    near : callable, optional
        Some columns in floats with bounds, a row for each.
    basic : callable, optional
        The z of a basis (`basic_solution`).

    Examples
    --------
    >>> problem = lcp([[2, 1], [1, 2]], [-5, -6])
    >>> problem.M[0], [str(x) for x in problem.q]
    ([Fraction(2, 1), Fraction(1, 1)], ['-5', '-6'])
    """

    q: ExactVector
    column: Callable[[int], IntegerColumn]
    product: Callable[[ExactVector], ExactVector] | None = None
    transposed: Callable[[ExactVector], ExactVector] | None = None
    rows: RationalRows | None = None
    near: Callable[[Sequence[int]], Bounded] | None = None
    basic: Callable[[Sequence[int]], ExactVector] | None = None

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
        """M z, exactly; only the columns where z is not zero are asked for.

        Parameters
        ----------
        z : ExactVector, shape (n,)
            Any vector.

        Returns
        -------
        ExactVector, shape (n,)
            The product.
        """
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

        Parameters
        ----------
        y : ExactVector, shape (n,)
            Any vector.

        Returns
        -------
        ExactVector, shape (n,)
            The product.

        Examples
        --------
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

        Parameters
        ----------
        z : ExactVector, shape (n,)
            Any vector.

        Returns
        -------
        ExactVector, shape (n,)
            The w of z.

        Examples
        --------
        >>> [str(x) for x in lcp([[2, 1], [1, 2]], [-5, -6]).w(exact_vector([1, 2]))]
        ['-1', '-1']
        """
        return combination([(ONE, self.times(z)), (ONE, self.q.plain())])

    def floats(self) -> tuple[FloatArray, FloatArray]:
        """(M, q) as dense numpy arrays."""
        if self.rows is not None:
            return self.rows.floats().toarray(), self.q.array()
        columns = [ExactVector({1: n}, d).array() for n, d in map(self.column, range(len(self)))]
        return np.array(columns).T.reshape(len(self), len(self)), self.q.array()

    def bounded_columns(self, wanted: Sequence[int]) -> Bounded:
        """Some columns of M in floats with bounds of their errors.

        Parameters
        ----------
        wanted : sequence of int
            The numbers of the columns.

        Returns
        -------
        Bounded, shape (columns, n)
            A row for each.
        """
        if self.near is not None:
            return self.near(wanted)
        if self.rows is not None:
            middle = np.array([self.rows.float_column(j) for j in wanted])
        else:
            columns = [ExactVector({1: x}, den) for x, den in map(self.column, wanted)]
            middle = np.array([column.array() for column in columns])
        return Bounded(middle, np.abs(middle) * ENTRY + LOST)

    def sparse(self) -> tuple[csc_array, FloatArray]:
        """(M, q) with M in scipy's sparse form, zeros left out."""
        if self.rows is not None:
            return csc_array(self.rows.floats()), self.q.array()
        M, q = self.floats()
        return csc_array(M), q


def lcp(M: Any, q: Sequence[Exact]) -> LCP:
    """The LCP w = M z + q, z, w >= 0, z . w = 0 of a matrix and a vector of exact numbers.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n)
        Nested lists, a matrix of numpy, sympy or flint, or, which stays sparse, one of scipy with
        an integer dtype or a list of rows {column: number}. Entries are integers, Fractions,
        Decimals, text such as "0.1" or "1e-3".
    q : sequence of exact numbers, shape (n,)
        It may be irrational as in "sqrt(3)", and a column.

    Returns
    -------
    LCP
        The problem, for `lemke`, `solve_lcp`, `z_lcp`.

    Raises
    ------
    InputError
        For other data. Floats are refused: `floats_exactly` is the door for them.

    Examples
    --------
    >>> [str(x) for x in lcp([["0.1", 0], [0, "1e-3"]], [[-1], ["sqrt(3)"]]).q]
    ['-1', 'sqrt(3)']
    """
    rows = rational_rows(M)
    vector = exact_vector(entries_of(q, "q"))
    if len(vector) != len(rows):
        raise InputError("the length of q", len(vector), f"{len(rows)}, the size of M")
    return LCP(vector, rows.column, rows.times, rows.transpose_times, rows)


def lcp_of(M: Any, q: Sequence[Exact] | None) -> LCP:
    """The LCP of M and q as of `lcp`, or M where it is one; q is left out then."""
    if isinstance(M, LCP):
        if q is not None:
            raise InputError("q", q, "nothing beside an LCP, which has its own")
        return M
    if q is None:
        raise InputError("q", q, "a vector of exact numbers")
    return lcp(M, q)
