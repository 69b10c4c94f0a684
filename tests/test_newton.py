"""Newton's method against exact solutions, its own energy, and scenes that fall or cycle."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest
from helpers import float_matrix, piles
from hoppers import hopper
from hypothesis import given, settings
from scipy.sparse import csr_array

from benchmarks.comparison.scenes import nearly_equal
from lcp_piles import Scene, contact_system, nt30, nt60, pile, silo, solve, tbs, tss, verify
from lcp_piles.linear.stiffness import stiffness
from lcp_piles.methods.newton import Energy, _weights, newton
from lcp_piles.numbers.exact import ZERO
from lcp_piles.problems import grain_scene


def relative_error(solution: object, exact: object) -> float:
    difference = np.abs(solution.force_array - exact.force_array).max()
    return float(difference / exact.force_array.max())


SCENES = [
    pytest.param(pile(kind, N, **parameters), id=f"{kind}-{N}-{'-'.join(parameters.values())}")
    for kind, N, parameters in [
        ("nt30", 6, {}),
        ("nt30", 6, {"push": "200"}),
        ("nt30", 6, {"push": "-200"}),
        ("nt30", 7, {"push": "667/6*sqrt(3)"}),
        ("nt30", 10, {}),
        ("nt30", 5, {"push": "1000000"}),
        ("nt30", 5, {"push": "-1000000"}),
        ("nt60", 9, {}),
        ("nt60", 9, {"push": "50", "corner_stones": "resting"}),
        ("tss", 11, {}),
        ("tss", 10, {"push": "100"}),
        ("tbs", 12, {}),
        ("nt30", 6, {"floor_compliance": "0"}),
        ("nt60", 8, {"floor_compliance": "0", "push": "30"}),
        ("tss", 8, {"floor_compliance": "0", "push": "-30"}),
        ("nt30", 6, {"floor_compliance": "1/1000"}),
        ("nt30", 6, {"floor_compliance": "1000"}),
    ]
]


@pytest.mark.parametrize("scene", SCENES)
def test_forces_are_the_exact_ones(scene: Scene) -> None:
    """Bilateral mechanisms, large pushes and a rigid floor among them."""
    exact, solution = solve(scene, "lemke"), solve(scene, "newton")
    assert solution.status == "solved"
    # A force is a difference of displacements: their rounding is the floor of its error.
    error = np.abs(solution.force_array - exact.force_array).max()
    reach = np.abs(exact.displacement_array).max()
    assert error < 1e-12 * exact.force_array.max() + 1e-14 * reach
    check = verify(scene, solution)
    assert not check.exact
    assert check.residual < 1e-12 * max(1, np.abs(solution.displacement_array).max())
    assert (solution.record.method, solution.record.arithmetic) == ("newton", "float64")
    assert solution.record.proof == "none: floating point"
    assert solution.stability is None


@pytest.mark.parametrize("scene", SCENES)
def test_states_are_the_exact_ones_where_gaps_are_unique(scene: Scene) -> None:
    exact, solution = solve(scene, "lemke"), solve(scene, "newton")
    for one, other, unique in zip(exact.states, solution.states, exact.gap_unique, strict=True):
        assert one == other or not unique
        assert (one == "closed") == (other == "closed")


@given(piles(rigid=False))
@settings(max_examples=15)
def test_any_elastic_pile(scene: Scene) -> None:
    assert relative_error(solve(scene, "newton"), solve(scene)) < 1e-11


@given(piles())
@settings(max_examples=15)
def test_any_pile_satisfies_its_equations(scene: Scene) -> None:
    """Rigid floors too, whose forces need not be unique."""
    solution = solve(scene, "newton")
    assert solution.status == "solved"
    residual = verify(scene, solution).residual
    assert residual < 1e-10 * max(1, np.abs(solution.displacement_array).max())


@pytest.mark.parametrize(
    ("kind", "layers"), [("nt30", 30), ("nt60", 30), ("tss", 40), ("tbs", 60), ("tbs", 100)]
)
def test_large_piles(kind: str, layers: int) -> None:
    pushes = [0] if kind == "tbs" else [0, 20, 200, -200]
    for push in pushes:
        system = contact_system(pile(kind, layers, push=push))
        result = newton(system)
        assert result.converged
        assert result.residual < 1e-12
        assert result.steps < 40  # the plain Hessian takes up to 80
        # The residual again, from the system's own arrays.
        B, C, o, p = system.floats()
        scale = np.abs(result.forces).max()
        assert np.abs(B.T @ result.forces + p).max() < 1e-12 * scale
        hooke = result.gaps - (B @ result.U + o + C * result.forces)
        assert np.abs(hooke).max() < 1e-12 * max(1, np.abs(result.U).max())
        assert result.forces.min() >= 0
        assert result.gaps.min() >= 0
        assert not (result.forces * result.gaps).any()


def energy(scene: Scene, u: np.ndarray) -> float:
    """The elastic energy less the work of the load, from the normals of the whole scene."""
    B, o, p = float_matrix(scene)
    overlap = -(B @ u + o)
    one_sided = np.array([not contact.bilateral for contact in scene.contacts])
    overlap = np.where(one_sided, np.maximum(overlap, 0), overlap)
    c = np.array([float(contact.compliance) for contact in scene.contacts])
    return float((overlap**2 / c).sum() / 2 - p @ u)


@pytest.mark.parametrize(
    "scene", [pile("nt30", 5), tss(8, push=40), nt60(6, push=-5), tbs(6), grain_scene().scene]
)
def test_no_other_displacement_has_less_energy(scene: Scene) -> None:
    free = np.array([h is None for disc in scene.discs for h in disc.held])
    u = solve(scene, "newton").displacement_array.ravel()[free]
    least = energy(scene, u)
    random = np.random.default_rng(1)
    for size in (1e-3, 1e-1, 10.0, 1e3):
        for _ in range(20):
            other = energy(scene, u + size * random.normal(size=len(u)))
            assert other >= least - 1e-9 * abs(least)


def test_solves_the_grain_on_which_the_plain_iteration_cycles() -> None:
    solution = solve(grain_scene().scene, "newton")
    known = [float(force) for force in grain_scene().forces]
    assert solution.displacement_array[0] == pytest.approx([-26 / 21, 52 / 21], abs=1e-13)
    assert solution.force_array == pytest.approx(known, abs=1e-13)
    assert solution.states == ("closed", "closed", "open", "open", "closed")


def test_solves_the_pile_on_which_the_plain_iteration_cycles() -> None:
    scene = tss(6, push=95)  # test_z_algorithm has the cycle
    assert relative_error(solve(scene, "newton"), solve(scene, "lemke")) < 1e-12


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(nt60(5).without([(5, 1)]), id="no corner stone"),
        pytest.param(nt60(5).without([(5, 1), (5, 5)]), id="no corner stones"),
        pytest.param(nt60(5).without([(3, 1)]), id="hole in the flank"),
        pytest.param(tbs(5).without((6, j) for j in range(1, 7)), id="no upper support"),
        pytest.param(tbs(3).without((i, j) for i in (4, 5) for j in range(1, i + 1)), id="falls"),
        pytest.param(nt60(4, floor_compliance=0).without([(4, 1)]), id="rigid floor"),
    ],
)
def test_unstable_scene_is_unresolved_without_noise(scene: Scene) -> None:
    assert solve(scene, "lemke").status == "unstable"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solution = solve(scene, "newton")
    assert solution.status == "unresolved"
    assert not hasattr(solution, "forces")
    assert "no convergence" in solution.record.proof


def test_scene_without_freedoms() -> None:
    scene = tbs(1).without([(1, 1)])
    solution = solve(scene, "newton")
    assert (solution.status, len(solution.force_array)) == ("solved", 0)
    assert not solution.displacement_array.any()


def test_paper_floor_is_solved_or_said_not_to_be() -> None:
    """The energy is not convex there: only what is claimed has to hold."""
    claimed = 0
    for kind in ("nt30", "nt60", "tss"):
        for push in (0, 50, 200, 1000):
            scene = pile(kind, 6, push=push, floor_compliance="-1/2")
            solution = solve(scene, "newton")
            if solution.status == "solved":
                claimed += 1
                scale = max(1, np.abs(solution.displacement_array).max())
                assert verify(scene, solution).residual < 1e-12 * scale
            else:
                assert solution.status == "unresolved"
    assert claimed > 0
    # One with a known answer: Lemke's method solves it too.
    scene = pile("nt30", 6, push=50, floor_compliance="-1/2")
    assert relative_error(solve(scene, "newton"), solve(scene, "lemke")) < 1e-12


def test_half_and_whole_agree() -> None:
    scene = pile("nt30", 6, push=20)
    half, whole = solve(scene, "newton"), solve(scene, "newton", whole=True)
    assert np.allclose(half.force_array, whole.force_array, rtol=0, atol=1e-11)
    assert (half.record.part, whole.record.part) == ("even", "whole")


def test_result_is_reproducible() -> None:
    system = contact_system(pile("nt30", 8, push=33))
    first, second = newton(system), newton(system)
    assert np.array_equal(first.U, second.U)
    assert np.array_equal(first.forces, second.forces)


@pytest.mark.parametrize("seed", [*range(6), 15, 42])  # the last two end on a flat energy
def test_without_load_overlaps_alone_make_forces_or_none(seed: int) -> None:
    """Some of these relax until nothing is left, others keep a self-stress: exact pivots say so."""
    pile = nearly_equal(nt30(5), seed)
    nothing = tuple(replace(disc, load=(ZERO, ZERO)) for disc in pile.discs)
    scene = Scene(nothing, pile.contacts)
    solution, exact = solve(scene, "newton"), solve(scene, "lemke")
    assert solution.status == exact.status == "solved"
    assert np.abs(solution.force_array - exact.force_array).max() < 1e-12


def test_a_residual_that_underflows_is_no_division_by_zero() -> None:
    """Newton's method goes on below its tolerance as long as that pays, here to 4e-221."""
    B = csr_array(np.array([[1.0], [-1.0]]))
    energy = Energy(stiffness(B), np.ones(2), np.ones(1), np.zeros(2, dtype=bool), 1e-11, abs(B))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        shares = _weights(energy, np.array([0.0, 1.0]), 4e-221, 2.0)
    assert shares.tolist() == [0.5, 1.0]


RIGID = {"walls": "smooth", "wall_compliance": 0, "floor_compliance": 0}


@pytest.mark.parametrize(
    "scene", [silo(4, 10, **RIGID), silo(6, 50, **RIGID), hopper(3, 10), hopper(4, 20)]
)
def test_rigid_walls(scene: Scene) -> None:
    """Multipliers settle to what the rounding of large displacements allows, and that is enough."""
    result = newton(contact_system(scene))
    assert result.converged
    assert result.residual < 1e-10
    exact = solve(scene)
    assert exact.record.pivots == 0
    assert relative_error(solve(scene, "newton"), exact) < 1e-9
