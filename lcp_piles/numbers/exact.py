"""Exact numbers: rationals, and sums of rational multiples of square roots.

`Surd` is the number type of scenes and results. Inside the solvers there are only integers (see
`vectors`); a Surd stands at the border, where people and files read numbers. sympy could do the
same, 50 times slower and at half a second of import; a Surd turns into a sympy number on request.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, total_ordering
from math import gcd, inf, isqrt
from operator import index
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq, fmpz

from ..errors import InputError

if TYPE_CHECKING:
    import sympy

Exact = Any
"""What may be given for an exact number: see `surd`."""

_MAX_CHARACTERS = 1_000_000
_SPACED_SIGN = re.compile(r"\s*([+-])\s*")
_TERM = re.compile(
    r"(?P<sign>[+-])(?:(?P<num>\d+)(?:/(?P<den>\d+))?(?:\*(?P<times>sqrt\((?P<r1>\d{1,9})\)))?"
    r"|sqrt\((?P<r2>\d{1,9})\))(?:/(?P<over>\d+))?",
    re.ASCII,
)


@total_ordering
@dataclass(frozen=True, eq=False, slots=True)
class Surd:
    """An exact real number, the sum of c sqrt(r) over `terms` (r, c).

    Invariant: radicands r are square-free, positive and increasing, and no c is zero. So equal
    numbers have equal terms (square roots of different square-free integers are independent over
    the rationals), and zero is the empty sum.

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
            raise InputError("the number", str(self), "a rational number")
        return self.terms[0][1] if self.terms else Fraction(0)

    def sign(self) -> int:
        """-1, 0 or 1, exactly."""
        return surd_sign([(r, c.numerator, c.denominator) for r, c in self.terms])

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __eq__(self, other: object) -> bool:
        value = _coerce(other)
        return NotImplemented if value is None else self.terms == value.terms

    def __hash__(self) -> int:
        return hash(self.rational()) if self.is_rational else hash(self.terms)

    def __lt__(self, other: object) -> bool:
        value = _coerce(other)
        return NotImplemented if value is None else (self - value).sign() < 0

    def __neg__(self) -> Surd:
        return Surd(tuple((r, -c) for r, c in self.terms))

    def __abs__(self) -> Surd:
        return -self if self.sign() < 0 else self

    def __add__(self, other: object) -> Surd:
        value = _coerce(other)
        if value is None:
            return NotImplemented
        return _collect(self.terms + value.terms)

    __radd__ = __add__

    def __sub__(self, other: object) -> Surd:
        value = _coerce(other)
        return NotImplemented if value is None else self + (-value)

    def __rsub__(self, other: object) -> Surd:
        return (-self) + other

    def __mul__(self, other: object) -> Surd:
        value = _coerce(other)
        if value is None:
            return NotImplemented
        products = []
        for r, c in self.terms:
            for s, e in value.terms:
                common = gcd(r, s)
                products.append((r // common * (s // common), c * e * common))
        return _collect(products)

    __rmul__ = __mul__

    def __truediv__(self, other: object) -> Surd:
        value = _coerce(other)
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
        return float(_approximate(self, 64))

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


def surd(value: Exact) -> Surd:
    """The exact number that `value` stands for.

    Takes int, Fraction, Surd, text such as "7/3" or "266/3*sqrt(3)", flint's fmpz and fmpq, and
    sympy numbers of the form of a Surd. A float is refused: it would hide a rounding.

    >>> surd("sqrt(12)/4") == surd("1/2*sqrt(3)")
    True
    >>> surd(0.5)
    Traceback (most recent call last):
    lcp_piles.errors.InputError: the number is 0.5, expected an exact number; pass an int, a \
Fraction or text such as "1/2" or "2/3*sqrt(3)", or floats_exactly(0.5) to mean its binary value
    """
    if isinstance(value, str):
        return _parse(value)
    result = _coerce(value)
    if result is None:
        result = _from_sympy(value)
    if result is None:
        remedy = 'pass an int, a Fraction or text such as "1/2" or "2/3*sqrt(3)"'
        if isinstance(value, float) or type(value).__name__.startswith("float"):
            remedy += f", or floats_exactly({value!r}) to mean its binary value"
        raise InputError("the number", value, "an exact number", remedy)
    return result


def rational(value: Exact, what: str = "the number") -> Fraction:
    """The exact rational that `value` stands for; see `surd` for what it takes."""
    number = surd(value)
    if not number.is_rational:
        raise InputError(what, str(number), "a rational number")
    return number.rational()


def floats_exactly(values: Any) -> Any:
    """Floats read as the binary fractions they are, in nested lists of the same shape.

    The named door from floating point into the exact solvers: nothing is rounded, and nothing is
    guessed (0.1 becomes 3602879701896397/36028797018963968, not 1/10).

    >>> floats_exactly([0.5, 0.25])
    [Fraction(1, 2), Fraction(1, 4)]
    """
    if hasattr(values, "tolist"):
        values = values.tolist()
    if isinstance(values, list | tuple):
        return [floats_exactly(value) for value in values]
    try:
        return Fraction(values)
    except (ValueError, OverflowError, TypeError) as error:
        raise InputError("the float", values, "a finite number") from error


def sqrt_of(n: int) -> Surd:
    """sqrt(n) for an integer n >= 1, simplified.

    >>> sqrt_of(12)
    Surd('2*sqrt(3)')
    """
    outside, inside = _square_part(n)
    return Surd(((inside, Fraction(outside)),))


def surd_sign(terms: list[tuple[int, Any, Any]]) -> int:
    """Sign of the sum of num/den sqrt(r) over (r, num, den), den > 0, r distinct square-free."""
    terms = [term for term in terms if term[1] != 0]
    if not terms:
        return 0
    if all(term[1] > 0 for term in terms):
        return 1
    if all(term[1] < 0 for term in terms):
        return -1
    if len(terms) == 2:  # opposite signs: the larger square decides
        (r, a, d), (s, b, e) = terms
        larger_first = r * (a * e) ** 2 > s * (b * d) ** 2
        return 1 if larger_first == (a > 0) else -1
    precision = 64
    while True:  # ends: the roots are independent over Q, so the sum is not zero
        ball = _enclose(terms, precision)
        if ball > 0:
            return 1
        if ball < 0:
            return -1
        precision *= 2


def decimal(value: Surd, digits: int) -> str:
    """The number in decimals, correctly rounded to so many significant digits.

    >>> decimal(surd("sqrt(3)/3"), 10)
    '0.5773502692'
    """
    if not value:
        return "0"
    return _trim(_approximate(value, 4 * digits + 8).str(digits, radius=False))


def _trim(text: str) -> str:
    """Without zeros at the end of the fraction."""
    mantissa, mark, exponent = text.partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return mantissa + mark + exponent


def _approximate(value: Surd, bits: int) -> arb:
    """A ball around a number other than zero, right to so many of its leading bits."""
    terms = [(r, c.numerator, c.denominator) for r, c in value.terms]
    precision = bits + 16
    ball = _enclose(terms, precision)
    while ball.rel_accuracy_bits() < bits:  # the terms cancel
        precision *= 2
        ball = _enclose(terms, precision)
    return ball


def _enclose(terms: list[tuple[int, Any, Any]], precision: int) -> arb:
    """A ball that holds the sum, at the working precision given in bits."""
    saved = ctx.prec
    ctx.prec = precision
    try:
        total = arb(0)
        for r, num, den in terms:
            total += arb(fmpz(num)) / arb(fmpz(den)) * arb(r).sqrt()
        return total
    finally:
        ctx.prec = saved


def _coerce(value: object) -> Surd | None:
    if isinstance(value, Surd):
        return value
    if isinstance(value, bool):
        return None
    if isinstance(value, int | Fraction):
        return Surd(((1, Fraction(value)),)) if value else ZERO
    if isinstance(value, fmpz):
        return _coerce(int(value))
    if isinstance(value, fmpq):
        return _coerce(Fraction(int(value.p), int(value.q)))
    if type(value).__module__ == "numpy" and getattr(value, "ndim", None) == 0:
        try:
            return _coerce(index(value))  # type: ignore[arg-type]
        except TypeError:
            return None
    return None


def _collect(terms: Any) -> Surd:
    total: dict[int, Fraction] = {}
    for r, c in terms:
        total[r] = total[r] + c if r in total else c
    return Surd(tuple(sorted((r, c) for r, c in total.items() if c)))


def _inverse(value: Surd) -> Surd:
    """1/value, clearing one prime of the radicands after the other by conjugation."""
    if not value:
        raise InputError("the divisor", "0", "a number other than zero")
    numerator, denominator = ONE, value
    while not denominator.is_rational:
        prime = next(_smallest_prime(r) for r, _ in denominator.terms if r > 1)
        conjugate = Surd(tuple((r, -c if r % prime == 0 else c) for r, c in denominator.terms))
        numerator, denominator = numerator * conjugate, denominator * conjugate
    return numerator * (1 / denominator.rational())


def _smallest_prime(n: int) -> int:
    return next((p for p in range(2, isqrt(n) + 1) if n % p == 0), n)


@cache
def _square_part(n: int) -> tuple[int, int]:
    """(a, b) with n = a^2 b and b square-free."""
    outside, p = 1, 2
    while p * p <= n:
        while n % (p * p) == 0:
            n //= p * p
            outside *= p
        p += 1
    return outside, n


def _parse(text: str) -> Surd:
    """A Surd from text, by a grammar of its own: nothing is ever evaluated."""
    if len(text) > _MAX_CHARACTERS:
        raise InputError("the number", text, f"at most {_MAX_CHARACTERS} characters")
    compact = _SPACED_SIGN.sub(r"\1", text.strip())
    rest = compact if compact[:1] in ("+", "-") else "+" + compact
    total, position = ZERO, 0
    while position < len(rest):
        match = _TERM.match(rest, position)
        if match is None:
            break
        position = match.end()
        numerator = fmpz(match["num"] or "1")
        denominator = fmpz(match["den"] or "1") * fmpz(match["over"] or "1")
        root = int(match["r1"] or match["r2"] or 1)
        if denominator == 0 or root == 0:
            break
        if match["sign"] == "-":
            numerator = -numerator
        total += sqrt_of(root) * Fraction(int(numerator), int(denominator))
    else:
        return total
    raise InputError("the number", text, 'an exact number such as "-7/3" or "2 - 1/2*sqrt(3)"')


def _from_sympy(value: object) -> Surd | None:
    """A sympy number, taken apart by its structure; None for anything else."""
    if not type(value).__module__.startswith("sympy"):
        return None
    import sympy

    if not isinstance(value, sympy.Expr):
        return None
    total = ZERO
    for term in sympy.Add.make_args(sympy.expand(value)):
        coefficient, root = term.as_coeff_Mul()
        if not coefficient.is_Rational:
            return None
        square = sympy.Integer(1) if root == 1 else root**2
        if not (square.is_Integer and square > 0 and (root == 1 or root.is_positive)):
            return None
        fraction = Fraction(int(coefficient.p), int(coefficient.q))
        total += sqrt_of(int(square)) * fraction
    return total


ZERO = Surd(())
ONE = Surd(((1, Fraction(1)),))
