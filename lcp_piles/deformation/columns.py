"""Arithmetic of exact vectors entry by entry, for vectors without factors (`ExactVector.plain`)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from flint import fmpz

from ..numbers.exact import Surd, surd
from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector, IntArray, combination, distinct, exact_vector


def product(v: ExactVector, w: ExactVector) -> ExactVector:
    """The products of the entries of two vectors.

    >>> v = exact_vector(["sqrt(3)", "1/2"])
    >>> [str(x) for x in product(v, v)]
    ['3', '1/4']
    """
    numerators: dict[int, list[fmpz]] = {}
    right = [(s, y) for s, y in w.numerators.items() if any(y)]
    for r, x in v.numerators.items():
        if not any(x):
            continue
        for s, y in right:
            factor, root = root_product(r, s)
            part = [p * q for p, q in zip(x, y, strict=True)]
            if factor > 1:
                part = [p * factor for p in part]
            before = numerators.get(root)
            numerators[root] = (
                [p + q for p, q in zip(before, part, strict=True)] if before else part
            )
    numerators.setdefault(1, [fmpz(0)] * len(v))
    return ExactVector(numerators, v.denominator * w.denominator)


def at(vector: ExactVector, places: IntArray) -> ExactVector:
    """The entries at these places."""
    return vector.take(places, np.ones(len(places), dtype=np.int64))


def spread(vector: ExactVector, places: IntArray, size: int) -> ExactVector:
    """The entries of a vector at these places of a longer one, zero elsewhere.

    >>> [str(x) for x in spread(exact_vector([7]), np.array([1]), 3)]
    ['0', '7', '0']
    """
    numerators = {}
    for r, column in vector.numerators.items():
        numerators[r] = [fmpz(0)] * size
        for k, x in zip(places.tolist(), column, strict=True):
            numerators[r][k] = x
    return ExactVector(numerators, vector.denominator)


def few_values(values: Sequence[Surd | Fraction]) -> tuple[list[Surd], IntArray]:
    """The numbers that are among many, and which of them each is."""
    different, which = distinct(values)
    return [surd(x) for x in different], which


def spread_values(values: tuple[list[Surd], IntArray]) -> ExactVector:
    """The vector of many numbers of which few differ."""
    return at(exact_vector(values[0]), values[1])


def scaled(vector: ExactVector, values: tuple[list[Surd], IntArray]) -> ExactVector:
    """The entries times many numbers of which few differ.

    >>> [str(x) for x in scaled(exact_vector([3, 5]), few_values([Fraction(1, 2)] * 2))]
    ['3/2', '5/2']
    """
    if len(values[0]) == 1:
        return combination([(values[0][0], vector)])
    return product(vector, spread_values(values))
