"""Dense matrices of rationals, read from whatever holds them."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpq_mat

from ..errors import InputError
from .exact import rational


def rational_matrix(values: Any, what: str) -> fmpq_mat:
    """The matrix of these exact numbers: nested lists, numpy, scipy.sparse, sympy, flint.

    `what` names it in the `InputError` for rows of different lengths, and for numbers that are not
    rational, floats among them.

    >>> rational_matrix([["1/2", 1], [0, "0.1"]], "A").tolist()
    [[1/2, 1], [0, 1/10]]
    """
    if hasattr(values, "toarray"):
        values = values.toarray()
    rows = [_sequence(row, f"a row of {what}") for row in _sequence(values, what)]
    width = len(rows[0]) if rows else 0
    for i, row in enumerate(rows):
        if len(row) != width:
            raise InputError(f"the length of row {i} of {what}", len(row), f"{width}, as row 0")
    numbers = [_fmpq(x, f"an entry of {what}") for row in rows for x in row]
    return fmpq_mat(len(rows), width, numbers)


def rational_column(values: Any, what: str) -> fmpq_mat:
    """The matrix of one column that holds these exact numbers; errors as of `rational_matrix`.

    >>> rational_column([1, "2/3"], "b").tolist()
    [[1], [2/3]]
    """
    entries = [_fmpq(x, f"an entry of {what}") for x in _sequence(values, what)]
    return fmpq_mat(len(entries), 1, entries)


def fractions(matrix: fmpq_mat) -> tuple[Fraction, ...]:
    """The entries, row by row, as Fractions.

    >>> fractions(rational_column([1, "2/3"], "b"))
    (Fraction(1, 1), Fraction(2, 3))
    """
    return tuple(Fraction(int(x.p), int(x.q)) for x in matrix.entries())


def _fmpq(value: Any, what: str) -> fmpq:
    number = rational(value, what)
    return fmpq(number.numerator, number.denominator)


def _sequence(values: Any, what: str) -> list[Any]:
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
