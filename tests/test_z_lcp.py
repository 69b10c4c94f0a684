"""The Z iteration on LCPs: published cycles, singular systems, and the definition step by step."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq, fmpq_mat
from helpers import (
    affine,
    assert_solves,
    brute_force,
    fmpq_of,
)
from hypothesis import given
from hypothesis import strategies as st

from lcp_piles import InputError, lcp, lemke, surd, z_lcp
from lcp_piles.problems import LCPCase, gilbert, grain, newton_min_definite


def sets(trace: tuple) -> list[tuple[int, ...]]:
    return [step.Z for step in trace]


def test_definite_lcp_cycles_as_published() -> None:
    case = newton_min_definite()
    result = z_lcp(case.M, case.q, start=[0])
    assert result.status == "cycle"
    assert sets(result.trace) == [(0,), (1,), (0, 1, 2), (0,)]
    assert result.cycle == ((0,), (1,), (0, 1, 2))
    assert result.z == ()


def test_a_problem_made_before_gives_the_same() -> None:
    case = gilbert()
    one, other = z_lcp(lcp(case.M, case.q), start=[0]), z_lcp(case.M, case.q, start=[0])
    assert (one.status, one.cycle, sets(one.trace)) == (
        other.status,
        other.cycle,
        sets(other.trace),
    )
    with pytest.raises(InputError, match="q is None"):
        z_lcp(case.M)


def test_gilbert_cycles_as_published() -> None:
    case = gilbert()
    result = z_lcp(case.M, case.q, start=[0])
    assert result.status == "cycle"
    assert sets(result.trace) == [(0,), (1,), (2,), (0,)]


def test_grain_lcp_cycles_as_published() -> None:
    # z are the forces here, so Z is the closed set.
    case = grain()
    result = z_lcp(case.M, case.q, start=[0, 1, 2])
    assert result.status == "cycle"
    assert sets(result.trace) == [(0, 1, 2), (0, 2), (), (1, 2), (0, 2)]


@pytest.mark.parametrize(
    "case", [newton_min_definite(), gilbert(), grain()], ids=lambda case: case.name
)
def test_lemke_solves_what_cycles(case: LCPCase) -> None:
    M, q, z = case.M, case.q, case.z
    result = lemke(M, q)
    assert_solves(M, q, result)
    assert result.z == z
    # From the solution's own set the Z iteration stays there.
    started = z_lcp(M, q, start=[i for i, x in enumerate(z) if x])
    assert (started.status, started.z, len(started.trace)) == ("solved", z, 1)


def test_lcp_given_as_a_value_and_with_roots() -> None:
    M, q = [[2, 1], [1, 2]], ["-sqrt(3)", "1 - sqrt(3)"]
    result = z_lcp(M, q)
    (expected,) = brute_force([[Fraction(x) for x in row] for row in M], q)
    assert result.status == "solved"
    assert [surd(x) for x in result.z] == expected[0]
    assert [surd(x) for x in result.w] == expected[1]


def test_singular_but_solvable_system_is_counted() -> None:
    # w = 0 z + 0 with z basic: every z solves it, the one taken is zero, so the index leaves.
    result = z_lcp([[0]], [0], start=[0])
    assert [(s.Z, s.rank, s.nullity, s.returned) for s in result.trace] == [
        ((0,), 0, 1, (0,)),
        ((), 0, 0, ()),
    ]
    assert result.trace[0].singular
    assert result.status == "solved"


def test_system_without_solution_puts_back() -> None:
    result = z_lcp([[0]], [1], start=[0])
    assert (result.status, result.trace[0].reintroduced) == ("solved", (0,))
    # An LCP that has no solution: the index leaves and is put back for ever.
    result = z_lcp([[0]], [-1])
    assert (result.status, result.cycle) == ("cycle", ((),))
    assert result.trace[-1].reintroduced == (0,)


def test_closest_goes_back_first() -> None:
    # z_0 + z_1 cannot be both 3 and 1, so z_0 and z_1 cannot both be basic. From the empty set
    # w = (-3, -1, 5): both enter, and the one with |z - w| = 1 goes back.
    M = [[1, 1, 0], [1, 1, 0], [0, 0, 1]]
    result = z_lcp(M, [-3, -1, 5])
    assert result.trace[1].reintroduced == (1,)
    assert (result.status, result.z) == ("solved", (3, 0, 0))


entries = st.fractions(min_value=-4, max_value=4, max_denominator=3)


@st.composite
def problems(draw: st.DrawFn) -> tuple[list[list[Fraction]], list[Fraction], list[int]]:
    n = draw(st.integers(1, 4))
    M = [[draw(entries) for _ in range(n)] for _ in range(n)]
    q = [draw(entries) for _ in range(n)]
    return M, q, sorted(draw(st.sets(st.integers(0, n - 1))))


def newton_min(M: list, q: list, Z: frozenset[int]) -> tuple[frozenset[int], list, list] | None:
    """The next Z, and z and w, by the definition; None where M_ZZ is singular."""
    at = sorted(Z)
    z = [fmpq(0)] * len(q)
    if at:
        block = fmpq_mat(len(at), len(at), [fmpq_of(M[i][j]) for i in at for j in at])
        try:
            values = block.solve(fmpq_mat(len(at), 1, [-fmpq_of(q[i]) for i in at])).entries()
        except ZeroDivisionError:
            return None
        for i, x in zip(at, values, strict=True):
            z[i] = x
    w = [
        sum((fmpq_of(m) * x for m, x in zip(row, z, strict=True)), fmpq_of(y))
        for row, y in zip(M, q, strict=True)
    ]
    following = {i for i in range(len(q)) if (z[i] > 0 if i in Z else w[i] < 0)}
    return frozenset(following), z, w


@given(problems())
def test_path_is_that_of_the_definition(problem: tuple) -> None:
    """As long as no principal block is singular, which is all that the definition covers."""
    M, q, start = problem
    result = z_lcp(M, q, start)
    Z, path = frozenset(start), []
    while Z not in path:
        path.append(Z)
        step = newton_min(M, q, Z)
        if step is None:
            assert [frozenset(s) for s in sets(result.trace)][: len(path) - 1] == path[:-1]
            return
        following, z, w = step
        if following == Z:
            assert result.status == "solved"
            assert [surd(x) for x in result.z] == [surd(x) for x in z]
            assert [surd(x) for x in result.w] == [surd(x) for x in w]
            assert sets(result.trace) == [tuple(sorted(s)) for s in path]
            assert_solves_lcp(M, q, result.z)
            return
        Z = following
    assert result.status == "cycle"
    assert sets(result.trace) == [tuple(sorted(s)) for s in [*path, Z]]
    assert set(result.cycle) == {tuple(sorted(s)) for s in path[path.index(Z) :]}


def assert_solves_lcp(M: list, q: list, z: tuple) -> None:
    w = affine(M, z, q)
    assert all(x >= 0 for x in (*w, *z))
    assert all(surd(x) * y == 0 for x, y in zip(z, w, strict=True))


@given(problems())
def test_every_end_is_what_it_says(problem: tuple) -> None:
    M, q, start = problem
    result = z_lcp(M, q, start)
    assert result.status in ("solved", "cycle")
    if result.status == "solved":
        assert_solves_lcp(M, q, result.z)
    else:
        # What repeats once repeats again: started in the cycle, it goes round the same way.
        again = z_lcp(M, q, result.cycle[0])
        assert (again.status, again.cycle) == ("cycle", result.cycle)


def test_limit() -> None:
    result = z_lcp(newton_min_definite().M, newton_min_definite().q, [0], limit=2)
    assert (result.status, len(result.trace), result.z) == ("limit", 2, ())


def test_refuses_an_index_outside() -> None:
    with pytest.raises(InputError, match="index of the start"):
        z_lcp(gilbert().M, gilbert().q, start=[3])
