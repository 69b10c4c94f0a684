"""LCPs by proposed bases: against brute force, closed forms, and whatever is proposed wrongly."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from flint import fmpq_mat
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
from scipy.sparse import csr_array

from benchmarks.lcp.random_problems import laplacian
from lcp_piles import (
    InputError,
    VerificationError,
    contact_lcp,
    contact_system,
    floats_exactly,
    lcp,
    lemke,
    nt60,
    solve_lcp,
    surd,
)
from lcp_piles.bases import solve_lcp as module
from lcp_piles.bases.dominance import dominating
from lcp_piles.bases.interior_point import interior_point
from lcp_piles.bases.matrix_class import matrix_class
from lcp_piles.bases.newton_min import newton_min
from lcp_piles.problems import degenerate as semidefinite_case
from lcp_piles.problems import fathi, gilbert, grain, kostreva, murty, newton_min_definite

SQUARES = st.integers(1, 4).flatmap(
    lambda n: st.lists(
        st.lists(st.integers(-3, 3), min_size=n + 1, max_size=n + 1), min_size=n, max_size=n
    )
)


def assert_right(M, q, result):
    """What the result claims holds, and for a semidefinite M nothing else than brute force says."""
    if result.status == "solved":
        assert_solves(M, q, result)
        return
    assert_ray(M, q, result)
    if result.status == "infeasible":
        assert_infeasible(M, q, result.certificate)


def minors(M):
    """The determinants of all principal submatrices."""
    n = len(M)
    for size in range(1, n + 1):
        for rows in combinations(range(n), size):
            yield fmpq_mat(size, size, [fmpq_of(M[i][j]) for i in rows for j in rows]).det()


def with_solution(M, seed):
    """q = w - M z of a drawn complementary pair, zeros in both, and z."""
    rng = np.random.default_rng(seed)
    kind = rng.integers(0, 3, M.shape[0])
    z = np.where(kind == 0, rng.integers(1, 99, M.shape[0]), 0)
    return np.where(kind == 1, rng.integers(1, 99, M.shape[0]), 0) - M @ z, z


@settings(max_examples=200)
@given(degenerate())
def test_degenerate_semidefinite_problems(problem):
    """w is unique, and where no basis solves there is a certificate: by brute force."""
    M, q = problem
    result, found = solve_lcp(M, q), brute_force(M, q)
    assert_right(M, q, result)
    assert result.success == bool(found)
    assert result.status in ("solved", "infeasible")
    assert all(w == [surd(x) for x in result.w] for _, w in found)


@settings(max_examples=150)
@given(SQUARES)
def test_any_matrix(rows):
    M, q = [row[:-1] for row in rows], [row[-1] for row in rows]
    result = solve_lcp(M, q)
    assert_right(M, q, result)
    if result.matrix.unique:
        assert len({tuple(z) for z, _ in brute_force(M, q)}) == 1
    if result.status == "ray" and result.matrix.name == "copositive":  # what `of_ray` says
        u = [int(x) for x in np.array(result.ray.dz) * 10**6]
        images = [sum(a * x for a, x in zip(row, result.ray.dz, strict=True)) for row in M]
        assert min(u) >= 0 <= min(images)
        assert sum(x * y for x, y in zip(result.ray.dz, images, strict=True)) == 0
        assert sum(x * y for x, y in zip(result.ray.dz, q, strict=True)) < 0


@settings(max_examples=150)
@given(SQUARES, st.booleans(), st.lists(st.integers(1, 5), min_size=4, max_size=4))
def test_classes_are_right(rows, symmetric, dens):
    """Against all principal minors and signs; rows over denominators of their own."""
    M = [[Fraction(x, d) for x in row[:-1]] for row, d in zip(rows, dens, strict=False)]
    if symmetric:
        M = [[M[i][j] + M[j][i] for j in range(len(M))] for i in range(len(M))]
    turned = zip(*M, strict=True)
    both = [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(M, turned, strict=True)]
    off = [x for i, row in enumerate(M) for j, x in enumerate(row) if i != j]
    on = [row[i] for i, row in enumerate(M)]
    true = {
        "positive definite": all(x > 0 for x in minors(both)),
        "P": all(x > 0 for x in minors(M)),
        "positive semidefinite": all(x >= 0 for x in minors(both)),
        "strictly copositive": min(off, default=0) >= 0 < min(on),
        "copositive": min(off + on) >= 0,
        "Z": max(off, default=0) <= 0,
        "unknown": True,
    }
    name = matrix_class(lcp(M, [0] * len(M))).name
    assert true[name]
    for sure in ("positive definite", "positive semidefinite", "copositive", "Z"):
        if true[sure]:
            assert name != "unknown"


@settings(max_examples=100)
@given(SQUARES, st.data())
def test_wrong_proposals_change_no_answer(rows, data):
    """Bases at random, singular ones among them, in the place of what floating point proposes."""
    M, q = [row[:-1] for row in rows], [row[-1] for row in rows]
    mask = st.lists(st.booleans(), min_size=len(q), max_size=len(q)).map(np.array)
    proposed = data.draw(st.lists(mask, max_size=3))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "proposals", lambda problem: iter(proposed))
        assert_right(M, q, solve_lcp(M, q))


def test_q_in_a_quadratic_field():
    M, q = [[2, 1], [1, 2]], ["-sqrt(3)", "sqrt(2) - 2"]
    result = solve_lcp(M, q)
    assert result.road == "proposed"
    assert_solves(M, [surd(x) for x in q], result)


@pytest.mark.parametrize(
    "case",
    [kostreva(), gilbert(), grain(), newton_min_definite(), murty(40), fathi(16)],
    ids=lambda c: c.name,
)
def test_published_problems(case):
    """Where Lemke's method takes 2^n pivots, or Newton's method cycles; all are P-matrices."""
    result = solve_lcp(case.M, case.q)
    assert (result.status, result.z, result.w) == ("solved", case.z, case.w)


@pytest.mark.parametrize("seed", range(5))
def test_ill_scaled_singular_problems_with_ties(seed):
    """Rank 4 of 12, scales from 10^-4 to 10^4, a third of all pairs zero: w is known."""
    case = semidefinite_case(seed, 12, 4, 4)
    result = solve_lcp(case.M, case.q)
    assert_solves(case.M, case.q, result)
    assert result.w == case.w


def test_an_osculatory_pair_stays_exact():
    """z_1 = w_1 = 0: M z + q of z = (0, 1)."""
    result = solve_lcp([[2, 1], [1, 3]], [-1, -3])
    assert (result.z, result.w) == ((0, 1), (0, 0))


def test_an_obstacle_on_a_grid():
    """An M-matrix, so that the solution which q was made from is the only one."""
    M = laplacian(17)
    q, z = with_solution(M, 0)
    result = solve_lcp(M, q)
    assert result.road == "proposed"
    assert result.z == tuple(z.tolist())
    assert result.matrix.unique


@pytest.mark.parametrize("kind", ["semidefinite", "P"])
def test_dense_problems(kind):
    rng = np.random.default_rng(5)
    M = rng.integers(-9, 10, (120, 120))
    if kind == "P":
        M[np.diag_indices(120)] = 1200
        M *= 10 ** rng.integers(0, 5, 120)  # columns of other sizes: no longer dominant as it is
    else:
        M = M[:, :70] @ M[:, :70].T
    q, z = with_solution(M, 1)
    result = solve_lcp(M, q)
    assert (result.status, result.road) == ("solved", "proposed")
    assert_solves(M.tolist(), q.tolist(), result)
    if kind == "P":
        assert result.matrix.name == "P"
        assert result.z == tuple(z.tolist())


def test_numbers_beyond_floats():
    big = 10**400
    result = solve_lcp([[big, 1], [1, big]], [-big, -1])
    assert_solves([[big, 1], [1, big]], [-big, -1], result)


def test_the_lcp_of_a_pile():
    """Columns by exact solves of the pile, no rows: w, the forces, is unique."""
    problem = contact_lcp(contact_system(nt60(4))).problem
    result = solve_lcp(problem)
    assert result.w == lemke(problem).w
    assert result.matrix.name == "unknown"


def test_the_interior_point_finds_a_vertex_where_newtons_method_has_a_singular_matrix():
    M, q, free = np.ones((3, 3)), -np.ones(3), np.zeros(3, dtype=bool)
    assert newton_min(M, q, free) is None
    assert int(interior_point(M, q, free).sum()) == 1


def test_dominance_is_found_by_scaling():
    """<A> d, in plain integers, is what is returned; a singular one has no such d."""
    A = csr_array(np.array([[1, -5, 0], [0, 1, 7], [0, 0, 1]]))
    d, c = dominating(A)
    right = [[1, -5, 0], [0, 1, -7], [0, 0, 1]]
    assert c == [sum(a * x for a, x in zip(row, d, strict=True)) for row in right]
    assert min(*d, *c) > 0
    assert dominating(csr_array(np.array([[1, -1], [-1, 1]]))) is None


def without_proposals(monkeypatch):
    monkeypatch.setattr(module, "proposals", lambda problem: iter(()))


@pytest.mark.parametrize(
    ("M", "said"),
    [
        ([[2, 1], [1, 2]], "exactly one solution, since M is positive definite"),
        ([[1, 3], [0, 1]], "exactly one solution, since M is a P-matrix"),
        ([[1, 1], [1, 1]], "a solution, or a proof of none"),
        ([[1, 5], [6, 1]], "There is a solution"),
        ([[0, 5], [6, 1]], "M is copositive"),
        ([[0, -5], [-6, 1]], "M is a Z-matrix"),
        ([[0, 5], [-6, -1]], "Nothing is known"),
    ],
)
def test_what_a_limit_means(M, said, monkeypatch):
    without_proposals(monkeypatch)
    result = solve_lcp(M, [-1, -1], max_pivots=0)
    assert result.status == "limit"
    assert said in result.meaning


def test_what_the_other_ends_mean():
    solved = solve_lcp([[1, 1], [1, 1]], [-1, -1])
    assert solved.meaning.endswith("there may be others.")
    none = solve_lcp([[0, 0], [0, 1]], [-1, 1])
    assert (none.status, none.success, none.z) == ("infeasible", False, ())
    assert "certificate" in none.meaning
    ray = solve_lcp([[0, 5], [-6, -1]], [-1, -1])
    assert (ray.status, ray.meaning) in [("infeasible", none.meaning), ("ray", ray.matrix.of_ray)]
    assert repr(solved) == ("<LCPSolution solved, proposed, proved, positive semidefinite matrix>")


def test_a_ray_that_cannot_be_is_no_answer(monkeypatch):
    """Lemke's method replaced by one that ends a definite problem on a ray."""
    without_proposals(monkeypatch)
    ray = lemke([[-1]], [-1])
    monkeypatch.setattr(module, "lemke", lambda problem, **_: lemke([[-1, 1], [0, -1]], [-1, -1]))
    assert ray.status in ("ray", "infeasible")
    monkeypatch.setattr(
        module, "lemke", lambda problem, **_: type(ray)("ray", None, None, 1, ray.ray)
    )
    with pytest.raises(VerificationError, match="positive definite"):
        solve_lcp([[1]], [-1])


def test_pivots_are_told(monkeypatch):
    without_proposals(monkeypatch)
    told = []
    assert solve_lcp([[2, 1], [1, 2]], [-5, -6], progress=told.append).road == "pivots"
    assert told == [1, 2, 3]


def test_nothing_to_do():
    assert solve_lcp([], []).success
    assert solve_lcp([[0, -1], [5, 0]], [0, 1]).z == (0, 0)
    assert solve_lcp([[0, 0], [0, 0]], [0, 1]).w == (0, 1)
    assert solve_lcp([[0, 0], [0, 0]], [0, -1]).status == "infeasible"


@pytest.mark.parametrize(
    ("M", "q", "words"),
    [
        ([[1, 2]], [1], "the length of row 0 of M is 2, expected 1"),
        ([[1, 2], [3, 4]], [1], "the length of q is 1, expected 2"),
        ([[1.5]], [1], r"floats_exactly\(1.5\)"),
        ([[1]], [0.5], r"floats_exactly\(0.5\)"),
        ([[float("nan")]], [1], "nan, expected an exact number"),
        (np.array([[1.5]]), [1], r"floats_exactly\(1.5\)"),
        ([["sqrt(2)"]], [1], "expected a rational number"),
        ("M", [1], "expected a square matrix"),
        ([[1]], None, "expected a vector of exact numbers"),
    ],
)
@pytest.mark.parametrize("door", [lemke, solve_lcp])
def test_bad_input(door, M, q, words):
    with pytest.raises(InputError, match=words):
        door(M, q)


@pytest.mark.parametrize("limit", [-1, 1.5, True, "many"])
@pytest.mark.parametrize("door", [lemke, solve_lcp])
def test_a_limit_that_is_none(door, limit):
    with pytest.raises(InputError, match=r"max_pivots is .* expected a whole number"):
        door([[1]], [-1], max_pivots=limit)


def test_q_beside_an_lcp():
    with pytest.raises(InputError, match="nothing beside an LCP"):
        solve_lcp(lcp([[1]], [-1]), [-1])


def test_floats_exactly():
    result = solve_lcp(floats_exactly(np.array([[0.5]])), floats_exactly([-0.75]))
    assert result.z == (Fraction(3, 2),)
