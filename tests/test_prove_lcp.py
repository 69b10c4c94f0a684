"""Supports without digits: against exact solutions, brute force, and problems made from theirs."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from flint import fmpq_mat
from helpers import brute_force, degenerate, fmpq_of
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.lcp.random_problems import laplacian
from lcp_piles import InputError, LcpPilesError, SolveError, prove_lcp, solve_lcp, surd
from lcp_piles.bases import prove_lcp as module
from lcp_piles.bases.inverse_bound import inverse_bound
from lcp_piles.pivoting.rows import rational_rows

SQUARES = st.integers(1, 4).flatmap(
    lambda n: st.lists(
        st.lists(st.integers(-4, 4), min_size=n + 1, max_size=n + 1), min_size=n, max_size=n
    )
)


def within(bounded, values):
    """Whether exact numbers are within bounds, in Fractions (irrational ones to 60 digits)."""
    return all(
        abs(exact - Fraction(float(m))) <= Fraction(float(r))
        for exact, m, r in zip(values, bounded.middle, bounded.radius, strict=True)
    )


def assert_among(M, q, proof):
    """Some solution, found by brute force, has the support and is within the bounds."""
    assert any(
        [x > 0 for x in z] == proof.support.tolist()
        and within(proof.z, [x.rational() for x in z])
        and within(proof.w, [x.rational() for x in w])
        for z, w in brute_force(M, q)
    )


def assert_right_if_proved(M, q):
    try:
        proof = prove_lcp(M, q)
    except SolveError:
        return
    if proof.proved:
        assert_among(M, q, proof)


@settings(max_examples=200)
@given(
    st.one_of(
        SQUARES.map(lambda rows: ([r[:-1] for r in rows], [r[-1] for r in rows])), degenerate()
    )
)
def test_what_is_proved_is_a_solution(problem):
    assert_right_if_proved(*problem)


@settings(max_examples=100)
@given(SQUARES, st.data())
def test_wrong_proposals_are_not_proved(rows, data):
    M, q = [row[:-1] for row in rows], [row[-1] for row in rows]
    mask = data.draw(st.lists(st.booleans(), min_size=len(q), max_size=len(q)))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "proposals", lambda problem: iter([np.array(mask, dtype=bool)]))
        assert_right_if_proved(M, q)


@settings(max_examples=150)
@given(SQUARES, st.lists(st.integers(1, 5), min_size=4, max_size=4))
def test_bounds_of_the_inverse(rows, dens):
    """Against the exact inverse of the integer rows, unit vector by unit vector."""
    M = [[Fraction(x, d) for x in row[:-1]] for row, d in zip(rows, dens, strict=False)]
    part = rational_rows(M)
    size = len(M)
    try:
        bound = inverse_bound(part, range(size))
    except SolveError:
        return
    A = fmpq_mat(
        size,
        size,
        [fmpq_of(x) * int(d) for row, d in zip(M, part.denominators, strict=True) for x in row],
    )
    inverse = A.inv().tolist()
    for k in range(size):
        limits = bound.of(np.eye(size)[k])
        exact = [Fraction(int(row[k].p), int(row[k].q)) for row in inverse]
        assert all(abs(x) <= Fraction(float(b)) for x, b in zip(exact, limits, strict=True))


@pytest.mark.parametrize("size", [17, 100])
def test_obstacles_on_grids(size):
    """q is drawn; floats see the same support, with all residuals away from zero."""
    M = laplacian(size)
    q = np.random.default_rng(0).integers(-9, 8, size * size)
    proof = prove_lcp(M, q)
    assert proof.proved
    assert proof.matrix.unique
    w = M @ proof.z.middle + q
    assert (proof.z.middle[proof.support] > 0).all()
    assert np.abs(w[proof.support]).max() < 1e-9
    assert w[~proof.support].min(initial=1.0) > 0
    if size == 17:
        exact = solve_lcp(M, q)
        assert within(proof.z, exact.z)
        assert within(proof.w, exact.w)


@pytest.mark.parametrize(
    ("M", "way"),
    [
        ([[2, 1], [1, 2]], "diagonal dominance"),
        ([[5, 4, 4], [4, 5, 4], [4, 4, 5]], "least eigenvalue"),
        ([[1, 2, 0], [0, 1, 2], [2, 0, 1]], "approximate inverse"),
    ],
)
def test_each_way_to_a_bound(M, way):
    proof = prove_lcp(M, [-1] * len(M))
    assert proof.proved
    assert proof.way == way


def test_q_in_a_quadratic_field():
    """z = (sqrt(3), 0): to 30 digits by Python's integers."""
    proof = prove_lcp([[3, 1], [1, 3]], ["-3*sqrt(3)", "1"])
    root = Fraction(1732050807568877293527446341505, 10**30)
    assert proof.proved
    assert abs(root - Fraction(float(proof.z.middle[0]))) <= Fraction(float(proof.z.radius[0]))
    assert proof.z.radius[0] < 1e-14


def test_an_exact_zero_is_named_unless_the_digits_end():
    """z = (1/3, 0), w = 0 in both: not to be told from tiny ones; with integers it is seen."""
    assert prove_lcp([[3, 0], [3, 1]], [-1, -1]).unproved == (1,)
    assert prove_lcp([[1, 0], [1, 1]], [-1, -1]).proved


def test_without_a_solution_nothing_is_proved():
    assert not prove_lcp([[0, 0], [0, 1]], [-1, 1]).proved


def test_nothing_to_propose(monkeypatch):
    monkeypatch.setattr(module, "proposals", lambda problem: iter(()))
    with pytest.raises(SolveError, match="use solve_lcp"):
        prove_lcp([[1]], [-1])


@pytest.mark.parametrize(
    ("M", "q", "words"),
    [
        ([[1, 2]], [1], "expected 1"),
        ([[1.5]], [1], r"floats_exactly\(1.5\)"),
        ([[1]], [float("nan")], "nan, expected an exact number"),
        ([[1]], None, "expected a vector of exact numbers"),
    ],
)
def test_bad_input(M, q, words):
    with pytest.raises(InputError, match=words):
        prove_lcp(M, q)


def test_numbers_beyond_floats_are_refused_in_words():
    with pytest.raises(LcpPilesError, match="use solve_lcp"):
        prove_lcp([[10**400]], [-1])


def test_nothing_to_do():
    assert prove_lcp([], []).proved
    assert prove_lcp([[1]], [surd("sqrt(2)")]).support.tolist() == [False]
