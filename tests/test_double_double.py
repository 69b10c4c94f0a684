"""Double-double arithmetic against fractions: relative errors within the proved bound."""

from fractions import Fraction

import numpy as np
import pytest

from lcp_piles.numbers.double_double import ERROR, DoubleDouble, difference

BOUND = Fraction(ERROR)


def _random(seed: int, size: int = 4000) -> DoubleDouble:
    rng = np.random.default_rng(seed)
    high = rng.standard_normal(size) * 2.0 ** rng.integers(-40, 40, size)
    low = high * 2.0**-54 * rng.uniform(-1, 1, size)
    return DoubleDouble(high, low)


def _exact(x: DoubleDouble) -> list[Fraction]:
    pairs = zip(x.high.tolist(), x.low.tolist(), strict=True)
    return [Fraction(high) + Fraction(low) for high, low in pairs]


def _cancelling(x: DoubleDouble, seed: int) -> DoubleDouble:
    """About -x: sums with it lose nearly all bits."""
    rng = np.random.default_rng(seed)
    near = -x.high * (1 + 2.0**-52 * rng.integers(-2, 3, len(x)))
    return DoubleDouble(near, -x.low * rng.integers(0, 2, len(x)))


@pytest.mark.parametrize("seed", range(3))
def test_operations_are_within_the_bound(seed: int) -> None:
    x, y = _random(seed), _random(seed + 100)
    near = _cancelling(x, seed)
    a_of, b_of = _exact(x), _exact(y)
    results = (
        (x + y, [a + b for a, b in zip(a_of, b_of, strict=True)]),
        (x - y, [a - b for a, b in zip(a_of, b_of, strict=True)]),
        (x + near, [a + b for a, b in zip(a_of, _exact(near), strict=True)]),
        (x * y, [a * b for a, b in zip(a_of, b_of, strict=True)]),
        (x / y, [a / b for a, b in zip(a_of, b_of, strict=True)]),
    )
    for computed, exact in results:
        pairs = zip(_exact(computed), exact, strict=True)
        assert all(abs(a - b) <= BOUND * abs(b) for a, b in pairs)
        assert (computed.high + computed.low == computed.high).all()


def test_roots_are_within_the_bound() -> None:
    x = _random(7)
    x = DoubleDouble(np.append(np.abs(x.high), 0.0), np.append(x.low, 0.0))
    for root, square in zip(_exact(x.sqrt()), _exact(x), strict=True):
        assert ((1 - BOUND) ** 2) * square <= root * root <= ((1 + BOUND) ** 2) * square


def test_differences_of_floats_are_exact() -> None:
    rng = np.random.default_rng(3)
    x = rng.standard_normal(1000)
    y = x * (1 + 2.0 ** rng.integers(-60, 10, 1000))
    pairs = zip(x.tolist(), y.tolist(), strict=True)
    assert _exact(difference(x, y)) == [Fraction(a) - Fraction(b) for a, b in pairs]
