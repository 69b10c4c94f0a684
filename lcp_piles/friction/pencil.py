"""The matrix of a basis as a function of the friction mu, and what Cramer's rule gives of it.

The columns n +- mu t of the equations are linear in mu. So determinants of a basis, and solutions
times determinants, are polynomials in mu; solving at whole numbers, as many as the degree asks
for, finds them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq_poly, fmpz, fmpz_mat

from ..numbers.roots import root_product
from ..programs.roots import Column, group_of
from .equations import FrictionProblem, friction_problem

_LARGEST = 240
"""Rows of the integer matrix beyond which no determinant is tried."""

Polynomials = Mapping[int, fmpq_poly]
"""A number of the field as a function of mu: a polynomial for each radicand."""


@dataclass(frozen=True, eq=False)
class Pencil:
    """The columns n + side mu t in integers: twice n, twice t (rows multiplied), and the loads."""

    rows: int
    group: tuple[int, ...]
    normals: list[Column]
    tangents: list[Column]
    sides: list[int]
    loads: Column

    def column(self, j: int, num: int, den: int) -> Column:
        """Column j, or that of an idle row, at mu = num / den, times 2 den."""
        if j >= len(self.normals):
            return ((j - len(self.normals), 1, 1),)
        total = {(i, r): a * den for i, r, a in self.normals[j]}
        for i, r, a in self.tangents[j]:
            total[i, r] = total.get((i, r), 0) + a * num * self.sides[j]
        return tuple((i, r, a) for (i, r), a in total.items())

    def matrix(self, columns: Sequence[Column], *, transposed: bool = False) -> fmpz_mat:
        """The regular representation of a square matrix of columns (of its transpose)."""
        size = self.rows
        place = {r: k * size for k, r in enumerate(self.group)}
        dense = fmpz_mat(size * len(self.group), size * len(self.group))
        for j, column in enumerate(columns):
            for i, q, a in column:
                for s in self.group:
                    g, r = root_product(q, s)
                    one, two = (j, i) if transposed else (i, j)
                    dense[place[r] + one, place[s] + two] += a * g
        return dense


def pencil_of(problem: FrictionProblem) -> Pencil | None:
    """None where the matrix is too large, or its field has more than one root."""
    unit = friction_problem(problem.scene, 1, tuple(problem.rough))
    read, b = unit.constraints, unit.constraints.b
    normals: list[Column] = [()] * len(read.columns)
    tangents: list[Column] = [()] * len(read.columns)
    sides = [0] * len(read.columns)
    for plus, minus in zip(unit.plus, unit.minus, strict=True):
        up, down = read.columns[plus], read.columns[minus]
        for j, side in ((plus, 1), (minus, -1)):
            normals[j] = _sum(up, down, 1)
            tangents[j] = _sum(up, down, -1)
            sides[j] = side
    group = group_of({r for column in read.columns for _, r, _ in column})
    loads = tuple(
        (i, r, int(x) * read.multiples[i])
        for r, values in b.numerators.items()
        for i, x in enumerate(values)
        if x != 0
    )
    fits = len(group) <= 2 and {r for _, r, _ in loads} <= set(group)
    if not fits or unit.constraints.scaled.rows * len(group) > _LARGEST:
        return None
    return Pencil(len(b), group, normals, tangents, sides, loads)


def _sum(one: Column, two: Column, sign: int) -> Column:
    total = {(i, r): a for i, r, a in one}
    for i, r, a in two:
        total[i, r] = total.get((i, r), 0) + sign * a
    return tuple((i, r, a) for (i, r), a in total.items() if a)


def stacked(pencil: Pencil, column: Column) -> fmpz_mat:
    """A column as a right-hand side."""
    right = fmpz_mat(pencil.rows * len(pencil.group), 1)
    for i, r, a in column:
        right[pencil.group.index(r) * pencil.rows + i, 0] += a
    return right


def solution(
    pencil: Pencil, basis: Sequence[int], right: Column, *, transposed: bool = False
) -> tuple[fmpq_poly, list[Polynomials]]:
    """(d, v) with M v = d b, for the matrix M of a basis (its transpose) and a right-hand side b.

    d is the determinant of the regular representation of M.
    """
    side = stacked(pencil, right)

    def at(mu: int) -> list[fmpz] | None:
        matrix: Any = pencil.matrix([pencil.column(j, mu, 1) for j in basis], transposed=transposed)
        det = matrix.det()
        if det == 0:
            return None
        numbers, den = matrix.solve(side).numer_denom()
        return [det, *(x * det // den for x in numbers.entries())]

    det, *rest = _interpolated(_degree(pencil, basis), at)
    m = pencil.rows
    parts: list[Polynomials] = [
        {r: rest[k * m + i] for k, r in enumerate(pencil.group)} for i in range(m)
    ]
    return det, parts


def determinant(pencil: Pencil, basis: Sequence[int]) -> fmpq_poly:
    """The determinant of the regular representation of some columns and, last, the loads."""

    def at(mu: int) -> list[fmpz]:
        columns = [pencil.column(j, mu, 1) for j in basis]
        return [pencil.matrix([*columns, pencil.loads]).det()]

    return _interpolated(_degree(pencil, basis), at)[0]


def _degree(pencil: Pencil, basis: Sequence[int]) -> int:
    """What no determinant exceeds: columns n + mu t and n - mu t span what n and mu t do."""
    contacts = {pencil.tangents[j] for j in basis if j < len(pencil.normals) and pencil.tangents[j]}
    return len(pencil.group) * len(contacts)


def _interpolated(degree: int, at: Callable[[int], list[fmpz] | None]) -> list[fmpq_poly]:
    """The polynomials with these values at whole numbers, where there are values."""
    points: list[int] = []
    table: list[list[fmpz]] = []
    mu = 0
    while len(points) <= degree:
        mu += 1
        line = at(mu)
        if line is not None:
            points.append(mu)
            table.append(line)
    size = degree + 1
    powers: Any = fmpz_mat(size, size, [fmpz(x) ** k for x in points for k in range(size)])
    values = fmpz_mat(size, len(table[0]), [x for line in table for x in line])
    rows, den = powers.solve(values).numer_denom()
    return [
        fmpq_poly([rows[k, column] for k in range(size)]) / den for column in range(len(table[0]))
    ]
