"""Exact solution of sparse square systems over a field of square roots.

The integer matrix of the regular representation (see `roots`) is put together from columns that
are expanded once: block column s of a column of the field is the column that multiplies sqrt(s).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from flint import fmpz
from scipy.sparse import coo_array, csr_array

from ..linear.integer_matrix import from_triplets
from ..linear.sparse_exact import ExactSolver
from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector, IntArray
from .roots import Column, cosets

SolveMany = Callable[[Sequence[Sequence[fmpz]]], list[tuple[list[fmpz], fmpz]]]
_SHORT = 2**60


class Expanded(NamedTuple):
    """The block columns of one column: rows and integers, for each radicand of the group."""

    rows: list[IntArray]
    values: list[Any]  # arrays of int64, or of Python integers where those are too long


def expanded(column: Column, size: int, group: Sequence[int]) -> Expanded:
    """A column of a matrix with `size` rows in the regular representation."""
    place = {r: k * size for k, r in enumerate(group)}
    rows, values = [], []
    for s in group:
        parts = [
            (place[root_product(q, s)[1]] + i, a * root_product(q, s)[0]) for i, q, a in column
        ]
        rows.append(np.array([i for i, _ in parts], dtype=np.int64))
        numbers = [a for _, a in parts]
        short = max(map(abs, numbers), default=0) < _SHORT
        values.append(np.array(numbers, dtype=np.int64 if short else object))
    return Expanded(rows, values)


class FieldSolver:
    """Solver of M x = b for the matrix M of some expanded columns.

    `transposed` makes it one of M^T x = b. Raises `SingularError` as `ExactSolver` does.

    >>> columns = [[(0, 3, 1)], [(0, 1, 1), (1, 1, 2)]]
    >>> solver = FieldSolver([expanded(column, 2, (1, 3)) for column in columns], (1, 3))
    >>> [str(x) for x in solver.solve(ExactVector({1: [fmpz(0), fmpz(2)]}, fmpz(1)))]
    ['-1/3*sqrt(3)', '1']
    """

    def __init__(
        self, columns: Sequence[Expanded], group: Sequence[int], transposed: bool = False
    ) -> None:
        self._size, self._group = len(columns), group
        blocks = range(len(group))
        rows = [column.rows[k] for k in blocks for column in columns]
        values = [column.values[k] for k in blocks for column in columns]
        n = len(rows)
        if n == 0:
            self._solve_many: SolveMany = lambda rights: [([], fmpz(1)) for _ in rights]
            return
        i, data = np.concatenate(rows), np.concatenate(values)
        j = np.repeat(np.arange(n), [len(x) for x in rows])
        if transposed:  # within the blocks: the radicands stay where they are
            m = self._size
            i, j = i // m * m + j % m, j // m * m + i % m
        shape = (n, n)
        matrix = (
            from_triplets(shape, i.tolist(), j.tolist(), data.tolist())
            if data.dtype == object
            else csr_array(coo_array((data, (i, j)), shape=shape))
        )
        self._solve_many = ExactSolver(matrix).solve_many

    def solve(self, b: ExactVector) -> ExactVector:
        """The solution for a right-hand side without factors."""
        group, n = self._group, self._size
        zero = [fmpz(0)] * n
        rights, extra = [], []
        starts = cosets(b.numerators, group)
        for start in starts:
            # sqrt(q) sqrt(start) = g sqrt(r): the part of r, divided by g, is that of q.
            across = [root_product(q, start) for q in group]
            common = fmpz(1)
            for g, _ in across:
                common = common.lcm(g)
            extra.append(common)
            rights.append([x * (common // g) for g, r in across for x in b.numerators.get(r, zero)])
        solutions = self._solve_many(rights)
        den = fmpz(1)
        for (_, d), common in zip(solutions, extra, strict=True):
            den = den.lcm(d * common)
        numerators: dict[int, list[fmpz]] = {}
        for start, (values, d), common in zip(starts, solutions, extra, strict=True):
            up = den // (d * common)
            for k, q in enumerate(group):
                g, r = root_product(q, start)
                numerators[r] = [x * (up * g) for x in values[k * n : (k + 1) * n]]
        numerators.setdefault(1, zero)
        return ExactVector(numerators, den * b.denominator)
