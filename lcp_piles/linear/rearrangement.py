"""Matrices of integers of any size made of the entries of others: parts, transposes, blocks.

scipy does all of it for int64. For a `BigMatrix` it moves numbers that stand for the entries, and
what has become of these says where the entries go.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from flint import fmpz
from scipy.sparse import block_array, csr_array

from ..numbers.vectors import IntArray, Mask
from .integer_matrix import BigMatrix, IntegerMatrix, entries, from_rows

Places = Sequence[int] | IntArray | Mask
"""Which rows or columns: their numbers, in any order, or a mask."""


def rows_of(A: IntegerMatrix, chosen: Places) -> IntegerMatrix:
    """Some rows of A.

    >>> rows_of(csr_array(np.array([[1, 2], [3, 4]])), [1, 1, 0]).toarray().tolist()
    [[3, 4], [3, 4], [1, 2]]
    """
    return _rearranged(lambda M: M[chosen], A)


def columns_of(A: IntegerMatrix, chosen: Places) -> IntegerMatrix:
    """Some columns of A."""
    return _rearranged(lambda M: M[:, chosen], A)


def transposed(A: IntegerMatrix) -> IntegerMatrix:
    """A^T."""
    return _rearranged(lambda M: M.T, A)


def blocks(parts: Sequence[Sequence[IntegerMatrix]]) -> IntegerMatrix:
    """The matrix of rows of blocks.

    >>> one = csr_array(np.array([[1, 2]]))
    >>> blocks([[one, 3 * one], [2 * one, one]]).toarray().tolist()
    [[1, 2, 3, 6], [2, 4, 1, 2]]
    """
    widths = [len(row) for row in parts]
    ends = np.cumsum([0, *widths])

    def arranged(*flat: csr_array) -> Any:
        return block_array([flat[a:b] for a, b in pairwise(ends)])

    return _rearranged(arranged, *(A for row in parts for A in row))


def diagonal_of_rows(A: IntegerMatrix) -> IntegerMatrix:
    """The matrix with the rows of A for diagonal blocks.

    >>> diagonal_of_rows(csr_array(np.array([[1, 2], [3, 4]]))).toarray().tolist()
    [[1, 2, 0, 0], [0, 0, 3, 4]]
    """

    def apart(M: csr_array) -> csr_array:
        rows, width = M.shape
        first = np.repeat(np.arange(rows) * width, np.diff(M.indptr))
        return csr_array((M.data, M.indices + first, M.indptr), shape=(rows, rows * width))

    return _rearranged(apart, A)


def rows_reaching(A: IntegerMatrix, columns: Mask) -> IntArray:
    """The rows of A that have an entry in one of these columns."""
    reached = np.repeat(np.arange(A.shape[0]), np.diff(A.indptr))[columns[A.indices]]
    return np.unique(reached)


def _rearranged(change: Callable[..., Any], *matrices: IntegerMatrix) -> IntegerMatrix:
    """What becomes of matrices by a change that moves entries, repeats them and leaves some out."""
    if not any(isinstance(A, BigMatrix) for A in matrices):
        return csr_array(change(*matrices))
    numbered, values = [], list[fmpz | int]()
    for A in matrices:
        # Counted from one on, so that none looks like an empty place.
        numbers = np.arange(len(values), len(values) + len(A.data)) + 1
        numbered.append(csr_array((numbers, A.indices, A.indptr), shape=A.shape))
        values += entries(A)
    moved = csr_array(change(*numbered))
    data = [fmpz(values[k - 1]) for k in moved.data.tolist()]
    return from_rows(moved.shape, moved.indptr, moved.indices, data)
