"""Problems on which pivoting and Newton-min fail: the failure, and the exact answer beside it."""

import numpy as np
import pytest

from lcp_piles import lemke, solve, z_algorithm, z_lcp
from lcp_piles.methods.float_lemke import float_lemke
from lcp_piles.problems import (
    degenerate,
    fathi,
    gilbert,
    grain_scene,
    kostreva,
    murty,
    newton_min_definite,
)

PRECISIONS = pytest.mark.parametrize("dtype", [np.float64, np.float32])


@PRECISIONS
def test_without_a_rule_for_ties_lemke_cycles_for_ever(dtype):
    case = kostreva()
    runs = [float_lemke(*case.floats(), dtype=dtype, max_pivots=k) for k in range(1, 41)]
    assert all(run.status == "limit" and not run.converged for run in runs)
    bases = [tuple(run.basis) for run in runs]
    period = next(p for p in range(1, 20) if bases[20] == bases[20 + p])
    assert period > 1
    assert bases[5:-period] == bases[5 + period :]  # the same bases again and again
    exact = lemke(case.M, case.q)
    assert (exact.status, exact.z) == ("solved", case.z)


@pytest.mark.parametrize("n", [3, 5, 7, 9])
@pytest.mark.parametrize("family", [murty, fathi])
def test_lemke_takes_two_to_the_n_pivots(family, n):
    case = family(n)
    assert float_lemke(*case.floats()).pivots == 2**n
    exact = lemke(case.M, case.q)
    assert exact.pivots == 2**n  # exactness does not help against this
    assert (exact.z, exact.w) == (case.z, case.w)


@pytest.mark.parametrize("family", [murty, fathi])
def test_the_z_iteration_takes_n_steps_where_lemke_takes_two_to_the_n(family):
    case = family(14)
    assert float_lemke(*case.floats()).status == "limit"
    found = z_lcp(case.M, case.q)
    assert found.status == "solved"
    assert len(found.trace) == 15
    assert (found.z, found.w) == (case.z, case.w)


FALSE_RAYS = [(2, 12, 4, 4), (17, 12, 4, 2), (3, 16, 6, 3), (22, 16, 6, 3), (0, 20, 6, 3)]


@pytest.mark.parametrize("parameters", FALSE_RAYS, ids=str)
def test_float_lemke_reports_a_ray_of_a_problem_that_has_a_solution(parameters):
    case = degenerate(*parameters)
    assert float_lemke(*case.floats()).status == "ray"
    exact = lemke(case.M, case.q)
    assert exact.status == "solved"
    assert exact.w == case.w


@pytest.mark.parametrize("seed", [0, 5, 20])
def test_float_lemke_calls_a_wrong_answer_solved(seed):
    case = degenerate(seed, 12, 4, 4)
    run = float_lemke(*case.floats())
    assert run.converged  # its residual is small beside the largest entry of q
    assert np.abs(run.w - np.array(case.w, dtype=float)).max() > 0.5
    assert lemke(case.M, case.q).w == case.w


def test_single_precision_fails_on_degenerate_problems_that_double_precision_solves():
    seeds = range(40)
    cases = [degenerate(seed, 20, 6) for seed in seeds]
    wrong = {np.float64: 0, np.float32: 0}
    for case in cases:
        w = np.array(case.w, dtype=float)
        for kind in wrong:
            run = float_lemke(*case.floats(), dtype=kind)
            wrong[kind] += not (run.converged and np.abs(run.w - w).max() < 1e-2 * w.max())
    assert wrong[np.float64] == 0
    assert wrong[np.float32] > 3
    assert all(lemke(case.M, case.q).w == case.w for case in cases[:10])


def test_newton_min_cycles_on_a_p_matrix_and_on_a_definite_one():
    for case in (gilbert(), newton_min_definite()):
        assert z_lcp(case.M, case.q, [0]).status == "cycle"
        assert lemke(case.M, case.q).z == case.z


def test_newton_min_cycles_on_a_grain_between_three_walls():
    case = grain_scene()
    scene = case.scene
    for arithmetic in ("exact", "float64"):
        assert z_algorithm(scene, arithmetic=arithmetic).status == "cycle"
    for method in ("proved", "lemke", "newton"):  # full steps cycle; with a line search they do not
        wanted = [float(force) for force in case.forces]
        np.testing.assert_allclose(solve(scene, method).force_array, wanted, atol=1e-12)
