"""Numbers a + b sqrt(r) + ..., against sympy and against integers alone."""

from decimal import Decimal
from fractions import Fraction
from math import isqrt
from time import process_time

import numpy as np
import pytest
import sympy
from flint import fmpq, fmpz
from hypothesis import given
from hypothesis import strategies as st

from lcp_piles import InputError, LcpPilesError, Surd, decimal, floats_exactly, surd
from lcp_piles.numbers.exact import rational, sqrt_of

fractions = st.fractions(min_value=-50, max_value=50, max_denominator=40)
surds = st.dictionaries(st.sampled_from([1, 2, 3, 5, 6, 12, 50]), fractions, max_size=4).map(
    lambda terms: sum((surd(c) * sqrt_of(r) for r, c in terms.items()), surd(0))
)


@given(surds, surds)
def test_arithmetic_is_that_of_sympy(x, y):
    a, b = x.sympy(), y.sympy()
    assert (x + y).sympy() == sympy.expand(a + b)
    assert (x - y).sympy() == sympy.expand(a - b)
    assert (x * y).sympy() == sympy.expand(a * b)
    assert surd(sympy.expand(a * b)) == x * y


@given(surds, surds)
def test_division_undoes_multiplication(x, y):
    if y == 0:
        with pytest.raises(InputError, match="divisor"):
            x / y
    else:
        assert x / y * y == x
        assert 1 / (1 / y) == y


@given(surds)
def test_sign_order_and_float_agree_with_sympy(x):
    a = x.sympy()
    sign = 0 if a == 0 else 1 if a.is_positive else -1
    assert x.sign() == sign
    assert ((x > 0) - (x < 0)) == sign
    assert abs(x).sympy() == (a if sign >= 0 else sympy.expand(-a))
    assert float(x) == pytest.approx(float(a.evalf(30)), rel=1e-15, abs=0)


@given(st.integers(1, 10**80), st.sampled_from([2, 3, 7, 10**8 + 7]))
def test_sign_just_beside_a_root(q, r):
    """p/q is the fraction next below sqrt(r): no float tells them apart, and p^2 < r q^2 does."""
    p = isqrt(r * q * q)
    x = surd(p) - sqrt_of(r) * q
    assert x.sign() == -1
    assert (x + 1).sign() == 1
    # p^2 - r q^2 = (p - q sqrt(r)) (p + q sqrt(r)), the second factor without cancellation
    assert float(x) == pytest.approx((p * p - r * q * q) / float(surd(p) + sqrt_of(r) * q))


@pytest.mark.parametrize("digits", [5, 40, 300])
def test_sign_of_three_roots_that_nearly_cancel(digits):
    """The sum of sqrt(2) and sqrt(3), whose square is 5 + 2 sqrt(6), against its first decimals."""
    ten = 10**digits
    p = isqrt(5 * ten**2 + isqrt(24 * ten**4))  # floor(ten * (sqrt(2) + sqrt(3)))
    x = sqrt_of(2) + sqrt_of(3) - Fraction(p, ten)
    assert x.sign() == 1
    assert (x - Fraction(1, ten)).sign() == -1


@given(surds)
def test_text_round_trip(x):
    assert surd(str(x)) == x
    assert hash(surd(str(x))) == hash(x)
    assert repr(x) == f"Surd('{x}')"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-7/3", sympy.Rational(-7, 3)),
        ("266/3*sqrt(3)", 266 * sympy.sqrt(3) / 3),
        ("2 - 1/2*sqrt(3)", 2 - sympy.sqrt(3) / 2),
        ("sqrt(12)/4", sympy.sqrt(3) / 2),
        (" +1+sqrt(8) ", 1 + 2 * sympy.sqrt(2)),
        ("sqrt(3) - sqrt(27)/3", sympy.Integer(0)),
        ("-sqrt(4)", sympy.Integer(-2)),
        ("0.5", sympy.Rational(1, 2)),
        ("-.25", sympy.Rational(-1, 4)),
        ("1e-3", sympy.Rational(1, 1000)),
        ("2.5e3", sympy.Integer(2500)),
        ("+1.50E+1/3", sympy.Integer(5)),
        ("0.1*sqrt(8) - 1e0", sympy.sqrt(2) / 5 - 1),
        ("1e-0010000", sympy.Rational(1, 10**10000)),
        ("\t1 -\n 2 ", sympy.Integer(-1)),
    ],
)
def test_parsing(text, value):
    assert surd(text).sympy() == value


@pytest.mark.parametrize(
    "text",
    [
        *(
            "",
            "+",
            ".",
            "1.",
            "1e",
            "1e+",
            "e5",
            "1.5.2",
            "1/2e3",
            "1/.5",
            "1/0",
            "sqrt(3)/0",
            "sqrt(0)",
            "sqrt(-1)",
            "2**3",
            "1 2",
            "--1",
        ),
        *(
            "1++2",
            "nan",
            "inf",
            "__import__('os')",
            "sqrt(3",
            "1_000",
            "\u0663",
            "1/\u00b2",
            "0x10",
        ),
        *("sqrt(2.0)", "sqrt(99999999999999999999)", "sqrt(3)*2", "1,5", "x", "0x10"),
    ],
)
def test_text_that_is_no_exact_number_is_refused(text):
    with pytest.raises(InputError, match="expected"):
        surd(text)


def test_numbers_of_thousands_of_digits():
    text = "7" * 6000  # more than Python's int will read or print
    assert str(surd(text)) == text
    with pytest.raises(InputError, match=r"at most 200000 characters"):
        surd("7" * 200_001)
    with pytest.raises(InputError, match=r"the text is .*, expected a number"):
        raise InputError("the text", 10**6000, "a number")
    assert surd(text) * 9 == 7 * (surd(10**6000) - 1)


@pytest.mark.parametrize(
    "value",
    [
        *(3, Fraction(3), "3", "3.0", "30e-1", fmpz(3), fmpq(3), np.int64(3), np.uint8(3)),
        *(Decimal(3), Decimal("3.000"), Decimal("0.3e1"), sympy.Integer(3)),
    ],
    ids=repr,
)
def test_everything_exact_is_taken(value):
    assert surd(value) == 3
    assert rational(value) == Fraction(3)


@pytest.mark.parametrize("value", [sympy.sqrt(3) / 3, "1/3*sqrt(3)", sqrt_of(3) / 3, "sqrt(3)/3"])
def test_surds_are_taken(value):
    assert surd(value) * surd(value) == Fraction(1, 3)
    with pytest.raises(InputError, match="a rational number"):
        rational(value)


@pytest.mark.parametrize(
    "value",
    [
        *(0.5, float("nan"), np.float64(1), np.float32(1), np.array(2.5), np.array([3]), np.True_),
        *(True, None, 1j, [1], b"1", sympy.pi, sympy.Float(2), sympy.I, sympy.nan, sympy.oo),
        *(Decimal("nan"), Decimal("inf"), Decimal("-inf"), Decimal("sNaN")),
        *(sympy.Symbol("x"), sympy.sqrt(1 + sympy.sqrt(2)), sympy.cbrt(2), sympy.true),
    ],
    ids=repr,
)
def test_everything_else_is_refused(value):
    with pytest.raises(InputError, match="expected an exact number"):
        surd(value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (" " * 1_000_000, "at most 200000 characters"),
        (" " * 200_000, "an exact number such as"),
        ("1" + " " * 199_998 + "1", "an exact number such as"),
        ("1" + " + sqrt(999999937)" * 10_000, "a sum of at most 64 terms"),
        ("+".join(f"1/{k}" for k in range(10**5, 10**5 + 20_000)), "a sum of at most 64 terms"),
        ("1e999999999", "an exponent of at most 10000"),
        ("1e-10001", "an exponent of at most 10000"),
        ("1e" + "9" * 100_000, "an exponent of at most 10000"),
        (Decimal("1e999999"), "an exponent of at most 10000"),
        ("1/" + "0" * 100_000, "an exact number such as"),
    ],
    ids=range(10),
)
def test_what_would_take_long_is_refused_at_once(text, expected):
    """Patterns that go back, sums of roots and long exponents once took minutes."""
    start = process_time()
    with pytest.raises(InputError, match=expected):
        surd(text)
    assert process_time() - start < 1


def test_as_much_as_is_taken_is_read_at_once():
    start = process_time()
    long = surd("7" * 99_990 + "/" + "9" * 99_990)
    many = surd(" + ".join(f"{'3' * 1500}/{k}*sqrt({10**9 - k})" for k in range(1, 65)))
    assert process_time() - start < 2
    assert 0 < float(long) < 1
    assert len(many.terms) > 50


def test_messages_show_exact_numbers_as_people_write_them():
    for value in (surd("3"), Fraction(3), fmpz(3), fmpq(3)):
        assert str(InputError("it", value, "more")) == "it is 3, expected more"
    values = [surd("1/2*sqrt(3)"), Fraction(1, 2), "text"]
    assert str(InputError("it", values, "more")) == (
        "it is [1/2*sqrt(3), 1/2, 'text'], expected more"
    )
    for value in (surd(10**5000) / 3, Fraction(10**5000, 3), fmpz(10) ** 5000, 10**5000):
        assert len(str(InputError("it", value, "more"))) < 150


def test_a_divisor_with_roots_of_many_primes_is_refused():
    """Its conjugates would be 2^k products."""
    primes = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53]
    x = sum((sqrt_of(p) for p in primes), surd(0))
    start = process_time()
    with pytest.raises(InputError, match="roots of fewer different primes"):
        1 / x
    assert process_time() - start < 5


def test_a_float_is_told_what_to_do():
    with pytest.raises(LcpPilesError, match=r"0\.1.*exact.*floats_exactly\(0\.1\)"):
        surd(0.1)


def test_floats_exactly_reads_the_binary_value():
    assert floats_exactly([[0.1], [-2.0]]) == [[Fraction(0.1)], [Fraction(-2)]]
    assert floats_exactly(np.array([0.25, 3.0])) == [Fraction(1, 4), Fraction(3)]
    for value in (float("nan"), float("inf"), "text", None):
        with pytest.raises(InputError, match="a finite number"):
            floats_exactly([value])


def test_equal_numbers_are_equal_whatever_their_type():
    assert surd("1/2") == Fraction(1, 2)
    assert hash(surd("1/2")) == hash(Fraction(1, 2))
    assert surd("sqrt(9)") == 3
    assert surd(1) != "1"
    assert sorted([sqrt_of(3), surd(2), sqrt_of(2)]) == [sqrt_of(2), sqrt_of(3), 2]
    assert not surd(0)
    assert Surd(()) == surd(0)


@given(surds, st.integers(1, 40))
def test_decimals_are_those_of_sympy(x, digits):
    shown = decimal(x, digits)
    if x == 0:
        assert shown == "0"
    else:
        error = sympy.Rational(shown) - x.sympy()
        size = 10 ** (sympy.floor(sympy.log(abs(x.sympy()), 10).evalf(50)) + 1 - digits)
        assert bool(sympy.N(abs(error), 80) <= sympy.Rational(51, 100) * size)


@pytest.mark.parametrize(
    ("text", "digits", "shown"),
    [("2", 5, "2"), ("1/4", 5, "0.25"), ("100", 5, "100"), ("1e30", 3, "1e+30")],
)
def test_decimals_end_with_their_last_digit(text, digits, shown):
    assert decimal(surd(text), digits) == shown
