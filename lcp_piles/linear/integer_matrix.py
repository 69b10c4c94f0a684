"""Sparse matrices of integers of any size: scipy's in int64 where they fit, `BigMatrix` elsewhere.

scipy knows no integers beyond 64 bits, and wraps sums of those that it knows without a word. So
whatever comes in is read here once: entries below 2^62, with duplicates added up, make a
`csr_array` of int64, and a single one above that a `BigMatrix`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from operator import index
from typing import Any, TypeAlias

import numpy as np
from flint import fmpz, fmpz_mat
from scipy.sparse import coo_array, csr_array, issparse

from ..errors import InputError
from ..numbers.vectors import IntArray

LARGEST = 2**62
"""What an entry in int64 stays below: a bit is left for sums."""
_FILLED = 2**16  # places of a matrix that is small enough to be written out


@dataclass(frozen=True, eq=False)
class BigMatrix:
    """Integers of any size, row by row as in scipy's csr; every place stands once.

    Row i has the entries `data[k]` in the columns `indices[k]`, indptr[i] <= k < indptr[i + 1].
    """

    shape: tuple[int, int]
    indptr: IntArray
    indices: IntArray
    data: tuple[fmpz, ...]

    def __repr__(self) -> str:
        return f"<BigMatrix {self.shape[0]} x {self.shape[1]} with {len(self.data)} entries>"


IntegerMatrix: TypeAlias = csr_array | BigMatrix


def integer_matrix(A: Any) -> IntegerMatrix:
    """A matrix of integers as a value of its own, exactly, whatever the size of its entries.

    Takes a `BigMatrix`, what scipy.sparse and numpy have with an integer dtype, nested lists or
    arrays of objects with ints and flint's fmpz, and flint's fmpz_mat. Raises `InputError`.

    >>> integer_matrix([[2**63 + 1, 0], [0, 1]])
    <BigMatrix 2 x 2 with 2 entries>
    >>> integer_matrix([[1, 0], [0, -1]]).toarray().tolist()
    [[1, 0], [0, -1]]
    """
    if isinstance(A, BigMatrix):
        return A
    if isinstance(A, csr_array) and A.dtype == np.int64 and A.has_canonical_format:
        least, largest = A.data.min(initial=0), A.data.max(initial=0)
        if least > -LARGEST and largest < LARGEST:
            return A.copy()
    if not issparse(A):
        A = _dense(A)
        if A.dtype == object:
            i, j = np.nonzero(A)
            return from_triplets(A.shape, i, j, A[i, j].tolist())
    if not np.issubdtype(A.dtype, np.integer):
        raise InputError("the entries of A", A.dtype.name, "integers")
    places = coo_array(A)  # a csr_array would add up what stands twice, in a dtype too small
    rows, columns = places.coords
    sizes = np.bincount(rows, np.abs(places.data.astype(np.float64)))
    if sizes.max(initial=0.0) >= LARGEST:
        return from_triplets(places.shape, rows, columns, places.data.tolist())
    return csr_array(places.astype(np.int64))


def from_triplets(
    shape: tuple[int, int],
    rows: Iterable[int],
    columns: Iterable[int],
    values: Iterable[int | fmpz],
) -> IntegerMatrix:
    """The matrix that is the sum of its entries (row, column, value), as in scipy's coo.

    >>> from_triplets((1, 2), [0, 0, 0], [1, 0, 1], [2**62, 5, 2**62])
    <BigMatrix 1 x 2 with 2 entries>
    """
    total: dict[tuple[int, int], fmpz] = {}
    for i, j, value in zip(rows, columns, values, strict=True):
        place = (int(i), int(j))
        total[place] = total.get(place, fmpz(0)) + value
    places = sorted(place for place, value in total.items() if value != 0)
    indices = np.array([j for _, j in places], dtype=np.int64)
    ends = np.zeros(shape[0] + 1, dtype=np.int64)
    np.add.at(ends, np.array([i + 1 for i, _ in places], dtype=np.int64), 1)
    return from_rows(shape, np.cumsum(ends), indices, [total[place] for place in places])


def from_rows(
    shape: tuple[int, int], indptr: IntArray, indices: IntArray, data: Sequence[int | fmpz]
) -> IntegerMatrix:
    """The matrix of entries that stand row by row, as in a `BigMatrix`."""
    if all(-LARGEST < x < LARGEST for x in data):
        entries = np.array([int(x) for x in data], dtype=np.int64)
        return csr_array((entries, indices, indptr), shape=shape)
    return BigMatrix(shape, indptr, indices, tuple(fmpz(x) for x in data))


def diagonal(values: Sequence[int | fmpz]) -> IntegerMatrix:
    """The square matrix with these numbers on its diagonal.

    >>> diagonal([3, 0, -1]).toarray().tolist()
    [[3, 0, 0], [0, 0, 0], [0, 0, -1]]
    """
    places = np.array([k for k, x in enumerate(values) if x != 0], dtype=np.int64)
    size = len(values)
    indptr = np.searchsorted(places, np.arange(size + 1))
    return from_rows((size, size), indptr, places, [values[k] for k in places.tolist()])


def entries(A: IntegerMatrix) -> list[int] | list[fmpz]:
    """The entries of A, row by row."""
    return list(A.data) if isinstance(A, BigMatrix) else A.data.tolist()


def largest_entry(A: IntegerMatrix) -> int:
    """The largest absolute value of an entry, 0 where there is none."""
    if isinstance(A, BigMatrix):
        return max((abs(int(x)) for x in A.data), default=0)
    return int(np.abs(A.data).max(initial=0))


def residues(A: IntegerMatrix, prime: int) -> csr_array:
    """A modulo a prime below 2^62, with entries from 0 on, all places kept."""
    if isinstance(A, BigMatrix):
        data = np.array([int(x % prime) for x in A.data], dtype=np.int64)
    else:
        data = A.data.astype(np.int64) % prime
    return csr_array((data, A.indices, A.indptr), shape=A.shape)


def dense(A: IntegerMatrix) -> fmpz_mat:
    """The same matrix for flint."""
    rows, columns = A.shape
    if not isinstance(A, BigMatrix) and rows * columns <= _FILLED:
        return fmpz_mat(rows, columns, A.toarray().ravel().tolist())
    matrix = fmpz_mat(rows, columns)
    indices, values = A.indices.tolist(), entries(A)
    for i, (a, b) in enumerate(pairwise(A.indptr.tolist())):
        for k in range(a, b):
            matrix[i, indices[k]] = values[k]
    return matrix


def _dense(A: Any) -> Any:
    """A table in an array of an integer dtype, or of objects that are integers."""
    if isinstance(A, fmpz_mat):
        A = A.tolist()
    expected = "a matrix of integers"
    if not isinstance(A, np.ndarray):
        try:
            table = [list(row) for row in A]
        except TypeError as error:
            raise InputError("A", A, expected) from error
        if len({len(row) for row in table}) > 1:
            raise InputError("the lengths of the rows of A", [len(row) for row in table], "one")
        array = np.empty((len(table), len(table[0]) if table else 0), dtype=object)
        for i, row in enumerate(table):
            array[i] = row
        A = array
    if A.ndim != 2:
        raise InputError("the shape of A", A.shape, expected)
    if A.dtype == object:
        exact = np.empty_like(A)
        for place, x in np.ndenumerate(A):
            exact[place] = _whole(x)
        A = exact
    return A


def _whole(x: Any) -> int | fmpz:
    if isinstance(x, fmpz):
        return x
    try:
        if not isinstance(x, bool | np.bool_):
            return index(x)
    except TypeError:
        pass
    raise InputError("an entry of A", x, "an integer")
