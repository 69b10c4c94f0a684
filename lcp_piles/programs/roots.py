"""Arithmetic in a field of square roots, on integers side by side.

A number of the field Q(sqrt d, sqrt e, ...) is a sum of integers times square roots of square-free
radicands, over one denominator. The radicands form a group: r and s have the product
rs / gcd(r, s)^2, since sqrt(r) sqrt(s) = gcd(r, s) sqrt(rs / gcd(r, s)^2). A matrix over the field
is therefore a matrix of integers of as many times the size (its regular representation),

    (sum_q sqrt(q) A_q) (sum_s sqrt(s) x_s) = sum_r sqrt(r) (sum_(q s = r) gcd(q, s) A_q x_s),

which for Q(sqrt 3) is [[A_1, 3 A_3], [A_3, A_1]]; one is regular where the other is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction

from flint import fmpz

from ..numbers.exact import Surd, surd_sign
from ..numbers.roots import root_product

Column = Sequence[tuple[int, int, int]]
"""The entries of a sparse column: (row, radicand, integer), a row once for each radicand."""
Parts = Mapping[int, Sequence[fmpz]]
"""A vector of the field without its denominator: integers for each radicand."""
Number = Mapping[int, fmpz]
"""A number of the field without its denominator."""


def group_of(radicands: Iterable[int]) -> tuple[int, ...]:
    """The group that these radicands generate, 1 first.

    >>> group_of([2, 3])
    (1, 2, 3, 6)
    """
    group = {1}
    for r in radicands:
        if r not in group:
            group |= {root_product(r, s)[1] for s in group}
    return tuple(sorted(group))


def cosets(radicands: Iterable[int], group: Sequence[int]) -> list[int]:
    """One of the radicands for each coset of the group that they touch.

    >>> cosets([1, 3, 5], (1, 3))
    [1, 5]
    """
    found: dict[frozenset[int], int] = {}
    for r in sorted(radicands):
        found.setdefault(frozenset(root_product(r, s)[1] for s in group), r)
    return list(found.values())


def dot(column: Column, vector: Parts) -> dict[int, fmpz]:
    """The sum of the products of a sparse column with the entries of a vector.

    >>> dot([(0, 3, 2), (1, 1, 5)], {1: [fmpz(1), fmpz(1)], 3: [fmpz(1), fmpz(0)]})
    {3: 2, 1: 11}
    """
    total: dict[int, fmpz] = {}
    for i, q, a in column:
        for s, values in vector.items():
            x = values[i]
            if x != 0:
                g, r = root_product(q, s)
                total[r] = total.get(r, _ZERO) + x * (a * g)
    return total


def times(one: Number, two: Number) -> dict[int, fmpz]:
    """The product of two numbers."""
    total: dict[int, fmpz] = {}
    for q, a in one.items():
        for s, b in two.items():
            g, r = root_product(q, s)
            total[r] = total.get(r, _ZERO) + a * b * g
    return total


def less(one: Number, two: Number) -> dict[int, fmpz]:
    """The difference of two numbers."""
    total = dict(one)
    for r, b in two.items():
        total[r] = total.get(r, _ZERO) - b
    return total


def sign(number: Number) -> int:
    """-1, 0 or 1, exactly."""
    return surd_sign([(r, x, 1) for r, x in number.items()])


def number(parts: Number, den: fmpz) -> Surd:
    """The number of these integers over one denominator."""
    terms = ((r, Fraction(int(x), int(den))) for r, x in sorted(parts.items()) if x != 0)
    return Surd(tuple(terms))


_ZERO = fmpz(0)
