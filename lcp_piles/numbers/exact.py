"""What may be given for an exact number, and how it becomes one.

Numbers are accepted as people have them, integers, fractions, decimals, text, the numbers of numpy,
flint and sympy, as long as they are exact. A float is not: it would hide a rounding.
"""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from math import isfinite
from typing import Any, Protocol, TypeAlias

import numpy as np
from flint import fmpq, fmpz

from ..errors import InputError
from .number_text import parsed
from .roots import surd_sign as surd_sign
from .surds import ONE as ONE
from .surds import ZERO as ZERO
from .surds import Surd as Surd
from .surds import coerced, summed
from .surds import decimal as decimal
from .surds import sqrt_of as sqrt_of


class SympyNumber(Protocol):
    """What the numbers of sympy have and floats do not; sympy itself is imported when needed."""

    def as_coeff_Mul(self) -> Any:
        """The number as a rational coefficient and the rest."""


Exact: TypeAlias = (
    int | Fraction | Decimal | str | Surd | fmpz | fmpq | np.integer[Any] | SympyNumber
)
"""What may be given for an exact number: see `surd`."""


def surd(value: Exact) -> Surd:
    """The exact number that `value` stands for.

    Parameters
    ----------
    value : exact number
        An int, Fraction, Decimal, Surd, text such as "7/3", "-0.25", "1e-3" or "266/3*sqrt(3)",
        numpy's integers, flint's fmpz and fmpq, or a sympy number of the form of a Surd.

    Returns
    -------
    Surd
        The number.

    Raises
    ------
    InputError
        For anything else, floats and bools among it.

    Examples
    --------
    >>> surd("sqrt(12)/4") == surd("1/2*sqrt(3)")
    True
    >>> surd(0.5)
    Traceback (most recent call last):
    lcp_piles.errors.InputError: the number is 0.5, expected an exact number; pass an int, a \
Fraction or text such as "1/2", "0.5" or "2/3*sqrt(3)", or floats_exactly(0.5) to mean its binary \
value
    """
    if isinstance(value, str):
        return parsed(value)
    if isinstance(value, Decimal) and value.is_finite():
        return parsed(str(value))
    result = coerced(value)
    if result is None:
        result = _from_sympy(value)
    if result is None:
        remedy = 'pass an int, a Fraction or text such as "1/2", "0.5" or "2/3*sqrt(3)"'
        if isinstance(value, float | np.floating) and isfinite(value):
            remedy += f", or floats_exactly({value!r}) to mean its binary value"
        raise InputError("the number", value, "an exact number", remedy)
    return result


def rational(value: Exact, what: str = "the number") -> Fraction:
    """The exact rational that `value` stands for; see `surd` for what it takes."""
    number = surd(value)
    if not number.is_rational:
        raise InputError(what, number, "a rational number")
    return number.rational()


def floats_exactly(values: Any) -> Any:
    """Floats read as the binary fractions they are, in nested lists of the same shape.

    The named door from floating point into the exact solvers: nothing is rounded, and nothing is
    guessed (0.1 becomes 3602879701896397/36028797018963968, not 1/10).

    Parameters
    ----------
    values : float, nested list, array or sparse matrix
        The floats, finite.

    Returns
    -------
    Fraction or list
        A Fraction for a float, nested lists of them for lists and arrays. A sparse matrix of scipy
        becomes a list of rows {column: Fraction}, which `lcp` takes too.

    Raises
    ------
    InputError
        For what is no number, infinity and NaN.

    Examples
    --------
    >>> floats_exactly([0.5, 0.25])
    [Fraction(1, 2), Fraction(1, 4)]
    """
    if hasattr(values, "tocoo"):
        return _sparse_rows(values.tocoo())
    if hasattr(values, "tolist"):
        values = values.tolist()
    if isinstance(values, list | tuple):
        return [floats_exactly(value) for value in values]
    try:
        return Fraction(values)
    except (ValueError, OverflowError, TypeError) as error:
        raise InputError("the float", values, "a finite number") from error


def _sparse_rows(places: Any) -> list[dict[int, Fraction]]:
    """The rows of a matrix of scipy's coo form; what stands twice at a place is added exactly."""
    rows: list[dict[int, Fraction]] = [{} for _ in range(places.shape[0])]
    numbers = floats_exactly(places.data)
    for i, j, x in zip(places.row.tolist(), places.col.tolist(), numbers, strict=True):
        rows[i][j] = rows[i].get(j, Fraction(0)) + x
    return rows


def _from_sympy(value: object) -> Surd | None:
    """A sympy number, taken apart by its structure; None for anything else."""
    if not type(value).__module__.startswith("sympy"):
        return None
    import sympy

    if not isinstance(value, sympy.Expr):
        return None
    terms: list[tuple[int, Fraction]] = []
    for term in sympy.Add.make_args(sympy.expand(value)):
        coefficient, root = term.as_coeff_Mul()
        if not coefficient.is_Rational:
            return None
        square = sympy.Integer(1) if root == 1 else root**2
        if not (square.is_Integer and square > 0 and (root == 1 or root.is_positive)):
            return None
        fraction = Fraction(int(coefficient.p), int(coefficient.q))
        terms += (sqrt_of(int(square)) * fraction).terms
    return summed(terms)
