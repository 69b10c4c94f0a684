"""Scenes that just stand or just do not, and piles that a molecular dynamics would not keep."""

from fractions import Fraction

import pytest

from benchmarks.failures.slide import slide
from lcp_piles import contact_system, nt30, solve, surd, tss, verify
from lcp_piles.methods.fire import fire
from lcp_piles.methods.gauss_seidel import gauss_seidel
from lcp_piles.problems import APEX_LIMIT, side_load

LAYERS = pytest.mark.parametrize("layers", [2, 3, 5])


@LAYERS
@pytest.mark.parametrize("k", [1, 3, 6, 12, 18, 30])
def test_the_exact_status_flips_at_the_exact_load(layers, k):
    margin = surd(Fraction(1, 10**k))
    scene = side_load(layers, APEX_LIMIT - margin)
    stands = solve(scene)
    assert stands.status == "solved"
    assert verify(scene, stands).ok
    # The load pushes the apex to the right: its left contact carries what is left of 1/sqrt(3).
    assert stands.forces[stands.contact_index((1, 1), (2, 1))] == margin
    falls = solve(side_load(layers, APEX_LIMIT + margin))
    assert falls.status == "unstable"
    assert verify(falls.scene, falls).ok


@LAYERS
def test_at_the_limit_the_left_contact_of_the_apex_carries_exactly_nothing(layers):
    scene = side_load(layers, APEX_LIMIT)
    solution = solve(scene)
    assert solution.status == "solved"
    assert solution.forces[solution.contact_index((1, 1), (2, 1))] == 0
    assert solution.stability.mechanisms >= 1
    assert verify(scene, solution).ok


@pytest.mark.parametrize("layers", [2, 3])
@pytest.mark.parametrize("k", [16, 18, 30])
def test_floating_point_calls_a_falling_pile_solved(layers, k):
    scene = side_load(layers, APEX_LIMIT + Fraction(1, 10**k))
    assert solve(scene).status == "unstable"
    system = contact_system(scene)
    assert solve(scene, "newton").status == "solved"
    assert fire(system).converged
    assert gauss_seidel(system).converged


@pytest.mark.parametrize("k", [1, 6])
def test_farther_from_the_limit_floating_point_sees_that_it_falls(k):
    system = contact_system(side_load(3, APEX_LIMIT + Fraction(1, 10**k)))
    assert not fire(system, max_iterations=3000).converged
    assert not gauss_seidel(system, max_sweeps=1000).converged


def test_discs_that_move_leave_a_saddle_and_keep_a_stable_pile():
    """The same kick and the same time; the verdict of the exact solution is known beforehand."""
    saddle, stable = solve(tss(4)), solve(nt30(3))
    assert (saddle.stability.verdict, stable.stability.verdict) == ("saddle", "stable")
    left = slide(saddle, 1e-4, duration=25.0, samples=20)
    kept = slide(stable, 1e-4, duration=25.0, samples=20)
    assert left.distance[0] < 1e-2
    assert kept.distance[0] < 1e-2
    assert left.distance[-1] > 100
    assert kept.distance.max() < 0.1


def test_a_pile_that_a_push_makes_a_saddle_slides_until_other_contacts_hold_it():
    """The same pile without the push is stable; both verdicts are known before anything moves."""
    saddle, stable = solve(nt30(6, push=200)), solve(nt30(6))
    assert (saddle.stability.verdict, stable.stability.verdict) == ("saddle", "stable")
    left = slide(saddle, 1e-5, duration=20.0, samples=20)
    kept = slide(stable, 1e-5, duration=20.0, samples=20)
    assert left.distance[0] < 1e-2
    assert kept.distance[0] < 1e-2
    assert left.distance[-1] > 1
    assert left.distance[-1] > 100 * left.distance[0]
    assert kept.distance.max() < 0.1
