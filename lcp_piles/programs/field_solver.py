"""Exact solution of sparse square systems over a field of square roots.

The integer matrix of the regular representation (see `roots`) is put together from columns that
are expanded once: block column s of a column of the field is the column that multiplies sqrt(s).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from flint import fmpz, fmpz_mat
from scipy.sparse import coo_array, csr_array

from ..linear.sparse_exact import ExactSolver, SingularError
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
        if data.dtype == object:
            self._solve_many = _dense_solver(n, i, j, data)
        else:
            matrix = csr_array(coo_array((data, (i, j)), shape=(n, n)))
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


def _dense_solver(n: int, i: IntArray, j: IntArray, values: Any) -> SolveMany:
    """FLINT's dense solver, for integers that are too long for the sparse one."""
    dense = fmpz_mat(n, n)
    for row, column, a in zip(i.tolist(), j.tolist(), values.tolist(), strict=True):
        dense[row, column] = a

    def solve_many(rights: Sequence[Sequence[fmpz]]) -> list[tuple[list[fmpz], fmpz]]:
        columns = [x for right in zip(*rights, strict=True) for x in right]
        try:
            solution: Any = dense.solve(fmpz_mat(n, len(rights), columns))
        except ZeroDivisionError as error:
            raise SingularError(f"the matrix of {n} unknowns is singular") from error
        numerators, den = solution.numer_denom()
        rows = numerators.tolist()
        return [([row[k] for row in rows], den) for k in range(len(rights))]

    return solve_many
