"""Lemke's method on published problems, on degenerate ones, and against all complementary bases.

Murty: K. G. Murty, "Linear Complementarity, Linear and Nonlinear Programming" (1988), chapter 2.
Kostreva: M. M. Kostreva, "Cycling in linear complementarity problems", Math. Programming 16 (1979).
Cottle, Pang, Stone: "The Linear Complementarity Problem" (1992), chapter 4.
"""

from decimal import Decimal
from fractions import Fraction
from math import isqrt
from multiprocessing import get_context
from time import perf_counter

import numpy as np
import pytest
import sympy
from flint import fmpq, fmpq_mat, fmpz, fmpz_mat
from helpers import (
    assert_infeasible,
    assert_ray,
    assert_solves,
    brute_force,
    degenerate,
    fmpq_of,
)
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array, csc_array, csr_array, csr_matrix, diags_array

from lcp_piles import (
    LCP,
    InputError,
    LcpPilesError,
    contact_lcp,
    contact_system,
    floats_exactly,
    lcp,
    lemke,
    nt60,
    surd,
)
from lcp_piles.numbers.vectors import ExactVector, exact_vector
from lcp_piles.pivoting.checks import is_certificate
from lcp_piles.pivoting.columns import Columns


def solved(M, q, d=None):
    result = lemke(M, q, d)
    assert_solves(M, q, result)
    return list(result.z)


def test_murty_2_8():
    M = [[1, -1, -1, -1], [-1, 1, -1, -1], [1, 1, 2, 0], [1, 1, 0, 2]]
    assert solved(M, [3, 5, -9, -5]) == [2, 1, 3, 1]


def test_murty_2_9_ends_on_a_ray():
    M, q = [[-1, 0, -3], [1, -2, -5], [-2, -1, -2]], [-3, -2, -1]
    assert_ray(M, q, lemke(M, q))


def test_kostreva_1_which_cycles_without_a_rule_for_ties():
    third = Fraction(1, 3)
    assert solved([[1, 2, 0], [0, 1, 2], [2, 0, 1]], [-1, -1, -1]) == [third, third, third]


def test_kostreva_2_ends_on_a_ray():
    M, q = [[1, -1, 3], [2, -1, 3], [-1, -2, 0]], [-1, -1, -1]
    assert_ray(M, q, lemke(M, q))


def test_cottle_pang_stone_remark_4_1_14():
    assert sum(solved([[1, 1], [1, 1]], [-1, -1])) == 1


def test_cottle_pang_stone_example_4_4_16():
    assert solved([[1, -1], [-1, 1]], [1, -1]) == [0, 1]


@pytest.mark.parametrize("n", range(2, 11))
def test_murty_exponential_family(n):
    """1 on the diagonal, 2 below it, q = -e: every one of the 2^n bases is visited."""
    M = [[1 if i == j else 2 if j < i else 0 for j in range(n)] for i in range(n)]
    q = [-1] * n
    result = lemke(M, q)
    assert_solves(M, q, result)
    assert list(result.z) == [1] + [0] * (n - 1)
    assert result.pivots == 2**n


def test_a_tie_with_the_covering_variable_is_a_solution_and_no_ray():
    """w_1 and z0 reach zero together; letting w_1 go first leads to a ray."""
    assert solved([[2, 0], [1, 0]], [-2, -1]) == [1, 0]
    assert solved([[2, 0], [1, -1]], [-2, -1]) == [1, 0]


def test_nothing_to_do():
    result = lemke([[0, -1], [5, 0]], [0, 1])
    assert (result.status, result.z, result.w, result.pivots) == ("solved", (0, 0), (0, 1), 0)
    assert lemke([], []).status == "solved"


# --- random problems against brute force ---


def assert_like_brute_force(M, q, d=None):
    """For a symmetric M >= 0: w is unique, solutions are bases, a ray proves there is none."""
    result = lemke(M, q, d)
    found = brute_force(M, q)
    if found:
        assert_solves(M, q, result)
        assert all(w == [surd(x) for x in result.w] for _, w in found)
        assert [surd(x) for x in result.z] in [z for z, _ in found]
    else:
        assert_ray(M, q, result, d)
        assert result.certificate is not None
        assert_infeasible(M, q, result.certificate)


@settings(max_examples=300)
@given(degenerate())
def test_degenerate_semidefinite_problems(problem):
    assert_like_brute_force(*problem)


@settings(max_examples=100)
@given(degenerate(), st.data())
def test_any_covering_vector_finds_the_same(problem, data):
    M, q = problem
    entry = st.fractions(min_value=Fraction(1, 9), max_value=9, max_denominator=9)
    d = [data.draw(entry if x < 0 else st.one_of(st.just(Fraction(0)), entry)) for x in q]
    assert_like_brute_force(M, q, d)


@settings(max_examples=100)
@given(degenerate(), st.data())
def test_q_in_a_quadratic_field(problem, data):
    """q = a + b sqrt(3): two right-hand sides are carried, ratios are compared exactly."""
    M, a = problem
    b = data.draw(st.lists(st.sampled_from([0, 0, 1, -1]), min_size=len(a), max_size=len(a)))
    q = [surd(x) + surd(y) * surd("sqrt(3)") for x, y in zip(a, b, strict=True)]
    assert_like_brute_force(M, q)


@settings(max_examples=100)
@given(
    st.integers(1, 4).flatmap(
        lambda n: st.lists(
            st.lists(st.integers(-3, 3), min_size=n + 1, max_size=n + 1), min_size=n, max_size=n
        )
    )
)
def test_any_matrix_ends_in_a_true_solution_or_a_true_ray(rows):
    M, q = [row[:-1] for row in rows], [row[-1] for row in rows]
    result = lemke(M, q)
    if result.status == "solved":
        assert_solves(M, q, result)
    else:
        assert_ray(M, q, result)
        if result.certificate is not None:
            assert_infeasible(M, q, result.certificate)


@settings(max_examples=50)
@given(degenerate(), st.data())
def test_q_with_factors(problem, data):
    """q_i = f_i p_i with positive factors f_i, as forces and displacements of a scene have them."""
    M, p = problem
    factors = (surd(1), surd("1/3*sqrt(3)"), surd("2 + sqrt(2)"))
    which = data.draw(st.lists(st.integers(0, 2), min_size=len(p), max_size=len(p)))
    base = exact_vector(p)
    vector = ExactVector(base.numerators, base.denominator, factors, np.array(which))
    q = [factors[k] * x for k, x in zip(which, p, strict=True)]
    result, plain = lemke(LCP(vector, lcp(M, p).column)), lemke(M, q)
    assert (result.status, result.z, result.w) == (plain.status, plain.z, plain.w)
    if plain.status == "solved":
        assert_solves(M, q, result)
    else:
        assert_ray(M, q, result)


def test_q_beside_a_root_is_decided_exactly():
    """q_0 is 1e-40 above or below zero: floats see none of it, and the bases differ."""
    tiny = surd("sqrt(3)") - Fraction(isqrt(3 * 10**80), 10**40)
    M = [[1, 0], [0, 1]]
    assert solved(M, [tiny, -1]) == [0, 1]
    assert solved(M, [-tiny, -1]) == [tiny, 1]


# --- limits, parameters, input ---


def test_pivot_limit_is_a_status_of_its_own():
    M, q = [[1, 0, 0], [2, 1, 0], [2, 2, 1]], [-1, -1, -1]
    for limit in range(8):
        result = lemke(M, q, max_pivots=limit)
        assert (result.status, result.pivots, result.z) == ("limit", limit, ())
    assert lemke(M, q, max_pivots=8).status == "solved"
    assert lemke(M, [1, 1, 1], max_pivots=0).status == "solved"


def test_progress_is_told_every_pivot():
    told = []
    result = lemke([[2, 1], [1, 2]], [-5, -6], progress=told.append)
    assert told == list(range(1, result.pivots + 1))


THIRDS = [[Fraction(2, 3), Fraction(1, 3)], [Fraction(1, 3), Fraction(2, 3)]]


@pytest.mark.parametrize(
    ("M", "q"),
    [
        (THIRDS, [Fraction(-5, 3), Fraction(-2)]),
        ([["2/3", "1/3"], ["1/3", "2/3"]], ["-5/3", "-2"]),
        (sympy.Matrix(THIRDS).tolist(), [sympy.Rational(-5, 3), -2]),
        (sympy.Matrix(THIRDS), sympy.Matrix(["-5/3", -2])),
        (sympy.ImmutableMatrix(THIRDS), (Fraction(-5, 3), -2)),
        ([[fmpq_of(x) for x in row] for row in THIRDS], [fmpq(-5, 3), fmpq(-2)]),
        (
            fmpq_mat(2, 2, list(map(fmpq_of, THIRDS[0] + THIRDS[1]))),
            fmpq_mat(2, 1, [fmpq(-5, 3), -2]),
        ),
    ],
    ids=["Fraction", "text", "sympy", "sympy Matrix", "ImmutableMatrix", "fmpq", "fmpq_mat"],
)
def test_every_exact_input_gives_the_same(M, q):
    assert lemke(M, q).z == (Fraction(4, 3), Fraction(7, 3))
    assert lcp(M, q).M == THIRDS


@pytest.mark.parametrize(
    "M", [f([[2, 1], [1, 2]]) for f in (list, tuple, np.array, fmpz_mat, sympy.Matrix)], ids=type
)
def test_every_integer_input_gives_the_same(M):
    for q in ([-5, -6], np.array([-5, -6]), (-5, -6), ["-5", "-6"]):
        result = lemke(M, q)
        assert result.z == (Fraction(4, 3), Fraction(7, 3))
        assert all(type(x) is Fraction for x in result.z)
    assert lemke(lcp(M, [-5, -6])).z == (Fraction(4, 3), Fraction(7, 3))


SPARSE = [f(np.array([[2, 1], [1, 2]])) for f in (csr_matrix, csr_array, coo_array, csc_array)]


@pytest.mark.parametrize("M", [*SPARSE, SPARSE[0].astype(np.uint8)], ids=repr)
def test_sparse_matrices_and_columns(M):
    """The same z for q as a column, in every form that has one."""
    columns = (
        np.array([[-5], [-6]]),
        [[-5], ["-6"]],
        csr_array([[-5], [-6]]),
        fmpz_mat(2, 1, [-5, -6]),
    )
    for q in columns:
        assert lemke(M, q, max_pivots=np.int32(9)).z == (Fraction(4, 3), Fraction(7, 3))
    assert lcp(M, [-5, -6]).M == [[2, 1], [1, 2]]


@given(
    st.lists(
        st.lists(st.fractions(max_denominator=9), min_size=3, max_size=3), min_size=3, max_size=3
    )
)
def test_rows_give_columns_and_products(M):
    """Against sums of Fractions; and with entries beyond 64 bits."""
    for factor in (1, 10**30):
        wide = [[factor * x for x in row] for row in M]
        problem, y = lcp(wide, [0, 0, 0]), exact_vector([1, -2, 3])
        assert wide == problem.M
        assert [x.rational() for x in problem.times(y)] == [
            r[0] - 2 * r[1] + 3 * r[2] for r in wide
        ]
        rows = zip(*wide, strict=True)
        expected = [c[0] - 2 * c[1] + 3 * c[2] for c in rows]
        assert [x.rational() for x in problem.transpose_times(y)] == expected
        near, (dense, _) = np.array(wide, dtype=float), problem.floats()
        assert np.allclose(dense, near, rtol=1e-14, atol=0)
        assert np.allclose(problem.sparse()[0].toarray(), near, rtol=1e-14, atol=0)


@pytest.mark.parametrize(
    "M", [[], np.zeros((0, 0)), np.zeros((0, 0), int), sympy.zeros(0, 0), fmpz_mat(0, 0)]
)
def test_no_unknowns_at_all(M):
    result = lemke(M, [])
    assert (result.status, result.success, result.z) == ("solved", True, ())


def test_rows_of_zeros():
    """0 z - 1 < 0 whatever z is: infeasible, with y = (0, 1); 0 z + 1 hinders nobody."""
    never, slack = lemke([[1, 0], [0, 0]], [-1, -1]), lemke([[1, 0], [0, 0]], [-1, 1])
    assert (never.status, never.success, never.certificate) == ("infeasible", False, (0, 1))
    assert (slack.status, slack.z, slack.w) == ("solved", (1, 0), (0, 1))


def test_decimals_as_people_write_them():
    M = [["0.1", Decimal("0.05")], ["5e-2", "1/10"]]
    assert lemke(M, [Decimal("-0.25"), "-3e-1"]).z == (Fraction(4, 3), Fraction(7, 3))


def test_two_thousand_sparse_rows_are_read_at_once():
    """Linear in the entries: a dense table of 4 million numbers would take seconds."""
    n = 2000
    M = csr_array(diags_array([-1, 2, -1], offsets=[-1, 0, 1], shape=(n, n), dtype=np.int64))
    started = perf_counter()
    problem = lcp(M, np.ones(n, dtype=np.int64))
    assert perf_counter() - started < 0.5
    assert problem.rows.A.nnz == 3 * n - 2
    assert problem.column(1)[0][:4] == [-1, 2, -1, 0]


def test_floats_by_name():
    assert lemke(floats_exactly([[0.5]]), floats_exactly([-0.1])).z == (2 * Fraction(0.1),)


@pytest.mark.parametrize("form", [csr_matrix, csr_array, coo_array, csc_array])
def test_sparse_floats_by_name(form):
    """Entry by entry as Fractions, and what stands twice in a coo is added without rounding."""
    rows = floats_exactly(form(np.array([[0.1, 0.0], [1e-300, 3.0]])))
    assert rows == [{0: Fraction(0.1)}, {0: Fraction(1e-300), 1: Fraction(3)}]
    assert [[Fraction(0.1), 0], [Fraction(1e-300), 3]] == lcp(rows, [1, 1]).M
    twice = coo_array(([1.0, 2.0**-60], ([0, 0], [0, 0])), shape=(1, 1))
    assert floats_exactly(twice) == [{0: 1 + Fraction(1, 2**60)}]


def test_rows_by_columns_are_sparse_rows():
    assert lemke([{0: 2, 1: "1"}, {1: 2, 0: 1}], [-5, -6]).z == (Fraction(4, 3), Fraction(7, 3))
    assert lcp([{}, {0: 0}], [0, 0]).M == [[0, 0], [0, 0]]
    assert lcp([{}, {0: 0}], [0, 0]).rows.A.nnz == 0


GOOD = [[2, 1], [1, 2]]


@pytest.mark.parametrize(
    ("M", "q", "message"),
    [
        ([[2.0, 1], [1, 2]], [1, 1], r"2\.0, expected an exact number.*floats_exactly"),
        (np.eye(2), [1, 1], "floats_exactly"),
        ([[True, 1], [1, 2]], [1, 1], "is True, expected an exact number"),
        ([[None, 1], [1, 2]], [1, 1], "is None"),
        ([["sqrt(3)", 1], [1, 2]], [1, 1], "expected a rational number"),
        ([["x", 1], [1, 2]], [1, 1], "is 'x'"),
        ([[1, 2, 3], [4, 5, 6]], [1, 1], "row 0 of M is 3, expected 2"),
        ([[1, 2], [3]], [1, 1], "row 1 of M is 1, expected 2"),
        ([1, 2], [1, 1], "a row of M is 1"),
        (None, [1, 1], "M is None, expected a square matrix"),
        ("1 2", [1, 1], "M is '1 2'"),
        (7, [1, 1], "M is 7"),
        (GOOD, [1], "length of q is 1, expected 2"),
        (GOOD, [1, 2, 3], "length of q is 3, expected 2"),
        (GOOD, [0.5, 1], r"is 0\.5"),
        (GOOD, [float("nan"), 1], 'is nan, expected an exact number; pass an int.*"2/3.sqrt.3."$'),
        (GOOD, [[1, 2]], "is \\[1, 2\\]"),
        (np.array([[1, 2, 3], [4, 5, 6]]), [1, 1], r"shape of M is \(2, 3\), expected a square"),
        (csr_matrix(np.eye(2)), [1, 1], "float64', expected integers.*floats_exactly"),
        ([{0: 1}, {2: 1}], [1, 1], "column in row 1 of M is 2, expected a number from 0 to 1"),
        ([{0: 1}, {-1: 1}], [1, 1], "column in row 1 of M is -1"),
        ([{0: 1}, {"1": 1}], [1, 1], "column in row 1 of M is '1'"),
        ([{0: 0.5}], [1], "floats_exactly"),
        (np.eye(2, dtype=bool), [1, 1], "is (np.)?True"),
        (GOOD, np.array([1.0, 2.0]), "floats_exactly"),
        (GOOD, [True, 1], "is True"),
        (GOOD, [None, 1], "is None"),
        (GOOD, None, "q is None, expected a vector"),
        (GOOD, 5, "q is 5"),
        (GOOD, "12", "q is '12'"),
        (lcp(GOOD, [1, 1]), [1, 1], "nothing beside an LCP"),
    ],
)
def test_bad_problems_are_refused(M, q, message):
    with pytest.raises(InputError, match=message) as caught:
        lemke(M, q)
    assert isinstance(caught.value, LcpPilesError)


@pytest.mark.parametrize(
    ("d", "message"),
    [
        ([1], "length of d is 1, expected 2"),
        ([1, 0], r"d\[1\] is 0, expected a positive number"),
        ([-1, 1], r"d\[0\] is -1,"),
        ([1, 0.5], r"0\.5"),
        ([1, "sqrt(3)"], "an entry of d is sqrt"),
        (5, "d is 5, expected a sequence of exact numbers"),
        ("11", "d is '11', expected a sequence"),
        (np.ones(2), "floats_exactly"),
        ([1, None], "is None"),
    ],
)
def test_bad_covering_vectors_are_refused(d, message):
    with pytest.raises(InputError, match=message):
        lemke(GOOD, [1, -1], d)


def test_covers_and_limits_of_other_types():
    fewer = lemke(GOOD, [-5, -6], max_pivots=np.int64(2))
    assert (fewer.status, fewer.pivots) == ("limit", 2)
    for d in (np.array([1, 2]), sympy.Matrix([1, 2]), fmpq_mat(2, 1, [1, 2]), ("1", "2.0")):
        assert lemke(GOOD, [-5, -6], d).z == (Fraction(4, 3), Fraction(7, 3))


def test_results_are_one_short_line_whatever_they_hold():
    """No number of 4,300 digits or more, which Python refuses to print, is in the way."""
    huge = 10**5000
    n = 50
    M = [[2 * (i == j) for j in range(n)] for i in range(n)]
    result, ray = lemke(M, [-huge] * n), lemke([[0]], [-huge])
    values = [result, ray, ray.ray, result.z_vector, lcp(M, [-huge] * n), result.z_vector.bounded()]
    for value in values:
        assert len(repr(value)) < 80
        assert "\n" not in repr(value)
    assert repr(ray) == "<LemkeResult infeasible after 1 pivots>"
    assert repr(ray.ray) == "<Ray of 1 variables>"
    for M, q, d in (
        ([[0.5]], [huge], None),
        ([[huge]], [-huge], [-huge]),
        ([[huge]], [surd(huge) * surd("sqrt(2)")], [surd(huge) * surd("sqrt(2)")]),
        ([[huge, huge]], [huge], None),
    ):
        with pytest.raises(InputError) as caught:
            lemke(M, q, d)
        assert len(str(caught.value)) < 250


def _solved(problem):
    return lemke(problem)


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_problems_and_results_pass_to_other_processes(way):
    """An LCP of numbers, the LCP of a pile, a solution and a ray: there and back."""
    problems = [
        lcp(GOOD, [-5, "-6 + sqrt(2)"]),
        lcp([[-1]], [-1]),
        contact_lcp(contact_system(nt60(3))).problem,
    ]
    here = [lemke(problem) for problem in problems]
    with get_context(way).Pool(1) as pool:
        there = pool.map(_solved, problems)
    for a, b in zip(here, there, strict=True):
        assert (a.status, a.z, a.w, a.certificate) == (b.status, b.z, b.w, b.certificate)
    assert vars(here[1].ray) == vars(there[1].ray)


@pytest.mark.parametrize("limit", [-1, 1.5, "3", True, np.int64(-1)])
def test_bad_limits_are_refused(limit):
    with pytest.raises(InputError, match="max_pivots"):
        lemke(GOOD, [1, -1], max_pivots=limit)


def test_numbers_beyond_the_range_of_floats() -> None:
    """The filter of the tableau is in floats; the solution (4/3, 7/3) scales with q."""
    huge = 10**400
    for d in (None, [huge, 3 * huge]):
        result = lemke([[2, 1], [1, 2]], [-5 * huge, -6 * huge], d)
        assert result.z == (Fraction(4 * huge, 3), Fraction(7 * huge, 3))
    tiny = Fraction(1, huge)
    result = lemke([[2, 1], [1, 2]], [-5 * tiny, -6 * tiny], [1, huge])
    assert result.z == (4 * tiny / 3, 7 * tiny / 3)


def test_columns_over_one_scale() -> None:
    """Entries 1/2, 1/3, 5, 2/7 stand over 42, and a cover put in later does so too."""
    columns = Columns(lcp([["1/2", "1/3"], [5, "2/7"]], [1, 1]), [1, 2])
    columns.fetch(2)
    columns.fetch(3)
    columns.replace_cover([3, 4])
    assert columns.scale == 42
    assert [columns.entries(v, [0, 1]) for v in (2, 3, 4)] == [[21, 210], [14, 12], [126, 168]]
    assert columns.row(1, [4, 2]) == [168, 210]
    assert columns.combine({3: fmpz(7)}) == [98, 84]
    assert columns.combine({2: fmpz(1), 4: fmpz(-2)}) == [21 - 252, 210 - 336]
    assert columns.dot(1, {2: fmpz(1), 4: fmpz(-2)}) == 210 - 336


def test_no_vector_proves_an_empty_problem_infeasible() -> None:
    assert not is_certificate(lcp([], []), [])
