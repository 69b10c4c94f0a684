"""Mixed LCPs: in plain Fractions, against brute force, with regular and singular free blocks."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq_mat
from helpers import fmpq_of, subsets
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import InputError, SolveError, lcp, lemke, mixed_lcp
from lcp_piles.bases.mixed_lcp import _by_pivots, _is_certificate, _is_solution
from lcp_piles.numbers.rational_matrix import rational_column


def times(M, z):
    return [sum((Fraction(m) * x for m, x in zip(row, z, strict=True)), Fraction(0)) for row in M]


def assert_proved(M, q, free, result) -> None:
    """The solution, or the certificate, in plain Fractions."""
    bound = set(range(len(q))) - set(free)
    if result.status == "solved":
        w = [x + b for x, b in zip(times(M, result.z), q, strict=True)]
        assert list(result.w) == w
        assert all(w[i] == 0 for i in free)
        assert all(w[i] >= 0 <= result.z[i] and w[i] * result.z[i] == 0 for i in bound)
        assert result.certificate is None
        return
    assert result.status == "infeasible"
    y = result.certificate
    slopes = times(list(zip(*M, strict=True)), y)
    assert all(slopes[i] == 0 for i in free)
    assert all(slopes[i] <= 0 <= y[i] for i in bound)
    assert sum(x * b for x, b in zip(y, q, strict=True)) < 0
    assert result.z == result.w == ()


def solvable(M, q, free) -> bool:
    """Whether any basis with a regular block solves it, the free variables in all of them."""
    n = len(q)
    bound = [i for i in range(n) if i not in free]
    for chosen in subsets(len(bound)):
        basic = sorted([*free, *(bound[k] for k in chosen)])
        size = len(basic)
        block = fmpq_mat(size, size, [fmpq_of(M[i][j]) for i in basic for j in basic])
        if size and block.det() == 0:
            continue
        z = [Fraction(0)] * n
        if size:
            right = fmpq_mat(size, 1, [-fmpq_of(q[i]) for i in basic])
            for i, x in zip(basic, block.solve(right).entries(), strict=True):
                z[i] = Fraction(int(x.p), int(x.q))
        w = [x + b for x, b in zip(times(M, z), q, strict=True)]
        if all(z[i] >= 0 <= w[i] for i in bound):
            return True
    return False


@st.composite
def semidefinite(draw):
    """M = L L^T + S with S skew, of any rank, q, and which are free."""
    n = draw(st.integers(1, 5))
    small = st.integers(-3, 3)
    L = [[draw(small) for _ in range(draw(st.integers(0, n)))] for _ in range(n)]
    M = [[sum(x * y for x, y in zip(a, b, strict=False)) for b in L] for a in L]
    for i in range(n):
        for j in range(i):
            s = draw(small)
            M[i][j] += s
            M[j][i] -= s
    return M, [draw(small) for _ in range(n)], draw(st.sets(st.integers(0, n - 1)))


@given(problem=semidefinite())
@settings(max_examples=150, deadline=None)
def test_every_semidefinite_problem_comes_to_a_proved_end(problem) -> None:
    M, q, free = problem
    result = mixed_lcp(M, q, free)
    assert_proved(M, q, free, result)
    if solvable(M, q, free):
        assert result.status == "solved"


@given(problem=semidefinite())
@settings(max_examples=150, deadline=None)
def test_pivots_come_to_a_proved_end_too(problem) -> None:
    """Lemke's method, which has the word where no proposal is right; of thirds."""
    whole, q, free = problem
    M = [[Fraction(x, 3) for x in row] for row in whole]
    signs = sorted(free)
    result = _by_pivots(lcp(M, q), rational_column(q, "q"), signs, None)
    assert_proved(M, q, signs, result)
    if solvable(M, q, signs):
        assert result.status == "solved"


def test_without_free_variables_it_is_an_lcp() -> None:
    M, q = [[2, 1], [1, 2]], [-5, -6]
    assert mixed_lcp(M, q, []).z == lemke(M, q).z


def test_all_variables_free_is_a_linear_system() -> None:
    """By Cramer; a singular one has solutions or none."""
    assert mixed_lcp([[1, 2], [3, 4]], [-5, -6], [0, 1]).z == (-4, Fraction(9, 2))
    singular = [[1, 1], [1, 1]]
    assert sum(mixed_lcp(singular, [-3, -3], [0, 1]).z) == 3
    no = mixed_lcp(singular, [-3, -4], [1, 0])
    assert_proved(singular, [-3, -4], [0, 1], no)
    assert no.status == "infeasible"
    assert mixed_lcp([], [], []).z == ()


def test_a_ray_that_proves_nothing_is_an_error() -> None:
    """w = (z_2 - 2, z_2 - 1) needs z_2 >= 2, where w_2 > 0 < z_2: feasible, and no solution."""
    with pytest.raises(SolveError, match="ray that proves nothing"):
        mixed_lcp([[1, 0, 0], [0, 0, 1], [0, 0, 1]], [0, -2, -1], [0])


def test_a_game_is_solved_where_the_covering_vector_of_ones_ends_on_a_ray() -> None:
    """A game with costs, which has an equilibrium, and a free variable beside it."""
    costs, others = [[1, 2], [3, 1]], [[2, 1], [1, 3]]
    M = [[1, 0, 0, 0, 0]]
    M += [[0, 0, 0, *row] for row in costs]
    M += [[0, *column, 0, 0] for column in zip(*others, strict=True)]
    assert lemke([row[1:] for row in M[1:]], [-1] * 4).status == "ray"
    found = mixed_lcp(M, [0, -1, -1, -1, -1], [0])
    assert_proved(M, [0, -1, -1, -1, -1], [0], found)
    assert found.status == "solved"


@pytest.mark.parametrize(
    ("M", "q", "free", "message"),
    [
        ([[1, 2]], [1, 2], [], "length of row 0 of M"),
        ([[1]], [1, 2], [], "length of q"),
        ([[1]], [0.5], [], "floats_exactly"),
        ([[1]], [1], [1], "from 0 to 0"),
        ([[1]], [1], [-1], "from 0 to 0"),
        ([[1, 0], [0, 1]], [1, 1], [True], "from 0 to 1"),
        ([[1]], [1], ["0"], "free"),
        ([[1]], [1], 0, "free is 0"),
    ],
)
def test_errors_say_what_is_wrong(M, q, free, message) -> None:
    with pytest.raises(InputError, match=message):
        mixed_lcp(M, q, free)


def test_the_checks_refuse_what_proves_nothing() -> None:
    """Each condition by itself, one entry wrong at a time."""

    def column(*entries):
        return fmpq_mat(len(entries), 1, list(entries))

    good = (column(-5, 0, 2), column(0, 3, 0))
    assert _is_solution(*good, [0])
    for z, w in (
        (column(-5, 0, 2), column(1, 3, 0)),  # an equation
        (column(-5, 0, -2), column(0, 3, 0)),
        (column(-5, 0, 2), column(0, -3, 0)),
        (column(-5, 1, 2), column(0, 3, 0)),
    ):
        assert not _is_solution(z, w, [0])
    M, q = fmpq_mat(2, 2, [0, 1, 0, -1]), column(-1, 0)
    assert _is_certificate(M, q, column(1, 1), [0])
    assert _is_certificate(M, q, column(1, 1), [1])
    assert not _is_certificate(M, q, column(1, 0), [])  # M^T y > 0
    assert not _is_certificate(M, q, column(1, 2), [1])  # an equation
    assert not _is_certificate(M, q, column(0, 0), [])  # q . y = 0
    assert not _is_certificate(M, column(1, -1), column(-1, 0), [1])  # y < 0
