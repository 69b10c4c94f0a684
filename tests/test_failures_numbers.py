"""Numbers that floating point cannot hold together: large pushes, stiff contacts, large piles."""

from dataclasses import replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest

from benchmarks.failures.float_runs import in_floats, loaded_stiffness, whole
from lcp_piles import (
    Scene,
    contact_system,
    nt30,
    nt60,
    pile,
    push_path,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lcp, float_lemke
from lcp_piles.methods.newton import newton
from lcp_piles.problems import stiff_every_other


@pytest.mark.parametrize(("kind", "layers"), [("nt30", 4), ("nt30", 6), ("nt60", 5)])
@pytest.mark.parametrize("exponent", [12, 30])
def test_a_huge_push_drowns_the_weights(kind, layers, exponent):
    """The largest force is the push, the smallest a few weights: no float balances both."""
    scene = pile(kind, layers, push=10**exponent)
    exact = solve(scene)
    assert verify(scene, exact).ok
    f = exact.force_array
    assert f.max() > 1e-2 * 10**exponent
    least = min((x for x in exact.forces if x > 0), key=float)
    assert least == surd("1/3*sqrt(3)")  # half of the apex's weight over sin 60: no push in it
    floats = solve(scene, "newton")
    assert floats.status == "solved"  # its residual is small beside the push
    error = np.abs(floats.force_array - f)
    assert error.max() > 1e-6 * float(least)
    assert sum(a != b for a, b in zip(floats.states, exact.states, strict=True)) > 0
    if exponent == 30:
        assert error.max() > 1e6 * float(least)


@pytest.mark.parametrize("method", ["FIRE", "Gauss-Seidel"])
def test_relaxation_stops_before_the_weights_come_into_play(method):
    """Its tolerance is one of the push: all of the least force is missing, or more."""
    scene = nt30(4, push=10**12)
    exact = solve(scene).force_array
    least = np.argmin(np.where(exact > 0, exact, np.inf))
    floats, converged = in_floats(scene, method)
    assert converged
    assert abs(floats.force_array[least] - exact[least]) > 0.5 * exact[least]


def test_the_huge_push_lies_on_the_asymptotic_piece():
    """Exact forces are c + s push there, with the c and s that the continuation finds."""
    path = push_path("nt30", 4)
    push = 10**30
    exact = solve(nt30(4, push=push))
    for contact, force in list(zip(exact.scene.contacts, exact.forces, strict=True))[::5]:
        constant, slope = path.linear_force(contact.a, contact.b, 10**6)
        assert force == constant + slope * push


@pytest.mark.parametrize("scene", [tss(6, push=10**12), nt30(4, push=-(10**12))])
def test_newton_says_so_where_a_huge_push_is_too_much(scene):
    assert solve(scene, "newton").status == "unresolved"
    exact = solve(scene)
    assert exact.status == "solved"
    assert verify(scene, exact).ok


@pytest.mark.parametrize("decades", [6, 9, 12, 15, 18])
@pytest.mark.parametrize(("kind", "layers"), [("nt60", 3), ("nt30", 3), ("tss", 4)])
def test_stiffness_ratios_up_to_1e18(kind, layers, decades):
    scene = stiff_every_other(kind, layers, decades)
    exact, pivoted = solve(scene), solve(scene, "lemke")
    assert verify(scene, exact).ok
    assert list(exact.forces) == list(pivoted.forces)
    assert exact.states == pivoted.states
    floats = newton(contact_system(scene))
    assert floats.converged == (decades == 6)
    assert not fire(contact_system(scene), max_iterations=2000).converged


@pytest.mark.parametrize("decades", [9, 15])
def test_gauss_seidel_on_forces_does_not_mind_stiff_contacts(decades):
    """It was made for rigid ones; so the failure above is that of stiffnesses, not of the scene."""
    scene = stiff_every_other("nt60", 3, decades)
    floats, converged = in_floats(scene, "Gauss-Seidel")
    assert converged
    np.testing.assert_allclose(floats.force_array, solve(scene).force_array, atol=1e-7)


def test_a_ratio_that_machine_integers_cannot_hold_is_solved_in_longer_ones():
    scene = stiff_every_other("nt60", 3, 30)
    for method in ("proved", "lemke"):
        solution = solve(scene, method)
        assert solution.status == "solved"
        assert verify(scene, solution).ok


@pytest.mark.parametrize("layers", [5, 8])
def test_every_contact_with_a_compliance_of_its_own(layers):
    """Two decimals each, without a common multiple that would fit an integer."""
    random = Random(0)
    scene = nt60(layers)
    contacts = tuple(
        replace(c, compliance=Fraction(random.randint(50, 150), 100)) for c in scene.contacts
    )
    scene = Scene(scene.discs, contacts)
    exact, pivoted = solve(scene), solve(scene, "lemke")
    assert verify(scene, exact).ok
    assert list(exact.forces) == list(pivoted.forces)
    np.testing.assert_allclose(solve(scene, "newton").force_array, exact.force_array, atol=1e-10)


def condition(scene):
    """Condition number of the stiffness of the loaded contacts."""
    system = contact_system(scene)
    values = np.linalg.eigvalsh(loaded_stiffness(system, newton(system).closed))
    return values[-1] / values[0]


def test_the_condition_number_grows_with_the_square_of_the_size_and_takes_digits():
    sizes = [5, 10, 20, 40]
    numbers = [condition(tbs(n)) for n in sizes]
    slope = np.polyfit(np.log(sizes), np.log(numbers), 1)[0]
    assert 1.4 < slope < 2.2
    errors = {np.float32: [], np.float64: []}
    for n in (5, 40):
        scene = tbs(n)
        system = contact_system(scene)
        exact = solve(scene)
        assert verify(scene, exact).ok
        run = newton(system)
        for kind, column in errors.items():
            w = float_lemke(*float_lcp(system), dtype=kind).w.astype(float)
            floats = whole(system, run.U, w, run.gaps).force_array
            column.append(np.abs(floats - exact.force_array).max() / exact.force_array.max())
    assert all(large > 1.5 * small for small, large in errors.values())
    assert errors[np.float32][1] > 1e-8 > 1e-12 > errors[np.float64][1]


@pytest.mark.parametrize("layers", [6, 12])
def test_single_precision_cannot_reach_a_tolerance_that_double_precision_reaches(layers):
    system = contact_system(nt30(layers))
    assert fire(system, tolerance=1e-9).converged
    single = fire(system, tolerance=1e-9, dtype=np.float32, max_iterations=5000)
    assert not single.converged
    assert single.residual > 1e-8
    assert verify(nt30(layers), solve(nt30(layers))).ok


@pytest.mark.parametrize("push", [0, 20, 300])
def test_on_the_published_floor_the_energy_has_no_minimum(push):
    """Floor discs that rise under load: whatever descends an energy runs away for ever."""
    scene = nt30(6, push=push, floor_compliance="-1/2")
    system = contact_system(scene)
    K = loaded_stiffness(system, np.ones(len(system.gap), dtype=bool))
    assert np.linalg.eigvalsh(K)[0] < -0.1
    run = fire(system)
    assert not run.converged
    assert np.abs(run.U).max() > 1e30
    exact = solve(scene)
    assert verify(scene, exact).ok
    assert exact.stability.verdict == "undecided"  # and no more is promised than that


def test_the_published_floor_has_the_published_first_breakpoint():
    """A float method at the exact breakpoint cannot tell; the states beside it are exact."""
    push = surd("64757787245/13047053469*sqrt(3)")  # the first row of Table 1
    step = Fraction(1, 10**15)
    before, at, after = (
        solve(nt30(6, push=push + k * step, floor_compliance="-1/2")) for k in (-1, 0, 1)
    )
    contact = ((3, 3), (3, 2))
    states = [solution.state(*contact) for solution in (before, at, after)]
    assert states == ["open", "osculatory", "closed"]
