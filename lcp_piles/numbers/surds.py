"""`Surd`: a sum of rational multiples of square roots, as people and files read numbers.

Inside the solvers there are only integers (see `vectors`); a Surd stands at the border. sympy could
do the same, 50 times slower and at half a second of import; a Surd turns into a sympy number on
request.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import total_ordering
from math import inf
from operator import index
from typing import TYPE_CHECKING

from flint import fmpq, fmpz

from ..errors import InputError
from .roots import approximate, root_product, smallest_prime, square_part, surd_sign

if TYPE_CHECKING:
    import sympy

_MOST_TERMS = 256


@total_ordering
@dataclass(frozen=True, eq=False, slots=True)
class Surd:
    """An exact real number, the sum of c sqrt(r) over `terms` (r, c).

    Equal numbers have equal terms (square roots of different square-free integers are independent
    over the rationals). Two Surds, or one and an int, Fraction, flint or numpy integer, are added,
    multiplied, divided and compared exactly. `surd` makes one of whatever is exact.

    Attributes
    ----------
    terms : tuple of (int, Fraction)
        Pairs (r, c): radicands r are square-free, positive and increasing, and no c is zero. Zero
        is the empty sum.

    Examples
    --------
    >>> from lcp_piles import surd
    >>> x = surd("2 - 1/2*sqrt(3)")
    >>> x * x
    Surd('19/4 - 2*sqrt(3)')
    >>> x > 1, float(surd("1/3*sqrt(3)")).hex() == (3 ** 0.5 / 3).hex()
    (True, True)
    """

    terms: tuple[tuple[int, Fraction], ...]

    @property
    def is_rational(self) -> bool:
        """Whether no root is left."""
        return all(r == 1 for r, _ in self.terms)

    def rational(self) -> Fraction:
        """The value as a Fraction; `InputError` where a root is left."""
        if not self.is_rational:
            raise InputError("the number", self, "a rational number")
        return self.terms[0][1] if self.terms else Fraction(0)

    def sign(self) -> int:
        """-1, 0 or 1, exactly."""
        return surd_sign([(r, c.numerator, c.denominator) for r, c in self.terms])

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __eq__(self, other: object) -> bool:
        value = coerced(other)
        return NotImplemented if value is None else self.terms == value.terms

    def __hash__(self) -> int:
        return hash(self.rational()) if self.is_rational else hash(self.terms)

    def __lt__(self, other: object) -> bool:
        value = coerced(other)
        return NotImplemented if value is None else (self - value).sign() < 0

    def __neg__(self) -> Surd:
        return Surd(tuple((r, -c) for r, c in self.terms))

    def __abs__(self) -> Surd:
        return -self if self.sign() < 0 else self

    def __add__(self, other: object) -> Surd:
        value = coerced(other)
        return NotImplemented if value is None else summed(self.terms + value.terms)

    __radd__ = __add__

    def __sub__(self, other: object) -> Surd:
        value = coerced(other)
        return NotImplemented if value is None else self + (-value)

    def __rsub__(self, other: object) -> Surd:
        return (-self) + other

    def __mul__(self, other: object) -> Surd:
        value = coerced(other)
        if value is None:
            return NotImplemented
        products = []
        for r, c in self.terms:
            for s, e in value.terms:
                factor, root = root_product(r, s)
                products.append((root, c * e * factor))
        return summed(products)

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Surd:
        value = coerced(other)
        return NotImplemented if value is None else self * _inverse(value)

    def __rtruediv__(self, other: object) -> Surd:
        return _inverse(self) * other

    def __float__(self) -> float:
        """The nearest float but for a thousandth of its last place, infinite beyond their range."""
        if self.is_rational:
            try:
                return float(self.rational())
            except OverflowError:
                return inf * self.sign()
        return float(approximate([(r, c.numerator, c.denominator) for r, c in self.terms], 64))

    def sympy(self) -> sympy.Expr:
        """The same number for sympy."""
        import sympy

        parts = (sympy.Rational(c.numerator, c.denominator) * sympy.sqrt(r) for r, c in self.terms)
        return sympy.Add(*parts)

    def __str__(self) -> str:
        """As the result format writes it: "-7/3", "1/3*sqrt(3)", "2 - 1/2*sqrt(3)"."""
        text = ""
        for r, c in self.terms:
            # python-flint prints integers of any length; int refuses beyond 4,300 digits.
            number = str(fmpq(abs(c.numerator), c.denominator))
            if r > 1:
                number = f"sqrt({r})" if number == "1" else f"{number}*sqrt({r})"
            if text:
                text += (" - " if c < 0 else " + ") + number
            else:
                text = ("-" if c < 0 else "") + number
        return text or "0"

    def __repr__(self) -> str:
        return f"Surd('{self}')"


def sqrt_of(n: int) -> Surd:
    """sqrt(n) for an integer n >= 1, simplified.

    >>> sqrt_of(12)
    Surd('2*sqrt(3)')
    """
    outside, inside = square_part(n)
    return Surd(((inside, Fraction(outside)),))


def decimal(value: Surd, digits: int) -> str:
    """The number in decimals, correctly rounded to so many significant digits.

    Parameters
    ----------
    value : Surd
        The number.
    digits : int
        How many digits, 1 or more.

    Returns
    -------
    str
        The decimals, without zeros at the end of the fraction; with an exponent where it is long.

    Examples
    --------
    >>> from lcp_piles import surd
    >>> decimal(surd("sqrt(3)/3"), 10)
    '0.5773502692'
    """
    if not value:
        return "0"
    terms = [(r, c.numerator, c.denominator) for r, c in value.terms]
    return _trimmed(approximate(terms, 4 * digits + 8).str(digits, radius=False))


def _trimmed(text: str) -> str:
    """Without zeros at the end of the fraction."""
    mantissa, mark, exponent = text.partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return mantissa + mark + exponent


def coerced(value: object) -> Surd | None:
    """The Surd of a number that is exact by its type, None for anything else."""
    if isinstance(value, Surd):
        return value
    if isinstance(value, bool):
        return None
    if isinstance(value, int | Fraction):
        return Surd(((1, Fraction(value)),)) if value else ZERO
    if isinstance(value, fmpz):
        return coerced(int(value))
    if isinstance(value, fmpq):
        return coerced(Fraction(int(value.p), int(value.q)))
    if type(value).__module__ == "numpy" and getattr(value, "ndim", None) == 0:
        if getattr(getattr(value, "dtype", None), "kind", "") == "b":  # an index to older numpy
            return None
        try:
            return coerced(index(value))  # type: ignore[arg-type]
        except TypeError:
            return None
    return None


def summed(terms: Iterable[tuple[int, Fraction]]) -> Surd:
    """The sum of c sqrt(r) over (r, c), each r square-free."""
    total: dict[int, Fraction] = {}
    for r, c in terms:
        total[r] = total[r] + c if r in total else c
    return Surd(tuple(sorted((r, c) for r, c in total.items() if c)))


def _inverse(value: Surd) -> Surd:
    """1/value, clearing one prime of the radicands after the other by conjugation."""
    if not value:
        raise InputError("the divisor", 0, "a number other than zero")
    numerator, denominator = ONE, value
    while not denominator.is_rational:
        if len(denominator.terms) > _MOST_TERMS:
            raise InputError("the divisor", value, "roots of fewer different primes")
        prime = next(smallest_prime(r) for r, _ in denominator.terms if r > 1)
        conjugate = Surd(tuple((r, -c if r % prime == 0 else c) for r, c in denominator.terms))
        numerator, denominator = numerator * conjugate, denominator * conjugate
    return numerator * (1 / denominator.rational())


ZERO = Surd(())
ONE = Surd(((1, Fraction(1)),))
