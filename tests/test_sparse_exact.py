"""Numeric-symbolic lifting against the p-adic solver of FLINT and against exact products."""

from fractions import Fraction
from math import comb, lcm

import numpy as np
import pytest
from flint import fmpz_mat
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array

from lcp_piles import ExactSolver, InputError, LcpPilesError
from lcp_piles.linear.sparse_exact import SingularError

LARGEST = (3, 50, 10**4, 2**31, 2**40, 2**52, 2**59)


@st.composite
def systems(draw, largest=LARGEST):
    """(A, columns): dense or sparse, with entries as large as int64 sums allow."""
    n = draw(st.integers(1, 8))
    bound = draw(st.sampled_from(largest))
    entry = st.integers(-bound, bound)
    if draw(st.booleans()):
        entry = st.one_of(st.just(0), st.just(0), entry)
    A = draw(st.lists(st.lists(entry, min_size=n, max_size=n), min_size=n, max_size=n))
    size = draw(st.sampled_from([1, 10**6, 2**63, 10**40]))
    column = st.lists(st.integers(-size, size), min_size=n, max_size=n)
    return A, draw(st.lists(column, min_size=1, max_size=3))


def flint_solution(A, b):
    """A^-1 b in Fractions by FLINT, or None where A is singular."""
    n = len(b)
    try:
        solution = fmpz_mat(A).solve(fmpz_mat(n, 1, b))
    except ZeroDivisionError:
        return None
    return [Fraction(int(x.p), int(x.q)) for x in solution.entries()]


def assert_solved(A, columns, solver):
    expected = [flint_solution(A, b) for b in columns]
    if expected[0] is None:
        with pytest.raises(SingularError, match="singular"):
            solver.solve_many(columns)
        return
    for (numerators, den), x in zip(solver.solve_many(columns), expected, strict=True):
        assert den > 0
        assert [Fraction(int(a), int(den)) for a in numerators] == x


@settings(max_examples=150)
@given(systems())
def test_random_systems_agree_with_flint(system):
    A, columns = system
    assert_solved(A, columns, ExactSolver(A))


@settings(max_examples=60)
@given(systems(largest=(3, 1000)))
def test_symmetric_systems_agree_with_flint(system):
    A, columns = system
    A = (np.array(A) @ np.array(A).T).tolist()
    assert_solved(A, columns, ExactSolver(A, symmetric=True))


@settings(max_examples=60)
@given(systems(largest=(1, 5, 50)), st.data())
def test_singular_systems_are_named_even_where_the_right_hand_side_fits(system, data):
    A, columns = system
    n = len(A)
    weights = data.draw(st.lists(st.integers(-3, 3), min_size=n - 1, max_size=n - 1))
    last = [sum(w * row[j] for w, row in zip(weights, A, strict=False)) for j in range(n)]
    A = [*A[:-1], last]
    x = data.draw(st.lists(st.integers(-9, 9), min_size=n, max_size=n))
    for b in [columns[0], [0] * n, [sum(a * y for a, y in zip(row, x, strict=True)) for row in A]]:
        with pytest.raises(SingularError):
            ExactSolver(A).solve(b)


@pytest.mark.parametrize(
    "A",
    [
        [[10**6, 10**6 + 1], [10**6 - 1, 10**6]],  # determinant 1
        [[2**30, 2**30 - 1], [2**30 + 1, 2**30]],  # determinant 1, and floats see 2^60 - 2^60
        [[10**15, 1], [1, -(10**15)]],
        [[2**62, 1], [1, 2]],
        [[0, 1], [1, 0]],
        [[-7]],
        [[2**62]],
        [[1]],
    ],
    ids=str,
)
def test_systems_on_the_edge(A):
    n = len(A)
    assert_solved(A, [[1] * n, list(range(n)), [-(10**30)] * n, [0] * n], ExactSolver(A))


@pytest.mark.parametrize("n", [3, 6, 9, 12])
def test_hilbert_matrices_scaled_to_integers(n):
    """Their inverses are known in integers (Choi 1983); n = 12 is singular to floats."""
    scale = lcm(*range(1, 2 * n))
    A = [[scale // (i + j + 1) for j in range(n)] for i in range(n)]
    numerators, den = ExactSolver(A).solve([scale] + [0] * (n - 1))
    inverse = [(-1) ** i * (i + 1) * comb(n + i, n - 1) * comb(n, n - i - 1) for i in range(n)]
    assert [x / den for x in numerators] == inverse


@pytest.mark.parametrize("digits", [30, 500])
def test_huge_right_hand_sides(digits):
    rng = np.random.default_rng(digits)
    A = np.diag(rng.integers(4, 9, 30)) + np.diag(rng.integers(-2, 2, 29), 1)
    columns = [[int(rng.integers(1, 10)) * 10**digits + k for k in range(30)] for _ in range(3)]
    columns.append([0] * 29 + [-1])
    solver = ExactSolver(A)
    assert_solved(A.tolist(), columns, solver)
    assert solver._shifts  # the lifting did it, not the fallback


def test_a_sparse_system_of_hundreds_of_unknowns_by_its_own_product():
    """A chain of springs of stiffness 1 and 2, whose exact solution A N = D b proves itself."""
    n = 400
    k = 1 + np.arange(n + 1) % 2
    A = csr_array(np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1))
    solver = ExactSolver(A, symmetric=True)
    numerators, den = solver.solve([1] * n)
    assert solver._shifts
    ends = [0, *numerators, 0]
    pull = [int(k[i]) * (ends[i + 1] - ends[i]) for i in range(n + 1)]
    assert all(pull[i] - pull[i + 1] == den for i in range(n))


class Lying:
    """A factorisation that does not invert the matrix."""

    def __init__(self, answer):
        self.answer, self.asked = answer, 0

    def solve(self, b):
        self.asked += 1
        return self.answer(b)


RNG = np.random.default_rng(5)
LIES = {
    "noise": lambda b: RNG.normal(size=b.shape) * 1e6,
    "small noise": lambda b: RNG.normal(size=b.shape),
    "nothing": np.zeros_like,
    "not a number": lambda b: np.full_like(b, np.nan),
    "infinity": lambda b: np.full_like(b, np.inf),
    "the right-hand side": lambda b: b,
}


@pytest.mark.parametrize("lie", LIES)
def test_a_factorisation_that_lies_is_caught(lie):
    A = (np.diag([5] * 12) + np.diag([2] * 11, 1) + np.diag([-1] * 10, -2)).tolist()
    solver = ExactSolver(A)
    solver._factors = Lying(LIES[lie])
    assert_solved(A, [[1] * 12, list(range(12))], solver)
    assert solver._factors.asked
    assert not solver._shifts  # nothing was left but the exact fallback


def test_a_sloppy_factorisation_is_good_enough():
    """Right to three digits: every step brings fewer bits, and the answer is exact still."""
    A = np.diag([5] * 12) + np.diag([2] * 11, 1)
    solver = ExactSolver(A)
    solver._factors = Lying(lambda b: np.linalg.solve(A, b) * 1.001)
    assert_solved(A.tolist(), [[1] * 12], solver)


@pytest.mark.parametrize(
    ("A", "b", "message"),
    [
        ([[1, 2]], [1], "square"),
        ([[0.5]], [1], "integers"),
        ([[1, 0], [0, 1]], [1], "length of b is 1, expected 2"),
    ],
)
def test_bad_input(A, b, message):
    with pytest.raises(InputError, match=message):
        ExactSolver(A).solve(b)
    assert issubclass(SingularError, LcpPilesError)


def test_no_unknowns():
    assert ExactSolver(csr_array((0, 0), dtype=np.int64)).solve([]) == ([], 1)
