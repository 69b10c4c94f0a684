"""The parametric LCP: closed forms, a published one, direct solves at and between breakpoints."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from helpers import brute_force
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import InputError, SolveError, lemke, parametric_lcp
from lcp_piles.numbers.rational_matrix import rational_column, rational_matrix
from lcp_piles.pivoting.parametric_lcp import ParametricPiece, _is_certificate, _is_right
from lcp_piles.problems import murty

F = Fraction
small = st.integers(-3, 3)


def moved(q0, q1, t) -> list[Fraction]:
    return [x + t * y for x, y in zip(q0, q1, strict=True)]


def some_t(path) -> list[Fraction]:
    """The breakpoints, the last t, a t in the middle of each piece, and two far out."""
    found = []
    for piece in path.pieces:
        last = piece.first + 20 if piece.last is None else piece.last
        found += [piece.first, (2 * piece.first + last) / 3, last]
    return found


@st.composite
def problems(draw, definite):
    """M = L L^T (+ I) + a skew part, q0 >= 0 or any, q1."""
    n = draw(st.integers(1, 4))
    L = [[draw(small) for _ in range(2)] for _ in range(n)]
    M = [[F(sum(x * y for x, y in zip(a, b, strict=True))) for b in L] for a in L]
    for i in range(n):
        M[i][i] += definite
        for j in range(i):
            s = draw(small)
            M[i][j] += s
            M[j][i] -= s
    rates = st.fractions(-3, 3, max_denominator=3)
    return M, [draw(small) for _ in range(n)], [draw(rates) for _ in range(n)]


@given(problem=problems(definite=1))
@settings(max_examples=80, deadline=None)
def test_definite_ones_against_lemke_at_single_t(problem) -> None:
    """A definite M has one solution at every t, and a path without an end."""
    M, q0, q1 = problem
    path = parametric_lcp(M, q0, q1)
    assert path.end == "asymptotic"
    assert path.pieces[0].first == 0
    for before, after in zip(path.pieces, path.pieces[1:], strict=False):
        assert before.last == after.first
        assert before.rate != after.rate
    for t in some_t(path):
        assert path.z(t) == lemke(M, moved(q0, q1, t)).z


@given(problem=problems(definite=0))
@settings(max_examples=120, deadline=None)
def test_semidefinite_ones_end_where_solutions_do(problem) -> None:
    """Feasibility at single t by brute force over bases; never "turned" or "lost"."""
    M, q0, q1 = problem
    if not brute_force(M, q0):
        with pytest.raises(SolveError, match="at t = 0"):
            parametric_lcp(M, q0, q1)
        return
    path = parametric_lcp(M, q0, q1)
    assert path.end in ("asymptotic", "infeasible")
    for t in some_t(path):
        z, q = path.z(t), moved(q0, q1, t)
        w = [
            sum(m * x for m, x in zip(row, z, strict=True)) + b for row, b in zip(M, q, strict=True)
        ]
        assert all(x >= 0 <= y and x * y == 0 for x, y in zip(z, w, strict=True))
    if path.end == "infeasible":
        last, y = path.pieces[-1].last, path.certificate
        assert all(x >= 0 for x in y)
        for column in zip(*M, strict=True):
            assert sum(m * x for m, x in zip(column, y, strict=True)) <= 0
        for later in (F(1, 1000), 1, 1000):
            q = moved(q0, q1, last + later)
            assert sum(b * x for b, x in zip(q, y, strict=True)) < 0
            assert not brute_force(M, q)
    else:
        assert path.certificate is None


def test_one_spring() -> None:
    """z = max(0, t - 1)."""
    path = parametric_lcp([[1]], [1], [-1])
    assert (path.breakpoints, path.end) == ((1,), "asymptotic")
    assert [path.z(t) for t in (0, 1, "7/2")] == [(0,), (0,), (F(5, 2),)]
    first, second = path.pieces
    assert (first.rate, second.rate, second.last) == ((0,), (1,), None)


@pytest.mark.parametrize("n", [2, 5])
def test_murty_has_every_basis_on_its_path(n: int) -> None:
    """Murty (1978): from q + T e to q the path goes through all 2^n complementary bases."""
    case, T = murty(n), 2 ** (n + 1)
    path = parametric_lcp(case.M, [x + T for x in case.q], [-1] * n, until=T)
    assert (len(path.pieces), path.pivots, path.end) == (2**n, 2**n - 1, "reached")
    assert path.z(T) == case.z


def test_until_cuts_the_path() -> None:
    q0, q1 = [1], [-1]
    for until, breakpoints, last in (("1/2", (), F(1, 2)), (1, (), 1), (3, (1,), 3)):
        path = parametric_lcp([[1]], q0, q1, until=until)
        assert (path.breakpoints, path.end, path.pieces[-1].last) == (breakpoints, "reached", last)
    point = parametric_lcp([[1]], q0, q1, until=0)
    assert point.z(0) == (0,)
    with pytest.raises(InputError, match="from 0 to 0"):
        point.z("1/9")


def test_ends_without_a_way_on() -> None:
    """w = 1 - t with z in no row; at once; w = 1 - t - z, solved by z = 1 - t too; and a ray."""
    end = parametric_lcp([[0]], [1], [-1])
    assert (end.end, end.pieces[-1].last, end.certificate) == ("infeasible", 1, (1,))
    at_once = parametric_lcp([[0]], [0], [-1])
    assert (at_once.end, at_once.z(0)) == ("infeasible", (0,))
    turned = parametric_lcp([[-1]], [1], [-1])
    assert (turned.end, turned.pieces[-1].last, turned.certificate) == ("turned", 1, None)
    lost = parametric_lcp([[0, 0], [-2, 0]], [2, 0], [-2, 0])
    assert (lost.end, lost.pieces[-1].last, lost.certificate) == ("lost", 1, None)


def test_no_change_and_no_variables() -> None:
    assert parametric_lcp([[2]], [-1], [0]).z(10**9) == (F(1, 2),)
    assert parametric_lcp([], [], []).z(1) == ()


def test_the_checks_refuse_what_is_wrong() -> None:
    """z = max(0, t - 1) for w = z + 1 - t: pieces too long, too steep, too early; points."""
    data = (rational_matrix([[1]], "M"), rational_column([1], "q0"), rational_column([-1], "q1"))
    good = ParametricPiece(F(1), None, (F(0),), (F(1),))
    assert _is_right(*data, good)
    still = ParametricPiece(F(0), F(1), (F(0),), (F(0),))
    assert _is_right(*data, still)
    for wrong in (
        replace(good, rate=(F(2),)),
        replace(good, start=(F(1),)),
        replace(good, first=F(0)),
        replace(still, last=F(2)),
        replace(still, last=None),
        replace(still, last=F(0), start=(F(1),)),
        replace(still, rate=(F(-1),)),
    ):
        assert not _is_right(*data, wrong)
    M, q = rational_matrix([[0, -1], [1, 0]], "M"), rational_column([0, 0], "q")
    falls = rational_column([-1, 0], "q1")
    assert _is_certificate(M, q, falls, rational_column([1, 0], "y"))
    assert not _is_certificate(M, q, falls, rational_column([1, 1], "y"))  # M^T y > 0
    assert not _is_certificate(M, q, falls, rational_column([0, 0], "y"))
    assert not _is_certificate(M, q, falls * -1, rational_column([-1, 0], "y"))
    assert not _is_certificate(M, falls * -1, falls, rational_column([1, 0], "y"))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"q1": [1, 2]}, "length of q1 is 2, expected 1"),
        ({"q0": [0.5]}, "floats_exactly"),
        ({"M": [[1, 2]]}, "M"),
        ({"until": -1}, "until is -1"),
        ({"until": 0.5}, "floats_exactly"),
    ],
)
def test_errors_say_what_is_wrong(given, message) -> None:
    with pytest.raises(InputError, match=message):
        parametric_lcp(**{"M": [[1]], "q0": [1], "q1": [1], **given})
