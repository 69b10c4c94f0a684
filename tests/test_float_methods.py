"""Lemke in floats, projected Gauss-Seidel and FIRE, against the exact solution; their claims."""

import numpy as np
import pytest

from lcp_piles import (
    InputError,
    SolveError,
    contact_lcp,
    contact_system,
    lemke,
    nt30,
    nt60,
    pile,
    solve,
    tbs,
    tss,
)
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lcp, float_lemke
from lcp_piles.methods.float_state import float_solution
from lcp_piles.methods.gauss_seidel import gauss_seidel
from lcp_piles.problems import degenerate
from lcp_piles.solution.record import make_record

PILES = {
    "nt60 5": nt60(5),
    "nt30 4 pushed": nt30(4, push=20),
    "nt30 3 pulled": nt30(3, push=-20),
    "tss 5": tss(5),
    "tbs 6": tbs(6),
    "stones resting": nt60(4, corner_stones="resting", floor_compliance="1/3"),
}
SCENES = pytest.mark.parametrize("scene", PILES.values(), ids=PILES.keys())
METHODS = {
    "fire": lambda system, **more: fire(system, **more),
    "gauss-seidel": lambda system, **more: gauss_seidel(system, **more),
}
BOTH = pytest.mark.parametrize("method", METHODS.values(), ids=METHODS.keys())


def whole_forces(system, run):
    """Forces (w) of every contact of the scene."""
    return float_solution(system, run, make_record(system, "", "", 0, ""), 0.0).force_array


@SCENES
@BOTH
def test_forces_of_relaxation_are_the_exact_ones(scene, method):
    system = contact_system(scene)
    run = method(system, tolerance=1e-10)
    exact = solve(scene).force_array
    assert run.converged
    assert run.residual <= 1e-10
    assert np.abs(whole_forces(system, run) - exact).max() < 1e-6 * exact.max()


@SCENES
@BOTH
def test_a_finer_tolerance_is_nearer(scene, method):
    system = contact_system(scene)
    exact = solve(scene).force_array
    errors = [
        np.abs(whole_forces(system, method(system, tolerance=t)) - exact).max()
        for t in (1e-3, 1e-6, 1e-9)
    ]
    assert errors[2] < 1e-2 * errors[0]
    assert errors[1] < errors[0]


@SCENES
@BOTH
def test_single_precision_reaches_single_precision(scene, method):
    system = contact_system(scene)
    run = method(system, tolerance=2e-6, dtype=np.float32)
    exact = solve(scene).force_array
    assert run.converged
    assert run.forces.dtype == np.float32
    error = np.abs(whole_forces(system, run) - exact).max() / exact.max()
    assert 1e-9 < error < 1e-3  # not float64 in disguise


@BOTH
@pytest.mark.parametrize("bad", [nt60(4).without([(4, 1)]), nt30(3).without([(3, 7)])])
def test_a_collapse_does_not_converge(method, bad):
    assert solve(bad).status == "unstable"  # a proof that is checked elsewhere
    limit = {"max_iterations": 3000} if method is METHODS["fire"] else {"max_sweeps": 800}
    assert not method(contact_system(bad), **limit).converged


def test_a_limit_is_no_convergence():
    system = contact_system(nt60(5))
    assert not fire(system, max_iterations=10).converged
    assert fire(system, max_iterations=10).steps == 10
    assert not gauss_seidel(system, max_sweeps=8).converged
    assert gauss_seidel(system, max_sweeps=8).steps == 8


def test_gauss_seidel_takes_rigid_contacts_and_fire_refuses_them():
    scene = nt60(5, floor_compliance=0, corner_stones="resting")
    system = contact_system(scene)
    run = gauss_seidel(system, tolerance=1e-9)
    assert run.converged
    exact = solve(scene).force_array
    np.testing.assert_allclose(whole_forces(system, run), exact, atol=1e-6)
    with pytest.raises(InputError, match="FIRE needs springs"):
        fire(system)


@pytest.mark.parametrize("stiffness", [0.5, 1.0, 10.0])
@pytest.mark.parametrize("sweeps", [1, 3, 10])
def test_gauss_seidel_ends_at_the_same_forces_with_any_time_step(stiffness, sweeps):
    system = contact_system(nt30(3))
    run = gauss_seidel(system, tolerance=1e-9, stiffness=stiffness, sweeps_per_step=sweeps)
    assert run.converged
    assert np.abs(whole_forces(system, run) - solve(nt30(3)).force_array).max() < 1e-6


@SCENES
def test_float_lemke_on_a_pile(scene):
    reduced = contact_lcp(contact_system(scene))
    run = float_lemke(*reduced.problem.floats())
    exact = lemke(reduced.problem)
    assert run.converged
    np.testing.assert_allclose(run.w, exact.w_vector.array(), atol=1e-11 * run.w.max())
    assert run.pivots == exact.pivots  # no tie on the way in these


@pytest.mark.parametrize("kind", ["nt60", "nt30", "tss", "tbs"])
def test_the_float_lcp_is_the_exact_one(kind):
    system = contact_system(pile(kind, 4))
    M, q = float_lcp(system)
    matrix, right = contact_lcp(system).problem.floats()
    # In physical units: gaps times the gap factor, forces (of one contact or a pair) divided by it.
    unit = np.array([float(f) for f in system.gap_factor])[system.factor_of]
    np.testing.assert_allclose(M * unit[:, None] * unit, matrix, atol=1e-12)
    np.testing.assert_allclose(q * unit, right, atol=1e-11)


def test_the_float_lcp_refuses_what_has_none():
    with pytest.raises(SolveError, match="rigid or bilateral"):
        float_lcp(contact_system(nt60(4, floor_compliance=0)))
    with pytest.raises(SolveError, match="a motion is free"):
        float_lcp(contact_system(nt30(2).without([(2, 1), (2, 4), (2, 2), (2, 3)])))


@pytest.mark.parametrize("seed", range(30))
def test_float_lemke_on_small_degenerate_problems(seed):
    case = degenerate(seed, 8, 3)
    run = float_lemke(*case.floats())
    assert run.status == "solved"
    w = np.array(case.w, dtype=float)
    np.testing.assert_allclose(run.w, w, atol=1e-9 * np.abs(case.floats()[1]).max())


def test_float_lemke_knows_a_ray_a_limit_and_nothing_to_do():
    ray = float_lemke([[-1.0]], [-1.0])  # w = -z - 1 is never positive
    assert (ray.status, ray.converged) == ("ray", False)
    limit = float_lemke([[2, 1], [1, 2]], [-5, -6], max_pivots=1)
    assert (limit.status, limit.pivots, limit.converged) == ("limit", 1, False)
    done = float_lemke([[2, 1], [1, 2]], [0, 3])
    assert (done.status, done.pivots, done.converged) == ("solved", 0, True)
    assert float_lemke(np.zeros((0, 0)), []).converged


def test_float_lemke_refuses_a_matrix_that_is_not_square():
    with pytest.raises(InputError, match="the shape of M"):
        float_lemke([[1, 2]], [1])
