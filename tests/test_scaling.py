"""Exact Lemke on badly scaled data: the float filter may only ever save work.

With M_ij = A_ij 10^(a_i - b_j), q_i = q0_i 10^(a_i) and d_i = 10^(a_i) rows and variables have
other units and nothing else: the pivots, z_j 10^(-b_j) and w_i 10^(-a_i) are those of A, q0 and
d = 1.
"""

from fractions import Fraction
from random import Random
from types import SimpleNamespace

import numpy as np
import pytest
from flint import fmpz
from helpers import assert_ray, assert_solves
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import lcp, lemke, surd
from lcp_piles.errors import VerificationError
from lcp_piles.numbers.exact import sqrt_of
from lcp_piles.numbers.floats import Bounded
from lcp_piles.numbers.vectors import ExactVector, exact_vector
from lcp_piles.pivoting import path
from lcp_piles.pivoting.checks import checked_dw, checked_w, is_certificate
from lcp_piles.pivoting.columns import Columns
from lcp_piles.pivoting.lemke import solved_table
from lcp_piles.pivoting.tableau import Tableau

TEN = Fraction(10)


def scaled(A, q, a, b):
    M = [
        [x * TEN ** (r - c) for x, c in zip(row, b, strict=True)]
        for row, r in zip(A, a, strict=True)
    ]
    return M, [x * TEN**r for x, r in zip(q, a, strict=True)], [TEN**r for r in a]


def over(values, powers):
    return [x / TEN**k for x, k in zip(values, powers, strict=True)]


def assert_scaling_changes_nothing(A, q, a, b):
    M, right, d = scaled(A, q, a, b)
    plain, result = lemke(A, q), lemke(M, right, d)
    assert result.pivots == plain.pivots
    # The ray of one may be a certificate where that of the other is none: M is no longer symmetric
    # where rows and columns are scaled apart.
    assert (result.ray is None) == (plain.ray is None)
    assert result.success == plain.success
    if result.success:
        assert_solves(M, right, result)
        assert (over(result.z, b), over(result.w, a)) == (list(plain.z), list(plain.w))
        return
    assert_ray(M, right, result, d)
    assert (over(result.ray.z, b), result.ray.z0) == (list(plain.ray.z), plain.ray.z0)


BLOCKED = ([[4, -1, -1], [-1, 2, -1], [-1, -1, 4]], [-2, -1, 1])


def test_a_blocking_row_whose_weight_underflows():
    """This once came out "solved" with w_3 = -5.7e-51, for d = 1; A is a P-matrix: one solution."""
    A, q = BLOCKED
    a, b = [-100, 0, -50], [-250, 100, -150]
    assert_scaling_changes_nothing(A, q, a, b)
    M, right, _ = scaled(A, q, a, b)
    result = lemke(M, right)
    assert_solves(M, right, result)
    assert over(result.z, b) == list(lemke(A, q).z)


def test_a_solution_behind_an_underflow_is_no_ray():
    """This once ended on a ray that is none."""
    assert_scaling_changes_nothing([[-2, 1], [-3, 1]], [-3, 2], [200, 100], [-200, 100])


def problems(power):
    entry, powers = st.integers(-4, 4), st.integers(-power, power)
    return st.integers(1, 4).flatmap(
        lambda n: st.tuples(
            st.lists(st.lists(entry, min_size=n, max_size=n), min_size=n, max_size=n),
            *(st.lists(x, min_size=n, max_size=n) for x in (entry, powers, powers)),
        )
    )


@settings(max_examples=300)
@given(problems(300))
def test_two_sided_scaling_changes_neither_status_nor_answer(problem):
    assert_scaling_changes_nothing(*problem)


@settings(max_examples=100)
@given(problems(300))
def test_the_table_to_go_on_from_is_scaled_alike(problem):
    """With d = 1 the pivots may be others, but for the symmetric A A^T + 1 the end is one."""
    A, q, a, _ = problem
    A = (np.array(A) @ np.array(A).T + np.eye(len(A), dtype=int)).tolist()
    M, right, _ = scaled(A, q, a, [-x for x in a])
    n = len(q)
    plain, table = solved_table(lcp(A, q)), solved_table(lcp(M, right))
    assert over(table.vector(0, n), a) == list(plain.vector(0, n))
    assert over(table.vector(n, 2 * n), [-x for x in a]) == list(plain.vector(n, 2 * n))


numbers = st.builds(
    lambda x, k: x * TEN**k, st.sampled_from([-3, 0, 1, 2, Fraction(1, 3)]), st.integers(-330, 330)
)


@settings(max_examples=300)
@given(st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=5), st.data())
def test_combinations_in_floats_are_within_their_bounds(rows, data):
    """Against exact products, with columns and weights beyond the range of floats both ways."""
    n = len(rows)
    entries = data.draw(st.lists(numbers, min_size=n * n, max_size=n * n))
    problem = lcp([entries[i * n : (i + 1) * n] for i in range(n)], [0] * n)
    d = [int(data.draw(st.integers(0, 10**340))) for _ in range(n)]
    columns, variables = Columns(problem, d), [*range(n, 2 * n), 2 * n]
    for v in variables:
        columns.fetch(v)
    weights = exact_vector([*(row[0] + row[1] * sqrt_of(3) for row in rows), rows[0][2]])
    near = columns.near(variables, columns.for_floats(variables, weights))
    for i in range(n):
        total = sum((entries[i * n + j] * weights[j] for j in range(n)), weights[n] * d[i])
        if np.isfinite(near.radius[i]) and np.isfinite(near.middle[i]):
            assert abs(total - Fraction(near.middle[i])) <= Fraction(near.radius[i])
        assert near.signs()[i] in (0, total.sign())


@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=5))
def test_floats_of_entries_keep_their_promise(pairs):
    vector = exact_vector([x + y * sqrt_of(7) for x, y in pairs])
    floats, bounded = vector.array(), vector.bounded()
    assert (bounded.middle == floats).all()
    for x, near, radius in zip(vector, floats.tolist(), bounded.radius.tolist(), strict=True):
        if not np.isfinite(near):
            assert abs(x) > Fraction(1.7e308)
            assert (near > 0) == (x > 0)
            continue
        error = abs(x - Fraction(near))
        assert error <= max(Fraction(10, 2**53) * abs(x), Fraction(1, 2**1074))
        assert error <= Fraction(radius)
        assert bool(near) or abs(x) < Fraction(1, 2**1073)


def test_factors_that_leave_the_range_of_floats():
    """(10^400 / 10^400, 10^-400, 0) by hand."""
    base = exact_vector([Fraction(1, 10**400), Fraction(1, 10**800), 0])
    assert ExactVector(
        base.numerators, base.denominator, (surd(10**400),)
    ).array().tolist() == pytest.approx([1, 0, 0], rel=1e-15, abs=0)


def test_a_radicand_beyond_the_range_of_floats():
    """sqrt(r) / 2^600 for r = 2^1203 + 1, against the integer square root of r 2^64."""
    r = 2**1203 + 1
    vector = ExactVector({1: [fmpz(0)], r: [fmpz(1)]}, fmpz(2) ** 600)
    assert vector.array()[0] == pytest.approx(2**1.5, rel=1e-15)


# --- what is returned has been checked ---


def test_every_solution_is_checked(monkeypatch):
    right = path.basic_z
    monkeypatch.setattr(path, "basic_z", lambda *at: exact_vector([x - 1 for x in right(*at)]))
    with pytest.raises(VerificationError, match="not a solution"):
        lemke([[2, 1], [1, 2]], [-5, -6])
    with pytest.raises(VerificationError, match="not a solution"):
        solved_table(lcp([[2, 1], [1, 2]], [-5, -6]))
    kept = Tableau.vector
    monkeypatch.setattr(Tableau, "vector", lambda *at: exact_vector([x - 1 for x in kept(*at)]))
    with pytest.raises(VerificationError, match="ray"):
        lemke([[-1]], [-1])


def test_a_filter_that_drops_rows_is_noticed(monkeypatch):
    monkeypatch.setattr(path, "first_to_leave", lambda *at: [])  # exact pivots decide all
    monkeypatch.setattr(Tableau, "_in_doubt", lambda *at: [])
    with pytest.raises(VerificationError):
        lemke(*BLOCKED)


def test_solutions_and_what_is_none():
    problem = lcp([[2, 1], [1, 2]], [-5, -6])
    assert list(checked_w(problem, exact_vector(["4/3", "7/3"]))) == [0, 0]
    for z in ([3, 0], [0, 0], [3, 3], ["5/2", 0], [-1, 4]):  # w < 0 or z . w > 0 or z < 0
        with pytest.raises(VerificationError):
            checked_w(problem, exact_vector(z))


RAY = {"foot": ([0, 0], 2), "step": ([1, 0], 1)}


@pytest.mark.parametrize(
    ("change", "right"),
    [
        ({}, True),
        ({"step": ([0, 0], 1)}, True),  # the first ray of all
        ({"step": ([0, 0], 0)}, False),
        ({"step": ([0, 0], -1)}, False),
        ({"step": ([1, 0], 2)}, False),  # dz_1 dw_1 > 0
        ({"step": ([1, 0], 0)}, False),  # dw_1 < 0
        ({"step": ([0, 1], 1)}, False),  # dz_2 w_2 > 0
        ({"step": ([-1, 0], 1)}, False),
        ({"foot": ([0, 0], 1)}, False),  # w_1 < 0
        ({"foot": ([1, 0], 3)}, True),
        ({"foot": ([1, 0], 4)}, False),  # z_1 w_1 > 0
        ({"foot": ([0, 0], 0)}, False),
    ],
)
def test_rays_and_what_is_none(change, right):
    """w = (-2, 3) - z + d z0 with d = 1: along z_1 = t, z0 = 2 + t the first w stays zero."""
    problem = lcp([[-1, 0], [0, 1]], [-2, 3])
    (z, z0), (dz, dz0) = {**RAY, **change}.values()
    foot, step = (exact_vector(z), surd(z0)), (exact_vector(dz), surd(dz0))
    if right:
        assert list(checked_dw(problem, exact_vector([1, 1]), foot, step)) == [
            dz0 - dz[0],
            dz0 + dz[1],
        ]
    else:
        with pytest.raises(VerificationError):
            checked_dw(problem, exact_vector([1, 1]), foot, step)


def test_a_foot_with_z0_at_zero_is_no_ray():
    problem = lcp([[0]], [0])
    with pytest.raises(VerificationError):
        checked_dw(
            problem, exact_vector([1]), (exact_vector([0]), surd(0)), (exact_vector([0]), surd(1))
        )


@pytest.mark.parametrize(
    ("y", "right"),
    [
        ([1, 1], True),
        ([2, 2], True),
        ([1], False),
        ([1, 1, 1], False),
        ([1, 0], False),  # M^T y > 0
        ([-1, -1], False),
        ([0, 0], False),  # q . y = 0
    ],
)
def test_certificates_and_what_is_none(y, right):
    """0 <= (1, 1) . (M z + q) = -1 for no z at all."""
    problem = lcp([[1, -1], [-1, 1]], [-2, 1])
    assert is_certificate(problem, [Fraction(x) for x in y]) == right


def test_a_ray_along_which_z0_stays():
    """w = -1 + z0 for any z: z = t, z0 = 1."""
    problem = lcp([[0]], [-1])
    foot, step = (exact_vector([0]), surd(1)), (exact_vector([1]), surd(0))
    assert list(checked_dw(problem, exact_vector([1]), foot, step)) == [0]


def test_certificates_may_have_zeros_and_fractions():
    """0 <= (1, 1, 0) . (M z + q) = -1 for no z, whatever y is multiplied by."""
    problem = lcp([[1, -1, 0], [-1, 1, 0], [0, 0, 1]], [-2, 1, 5])
    for c in (Fraction(1), Fraction(1, 7)):
        assert is_certificate(problem, [c, c, 0 * c])
        assert not is_certificate(problem, [c, c / 2, 0 * c])  # M^T y > 0, however little


def test_a_certificate_has_no_negative_entry():
    """M^T y <= 0 and q . y < 0 hold for y = (-1, 0) and (1, -1); z = (1, 0) is feasible."""
    problem = lcp([[1, 0], [0, 0]], [1, 2])
    for y in ([-1, 0], [1, -1], [0, -1]):
        assert not is_certificate(problem, [Fraction(x) for x in y])


def test_no_row_that_may_block_first_is_left_out_for_a_rounding():
    """Bounds of a few units in the last place: which rows they leave is worked out in fractions."""
    random = Random(3)
    for _ in range(1000):
        value, change = (
            np.array([1 + random.randint(0, 4) * 2.0**-51 for _ in range(3)]) * random.uniform(1, 3)
            for _ in range(2)
        )
        spread = [
            np.array([random.choice([0, 2.0**-54, 2.0**-53, 2.0**-52]) for _ in range(3)])
            for _ in range(2)
        ]
        table = Tableau(lcp(np.eye(3, dtype=int).tolist(), [1, 1, 1]), [1, 1, 1])
        table._w_near = Bounded(value, spread[0])
        nothing = Bounded(np.zeros(0), np.zeros(0))
        left = table._in_doubt(SimpleNamespace(near=(nothing, Bounded(-change, spread[1]))))
        v, c, dv, dc = ([Fraction(x) for x in xs.tolist()] for xs in (value, change, *spread))
        latest = min((v[k] + dv[k]) / (c[k] - dc[k]) for k in range(3))
        first = {k for k in range(3) if (v[k] - dv[k]) / (c[k] + dc[k]) <= latest}
        assert first <= set(left)


def test_rows_that_surely_block_later_are_left_out():
    table = Tableau(lcp(np.eye(3, dtype=int).tolist(), [1, 1, 1]), [1, 1, 1])
    table._w_near = Bounded(np.array([1.0, 1.0, 1.0]), np.full(3, 1e-9))
    nothing = Bounded(np.zeros(0), np.zeros(0))
    changes = Bounded(np.array([-1.0, -1.0 + 1e-6, 1.0]), np.full(3, 1e-9))
    assert table._in_doubt(SimpleNamespace(near=(nothing, changes))) == [0]
