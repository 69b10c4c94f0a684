"""Contacts that a threshold names wrongly: ties, breakpoints, tiny pushes, mechanisms."""

from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from benchmarks.failures.float_runs import (
    ABOVE_ROUNDING,
    RELAXED,
    THRESHOLDS,
    in_floats,
    loaded_stiffness,
    misread,
)
from lcp_piles import (
    contact_system,
    nt30,
    pile,
    push_path,
    solve,
    surd,
    tbs,
    tss,
    verify,
    z_algorithm,
)
from lcp_piles.problems import LAST_BREAKPOINT, beside, near_breakpoint
from lcp_piles.solution.solution import states_of

EACH = pytest.mark.parametrize("method", RELAXED)


def read_floats(scene, method):
    """The float solution with all that was computed, for any threshold to read."""
    floats, converged = in_floats(scene, method)
    assert converged
    return floats


def least_misread(floats, exact):
    """At the best threshold above 1e-16; below, one reads rounding, and may be right by luck."""
    return min(misread(floats, exact.states, t) for t in ABOVE_ROUNDING)


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
    floats = read_floats(scene, "Newton")
    assert min(misread(floats, exact.states, t) for t in THRESHOLDS) >= 2


def test_a_threshold_that_is_right_for_a_small_pile_is_wrong_for_a_large_one():
    """The smallest force of TBS falls with the size, so no threshold serves every size."""
    least = {}
    for layers in (5, 60):
        f = solve(tbs(layers)).force_array
        least[layers] = f[f > 0].min() / f.max()
    assert least[60] < 1e-5 < 1e-2 < least[5]
    exact = solve(tbs(60))
    floats = read_floats(tbs(60), "Newton")
    assert misread(floats, exact.states, 1e-3) > 0
    assert misread(read_floats(tbs(5), "Newton"), solve(tbs(5)).states, 1e-3) == 0


@EACH
def test_a_stable_pile_without_ties_is_read_well_at_many_thresholds(method):
    """That the catalogue is one of hard cases: this easy one nobody misreads."""
    exact = solve(nt30(6))
    floats = read_floats(nt30(6), method)
    assert all(misread(floats, exact.states, t) == 0 for t in (1e-4, 1e-6, 1e-8))


@pytest.mark.parametrize(("kind", "layers"), [("tss", 6), ("tss", 13), ("nt30", 8), ("nt30", 12)])
def test_pivoting_ends_where_mechanisms_run_into_their_stops(kind, layers):
    """The forces are right; but contacts touch that open in other displacements as good as these.

    Lemke's method ends at a vertex of the set of displacements, the Z algorithm with the contacts
    that the smallest displacements close. The state of a contact asks for the whole set.
    """
    scene = pile(kind, layers)
    exact = solve(scene)
    assert exact.stability.mechanisms > 0
    assert verify(scene, exact).ok
    pivoted, z = read_floats(scene, "Lemke"), z_algorithm(scene, arithmetic="float64")
    assert z.status == "solved"
    for floats in (pivoted, z.solution):
        np.testing.assert_allclose(floats.force_array, exact.force_array, atol=1e-11)
        touching = [
            k
            for k, (state, gap) in enumerate(zip(exact.states, floats.gap_array, strict=True))
            if state == "open" and abs(gap) < 1e-12
        ]
        assert len(touching) >= 2
        assert all(exact.gaps[k] > 0 and not exact.gap_unique[k] for k in touching)
        assert least_misread(floats, exact) >= 2


@pytest.mark.parametrize("layers", [8, 12])
def test_gauss_seidel_stops_there_as_well(layers):
    """It comes from outside the set of displacements and ends where it reaches it."""
    exact = solve(nt30(layers))
    assert verify(nt30(layers), exact).ok
    assert least_misread(read_floats(nt30(layers), "Gauss-Seidel"), exact) >= 2


@pytest.mark.parametrize("layers", [6, 9, 13])
def test_newton_ends_between_the_stops_but_may_need_a_fine_threshold(layers):
    """How far it opens a contact is an accident of its steps, however far the contact can open."""
    exact = solve(tss(layers), "lemke")  # the default takes the displacements of Newton
    assert verify(tss(layers), exact).ok
    floats = read_floats(tss(layers), "Newton")
    assert misread(floats, exact.states, 1e-13) == 0
    if layers == 9:  # where NT30 of 6 layers is read well, see above
        assert misread(floats, exact.states, 1e-4) == 2
        length = float(max(map(abs, exact.displacement_array.ravel())))
        assert min(float(g) for g in exact.gaps if g > 0) > 1e-4 * length


@pytest.mark.parametrize(
    ("kind", "layers", "overlap"),
    [("tss", 6, True), ("nt30", 7, False), ("nt30", 8, True), ("nt60", 3, False)],
)
def test_the_matrix_of_the_loaded_contacts_is_singular(kind, layers, overlap):
    """So the right contact set does not give the displacements; ours counts the motions.

    Elimination divides by rounding there. The smallest displacements that balance the load, the
    usual way out, may let other contacts overlap.
    """
    exact = solve(pile(kind, layers))
    system = contact_system(exact.scene, "whole")
    B, C, o, p = system.floats()
    closed = np.array([s == "closed" for s in exact.states])
    K = loaded_stiffness(system, closed)
    values = np.linalg.eigvalsh(K)
    assert int((values < 1e-12 * values[-1]).sum()) == exact.stability.mechanisms > 0
    right = p - B.toarray()[closed].T @ (o[closed] / C[closed])
    smallest = np.linalg.lstsq(K, right, rcond=1e-12)[0]
    assert ((B @ smallest + o)[~closed] < -1).any() == overlap
    assert min(exact.gaps) >= 0
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


@pytest.mark.parametrize("k", [12, 18, 40])
def test_a_tiny_push_from_rest_changes_forces_by_exactly_its_share(k):
    """Before the first breakpoint forces are linear in the push; in floats the share drowns."""
    rest, one = solve(nt30(4)), solve(nt30(4, push=1))
    scene = nt30(4, push=Fraction(1, 10**k))
    tiny = solve(scene)
    assert tiny.states == rest.states == one.states
    share = surd(Fraction(1, 10**k))
    for a, b, c in zip(rest.forces, one.forces, tiny.forces, strict=True):
        assert c == a + (b - a) * share
    change = one.force_array - rest.force_array
    assert np.abs(change).max() > 1e-2
    for method in RELAXED:
        seen = read_floats(scene, method).force_array - read_floats(nt30(4), method).force_array
        error = np.abs(seen * 10.0**k - change).max() / np.abs(change).max()
        assert error > (1e-4 if k == 12 else 0.5)


def test_states_are_those_of_the_signs_of_the_exact_numbers():
    solution = solve(near_breakpoint(15, 0))
    assert states_of(solution.forces, solution.gaps) == solution.states
