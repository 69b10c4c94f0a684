"""Published convex quadratic programmes with their solutions, for whoever tries a solver.

From Hock and Schittkowski (1981), "Test Examples for Nonlinear Programming Codes", Lecture Notes in
Economics and Mathematical Systems 187, where they have the numbers that they are named by; the
solutions that are printed there as decimals are given as the fractions that they round.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

Numbers = tuple[Fraction, ...]
Rows = tuple[Numbers, ...]
Bounds = tuple[Fraction | None, ...]


@dataclass(frozen=True)
class QuadraticCase:
    """Minimise x . P x / 2 + c . x subject to G x <= h, lower <= x <= upper, and its solution x.

    `value` is the least value as published, which has `constant` beside the terms of x.
    """

    name: str
    P: Rows
    c: Numbers
    G: Rows
    h: Numbers
    lower: Bounds
    upper: Bounds
    constant: Fraction
    x: Numbers
    value: Fraction


def _numbers(text: str) -> Numbers:
    return tuple(map(Fraction, text.split()))


def _rows(*lines: str) -> Rows:
    return tuple(map(_numbers, lines))


def hock_schittkowski_21() -> QuadraticCase:
    """Problem 21: two variables, one row, bounds on both sides."""
    return QuadraticCase(
        "hock-schittkowski 21",
        P=_rows("0.02 0", "0 2"),
        c=_numbers("0 0"),
        G=_rows("-10 1"),
        h=_numbers("-10"),
        lower=_numbers("2 -50"),
        upper=_numbers("50 50"),
        constant=Fraction(-100),
        x=_numbers("2 0"),
        value=Fraction("-99.96"),
    )


def hock_schittkowski_35() -> QuadraticCase:
    """Problem 35, of Beale: three variables, one row."""
    return QuadraticCase(
        "hock-schittkowski 35",
        P=_rows("4 2 2", "2 4 0", "2 0 2"),
        c=_numbers("-8 -6 -4"),
        G=_rows("1 1 2"),
        h=_numbers("3"),
        lower=_numbers("0 0 0"),
        upper=(None,) * 3,
        constant=Fraction(9),
        x=_numbers("4/3 7/9 4/9"),
        value=Fraction(1, 9),
    )


def hock_schittkowski_76() -> QuadraticCase:
    """Problem 76: four variables, three rows."""
    return QuadraticCase(
        "hock-schittkowski 76",
        P=_rows("2 0 -1 0", "0 1 0 0", "-1 0 2 1", "0 0 1 1"),
        c=_numbers("-1 -3 1 -1"),
        G=_rows("1 2 1 1", "3 1 2 -1", "0 -1 -4 0"),
        h=_numbers("5 4 -3/2"),
        lower=_numbers("0 0 0 0"),
        upper=(None,) * 4,
        constant=Fraction(0),
        x=_numbers("3/11 23/11 0 6/11"),
        value=Fraction(-103, 22),
    )


def hock_schittkowski_118() -> QuadraticCase:
    """Problem 118: fifteen variables in five periods, 29 rows, many of them tight."""
    size = 15
    rows: list[Numbers] = []
    right: list[Fraction] = []

    def row(entries: dict[int, int], most: int) -> None:
        rows.append(tuple(Fraction(entries.get(j, 0)) for j in range(size)))
        right.append(Fraction(most))

    for j in range(1, 5):
        for place, most in enumerate((6, 7, 6)):
            now, before = 3 * j + place, 3 * j + place - 3
            row({now: 1, before: -1}, most)
            row({now: -1, before: 1}, 7)
    for j, least in enumerate((60, 50, 70, 85, 100)):
        row({3 * j: -1, 3 * j + 1: -1, 3 * j + 2: -1}, -least)
    diagonal = _numbers("0.0002 0.0002 0.0003") * 5
    zero = Fraction(0)
    return QuadraticCase(
        "hock-schittkowski 118",
        P=tuple(tuple(x if i == j else zero for j in range(size)) for i, x in enumerate(diagonal)),
        c=_numbers("2.3 1.7 2.2") * 5,
        G=tuple(rows),
        h=tuple(right),
        lower=_numbers("8 43 3") + (zero,) * 12,
        upper=_numbers("21 57 16") + _numbers("90 120 60") * 4,
        constant=zero,
        x=_numbers("8 49 3 1 56 0 1 63 6 3 70 12 5 77 18"),
        value=Fraction("664.82045"),
    )
