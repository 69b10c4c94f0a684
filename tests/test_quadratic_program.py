"""Quadratic programmes: published ones, closed forms, brute force; proofs in plain Fractions."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq_mat
from helpers import fmpq_of, subsets
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import InputError, NotConvexError, linear_program, quadratic_program
from lcp_piles.numbers.rational_matrix import rational_column
from lcp_piles.problems import quadratic_problems
from lcp_piles.programs.convexity import negative_direction
from lcp_piles.programs.quadratic_data import (
    Multipliers,
    is_farkas,
    is_optimal,
    is_ray,
    quadratic_data,
)

F = Fraction
PUBLISHED = [
    case()
    for name, case in vars(quadratic_problems).items()
    if name.startswith("hock_schittkowski")
]


def dot(one, two):
    return sum((F(x) * F(y) for x, y in zip(one, two, strict=True)), F(0))


def apply(M, x):
    return [dot(row, x) for row in M]


def assert_proved(result, P, c, A=(), b=(), G=(), h=(), lower=None, upper=None) -> None:
    """What the status claims, from the data in plain Fractions."""
    n = len(c)
    lower, upper = lower or [None] * n, upper or [None] * n

    def feasible(x) -> bool:
        inside = all(
            (low is None or s >= low) and (up is None or s <= up)
            for low, s, up in zip(lower, x, upper, strict=True)
        )
        below = all(s <= t for s, t in zip(apply(G, x), h, strict=True))
        return inside and below and apply(A, x) == list(b)

    def slope() -> list[Fraction]:
        return [
            dot([row[i] for row in A], result.y)
            + dot([row[i] for row in G], result.z)
            - result.lower[i]
            + result.upper[i]
            for i in range(n)
        ]

    def signed() -> None:
        assert all(m >= 0 for m in (*result.z, *result.lower, *result.upper))
        assert all(m == 0 for m, low in zip(result.lower, lower, strict=True) if low is None)
        assert all(m == 0 for m, up in zip(result.upper, upper, strict=True) if up is None)

    if result.status == "infeasible":
        signed()
        assert slope() == [0] * n
        sums = dot(result.y, b) + dot(result.z, h)
        sums -= dot(result.lower, [v or 0 for v in lower])
        sums += dot(result.upper, [v or 0 for v in upper])
        assert sums < 0
        assert result.x == result.ray == ()
        return
    x = result.x
    assert feasible(x)
    if result.status == "optimal":
        signed()
        assert [g + s for g, s in zip(slope(), apply(P, x), strict=True)] == [-v for v in c]
        assert result.value == dot(x, apply(P, x)) / 2 + dot(c, x)
        for m, s, t in zip(result.z, apply(G, x), h, strict=True):
            assert m * (t - s) == 0
        for i in range(n):
            assert result.lower[i] == 0 or x[i] == lower[i]
            assert result.upper[i] == 0 or x[i] == upper[i]
        assert result.ray == ()
        return
    assert result.status == "unbounded"
    d = result.ray
    assert apply(P, d) == [0] * n
    assert apply(A, d) == [0] * len(b)
    assert all(s <= 0 for s in apply(G, d))
    assert all(s >= 0 for s, low in zip(d, lower, strict=True) if low is not None)
    assert all(s <= 0 for s, up in zip(d, upper, strict=True) if up is not None)
    assert dot(c, d) < 0


@pytest.mark.parametrize("case", PUBLISHED, ids=lambda case: case.name)
def test_published_programmes(case) -> None:
    """Their solutions as printed, which are unique."""
    bounds = {"lower": case.lower, "upper": case.upper}
    result = quadratic_program(case.P, case.c, G=case.G, h=case.h, **bounds)
    assert_proved(result, case.P, case.c, G=case.G, h=case.h, **bounds)
    assert result.x == case.x
    assert result.value + case.constant == case.value


@given(st.lists(st.fractions(-5, 5, max_denominator=9), min_size=1, max_size=8))
@settings(max_examples=30, deadline=None)
def test_projection_onto_the_simplex(p) -> None:
    """The nearest point is max(p - t, 0), with t from the sorted entries."""
    n = len(p)
    order = sorted(p, reverse=True)
    t = max((sum(order[:k]) - 1) / k for k in range(1, n + 1))
    P = [[int(i == j) for j in range(n)] for i in range(n)]
    result = quadratic_program(P, [-x for x in p], [[1] * n], [1], lower=[0] * n)
    assert list(result.x) == [max(x - t, F(0)) for x in p]


def test_least_norm_on_dependent_equations() -> None:
    """x = a b / |a|^2; the same row stands there three times."""
    P = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    A, b = [[1, 2, 2], [2, 4, 4], [-1, -2, -2]], [9, 18, -9]
    result = quadratic_program(P, [0, 0, 0], A, b)
    assert result.x == (1, 2, 2)
    assert_proved(result, P, [0, 0, 0], A, b)


def test_equal_bounds_fix_a_variable_and_crossed_ones_are_infeasible() -> None:
    P, c = [[2, 0], [0, 2]], [0, -4]
    fixed = quadratic_program(P, c, lower=[3, 1], upper=[3, None])
    assert fixed.x == (3, 2)
    crossed = quadratic_program(P, c, lower=[3, None], upper=[2, None])
    assert crossed.status == "infeasible"
    assert_proved(crossed, P, c, lower=[3, None], upper=[2, None])


def test_ends_without_a_solution() -> None:
    """A trough that falls along (1, -1): without end, up to a bound, and with rows at odds."""
    P, c = [[1, 1], [1, 1]], [-1, 0]
    free = quadratic_program(P, c)
    assert free.status == "unbounded"
    assert free.ray[0] == -free.ray[1] > 0
    assert quadratic_program(P, c, upper=[5, None]).x == (5, -5)
    neither = quadratic_program(P, c, [[1, 1], [1, 1]], [0, 1])
    assert neither.status == "infeasible"
    assert_proved(neither, P, c, [[1, 1], [1, 1]], [0, 1])
    assert quadratic_program([], []).x == ()


small = st.integers(-3, 3)


@st.composite
def programmes(draw):
    """Any convex programme of up to four variables, degenerate, empty and unbounded ones too."""
    n = draw(st.integers(1, 4))
    L = [[draw(small) for _ in range(n)] for _ in range(draw(st.integers(0, n)))]
    P = [[sum(row[i] * row[j] for row in L) for j in range(n)] for i in range(n)]
    line = st.lists(small, min_size=n, max_size=n)
    A, G = draw(st.lists(line, max_size=2)), draw(st.lists(line, max_size=3))
    bound = st.lists(st.none() | small, min_size=n, max_size=n)
    return {
        "P": P,
        "c": draw(line),
        "A": A,
        "b": [draw(small) for _ in A],
        "G": G,
        "h": [draw(small) for _ in G],
        "lower": draw(bound),
        "upper": draw(bound),
    }


@given(data=programmes())
@settings(max_examples=200, deadline=None)
def test_every_end_is_proved(data) -> None:
    assert_proved(quadratic_program(**data), **data)


@given(data=programmes())
@settings(max_examples=60, deadline=None)
def test_definite_ones_by_brute_force(data) -> None:
    """With P + I, the least value over all points that are stationary on some rows held tight."""
    n = len(data["c"])
    data["P"] = [[x + (i == j) for j, x in enumerate(row)] for i, row in enumerate(data["P"])]
    rows = [(row, t) for row, t in zip(data["G"], data["h"], strict=True)]
    for i in range(n):
        unit = [int(i == j) for j in range(n)]
        if data["lower"][i] is not None:
            rows.append(([-x for x in unit], -data["lower"][i]))
        if data["upper"][i] is not None:
            rows.append((unit, data["upper"][i]))
    equations = list(zip(data["A"], data["b"], strict=True))
    values = []
    for chosen in subsets(len(rows)):
        held = equations + [rows[k] for k in chosen]
        if len(held) > n + len(equations):
            continue
        x = stationary(data["P"], data["c"], held)
        if x is not None and all(dot(row, x) <= t for row, t in rows):
            values.append(dot(x, apply(data["P"], x)) / 2 + dot(data["c"], x))
    result = quadratic_program(**data)
    if values:
        assert result.value == min(values)
    elif not equations:  # dependent equations are beyond this brute force
        assert result.status == "infeasible"


def stationary(P, c, held):
    """The stationary point on these equations; None where they depend on each other."""
    n, m = len(c), len(held)
    table = [[*P[i], *(row[i] for row, _ in held)] for i in range(n)]
    table += [[*row, *[0] * m] for row, _ in held]
    matrix = fmpq_mat(n + m, n + m, [fmpq_of(x) for row in table for x in row])
    if matrix.det() == 0:
        return None
    right = fmpq_mat(n + m, 1, [*(fmpq_of(-x) for x in c), *(fmpq_of(t) for _, t in held)])
    return [F(int(x.p), int(x.q)) for x in matrix.solve(right).entries()[:n]]


def test_without_a_quadratic_term_it_is_a_linear_programme() -> None:
    """Against the simplex method."""
    A, b, c = [[1, 2, 1, 0], [3, 1, 0, 1]], [7, 8], [-2, -3, 0, 0]
    zero = [[0] * 4 for _ in range(4)]
    assert quadratic_program(zero, c, A, b, lower=[0] * 4).value == linear_program(c, A, b).value


@given(st.lists(st.lists(small, min_size=4, max_size=4), min_size=4, max_size=4), st.booleans())
@settings(max_examples=100, deadline=None)
def test_convexity_is_decided_by_principal_minors(rows, square) -> None:
    """Semidefinite exactly if no principal minor is negative; else the witness is one."""
    P = [[rows[i][j] + rows[j][i] for j in range(4)] for i in range(4)]
    if square:
        P = [[dot(rows[i][:2], rows[j][:2]) for j in range(4)] for i in range(4)]
    convex = all(
        fmpq_mat(len(s), len(s), [fmpq_of(P[i][j]) for i in s for j in s]).det() >= 0
        for s in subsets(4)
        if s
    )
    d = negative_direction(fmpq_mat(4, 4, [fmpq_of(x) for row in P for x in row]))
    assert (d is None) == convex
    if d is not None:
        plain = [F(int(x.p), int(x.q)) for x in d.entries()]
        assert dot(plain, apply(P, plain)) < 0
        with pytest.raises(NotConvexError) as caught:
            quadratic_program(P, [0] * 4)
        assert list(caught.value.direction) == plain


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"P": [[1, 2], [0, 1]]}, "symmetric matrix of size 2"),
        ({"P": [[1]]}, "columns of P is 1, expected 2"),
        ({"A": [[1, 1]]}, "b is None"),
        ({"b": [1]}, "A is None"),
        ({"G": [[1, 1]], "h": [1, 2]}, "length of h is 2, expected 1"),
        ({"G": [[1]], "h": [1]}, "columns of G"),
        ({"lower": [0]}, "length of lower"),
        ({"upper": 3}, "upper is 3"),
        ({"upper": [0.5, 1]}, "floats_exactly"),
        ({"c": [0.5, 1]}, "floats_exactly"),
    ],
)
def test_errors_say_what_is_wrong(given, message) -> None:
    data = {"P": [[1, 0], [0, 1]], "c": [0, 0], **given}
    with pytest.raises(InputError, match=message):
        quadratic_program(**data)


def test_the_checks_refuse_what_is_changed() -> None:
    """Any entry of a proof that is moved by 1/7 makes it none, up or down."""

    def moved(column):
        for i in range(column.nrows()):
            for step in (fmpq_of(F(1, 7)), fmpq_of(F(-1, 7))):
                other = fmpq_mat(column)
                other[i, 0] += step
                yield other

    def columns(result):
        return {
            name: rational_column(getattr(result, name), name)
            for name in ("y", "z", "lower", "upper")
        }

    case = {"P": [[2, 0], [0, 0]], "c": [-2, 1], "A": [[1, 1]], "b": [2]}
    sides = {"G": [[1, 0]], "h": ["1/2"], "lower": [0, 0], "upper": [3, 5]}
    data = quadratic_data(**case, **sides)
    result = quadratic_program(**case, **sides)
    x, parts = rational_column(result.x, "x"), columns(result)
    assert is_optimal(data, x, Multipliers(**parts))
    assert not any(is_optimal(data, other, Multipliers(**parts)) for other in moved(x))
    for name, part in parts.items():
        for other in moved(part):
            assert not is_optimal(data, x, Multipliers(**{**parts, name: other}))
    # The same, with the multipliers of both bounds raised alike: the slope stays.
    both = {name: parts[name] + fmpq_mat(2, 1, [1, 1]) for name in ("lower", "upper")}
    assert not is_optimal(data, x, Multipliers(**{**parts, **both}))

    sides["upper"] = [1, 0]
    empty, result = quadratic_data(**case, **sides), quadratic_program(**case, **sides)
    parts = columns(result)
    assert is_farkas(empty, Multipliers(**parts))
    for name, part in parts.items():
        for other in moved(part):
            assert not is_farkas(empty, Multipliers(**{**parts, name: other}))
    assert not is_farkas(empty, Multipliers(**{name: part * 0 for name, part in parts.items()}))
    negative = Multipliers(**{name: part * -1 for name, part in parts.items()})
    assert not is_farkas(empty, negative)

    falling = quadratic_data([[1, 1], [1, 1]], [-1, 0], None, None, None, None, None, [None, 0])
    assert is_ray(falling, fmpq_mat(2, 1, [1, -1]))
    for d in ([-1, 1], [1, 0], [0, 0]):
        assert not is_ray(falling, fmpq_mat(2, 1, d))
