"""Exact linear programmes: every certificate is checked again here, in plain Surds."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array

from lcp_piles import InputError, linear_program, surd
from lcp_piles.errors import VerificationError
from lcp_piles.numbers.vectors import exact_vector as vector
from lcp_piles.programs.certificates import is_farkas, is_feasible, is_optimal, is_ray
from lcp_piles.programs.constraints import SparseSurds, constraints
from lcp_piles.programs.linear_program import minimise
from lcp_piles.programs.proposal import Proposal

ZERO = surd(0)


def exactly(rows):
    return [[surd(x) for x in row] for row in rows]


def along(one, two):
    return sum((x * y for x, y in zip(one, two, strict=True)), ZERO)


def assert_proved(c, A, b, result):
    """The certificate that belongs to the status holds, in plain Surds."""
    c, b, A = [surd(x) for x in c], [surd(x) for x in b], exactly(A)
    columns = [list(column) for column in zip(*A, strict=True)] if A else [[] for _ in c]

    def is_point(x):
        assert len(x) == len(c)
        assert all(value >= 0 for value in x)
        assert [along(row, x) for row in A] == b

    if result.status == "infeasible":
        y = list(result.y)
        assert len(y) == len(b)
        assert all(along(column, y) <= 0 for column in columns)
        assert along(b, y) > 0
        assert result.x is result.ray is result.value is None
        return
    x = list(result.x)
    is_point(x)
    if result.status == "optimal":
        y = list(result.y)
        assert len(y) == len(b)
        assert all(along(column, y) <= own for column, own in zip(columns, c, strict=True))
        assert along(b, y) == along(c, x) == result.value
        assert result.ray is None
        return
    assert result.status == "unbounded"
    ray = list(result.ray)
    assert all(value >= 0 for value in ray)
    assert all(along(row, ray) == 0 for row in A)
    assert along(c, ray) < 0
    assert result.y is result.value is None


small = st.integers(-3, 3)
fractions = st.fractions(min_value=-3, max_value=3, max_denominator=5)
rationals = st.one_of(st.just(0), small, fractions)
roots = st.builds(lambda a, b: surd(a) + surd(b) * surd("sqrt(3)"), rationals, rationals)


@st.composite
def programmes(draw, entries):
    """Degenerate ones, infeasible and unbounded ones, and rows that repeat others."""
    m, n = draw(st.integers(1, 4)), draw(st.integers(1, 6))
    A = [draw(st.lists(entries, min_size=n, max_size=n)) for _ in range(m)]
    x = draw(st.lists(st.sampled_from([0, 0, 1, 2]), min_size=n, max_size=n))
    b = [
        draw(entries) if draw(st.booleans()) else sum(p * q for p, q in zip(r, x, strict=True))
        for r in A
    ]
    if draw(st.booleans()):
        k = draw(st.integers(0, m - 1))
        factor = draw(st.sampled_from([1, -2, Fraction(1, 3)]))
        A.append([factor * value for value in A[k]])
        b.append(factor * b[k] + draw(st.sampled_from([0, 0, 1])))
    return draw(st.lists(entries, min_size=n, max_size=n)), A, b


def assert_solved(c, A, b):
    result = linear_program(c, A, b)
    assert_proved(c, A, b, result)
    return result


@given(programmes(rationals))
@settings(max_examples=60, deadline=None)
def test_every_end_over_the_rationals_is_proved(problem):
    assert_solved(*problem)


@given(programmes(roots))
@settings(max_examples=40, deadline=None)
def test_every_end_over_a_field_of_roots_is_proved(problem):
    assert_solved(*problem)


@given(programmes(rationals), st.data())
@settings(max_examples=40, deadline=None)
def test_scaling_of_rows_and_columns_changes_nothing(problem, data):
    c, A, b = problem
    exponents = st.integers(-40, 40)
    rows = [Fraction(10) ** data.draw(exponents) for _ in A]
    columns = [Fraction(10) ** data.draw(exponents) for _ in c]

    def times(one, two):
        return [x * y for x, y in zip(one, two, strict=True)]

    wide = [times(times(row, columns), [r] * len(c)) for row, r in zip(A, rows, strict=True)]
    plain = assert_solved(c, A, b)
    scaled = assert_solved(times(c, columns), wide, times(b, rows))
    assert plain.status == scaled.status
    assert plain.value == scaled.value


@given(programmes(rationals))
@settings(max_examples=40, deadline=None)
def test_without_a_proposal_the_exact_pivots_end_alike(problem):
    c, A, b = problem
    read = constraints(A, b)
    idle = range(len(c), len(c) + len(b))
    cold = minimise(read, c, start=list(idle))
    assert_proved(c, A, b, cold)
    assert cold.status == linear_program(c, A, b).status


def test_proposals_at_degenerate_vertices_need_no_pivots():
    # Few columns carry b, rows repeat, and the multipliers of several rows are zero.
    rng = np.random.default_rng(7)
    for _ in range(20):
        A = rng.integers(-2, 3, size=(8, 14))
        A[6], A[7] = A[0] + A[1], 2 * A[2]
        b = A[:, :3] @ rng.integers(1, 4, size=3)
        c = rng.integers(0, 3, size=14)
        result = linear_program(c, A, b)
        assert (result.status, result.pivots) == ("optimal", 0)


class Liar:
    """A proposer that claims what it is told and names a basis of its own."""

    def __init__(self, claim, basis):
        self.answer = Proposal(claim, basis)

    def propose(self, c):
        return self.answer


@pytest.mark.parametrize("claim", ["optimal", "infeasible", "nothing"])
@pytest.mark.parametrize("basis", [None, [0, 1], [2, 3], [4, 5], [0, 0], [1]])
def test_a_wrong_proposal_is_repaired(claim, basis):
    # Vertices of the triangle x, y >= 0, x + 2 y <= 4, 3 x + y <= 6: the least of -x - y is at
    # x = 8/5, y = 6/5.
    c, A, b = [-1, -1, 0, 0], [[1, 2, 1, 0], [3, 1, 0, 1]], [4, 6]
    read = constraints(A, b)
    for right, status in ((b, "optimal"), ([-1, 6], "infeasible")):
        problem = constraints(A, right)
        result = minimise(problem, c, proposer=Liar(claim, basis))
        assert_proved(c, A, right, result)
        assert result.status == status
    assert minimise(read, c, proposer=Liar(claim, basis)).value == Fraction(-14, 5)
    ray = constraints([[1, -1, 1, 0], [-1, 1, 0, 1]], b)
    assert minimise(ray, c, proposer=Liar(claim, basis)).status == "unbounded"


def test_beale_cycles_under_the_rule_of_the_largest_coefficient_but_not_here():
    # Beale 1955, "Cycling in the dual simplex algorithm"; least value -1/20.
    c = ["-3/4", 20, "-1/2", 6, 0, 0, 0]
    A = [["1/4", -8, -1, 9, 1, 0, 0], ["1/2", -12, "-1/2", 3, 0, 1, 0], [0, 0, 1, 0, 0, 0, 1]]
    b = [0, 0, 1]
    read = constraints(A, b)
    for result in (linear_program(c, A, b), minimise(read, c, start=[4, 5, 6])):
        assert_proved(c, A, b, result)
        assert result.value == Fraction(-5, 4)


def test_a_difference_below_all_floats_is_seen():
    tiny = Fraction(1, 10**400)
    A, b = [[1, 1, 0], [1, 0, 1]], [1, 1 - tiny]
    c = [-1, 0, 0]
    result = linear_program(c, A, b)
    assert_proved(c, A, b, result)
    assert result.value == tiny - 1
    assert linear_program([0, 0], [[1, 1], [1, 1]], [1, 1 + tiny]).status == "infeasible"


def test_coefficients_beyond_floats_and_words():
    huge = 10**400
    A = [[huge, 7, 1, 0], [1, huge + 1, 0, huge**2]]
    b = [huge, huge + 3]
    c = [-1, -1, huge, 1]
    assert_proved(c, A, b, linear_program(c, A, b))
    # 2^63 + 1 in a word of 64 bits would come out negative.
    word = 2**63 + 1
    result = linear_program([1, 1], [[word, 3]], [word])
    assert_proved([1, 1], [[word, 3]], [word], result)
    assert result.value == 1


def test_shapes_without_rows_or_columns():
    assert linear_program([1, 0], [], []).value == 0
    assert linear_program([-1, 0], [], []).status == "unbounded"
    assert linear_program([], [], []).status == "optimal"
    assert linear_program([], [[], []], [0, 0]).status == "optimal"
    assert linear_program([], [[], []], [0, 1]).status == "infeasible"
    assert linear_program([1], [[0], [0]], [0, 0]).value == 0


def test_the_forms_of_a_matrix_that_are_read():
    import sympy
    from flint import fmpq_mat

    c, A, b = [1, 2], [[1, 1]], [3]
    forms = [
        A,
        np.array(A),
        csr_array(np.array(A)),
        sympy.Matrix(A),
        fmpq_mat(A),
        SparseSurds((1, 2), [0, 0, 0], [0, 1, 1], [surd(1), surd(3), surd(-2)]),
    ]
    for form in forms:
        assert linear_program(c, form, b).value == 3


@pytest.mark.parametrize(
    ("c", "A", "b", "message"),
    [
        ([1], [[1, 1]], [1], "length of c"),
        ([1, 1], [[1, 1]], [1, 2], "length of b"),
        ([1, 1], [[1, 1], [1]], [1, 2], "length of row 1"),
        ([1, 1], [[1, 0.5]], [1], "floats_exactly"),
        ([1, 1], "11", [1], "A"),
        ([1, 1], 3, [1], "A"),
        ([1], SparseSurds((1, 1), [1], [0], [surd(1)]), [1], "an entry of A"),
    ],
)
def test_what_cannot_be_read_is_refused(c, A, b, message):
    with pytest.raises(InputError, match=message):
        linear_program(c, A, b)


def test_the_checks_refuse_what_is_not_a_proof():
    c, A, b = [-1, -1, 0, 0], [[1, 2, 1, 0], [3, 1, 0, 1]], [4, 6]
    read = constraints(A, b)
    result = minimise(read, c)
    cost = vector(c)
    assert is_optimal(read, cost, result.x, result.y)
    assert not is_optimal(read, cost, vector([0, 0, 4, 6]), result.y)  # feasible, not the least
    assert not is_optimal(read, cost, vector([2, 2, -2, -2]), result.y)  # balanced, not feasible
    assert not is_optimal(read, cost, result.x, vector([0, 0]))  # y not below c
    assert not is_optimal(read, cost, result.x, vector([-1, -1]))  # below c, another value
    assert not is_feasible(read, vector([0, 0, 4, 5]))
    assert not is_feasible(read, vector([0, 0, 4]))
    assert not is_farkas(read, vector([-1, 0]))
    assert not is_farkas(read, vector([1, 1]))
    assert is_farkas(constraints([[1, 2]], [-1]), vector([-1]))
    assert not is_farkas(constraints([[1, 2]], [-1]), vector([0]))
    wedge = constraints([[1, -1]], [0])
    assert is_ray(wedge, vector([-1, 0]), vector([1, 1]))
    assert not is_ray(wedge, vector([-1, 0]), vector([1, 2]))
    assert not is_ray(wedge, vector([-1, 0]), vector([-1, -1]))
    assert not is_ray(wedge, vector([-1, 1]), vector([1, 1]))


def test_a_proof_that_fails_is_an_error(monkeypatch):
    from lcp_piles.programs import linear_program as module

    monkeypatch.setattr(module, "is_optimal", lambda *_: False)
    with pytest.raises(VerificationError):
        linear_program([1, 1], [[1, 1]], [1])


def test_nothing_is_printed(capfd):
    linear_program([1, 1], [[1, 1]], [1])
    assert capfd.readouterr() == ("", "")
