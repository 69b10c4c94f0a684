"""Numeric-symbolic lifting against the p-adic solver of FLINT and against exact products."""

import pickle
from dataclasses import replace
from fractions import Fraction
from itertools import count
from math import comb, lcm
from random import Random

import numpy as np
import pytest
from flint import fmpz, fmpz_mat
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array, csc_array, csr_array

import lcp_piles.linear.sparse_exact
from lcp_piles import ExactSolver, InputError, LcpPilesError, SolveError, contact_system, tbs
from lcp_piles.linear.integer_matrix import (
    BigMatrix,
    dense,
    from_triplets,
    integer_matrix,
)
from lcp_piles.linear.integer_product import times
from lcp_piles.linear.lifting import column_shifts
from lcp_piles.linear.sparse_exact import SingularError
from lcp_piles.mechanics.held_set import held_set


@pytest.fixture(scope="module", autouse=True)
def _lifted():
    """Small systems are lifted too here, as only large ones are elsewhere."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lcp_piles.linear.sparse_exact, "_SMALL", 0)
        yield


LARGEST = (3, 50, 10**4, 2**31, 2**40, 2**52, 2**59, 2**63, 2**64, 10**30, 10**400)


@st.composite
def systems(draw, largest=LARGEST):
    """(A, columns): dense or sparse, with entries of all sizes."""
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


@settings(max_examples=100)
@given(systems())
def test_random_systems_agree_with_flint(system):
    A, columns = system
    assert_solved(A, columns, ExactSolver(A))


@settings(max_examples=60)
@given(systems(), st.integers(1, 10**30))
def test_a_likely_denominator_changes_no_answer(system, wrong):
    """The determinant is one of every solution; any other number is none, as a rule."""
    A, columns = system
    det = abs(fmpz_mat(A).det())
    if not det:
        return
    for likely in (det, 6 * det, fmpz(wrong)):
        for b, (numerators, den) in zip(
            columns, ExactSolver(A).solve_many(columns, likely), strict=True
        ):
            assert den > 0
            assert [Fraction(int(a), int(den)) for a in numerators] == flint_solution(A, b)


@settings(max_examples=40)
@given(systems(largest=(3, 50, 10**4, 2**31, 2**59)))
def test_small_systems_without_lifting(system):
    """By the equations themselves, and by the determinant where there is no solution."""
    A, columns = system
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lcp_piles.linear.sparse_exact, "_SMALL", 90)
        solver = ExactSolver(A)
        if fmpz_mat(A).det() == 0:
            with pytest.raises(SingularError, match="singular"):
                solver.solve_many(columns)
            return
        solutions = solver.solve_many(columns)
        assert "_lifting" not in vars(solver)
    for b, (numerators, den) in zip(columns, solutions, strict=True):
        assert [sum(a * x for a, x in zip(row, numerators, strict=True)) for row in A] == [
            x * den for x in b
        ]
        assert den > 0


def steps_taken(A, b, likely):
    solver, taken = ExactSolver(A), []
    steps = solver._lifting.steps
    counted = lambda *given: (taken.append(1) or step for step in steps(*given))  # noqa: E731
    object.__setattr__(solver._lifting, "steps", counted)
    solver.solve_many([b], likely)
    return len(taken)


def test_a_likely_denominator_takes_half_the_steps():
    """Numerators show after the bits of the denominator, fractions after twice as many."""
    n = 60
    A = [[2 + (i == j) * 5 + (i * j) % 3 for j in range(n)] for i in range(n)]
    b = [1] + [0] * (n - 1)
    _, den = ExactSolver(A).solve(b)
    assert steps_taken(A, b, fmpz(den)) < 0.7 * steps_taken(A, b, None)


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
    assert_solved(A.tolist(), columns, lifting_only(A))


def test_a_sparse_system_of_hundreds_of_unknowns_by_its_own_product():
    """A chain of springs of stiffness 1 and 2, whose exact solution A N = D b proves itself."""
    n = 400
    k = 1 + np.arange(n + 1) % 2
    A = csr_array(np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1))
    numerators, den = lifting_only(A, symmetric=True).solve([1] * n)
    ends = [0, *numerators, 0]
    pull = [int(k[i]) * (ends[i + 1] - ends[i]) for i in range(n + 1)]
    assert all(pull[i] - pull[i + 1] == den for i in range(n))


@pytest.fixture(autouse=True)
def lifted(monkeypatch):
    """Long matrices are lifted here even where they are small, and dense arithmetic is faster."""
    monkeypatch.setattr(lcp_piles.linear.sparse_exact, "_FEW", 0)


def lifting_only(A, **words):
    """A solver without the fallback."""
    solver = ExactSolver(A, **words)
    solver._solve_dense = None
    return solver


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
    liar = Lying(LIES[lie])
    solver._lifting = replace(solver._lifting, factors=liar)
    kept, dense = solver._solve_dense, []
    solver._solve_dense = lambda rights: dense.extend(rights) or kept(rights)
    assert_solved(A, [[1] * 12, list(range(12))], solver)
    assert liar.asked
    assert len(dense) == 2  # nothing was left but the exact fallback


def test_a_sloppy_factorisation_is_good_enough():
    """Right to three digits: every step brings fewer bits, and the answer is exact still."""
    A = np.diag([5] * 12) + np.diag([2] * 11, 1)
    solver = lifting_only(A)
    unit = solver._lifting.units[0]
    sloppy = Lying(lambda b: np.linalg.solve(A, b / unit) * 1.001)
    solver._lifting = replace(solver._lifting, factors=sloppy)
    assert_solved(A.tolist(), [[1] * 12], solver)


@pytest.mark.parametrize(
    ("A", "b", "message"),
    [
        ([[1, 2]], [1], "square"),
        ([[0.5]], [1], r"entry of A is 0\.5, expected an integer"),
        (np.eye(1), [1], "float64', expected integers"),
        (csr_array(np.eye(1)), [1], "float64', expected integers"),
        ([[True]], [1], "True, expected an integer"),
        (np.eye(1, dtype=bool), [1], "bool', expected integers"),
        ([[1, 2], [3]], [1], r"lengths of the rows of A is \[2, 1\]"),
        ([1, 2], [1], "expected a matrix of integers"),
        (np.ones(2, dtype=int), [1], "expected a matrix of integers"),
        (5, [1], "A is 5, expected a matrix"),
        ("12", [1], "an entry of A is '1', expected an integer"),
        ([[1, 0], [0, 1]], [1], "length of b is 1, expected 2"),
    ],
)
def test_bad_input(A, b, message):
    with pytest.raises(InputError, match=message):
        ExactSolver(A).solve(b)
    assert issubclass(SingularError, LcpPilesError)


def test_no_unknowns():
    assert ExactSolver(csr_array((0, 0), dtype=np.int64)).solve([]) == ([], 1)


# --- entries of any size ---


def test_unsigned_entries_beyond_int64():
    """(2^63 + 1) x = 1 once came out as x = -1 / (2^63 - 1)."""
    A = np.array([[2**63 + 1]], dtype=np.uint64)
    for matrix in (A, csr_array(A), csc_array(A), coo_array(A), A.tolist(), fmpz_mat(A.tolist())):
        assert ExactSolver(matrix).solve([1]) == ([1], 2**63 + 1)
    small = csr_array(np.array([[2, 1], [0, 3]], dtype=np.uint64))
    assert ExactSolver(small).solve([1, 3]) == ([0, 1], 1)


@pytest.mark.parametrize("kind", [np.int8, np.int32, np.int64, np.uint64])
def test_duplicates_add_up_exactly(kind):
    """Eight times the largest entry of a dtype in one place."""
    largest = int(np.iinfo(kind).max)
    places = ([0] * 8 + [1], [0] * 8 + [1])
    A = coo_array((np.array([largest] * 8 + [1], dtype=kind), places), shape=(2, 2))
    numerators, den = ExactSolver(A).solve([8, 3])
    assert (numerators[0] * largest, numerators[1]) == (den, 3 * den)
    big = from_triplets((2, 2), *places, [largest] * 8 + [1])
    assert ExactSolver(big).solve([8, 3]) == (numerators, den)


@pytest.mark.parametrize("entry", [2**62, -(2**62)])
def test_integers_of_two_to_the_62_are_big_ones(entry):
    """Below that a bit of int64 is left for sums."""
    for big, kind in ((entry, BigMatrix), (entry - np.sign(entry).item(), csr_array)):
        matrix = from_triplets((1, 1), [0], [0], [big])
        assert isinstance(matrix, kind)
        assert [int(x) for x in matrix.data] == [big]


def test_triplets_that_cancel_leave_nothing():
    A = from_triplets((2, 2), [0, 1, 0, 0], [0, 1, 1, 1], [1, 1, 10**30, -(10**30)])
    assert A.toarray().tolist() == [[1, 0], [0, 1]]


@given(
    st.lists(st.lists(st.integers(-(10**40), 10**40), min_size=3, max_size=3), max_size=3),
    st.lists(st.integers(-(10**40), 10**40), min_size=3, max_size=3),
)
def test_products_in_integers_of_any_size(rows, vector):
    A = integer_matrix(np.array(rows, dtype=object).reshape(-1, 3))
    assert times(A, [fmpz(x) for x in vector]) == [
        sum(a * x for a, x in zip(row, vector, strict=True)) for row in rows
    ]
    assert dense(A) == fmpz_mat(len(rows), 3, [x for row in rows for x in row])


def spring_network(n, denominator, compliance=1):
    """[[0, B^T], [B, -C]] of n freedoms and 2 n contacts with normals over large denominators.

    C_k is the square of the denominator of row k, as the rational gauge has it.
    """
    random = Random(n)
    rows, columns, values = [], [], []
    for k in range(2 * n):
        ends = random.sample(range(n), 2) if k >= n else [k, (k + 1) % n]
        for j in ends:
            value = random.randrange(1, denominator) * random.choice((-1, 1))
            rows += [n + k, j]
            columns += [j, n + k]
            values += [value, value]
        rows.append(n + k)
        columns.append(n + k)
        values.append(-compliance * (denominator - random.randrange(9)) ** 2)
    return from_triplets((3 * n, 3 * n), rows, columns, values)


@pytest.mark.parametrize(
    ("n", "denominator", "compliance"),
    [(20, 10**6, 1), (20, 10**15, 1), (20, 10**40, 1), (20, 10**15, 10**100), (100, 10**15, 1)],
)
def test_networks_with_normals_of_long_denominators(n, denominator, compliance):
    """Lifting alone, in limbs and with shifted columns, proved by the exact product."""
    A = spring_network(n, denominator, compliance)
    assert isinstance(A, BigMatrix) == (denominator > 10**6)
    b = [fmpz(k % 7 - 3) * denominator**2 for k in range(3 * n)]
    numerators, den = lifting_only(A).solve(b)
    assert den > 0
    assert times(A, numerators) == [den * x for x in b]


def test_columns_far_apart_need_their_shifts():
    """One forces' unit apart from one of displacements: the digits would not shrink unshifted."""
    A = spring_network(20, 10**15)
    shifts = column_shifts(A)
    assert shifts.min() == 0
    assert shifts.max() > 32
    assert column_shifts(integer_matrix([[5, 1], [1, 2**12]])).tolist() == [0, 0]
    solver = ExactSolver(A)
    solver._column_shifts = np.zeros_like(shifts)
    dense = []
    solver._solve_dense = lambda rights: dense.extend(rights) or rights
    solver.solve([1] * A.shape[0])
    assert len(dense) == 1


def test_a_solver_passes_to_another_process():
    """Its factors and whom it tells stay behind."""
    for A in ([[2, 1], [1, 3]], [[2**70, 1], [1, 3]]):
        solver = ExactSolver(A, symmetric=True, progress=lambda line: None)
        solution = solver.solve([1, 0])
        assert pickle.loads(pickle.dumps(solver)).solve([1, 0]) == solution


def test_an_approximation_leaves_an_exact_residual():
    """A x 2^k + r = b 2^k in integers, for short entries and for long ones."""
    for A in (
        [[5, 2, 0], [1, 7, 1], [0, 3, -9]],
        [[2**70 + 1, 2, 0], [1, 2**70, 1], [0, 3, 2**69]],
        [[3, 2**20, 0], [1, 2**21, 5], [0, 2**20, 7]],  # columns far apart, which are shifted
    ):
        b = [fmpz(10**20), fmpz(-3), fmpz(0)]
        near = ExactSolver(A).approximate(b, 3)
        steps = len(near.digits)
        assert steps == near.length + 3
        x = [
            sum(int(d[i]) << near.shift * (steps - 1 - k) for k, d in enumerate(near.digits))
            for i in range(3)
        ]
        right = [y << near.shift * (steps - near.length) for y in b]
        left = [sum(a * y for a, y in zip(row, x, strict=True)) for row in A]
        assert [y + r for y, r in zip(left, near.rest, strict=True)] == right
    with pytest.raises(SolveError, match="ill-conditioned"):
        ExactSolver([[1, 1], [1, 1]]).approximate([1, 1], 3)
    nothing = ExactSolver([]).approximate([], 3)
    assert nothing.rest == []
    assert [(d.shape, d.dtype) for d in nothing.digits] == [((0,), np.int64)]


def test_whoever_waits_is_told_every_two_seconds(monkeypatch):
    """By a clock that goes on by a second whenever it is read: after three steps of 32 bits."""
    clock = count()
    monkeypatch.setattr(lcp_piles.linear.sparse_exact, "perf_counter", lambda: next(clock))
    system, told = contact_system(tbs(8)), []
    held = held_set(system, np.ones(system.contacts, dtype=bool), told.append)
    held.state(system.gap, system.load)
    assert told[:2] == ["96 bits of the exact solution", "192 bits of the exact solution"]
