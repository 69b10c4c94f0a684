"""Elimination modulo a prime inside a band: which rows and columns of a sparse matrix carry it.

Rows that are independent modulo a prime are independent; that the rest depend on them is likely and
not proved. What asks has a use for the first half only, or proves the second (`kernel`).

With the columns in the order of Cuthill and McKee every row lives inside a narrow window, and so
does every combination that the elimination makes: from left to right each column takes one row that
is not zero there for its pivot, and clears the others. Where there is a choice the preferred row
is taken, so that a row is only ever changed by preferred ones. It ends as zero exactly if it
depends on those: the pivots are the basis that a greedy choice in the order of preference makes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from flint import fmpz
from scipy.sparse import csc_array, csr_array

from ..numbers.vectors import IntArray
from .banded import band_order
from .integer_matrix import IntegerMatrix, residues

PRIME = 2**31 - 1


class Pivots(NamedTuple):
    """Independent rows and columns, as many of each as the matrix has (but for a bad prime)."""

    rows: list[int]
    columns: list[int]


def pivots(B: IntegerMatrix, preference: Sequence[int] | IntArray | None = None) -> Pivots:
    """The pivots of an integer matrix; its rows are taken in the order of `preference`, if given.

    >>> B = csr_array(np.array([[1, 1], [2, 2], [0, 1]]))
    >>> pivots(B).rows, pivots(B, [2, 1, 0]).rows
    ([0, 2], [1, 2])
    """
    B = residues(B, PRIME)
    rank = np.arange(B.shape[0])
    if preference is not None:
        rank[np.asarray(preference)] = np.arange(B.shape[0])
    pattern = csr_array((np.ones(B.nnz, dtype=np.int64), B.indices, B.indptr), shape=B.shape)
    order = band_order(csr_array(pattern.T @ pattern))
    columns = np.argsort(order)[B.indices]
    filled = np.flatnonzero(np.diff(B.indptr))
    if not len(filled):
        return Pivots([], [])
    starts = B.indptr[filled]
    first = np.minimum.reduceat(columns, starts)
    width = int((np.maximum.reduceat(columns, starts) - first).max()) + 1
    coming = np.argsort(first, kind="stable")
    ends = np.searchsorted(first[coming], np.arange(len(order) + 1))
    window = np.zeros((0, 2 * width), dtype=np.int64)  # rows that are not done, from column `left`
    names = np.zeros(0, dtype=np.int64)
    left = 0
    found: list[tuple[int, int]] = []
    for column in range(len(order)):
        if column - left == width:
            window = np.hstack([window[:, width:], np.zeros_like(window[:, width:])])
            left = column
        at = column - left
        new = filled[coming[ends[column] : ends[column + 1]]]
        if len(new):
            rows = np.zeros((len(new), 2 * width), dtype=np.int64)
            for row, k in zip(rows, new.tolist(), strict=True):
                entries = slice(B.indptr[k], B.indptr[k + 1])
                np.add.at(row, columns[entries] - left, B.data[entries])
            window, names = np.vstack([window, rows % PRIME]), np.append(names, new)
        touched = np.flatnonzero(window[:, at])
        if not len(touched):
            continue
        best = touched[np.argmin(rank[names[touched]])]
        found.append((int(names[best]), int(order[column])))
        reach = slice(at, at + width)
        pivot = window[best, reach] * pow(int(window[best, at]), -1, PRIME) % PRIME
        rest = touched[touched != best]
        window[rest, reach] = (window[rest, reach] - window[rest, at, None] * pivot) % PRIME
        done = np.append(rest[~window[rest, reach].any(axis=1)], best)
        window, names = np.delete(window, done, axis=0), np.delete(names, done)
    return Pivots(sorted(k for k, _ in found), sorted(j for _, j in found))


def product(B: IntegerMatrix, vectors: Sequence[Sequence[int | fmpz]]) -> csr_array:
    """The columns B v for some integer vectors, modulo the prime: what `pivots` needs of them.

    >>> product(csr_array(np.array([[2, -1], [0, 3]])), [[1, 1], [0, 1]]).toarray().tolist()
    [[1, 2147483646], [3, 3]]
    """
    entries = [[(j, int(x) % PRIME) for j, x in enumerate(v) if x != 0] for v in vectors]
    ends = np.cumsum([0, *map(len, entries)])
    places, values = (
        np.array([pair[side] for row in entries for pair in row], dtype=np.int64) for side in (0, 1)
    )
    table = csc_array((values, places, ends), shape=(B.shape[1], len(entries)))
    # In two halves of 16 bits, whose products with the entries add up inside 64 bits.
    B = residues(B, PRIME)
    total = None
    for half in (B.data >> 16, B.data & 0xFFFF):
        part = csr_array((half, B.indices, B.indptr), shape=B.shape) @ table
        total = part if total is None else part + 65536 * total
        total.data %= PRIME
    return csr_array(total)
