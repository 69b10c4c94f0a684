"""A square matrix of rationals as sparse rows of integers, each row over a denominator of its own.

What has few entries stays so: nothing here is dense but single columns and the products.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf, lcm
from typing import Any

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array, issparse

from ..errors import InputError
from ..linear.integer_matrix import BigMatrix, IntegerMatrix, entries, from_rows, integer_matrix
from ..linear.integer_product import times
from ..linear.rearrangement import columns_of, rows_of
from ..numbers.exact import rational
from ..numbers.vectors import ExactVector, FloatArray, IntArray


@dataclass(frozen=True, eq=False, repr=False)
class RationalRows:
    """The matrix whose row i is that of the integer matrix `A` over `denominators[i]` > 0."""

    A: IntegerMatrix
    denominators: tuple[fmpz, ...]

    def __repr__(self) -> str:
        return f"<RationalRows {len(self)} x {len(self)}>"

    def __len__(self) -> int:
        return len(self.denominators)

    @cached_property
    def common(self) -> fmpz:
        """The least common denominator of all rows."""
        return common_multiple(set(self.denominators))

    @cached_property
    def _by_column(self) -> tuple[IntArray, IntArray, IntArray]:
        """Where the entries of each column stand: their places, their rows and the ends."""
        order = np.argsort(self.A.indices, kind="stable")
        rows = np.repeat(np.arange(len(self)), np.diff(self.A.indptr))
        ends = np.searchsorted(self.A.indices[order], np.arange(len(self) + 1))
        return order, rows[order], ends

    def column(self, j: int) -> tuple[list[fmpz], fmpz]:
        """Column j as integers over one denominator.

        >>> rational_rows([["1/2", 0], [1, "1/3"]]).column(0)
        ([3, 6], 6)
        """
        order, row_of, ends = self._by_column
        here = slice(ends[j], ends[j + 1])
        rows, places = row_of[here].tolist(), order[here].tolist()
        common = common_multiple({self.denominators[i] for i in rows})
        found = [fmpz(0)] * len(self)
        for i, k in zip(rows, places, strict=True):
            found[i] = int(self.A.data[k]) * (common // self.denominators[i])
        return found, common

    def float_column(self, j: int) -> FloatArray:
        """Column j in floats, each entry within a few units in its last place."""
        order, row_of, ends = self._by_column
        here = slice(ends[j], ends[j + 1])
        rows, places = row_of[here].tolist(), order[here].tolist()
        found = np.zeros(len(self))
        bottoms = self._bottoms
        found[rows] = [
            _float(self.A.data[k], bottoms[i]) for i, k in zip(rows, places, strict=True)
        ]
        return found

    def times(self, z: ExactVector) -> ExactVector:
        """M z, exactly."""
        plain = z.plain()
        ups = self._ups()
        numerators = {
            r: [x * up for x, up in zip(times(self.A, part), ups, strict=True)]
            for r, part in plain.numerators.items()
        }
        return ExactVector(numerators, plain.denominator * self.common)

    def transpose_times(self, y: ExactVector) -> ExactVector:
        """M^T y, exactly."""
        plain = y.plain()
        ups = self._ups()
        numerators = {
            r: times(self.transposed, [x * up for x, up in zip(part, ups, strict=True)])
            for r, part in plain.numerators.items()
        }
        return ExactVector(numerators, plain.denominator * self.common)

    @cached_property
    def transposed(self) -> IntegerMatrix:
        """The transpose of `A`."""
        order, rows, ends = self._by_column
        if not isinstance(self.A, BigMatrix):
            return csr_array((self.A.data[order], rows, ends), shape=self.A.shape)
        return BigMatrix(self.A.shape, ends, rows, tuple(self.A.data[k] for k in order.tolist()))

    def part(self, places: Sequence[int]) -> RationalRows:
        """The principal submatrix in some rows and columns."""
        A = columns_of(rows_of(self.A, places), places)
        return RationalRows(A, tuple(self.denominators[i] for i in places))

    def floats(self) -> csr_array:
        """The matrix in floats, each entry within a few units in its last place."""
        rows = np.repeat(np.arange(len(self)), np.diff(self.A.indptr))
        if isinstance(self.A, BigMatrix) or max(self.denominators, default=1) >= 2**52:
            pairs = zip(entries(self.A), rows.tolist(), strict=True)
            data = np.array([_float(x, self._bottoms[i]) for x, i in pairs])
        else:
            data = self.A.data / np.array(self._bottoms, dtype=np.float64)[rows]
        return csr_array((data, self.A.indices, self.A.indptr), shape=self.A.shape)

    @cached_property
    def _bottoms(self) -> list[int]:
        """The denominators as Python has integers."""
        return [int(den) for den in self.denominators]

    def _ups(self) -> list[fmpz]:
        return [self.common // den for den in self.denominators]


def rational_rows(M: Any) -> RationalRows:
    """A square matrix of exact rationals, in whatever form: see `lcp`. Raises `InputError`."""
    integers = getattr(getattr(M, "dtype", None), "kind", "") in ("i", "u")
    if issparse(M) and not integers:
        raise InputError(
            "the entries of the sparse M",
            M.dtype.name,
            "integers",
            "multiply rows of M and q by what makes them so, "
            "or pass floats_exactly(M) to mean the binary values of floats",
        )
    if integers and M.ndim == 2:
        A = integer_matrix(M)
        if A.shape[0] != A.shape[1]:
            raise InputError("the shape of M", A.shape, "a square matrix")
        return RationalRows(A, (fmpz(1),) * A.shape[0])
    if isinstance(M, str) or not (hasattr(M, "__iter__") or hasattr(M, "tolist")):
        raise InputError("M", M, "a square matrix")
    table = M.tolist() if hasattr(M, "tolist") else list(M)
    if getattr(M, "shape", (len(table),) * 2) == (0, 0):  # numpy, sympy list no empty rows alike
        table = []
    size = len(table)
    ends, places, data, denominators = [0], list[int](), list[int | fmpz](), list[fmpz]()
    for i, row in enumerate(table):
        given = _entries(row, i, size)
        exact = {j: x if type(x) is int else rational(x, "an entry of M") for j, x in given}
        support = sorted(j for j, x in exact.items() if x != 0)
        den = lcm(*{exact[j].denominator for j in support})
        places += support
        data += [exact[j].numerator * (den // exact[j].denominator) for j in support]
        ends.append(len(places))
        denominators.append(fmpz(den))
    columns = np.array(places, dtype=np.int64)
    A = from_rows((size, size), np.array(ends, dtype=np.int64), columns, data)
    return RationalRows(A, tuple(denominators))


def _entries(row: Any, i: int, size: int) -> Iterable[tuple[int, Any]]:
    """The columns and numbers of row i, a sequence or {column: number}."""
    if isinstance(row, Mapping):
        for j in row:
            if type(j) is not int or not 0 <= j < size:
                raise InputError(f"a column in row {i} of M", j, f"a number from 0 to {size - 1}")
        return row.items()
    found = entries_of(row, "a row of M")
    if len(found) != size:
        raise InputError(f"the length of row {i} of M", len(found), f"{size}, as M has rows")
    return enumerate(found)


def entries_of(values: Any, what: str) -> list[Any]:
    """The entries of a vector in whatever form, a column of one among them.

    Raises `InputError` where it is none.

    >>> entries_of([[1], [2]], "q")
    [1, 2]
    """
    expected = "a sequence of exact numbers"
    if isinstance(values, str):
        raise InputError(what, values, expected)
    if issparse(values):
        values = values.toarray()
    try:
        found = list(values.entries() if hasattr(values, "entries") else values)
    except TypeError as error:
        raise InputError(what, values, expected) from error
    rows = [x for x in found if isinstance(x, list | tuple | np.ndarray)]
    if rows and len(rows) == len(found) and all(np.ndim(x) == 1 and len(x) == 1 for x in rows):
        return [x[0] for x in rows]
    return found


def common_multiple(denominators: Iterable[fmpz]) -> fmpz:
    """The least common multiple of positive integers."""
    common = fmpz(1)
    for den in denominators:
        common = common.lcm(den)
    return common


def _float(x: Any, den: int) -> float:
    """The quotient as a float, infinite beyond their range."""
    try:
        return int(x) / den  # which rounds once, however long they are
    except OverflowError:
        return inf if int(x) > 0 else -inf
