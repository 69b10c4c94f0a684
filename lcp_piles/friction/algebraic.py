"""Real algebraic numbers: a root of an integer polynomial, and signs of what is built from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from flint import arb, arb_poly, ctx, fmpq, fmpq_poly, fmpz_poly

from ..errors import SolveError

if TYPE_CHECKING:
    import sympy

_BITS = (96, 512, 4096, 32768)


@dataclass(frozen=True)
class AlgebraicNumber:
    """The only root of an irreducible integer polynomial in [lower, upper].

    `polynomial` has its coefficients, of the constant first.

    >>> AlgebraicNumber((1, -4, 1), Fraction(1, 4), Fraction(1, 3))
    <AlgebraicNumber 2 - sqrt(3)>
    """

    polynomial: tuple[int, ...]
    lower: Fraction
    upper: Fraction

    @property
    def degree(self) -> int:
        """Its degree over the rationals."""
        return len(self.polynomial) - 1

    def narrowed(self, bits: int) -> tuple[Fraction, Fraction]:
        """Rationals around the number, at most 2^-bits apart."""
        p = fmpz_poly(list(self.polynomial))
        low, high = self.lower, self.upper
        if low == high:
            return low, high
        rising = _at(p, high) > 0
        while (high - low) * (1 << bits) > 1:
            middle = (low + high) / 2
            value = _at(p, middle)
            if value == 0:
                return middle, middle
            low, high = (low, middle) if (value > 0) == rising else (middle, high)
        return low, high

    def decimal(self, digits: int) -> str:
        """The number in decimals.

        >>> AlgebraicNumber((1, -4, 1), Fraction(1, 4), Fraction(1, 3)).decimal(12)
        '0.267949192431'
        """
        return str(_ball(self, 4 * digits + 16).str(digits, radius=False))

    def sympy(self) -> sympy.Expr:
        """The same number for sympy: in roots for degrees up to two, else a `CRootOf`."""
        import sympy

        p = sympy.Poly(list(self.polynomial[::-1]), sympy.Symbol("m"))
        low, _ = self.narrowed(256)
        near = sympy.Rational(low.numerator, low.denominator)
        roots = p.real_roots()
        return min(roots, key=lambda root: abs(root.evalf(60) - near))

    def __float__(self) -> float:
        return float(_ball(self, 64))

    def __repr__(self) -> str:
        if self.degree <= 2:
            return f"<AlgebraicNumber {self.sympy()}>"
        import sympy

        text = sympy.Poly(list(self.polynomial[::-1]), sympy.Symbol("m")).as_expr()
        return f"<AlgebraicNumber {self.decimal(12)}, a root of {text}>"


def sign_at(number: AlgebraicNumber, parts: Mapping[int, fmpq_poly]) -> int:
    """Sign of the sum of sqrt(r) parts[r](number), exactly, for at most two radicands."""
    p = fmpq_poly(list(number.polynomial))
    rest = {r: q % p for r, q in parts.items()}
    rest = {r: q for r, q in rest.items() if q.degree() >= 0}
    if not rest:
        return 0
    for bits in _BITS:
        ball = _value(number, rest, bits)
        if ball > 0:
            return 1
        if ball < 0:
            return -1
        if len(rest) == 2 and bits == _BITS[0]:
            (r, u), (s, v) = rest.items()
            # u sqrt(r) + v sqrt(s) or its conjugate is zero: which, the signs of u and v tell.
            same = ((r * u * u - s * v * v) % p).degree() < 0
            if same and sign_at(number, {1: u}) == -sign_at(number, {1: v}):
                return 0
    raise SolveError("the sign of an algebraic number needs more digits than are tried")


def _value(number: AlgebraicNumber, parts: Mapping[int, fmpq_poly], bits: int) -> arb:
    """A ball around the sum of sqrt(r) parts[r](number)."""
    saved = ctx.prec
    ctx.prec = 2 * bits + 64
    try:
        low, high = number.narrowed(bits)
        x = arb(_fmpq(low)).union(arb(_fmpq(high)))
        total = arb(0)
        for r, q in parts.items():
            total += arb_poly(q)(x) * arb(r).sqrt()
        return total
    finally:
        ctx.prec = saved


def _ball(number: AlgebraicNumber, bits: int) -> arb:
    return _value(number, {1: fmpq_poly([0, 1])}, bits)


def _at(p: fmpz_poly, x: Fraction) -> Fraction:
    value: Fraction = Fraction(0)
    for c in reversed(p.coeffs()):
        value = value * x + int(c)
    return value


def _fmpq(x: Fraction) -> fmpq:
    return fmpq(x.numerator, x.denominator)
