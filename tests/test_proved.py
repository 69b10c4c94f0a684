"""Floating point proposes, exact arithmetic decides: a lying proposal changes nothing."""

from importlib import import_module

import numpy as np
import pytest
from helpers import piles, rough_piles
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import nt30, nt60, solve, tss, verify
from lcp_piles.proved import Guess


def solved_from(scene, closed_of):
    """The solution when the contact set is guessed by `closed_of(number of contacts)`."""
    guesses = []

    def guess(system):
        closed = np.array(closed_of(system.contacts), dtype=bool)
        guesses.append(closed)
        return Guess(closed, np.arange(len(closed), dtype=float))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(import_module("lcp_piles.solve"), "float_guess", guess)
        solution = solve(scene, "proved")
    assert guesses
    return solution


def assert_same(one, other):
    assert one.status == other.status == "solved"
    assert list(one.forces) == list(other.forces)
    assert one.states == other.states
    assert one.stability == other.stability
    assert one.gap_unique == other.gap_unique


@settings(max_examples=40)
@given(st.one_of(piles(), rough_piles()), st.randoms(use_true_random=False))
def test_any_guess_ends_in_the_same_solution(scene, random):
    exact = solve(scene, "lemke")
    assert_same(solved_from(scene, lambda n: [random.random() < 0.7 for _ in range(n)]), exact)


@pytest.mark.parametrize("scene", [nt30(5), tss(6), nt60(6, push=20)], ids=lambda s: s.kind)
@pytest.mark.parametrize("value", [True, False], ids=["all closed", "all open"])
def test_the_worst_guesses(scene, value):
    assert_same(solved_from(scene, lambda n: [value] * n), solve(scene, "lemke"))


def test_a_right_guess_needs_no_pivot_and_a_wrong_one_is_counted():
    scene = nt30(5)
    right = solve(scene, "proved")
    assert right.record.pivots == 0
    assert right.record.guess_errors == 0
    wrong = solved_from(scene, lambda n: [True] * n)
    assert wrong.record.pivots > 0
    assert wrong.record.guess_errors > 0


@settings(max_examples=20)
@given(st.randoms(use_true_random=False))
def test_no_guess_makes_a_broken_pile_stand(random):
    scene = nt60(4).without([(4, 1)])
    solution = solved_from(scene, lambda n: [random.random() < 0.7 for _ in range(n)])
    assert solution.status == "unstable"
    assert verify(scene, solution).ok
