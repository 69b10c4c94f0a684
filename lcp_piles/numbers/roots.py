"""Square roots of integers, and signs and enclosures of sums of rational multiples of them.

Square roots of different square-free integers are independent over the rationals, so such a sum is
zero only where every coefficient is.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import gcd, isqrt
from typing import TypeAlias

from flint import arb, ctx, fmpz

Term: TypeAlias = tuple[int, int | fmpz, int | fmpz]
"""(r, num, den) for num/den sqrt(r), r square-free and den > 0."""


def root_product(r: int, s: int) -> tuple[int, int]:
    """(k, t) with sqrt(r) sqrt(s) = k sqrt(t) and t square-free, as r and s have to be.

    >>> root_product(6, 15)
    (3, 10)
    """
    common = gcd(r, s)
    return common, r // common * (s // common)


@lru_cache(maxsize=1024)
def square_part(n: int) -> tuple[int, int]:
    """(a, b) with n = a^2 b and b square-free, for n >= 1.

    >>> square_part(12)
    (2, 3)
    """
    outside, p = 1, 2
    while p * p <= n:
        while n % (p * p) == 0:
            n //= p * p
            outside *= p
        p += 1
    return outside, n


def smallest_prime(n: int) -> int:
    """The smallest prime factor of n >= 2."""
    return next((p for p in range(2, isqrt(n) + 1) if n % p == 0), n)


def surd_sign(terms: Sequence[Term]) -> int:
    """Sign of the sum of num/den sqrt(r) over (r, num, den), the r distinct.

    >>> surd_sign([(1, 17, 10), (3, -1, 1)])
    -1
    """
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
    ball = approximate(terms, 1)
    return 1 if ball > 0 else -1


def approximate(terms: Sequence[Term], bits: int) -> arb:
    """A ball around the sum of the terms, which is not zero, right to so many leading bits."""
    precision = bits + 64
    ball = _enclosed(terms, precision)
    while ball.contains(0) or ball.rel_accuracy_bits() < bits:  # the terms cancel
        precision *= 2
        ball = _enclosed(terms, precision)
    return ball


def _enclosed(terms: Sequence[Term], precision: int) -> arb:
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
