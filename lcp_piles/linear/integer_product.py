"""Products of matrices of integers, exactly: in int64 where no sum can wrap."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from ..numbers.vectors import IntArray
from .integer_matrix import (
    LARGEST,
    BigMatrix,
    IntegerMatrix,
    diagonal,
    entries,
    from_triplets,
    largest_entry,
)

_SHORT = 2**31


def times(A: IntegerMatrix, vector: Sequence[fmpz]) -> list[fmpz]:
    """A v in integers of any size."""
    if _fits(A, _SHORT) and all(-_SHORT < x < _SHORT for x in vector):
        return _short_product(A, np.array([int(x) for x in vector], dtype=np.int64))
    return _long_product(A, vector)


def times_words(A: IntegerMatrix, vector: IntArray) -> list[fmpz]:
    """A v for a vector in int64."""
    if _fits(A, int(np.abs(vector).max(initial=0))):
        return _short_product(A, vector)
    return _long_product(A, [fmpz(x) for x in vector.tolist()])


def product(A: IntegerMatrix, B: IntegerMatrix) -> IntegerMatrix:
    """A B, without entries for what is zero.

    >>> A = csr_array(np.array([[2**40, 1]]))
    >>> product(A, csr_array(np.array([[1], [-(2**40)]]))).nnz
    0
    >>> product(A, csr_array(np.array([[2**40], [5]])))
    <BigMatrix 1 x 1 with 1 entries>
    """
    if product_fits(A, B):
        short: csr_array = A
        found = csr_array(short @ B)
        found.eliminate_zeros()
        found.sort_indices()
        return found
    columns, values = A.indices.tolist(), entries(A)
    ends, places, others = B.indptr.tolist(), B.indices.tolist(), entries(B)
    i, j, terms = list[int](), list[int](), list[int | fmpz]()
    for row, (a, b) in enumerate(pairwise(A.indptr.tolist())):
        for k in range(a, b):
            across = slice(ends[columns[k]], ends[columns[k] + 1])
            j += places[across]
            terms += [values[k] * x for x in others[across]]
        i += [row] * (len(j) - len(i))
    return from_triplets((A.shape[0], B.shape[1]), i, j, terms)


def multiplied_rows(A: IntegerMatrix, factors: Sequence[int]) -> IntegerMatrix:
    """Every row of A times a factor of its own.

    >>> multiplied_rows(csr_array(np.array([[1, 2], [3, 0]])), [5, 0]).toarray().tolist()
    [[5, 10], [0, 0]]
    """
    if (
        not isinstance(A, BigMatrix)
        and largest_entry(A) * max(map(abs, factors), default=0) < LARGEST
    ):
        lengths = np.diff(A.indptr)
        data = A.data * np.repeat(np.array(factors, dtype=np.int64), lengths)
        return csr_array((data, A.indices, A.indptr), shape=A.shape)
    return product(diagonal(factors), A)


def product_fits(A: IntegerMatrix, B: IntegerMatrix) -> bool:
    """Whether A B and all sums on the way to it are sure to stay within int64."""
    return not isinstance(B, BigMatrix) and _fits(A, largest_entry(B))


def _fits(A: IntegerMatrix, largest: int) -> bool:
    """Whether A v does so for every v with entries up to `largest`."""
    if isinstance(A, BigMatrix):
        return False
    most = int(np.diff(A.indptr).max(initial=0))
    return largest_entry(A) * most * largest < LARGEST


def _short_product(A: csr_array, vector: IntArray) -> list[fmpz]:
    return [fmpz(x) for x in (A @ vector).tolist()]


def _long_product(A: IntegerMatrix, vector: Sequence[fmpz]) -> list[fmpz]:
    indptr, indices, data = A.indptr.tolist(), A.indices.tolist(), entries(A)
    product = []
    for a, b in pairwise(indptr):
        total = fmpz(0)
        for k in range(a, b):
            total += data[k] * vector[indices[k]]
        product.append(total)
    return product
