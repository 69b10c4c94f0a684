"""Vectors over one denominator, entry by entry against Surds."""

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest
from flint import fmpz
from hypothesis import given
from hypothesis import strategies as st

from lcp_piles import InputError, surd
from lcp_piles.numbers.exact import sqrt_of
from lcp_piles.numbers.vectors import ExactVector, combination, content, exact_vector

numbers = st.builds(
    lambda a, b, r: surd(a) + surd(b) * sqrt_of(r),
    st.fractions(max_denominator=1000),
    st.sampled_from([Fraction(0), Fraction(0), Fraction(1), Fraction(-7, 5)]),
    st.sampled_from([2, 3]),
)
lists = st.lists(numbers, max_size=8)


@st.composite
def factored(draw):
    """A vector with factors, as displacements have them, and its entries."""
    plain = draw(st.lists(numbers, min_size=1, max_size=8))
    factors = (surd(1), surd("1/3*sqrt(3)"), surd("5/2*sqrt(2)"), surd("1/2 + 3*sqrt(6)"))
    which = draw(st.lists(st.integers(0, 3), min_size=len(plain), max_size=len(plain)))
    base = exact_vector(plain)
    vector = ExactVector(base.numerators, base.denominator, factors, np.array(which))
    return vector, [factors[k] * x for k, x in zip(which, plain, strict=True)]


@given(lists)
def test_entries_and_signs_are_those_given(values):
    vector = exact_vector(values)
    assert len(vector) == len(values)
    assert list(vector) == values
    assert vector.signs() == [x.sign() for x in values]
    assert vector.denominator > 0


@given(factored())
def test_factors_belong_to_entries(pair):
    vector, values = pair
    assert list(vector) == values
    assert list(vector.plain()) == values
    assert vector.signs() == [x.sign() for x in values]
    assert vector.array() == pytest.approx([float(x) for x in values], rel=1e-15, abs=0)


def test_products_with_a_factor_of_two_terms_meet_on_each_root():
    """(1 + sqrt(3))^2 = 4 + 2 sqrt(3), and (1 + sqrt(3)) sqrt(3) = 3 + sqrt(3)."""
    base = exact_vector(["1 + sqrt(3)", "sqrt(3)", 0, 1])
    vector = ExactVector(base.numerators, base.denominator, (surd("1 + sqrt(3)"),))
    assert list(vector.plain()) == [
        surd(x) for x in ("4 + 2*sqrt(3)", "3 + sqrt(3)", "0", "1 + sqrt(3)")
    ]


@given(factored(), st.data())
def test_take_picks_and_signs(pair, data):
    vector, values = pair
    picks = data.draw(st.lists(st.integers(0, len(values) - 1), max_size=6))
    signs = data.draw(
        st.lists(st.sampled_from([-1, 0, 1]), min_size=len(picks), max_size=len(picks))
    )
    taken = vector.take(np.array(picks, dtype=np.int64), signs)
    assert list(taken) == [s * values[i] for i, s in zip(picks, signs, strict=True)]


@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=6), numbers, numbers)
def test_combination_is_linear(pairs, c, e):
    v, w = (exact_vector([pair[k] for pair in pairs]) for k in (0, 1))
    assert list(combination([(c, v), (e, w)])) == [c * x + e * y for x, y in pairs]


@pytest.mark.parametrize("digits", [20, 200, 600])
def test_floats_of_entries_far_longer_than_a_float(digits):
    """Ratios of integers that overflow a float, and p - q sqrt(3) with p/q just below sqrt(3)."""
    q = 10**digits + 7
    p = isqrt(3 * q * q)
    ratio = Fraction(10**digits, 3 * q)
    assert exact_vector([ratio, -ratio]).array() == pytest.approx([1 / 3, -1 / 3], rel=1e-15)
    # (p - q sqrt(3)) (p + q sqrt(3)) = p^2 - 3 q^2, and p + q sqrt(3) is 2 p but for 1 in 10^digits
    difference = float(Fraction(p * p - 3 * q * q, 2 * p))
    vector = exact_vector([ratio, p - sqrt_of(3) * q])
    assert vector.array() == pytest.approx([1 / 3, difference], rel=1e-15, abs=0)


def test_terms_below_one_that_cancel_are_rounded_exactly():
    q = 10**20 + 7
    p = isqrt(3 * q * q)
    vector = exact_vector([(p - sqrt_of(3) * q) / (4 * q), (sqrt_of(3) * q - p) / (4 * q)])
    small = float(Fraction(p * p - 3 * q * q, 8 * p * q))  # as above, to 40 digits
    assert vector.array() == pytest.approx([small, -small], rel=1e-15, abs=0)


def test_an_empty_vector():
    vector = exact_vector([])
    assert len(vector) == 0
    assert list(vector) == vector.signs() == vector.array().tolist() == []


def test_floats_are_refused():
    with pytest.raises(InputError, match=r"is 0\.5, expected an exact number"):
        exact_vector([1, 0.5])


@given(st.lists(st.integers(-(10**30), 10**30)), st.integers(-(10**30), 10**30))
def test_content_is_the_greatest_common_divisor(values, start):
    assert content([fmpz(x) for x in values], fmpz(start)) == np.gcd.reduce(
        [start, *values], dtype=object
    )
