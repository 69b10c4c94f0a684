"""Contacts that a threshold names wrongly: ties, breakpoints, tiny pushes, mechanisms."""

from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from failure_cases import LAST_BREAKPOINT, THRESHOLDS, beside, misread, near_breakpoint

from lcp_piles import contact_system, nt30, pile, solve, surd, tbs, tss, verify
from lcp_piles.fire import fire
from lcp_piles.float_solution import float_solution
from lcp_piles.gauss_seidel import gauss_seidel
from lcp_piles.newton import newton
from lcp_piles.push import push_path
from lcp_piles.solution import states_of

FLOATS = {
    "newton": newton,
    "fire": lambda system: fire(system, tolerance=1e-11),
    "gauss-seidel": lambda system: gauss_seidel(system, tolerance=1e-10),
}
EACH = pytest.mark.parametrize("method", FLOATS)


def read_floats(scene, method):
    """The float solution with all that was computed, for any threshold to read."""
    system = contact_system(scene)
    run = FLOATS[method](system)
    assert run.converged
    return float_solution(
        system,
        run.U,
        run.forces,
        run.gaps,
        method=method,
        arithmetic="float64",
        steps=0,
        tolerance=0.0,
        start=0.0,
    )


@cache
def path():
    return push_path("nt30", 6)


@cache
def a_tenth_away(side):
    return solve(near_breakpoint(1, side))


def changing():
    """The contacts that open at the last breakpoint."""
    last = path().rearrangements[-1]
    assert last.push == LAST_BREAKPOINT  # the published position of the last breakpoint
    return [nt30(6).contacts.index(contact) for contact in last.opens]


@pytest.mark.parametrize("k", [3, 6, 9, 12, 15, 30])
def test_the_states_next_to_a_breakpoint(k):
    """Force and gap are linear on either side, so 10^-k away they are 10^(1-k) of a tenth away."""
    shrunk = Fraction(10, 10**k)
    before, at, after = (solve(near_breakpoint(k, side)) for side in (-1, 0, 1))
    assert len(changing()) == 2
    for c in changing():
        assert (before.states[c], at.states[c], after.states[c]) == ("closed", "osculatory", "open")
        assert before.forces[c] == a_tenth_away(-1).forces[c] * shrunk
        assert after.gaps[c] == a_tenth_away(1).gaps[c] * shrunk
    others = [c for c in range(len(at.states)) if c not in changing()]
    assert all(before.states[c] == at.states[c] == after.states[c] for c in others)
    for side, solution in zip((-1, 0, 1), (before, at, after), strict=True):
        assert verify(near_breakpoint(k, side), solution).ok
        moved = path().solution(LAST_BREAKPOINT + Fraction(side, 10**k))
        assert list(moved.forces) == list(solution.forces)


@pytest.mark.parametrize(("k", "wrong"), [(3, 0), (5, 0), (8, 2), (12, 2), (15, 2)])
@pytest.mark.parametrize("side", [-1, 1])
def test_the_usual_threshold_misreads_the_last_of_it(k, side, wrong):
    scene = near_breakpoint(k, side)
    truth = solve(scene).states
    named = solve(scene, "newton").states
    assert sum(a != b for a, b in zip(named, truth, strict=True)) == wrong


@pytest.mark.parametrize("k", [15, 18])
def test_a_tie_beside_a_near_tie_is_misread_at_every_threshold(k):
    scene = beside(near_breakpoint(k, 0), near_breakpoint(k, -1))
    exact = solve(scene)
    for c in changing():
        assert exact.states[c] == "osculatory"
        assert exact.states[len(nt30(6).contacts) + c] == "closed"
    assert verify(scene, exact).ok
    floats = read_floats(scene, "newton")
    assert min(misread(floats, exact.states, t) for t in THRESHOLDS) >= 2


def test_a_threshold_that_is_right_for_a_small_pile_is_wrong_for_a_large_one():
    """The smallest force of TBS falls with the size, so no threshold serves every size."""
    least = {}
    for layers in (5, 60):
        f = solve(tbs(layers)).force_array
        least[layers] = f[f > 0].min() / f.max()
    assert least[60] < 1e-5 < 1e-2 < least[5]
    exact = solve(tbs(60))
    floats = read_floats(tbs(60), "newton")
    assert misread(floats, exact.states, 1e-3) > 0
    assert misread(read_floats(tbs(5), "newton"), solve(tbs(5)).states, 1e-3) == 0


@EACH
def test_a_stable_pile_without_ties_is_read_well_at_many_thresholds(method):
    """That the catalogue is one of hard cases: this easy one nobody misreads."""
    exact = solve(nt30(6))
    floats = read_floats(nt30(6), method)
    assert all(misread(floats, exact.states, t) == 0 for t in (1e-4, 1e-6, 1e-8))


@pytest.mark.parametrize("layers", [6, 13])
def test_where_mechanisms_are_free_newton_stops_at_a_gap_that_only_looks_closed(layers):
    """A float method ends at one of many displacements; the state asks for all of them."""
    exact = solve(tss(layers))
    assert exact.stability.mechanisms > 0
    assert verify(tss(layers), exact).ok
    floats = read_floats(tss(layers), "newton")
    # Below 1e-16 a threshold reads rounding, and may be right by luck.
    assert min(misread(floats, exact.states, t) for t in THRESHOLDS if t > 1e-16) >= 2
    assert not all(exact.gap_unique)


@pytest.mark.parametrize(("kind", "layers"), [("tss", 6), ("nt30", 7), ("nt30", 8), ("nt60", 3)])
def test_the_matrix_of_the_loaded_contacts_is_singular(kind, layers):
    """So elimination on the right contact set fails or returns rubbish; ours counts the motions."""
    exact = solve(pile(kind, layers))
    system = contact_system(exact.scene, "whole")
    B, C, _, _ = system.floats()
    closed = np.array([s == "closed" for s in exact.states])
    K = (B[closed].T @ (B[closed] / C[closed][:, None])).toarray()
    values = np.linalg.eigvalsh(K)
    assert int((values < 1e-12 * values[-1]).sum()) == exact.stability.mechanisms > 0
    assert verify(exact.scene, exact).ok


@pytest.mark.parametrize("k", [10, 12, 30])
@pytest.mark.parametrize("side", [1, -1])
def test_a_tiny_push_decides_a_tie_and_a_threshold_does_not_see_it(k, side):
    """From the first breakpoint of a pushed pile on, 10^-k in the push is a state."""
    first = path().rearrangements[0]
    scene = nt30(6, push=first.push + Fraction(side, 10**k))
    exact = solve(scene)
    for contact in first.closes:
        assert exact.state(contact.a, contact.b) == ("closed" if side > 0 else "open")
        assert solve(scene, "newton").state(contact.a, contact.b) == "osculatory"


@pytest.mark.parametrize("k", [12, 40])
def test_a_tiny_push_from_rest_changes_forces_by_exactly_its_share(k):
    """Before the first breakpoint forces are linear in the push."""
    rest, one = solve(nt30(6)), solve(nt30(6, push=1))
    tiny = solve(nt30(6, push=Fraction(1, 10**k)))
    assert tiny.states == rest.states
    share = surd(Fraction(1, 10**k))
    for a, b, c in zip(rest.forces, one.forces, tiny.forces, strict=True):
        assert c == a + (b - a) * share
    # Floats of the two piles differ by rounding only, where they differ at all.
    change = np.abs(
        solve(nt30(6, push=Fraction(1, 10**40)), "newton").force_array
        - solve(nt30(6), "newton").force_array
    )
    assert change.max() == 0.0


def test_states_are_those_of_the_signs_of_the_exact_numbers():
    solution = solve(near_breakpoint(15, 0))
    assert states_of(solution.forces, solution.gaps) == solution.states
