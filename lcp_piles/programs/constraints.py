"""The constraints A x = b, x >= 0 of a linear programme, read and made as rational as they go.

Data may hold square roots. Scaling rows and columns by roots changes no sign, and often makes every
entry rational:

    sqrt(rho_i) a_ij sqrt(kappa_j) rational,    x_j = sqrt(kappa_j) x'_j,   y_i = sqrt(rho_i) y'_i.

The rho and kappa are found by walking from row to column through entries that are one multiple of
one root, from b on, so that b is made rational first. Entries that remain irrational are a matter
of the field of their roots (see `roots`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import Any

import numpy as np

from ..errors import InputError
from ..numbers.exact import ONE, Surd, sqrt_of, surd
from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector, IntArray, distinct, exact_vector
from .field_solver import Expanded, expanded
from .roots import Column, group_of


@dataclass(frozen=True, eq=False)
class SparseSurds:
    """A sparse matrix of exact numbers: `values[k]` at row `rows[k]`, column `columns[k]`.

    Entries that are given twice add up.

    >>> SparseSurds((1, 2), [0], [1], [surd("1/2*sqrt(3)")]).shape
    (1, 2)
    """

    shape: tuple[int, int]
    rows: Sequence[int]
    columns: Sequence[int]
    values: Sequence[Surd]


@dataclass(frozen=True, eq=False)
class StandardForm:
    """A x = b, x >= 0 with the entries of A integers, or integers times roots, and no factors."""

    columns: Sequence[Column]
    b: ExactVector

    @property
    def rows(self) -> int:
        """Number of equations."""
        return len(self.b)

    @cached_property
    def idle(self) -> tuple[int, ...]:
        """The entry of the idle column of every row: as large as the row's others, for scale."""
        largest = [1] * self.rows
        for column in self.columns:
            for i, _, a in column:
                largest[i] = max(largest[i], abs(a))
        return tuple(largest)

    @cached_property
    def group(self) -> tuple[int, ...]:
        """The group of the radicands that the matrix holds."""
        return group_of({r for column in self.columns for _, r, _ in column})

    @cached_property
    def expanded(self) -> list[Expanded]:
        """Every column in the regular representation."""
        return [expanded(column, self.rows, self.group) for column in self.columns]


@dataclass(frozen=True, eq=False)
class Constraints:
    """A x = b, x >= 0 as given, in integers, and scaled.

    Row i of `columns` is row i of A times the positive integer `multiples[i]`. `scaled` is A with
    row i times `row_factors[row_factor_of[i]]` and column j times
    `column_factors[column_factor_of[j]]`, and b in the units of its rows.
    """

    columns: list[Column]
    b: ExactVector
    multiples: list[int]
    scaled: StandardForm
    row_factors: tuple[Surd, ...]
    row_factor_of: IntArray
    column_factors: tuple[Surd, ...]
    column_factor_of: IntArray

    def of(self, chosen: Sequence[int]) -> Constraints:
        """The constraints of some of the columns: all others are zero."""
        columns = [self.scaled.columns[j] for j in chosen]
        return replace(
            self,
            columns=[self.columns[j] for j in chosen],
            scaled=StandardForm(columns, self.scaled.b),
            column_factor_of=self.column_factor_of[np.array(chosen, dtype=np.int64)],
        )

    def scaled_cost(self, c: ExactVector) -> ExactVector:
        """An objective in the units of the scaled columns."""
        return self.given_point(c.plain()).plain()

    def given_point(self, x: ExactVector) -> ExactVector:
        """A vector over the columns of A from one over the scaled columns."""
        factors, which = self.column_factors, self.column_factor_of
        return ExactVector(x.numerators, x.denominator, factors, which)

    def given_multipliers(self, y: ExactVector) -> ExactVector:
        """A vector over the rows of A from one over the scaled rows."""
        return ExactVector(y.numerators, y.denominator, self.row_factors, self.row_factor_of)


def constraints(A: Any, b: Iterable[Any], n: int = 0) -> Constraints:
    """Read A x = b, x >= 0. Takes for A and b what `linear_program` takes.

    `n` is the number of columns, which an A without rows does not tell.
    """
    right = [surd(x) for x in _sequence(b, "b")]
    entries, n = _entries(A, len(right), n)
    m = len(right)
    multiples = [1] * m
    for (i, _), x in entries.items():
        for _, c in x.terms:
            if c.denominator > 1:
                multiples[i] = lcm(multiples[i], c.denominator)
    rho, kappa = _roots(entries, right, n)
    columns: list[list[tuple[int, int, int]]] = [[] for _ in range(n)]
    scaled: list[list[tuple[int, int, int]]] = [[] for _ in range(n)]
    row_content = [0] * m
    for (i, j), x in entries.items():
        for r, c in x.terms:
            whole = c.numerator * (multiples[i] // c.denominator)
            columns[j].append((i, r, whole))
            g, part = root_product(r, rho[i])
            h, root = root_product(part, kappa[j])
            scaled[j].append((i, root, whole * g * h))
            row_content[i] = gcd(row_content[i], whole * g * h)
    forms, column_factors = [], []
    for j, column in enumerate(scaled):
        content = gcd(*(a // row_content[i] for i, _, a in column)) or 1
        forms.append(tuple((i, r, a // row_content[i] // content) for i, r, a in column))
        column_factors.append(sqrt_of(kappa[j]) * Fraction(1, content))
    row_factors = [
        sqrt_of(r) * Fraction(multiple, content or 1)
        for r, multiple, content in zip(rho, multiples, row_content, strict=True)
    ]
    scaled_b = exact_vector([f * x for f, x in zip(row_factors, right, strict=True)])
    return Constraints(
        [tuple(column) for column in columns],
        exact_vector(right),
        multiples,
        StandardForm(forms, scaled_b),
        *_kinds(row_factors),
        *_kinds(column_factors),
    )


def _kinds(factors: list[Surd]) -> tuple[tuple[Surd, ...], IntArray]:
    kinds, which = distinct(factors)
    return tuple(kinds) or (ONE,), which


def _entries(A: Any, m: int, n: int) -> tuple[dict[tuple[int, int], Surd], int]:
    """The entries of A that are not zero, by row and column, and the number of columns."""
    values: Iterable[tuple[int, int, Any]]
    if isinstance(A, SparseSurds):
        shape, values = A.shape, zip(A.rows, A.columns, A.values, strict=True)
    elif hasattr(A, "tocoo"):
        sparse = A.tocoo()
        shape = tuple(sparse.shape)
        places = sparse.row.tolist(), sparse.col.tolist(), sparse.data.tolist()
        values = zip(*places, strict=True)
    else:
        rows = [_sequence(row, "a row of A") for row in _sequence(A, "A")]
        shape = len(rows), len(rows[0]) if rows else n
        for i, row in enumerate(rows):
            if len(row) != shape[1]:
                raise InputError(f"the length of row {i} of A", len(row), f"{shape[1]}, as row 0")
        values = ((i, j, x) for i, row in enumerate(rows) for j, x in enumerate(row))
    if shape[0] != m:
        raise InputError("the length of b", m, f"{shape[0]}, the rows of A")
    entries: dict[tuple[int, int], Surd] = {}
    for i, j, value in values:
        x = value if isinstance(value, Surd) else surd(value)
        key = int(i), int(j)
        if not (0 <= key[0] < shape[0] and 0 <= key[1] < shape[1]):
            raise InputError("an entry of A", key, f"a place in a matrix of shape {shape}")
        entries[key] = entries[key] + x if key in entries else x
    return {key: x for key, x in entries.items() if x}, shape[1]


def _sequence(values: Any, what: str) -> list[Any]:
    """A list of what is given row by row: lists, arrays, matrices of sympy or flint."""
    expected = "a sequence of exact numbers"
    if isinstance(values, str | Mapping):
        raise InputError(what, values, expected)
    if hasattr(values, "tolist"):
        values = values.tolist()
    elif hasattr(values, "entries"):
        values = values.entries()
    try:
        return list(values)
    except TypeError as error:
        raise InputError(what, values, expected) from error


def _roots(
    entries: Mapping[tuple[int, int], Surd], b: Sequence[Surd], n: int
) -> tuple[list[int], list[int]]:
    """The radicands rho of the rows and kappa of the columns."""
    m = len(b)
    # Nodes are rows, columns and b, a column whose kappa is 1; the entries are edges.
    edges: list[list[tuple[int, int]]] = [[] for _ in range(m + n + 1)]
    for (i, j), x in entries.items():
        if len(x.terms) == 1:
            edges[i].append((m + j, x.terms[0][0]))
            edges[m + j].append((i, x.terms[0][0]))
    for i, x in enumerate(b):
        if len(x.terms) == 1:
            edges[m + n].append((i, x.terms[0][0]))
    radicand = [0] * (m + n + 1)
    for start in (m + n, *range(m + n)):
        if radicand[start]:
            continue
        radicand[start] = 1
        waiting = [start]
        while waiting:
            node = waiting.pop()
            for other, r in edges[node]:
                if not radicand[other]:
                    radicand[other] = root_product(radicand[node], r)[1]
                    waiting.append(other)
    return radicand[:m], radicand[m : m + n]
