"""Pivots that floats with bounds decide are those of exact pivots, and the bounds are bounds.

The textbook tableau of fractions (`benchmarks.comparison.fraction_tableau`) shares nothing with
`lemke`: it is what pivots and solutions are compared with.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import fmpq_mat
from helpers import fmpq_of, piles
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.comparison.fraction_tableau import lemke_tableau
from lcp_piles import contact_lcp, contact_system, lcp, lemke, nt30, tss
from lcp_piles.errors import SolveError
from lcp_piles.mechanics.held_set import held_set, independent_rigid
from lcp_piles.mechanics.near_columns import near_columns
from lcp_piles.numbers.floats import Bounded
from lcp_piles.numbers.vectors import exact_vector
from lcp_piles.pivoting import path as path_module
from lcp_piles.pivoting.basic_solution import basic_z
from lcp_piles.pivoting.lemke import solved_table
from lcp_piles.pivoting.near_basis import NearColumns, first_to_leave, near_step
from lcp_piles.pivoting.path import lemke_path

Problem = tuple[list[list[Any]], list[Any]]


@st.composite
def problems(draw: st.DrawFn) -> Problem:
    """Any M of few different entries, so that ties, singular bases and rays are common."""
    n = draw(st.integers(1, 7))
    entry = st.sampled_from([-2, -1, 0, 0, 1, 1, 2, Fraction(1, 3)])
    M = draw(st.lists(st.lists(entry, min_size=n, max_size=n), min_size=n, max_size=n))
    if draw(st.booleans()):  # semidefinite, of a lower rank often
        A = np.array(M, dtype=object)[:, : draw(st.integers(1, n))]
        M = (A @ A.T).tolist()
    q = draw(st.lists(st.sampled_from([-3, -2, -1, -1, 0, 1]), min_size=n, max_size=n))
    return M, q


@st.composite
def smooth_problems(draw: st.DrawFn) -> Problem:
    """Problems without ties, of one to twelve unknowns, positive definite or not."""
    n = draw(st.integers(1, 12))
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    A = rng.integers(-1000, 1000, (n, n)).astype(object)
    M = A @ A.T + np.diag(rng.integers(1, 1000, n)).astype(object)
    if draw(st.booleans()):
        M = M + 200 * rng.integers(-1000, 1000, (n, n)).astype(object)
    return M.tolist(), rng.integers(-1000, 100, n).astype(object).tolist()


def assert_textbook(M: list[list[Any]], q: list[Any]) -> None:
    expected = lemke_tableau(M, q)
    result = lemke(M, q)
    assert result.success == (expected is not None)
    if expected is not None:
        z, pivots = expected
        assert (list(result.z), result.pivots) == (z, pivots)


@given(problems())
def test_pivots_and_ends_of_the_textbook_with_ties(problem: Problem) -> None:
    assert_textbook(*problem)


@given(problems(), st.data())
def test_pivots_and_ends_of_the_textbook_beside_ties(problem: Problem, data: st.DataObject) -> None:
    """What floats take for a tie, of z0 with others too, is none by 30 digits."""
    M, q = problem
    steps = data.draw(st.lists(st.integers(-3, 3), min_size=len(q), max_size=len(q)))
    assert_textbook(M, [x + Fraction(k, 10**30) for x, k in zip(q, steps, strict=True)])


@pytest.mark.parametrize("beside", [-1, 0, 1])
@pytest.mark.parametrize(
    "M", [[[2, 0], [1, 0]], [[2, 0], [1, -1]], [[2, 1, 0], [1, 2, 0], [1, 1, 1]]]
)
def test_z0_and_another_variable_that_floats_take_for_tied(M: list[list[int]], beside: int) -> None:
    """The last w, zero at the solution without z0, is 1e-30 from it: below, it leaves before z0."""
    q: list[Any] = [-sum(row[:-1]) for row in M]
    q[-1] += Fraction(beside, 10**30)
    assert_textbook(M, q)


@given(smooth_problems())
@settings(max_examples=40)
def test_pivots_and_ends_of_the_textbook_without_ties(problem: Problem) -> None:
    assert_textbook(*problem)


@given(problems() | smooth_problems())
@settings(max_examples=60)
def test_exact_pivots_alone_end_in_the_same(problem: Problem) -> None:
    """Rays and limits too: with and without the help of floats."""
    made = lcp(*problem)
    limit = lemke(made).pivots // 2
    with_floats = [lemke(made), lemke(made, max_pivots=limit)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(path_module, "first_to_leave", lambda *_: [])
        alone = [lemke(made), lemke(made, max_pivots=limit)]
    for one, other in zip(with_floats, alone, strict=True):
        assert (one.status, one.pivots, one.z, one.w) == (
            other.status,
            other.pivots,
            other.z,
            other.w,
        )
        assert (one.certificate is None) == (other.certificate is None)
        if one.ray and other.ray:
            assert (one.ray.z, one.ray.z0) == (other.ray.z, other.ray.z0)
            assert _directed(one.ray) == _directed(other.ray)


def _directed(ray: Any) -> list[Fraction]:
    """The direction of a ray, of any length, with entries that sum up to one."""
    parts = [*ray.dz, *ray.dw, ray.dz0]
    return [x / sum(parts) for x in parts]


@given(problems())
@settings(max_examples=60)
def test_the_table_at_the_end_pivots_on(problem: Problem) -> None:
    """Founded on the last basis, its values are the solution's and its directions those of M."""
    M, q = problem
    table = solved_table(lcp(M, q))
    if table is None:
        return
    n = len(q)
    z, w = (list(table.vector(*ends)) for ends in ((n, 2 * n), (0, n)))
    assert [
        sum((m * x for m, x in zip(row, z, strict=True)), c) for row, c in zip(M, q, strict=True)
    ] == w
    for entering in range(2 * n):
        if not table.is_basic[entering]:
            change = table.direction(entering)
            dz = [Fraction(int(change[v])) for v in range(n, 2 * n)]
            dw = [Fraction(int(change[v])) for v in range(n)]
            assert [sum(m * x for m, x in zip(row, dz, strict=True)) for row in M] == dw


# --- the bounds ---


@given(smooth_problems() | problems(), st.data())
@settings(max_examples=60)
def test_values_and_changes_are_within_their_bounds(problem: Problem, data: st.DataObject) -> None:
    """Of any complementary basis, the way of z0 among its columns, by fractions."""
    M, q = problem
    n = len(q)
    d = data.draw(st.lists(st.integers(1, 3), min_size=n, max_size=n))
    left = data.draw(st.lists(st.integers(0, n - 1), min_size=1, max_size=n, unique=True))
    active = [*(n + i for i in left[1:]), 2 * n]
    entering = left[0] if data.draw(st.booleans()) else n + left[0]
    unit = Fraction(1, 2 ** max(x.bit_length() for x in d))
    columns = {n + j: [row[j] for row in M] for j in range(n)} | {2 * n: [x * unit for x in d]}
    found = near_step(NearColumns(lcp(M, q), d), active, left, entering)
    G = fmpq_mat(
        len(left), len(left), [fmpq_of(Fraction(columns[v][i])) for i in left for v in active]
    )
    if G.det() == 0:
        assert found is None
        return
    if found is None:  # too near to singular
        return
    for bounded, start in zip(found, (q, columns.get(entering, [0] * n)), strict=True):
        right = [fmpq_of(Fraction(-start[i])) for i in left]
        if bounded is found[1] and entering < n:
            right[0] += 1
        x = [Fraction(int(y.p), int(y.q)) for y in G.solve(fmpq_mat(len(left), 1, right)).entries()]
        w = [
            start[i] + sum(columns[v][i] * y for v, y in zip(active, x, strict=True))
            for i in range(n)
        ]
        assert_within([*w, *x], bounded)


def assert_within(exact: list[Any], bounded: Bounded) -> None:
    parts = zip(exact, bounded.middle.tolist(), bounded.radius.tolist(), strict=True)
    assert all(abs(Fraction(x) - Fraction(m)) <= Fraction(r) for x, m, r in parts)


def test_bounds_are_narrow_and_decide() -> None:
    """A half of 124 contacts: floats decide all pivots but a tie of z0 at the end."""
    problem = contact_lcp(contact_system(nt30(8))).problem
    asked = []

    def counted(*words: Any) -> list[int]:
        asked.append(first_to_leave(*words))
        return asked[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(path_module, "first_to_leave", counted)
        found = lemke_path(problem, [1] * len(problem), stop_at_tie=True)
    assert found.pivots == len(asked) + 1 == 23
    assert [len(first) for first in asked[:-1]] == [1] * 21


def test_a_nearly_singular_matrix_is_left_to_exact_pivots() -> None:
    """A Hilbert matrix of 14 rows: no float inverse proves anything of its bases."""
    n = 14
    M = [[Fraction(1, i + j + 1) for j in range(n)] for i in range(n)]
    q = [Fraction((-1) ** i, i + 1) - Fraction(1, 2) for i in range(n)]
    assert_textbook(M, q)
    left = list(range(n))
    active = [*range(n, 2 * n - 1), 2 * n]
    assert near_step(NearColumns(lcp(M, q), [1] * n), active, left, 2 * n - 1) is None


@given(piles(), st.data())
@settings(max_examples=25, deadline=None)
def test_columns_of_contacts_are_within_their_bounds(scene: Any, data: st.DataObject) -> None:
    system = contact_system(scene)
    closed = np.ones(system.contacts, dtype=bool)
    if data.draw(st.booleans()):
        closed[data.draw(st.integers(0, system.contacts - 1))] = False
    try:
        held = held_set(system, independent_rigid(system, closed | system.bilateral))
        near = near_columns(held)
        wanted = list(range(system.contacts))
        exact = held.columns(wanted)
    except SolveError:
        return
    if near is None:
        return
    found = near.of(wanted)
    for k, (numbers, den) in enumerate(exact):
        column = [Fraction(int(x), int(den)) for x in numbers]
        assert_within(column, Bounded(found.middle[k], found.radius[k]))
        assert found.radius[k].max() < 1e-6 * max(1.0, np.abs(found.middle[k]).max())


@pytest.mark.parametrize("scene", [nt30(4), tss(6)], ids=["nt30", "tss"])
def test_the_z_of_a_basis_of_contacts_is_that_of_its_matrix(scene: Any) -> None:
    """One exact solve of the pile against the principal submatrix of the whole matrix."""
    problem = contact_lcp(contact_system(scene)).problem
    q = [x.rational() for x in problem.q]
    dense = lcp(problem.M, q)
    rng = np.random.default_rng(1)
    for _ in range(4):
        basis = rng.permutation(len(q))[:3].tolist()
        try:
            expected = list(basic_z(dense, basis))
        except SolveError:
            continue
        assert list(basic_z(problem, basis)) == expected
        w = problem.w(exact_vector(expected))
        assert not any(w[j] for j in basis)
