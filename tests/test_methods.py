"""Every method of the registry, on the same scenes, by the same call."""

from dataclasses import replace

import numpy as np
import pytest
from endings import FLOAT, few_steps

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    contact_system,
    nt30,
    nt60,
    solve,
    tbs,
    verify,
)
from lcp_piles.methods.float_state import FloatState, unbalanced
from lcp_piles.methods.registry import METHODS

EVERY = pytest.mark.parametrize("method", METHODS.values(), ids=METHODS.keys())
ACCURACY = {"float64": 1e-7, "float32": 1e-4}
SCENES = {"nt60 4": nt60(4), "nt30 4 pushed": nt30(4, push=7), "tbs 4": tbs(4)}


@EVERY
@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_every_method_finds_the_forces(method, scene) -> None:
    """The reference is Lemke's method, which brute force checks elsewhere."""
    exact = solve(scene, "lemke")
    solution = solve(scene, method.name)
    assert solution.status == "solved"
    assert (solution.record.method, solution.record.arithmetic) == (method.name, method.arithmetic)
    assert solution.record.seconds > 0
    assert solution.states == exact.states
    check = verify(scene, solution)
    if method.arithmetic == "exact":
        assert list(solution.forces) == list(exact.forces)
        assert check.ok
    else:
        largest = exact.force_array.max()
        error = np.abs(solution.force_array - exact.force_array).max() / largest
        assert error < ACCURACY[method.arithmetic]
        reach = np.abs(exact.displacement_array).max()
        assert check.residual < ACCURACY[method.arithmetic] * max(largest, reach)
        assert (solution.gap_unique, solution.forces_unique, solution.stability) == ((), None, None)


@EVERY
def test_an_outcome_says_what_the_method_claims(method) -> None:
    system = contact_system(nt30(3))
    said: list[str] = []
    outcome = method.run(system, said.append)
    assert outcome.claim == "solved"
    assert outcome.steps >= 0
    if method.arithmetic == "exact":
        assert outcome.residual == 0
        return
    assert isinstance(outcome.state, FloatState)
    assert outcome.residual == outcome.state.residual
    assert outcome.steps == outcome.state.steps
    assert len(outcome.state.U) == system.dof
    assert len(outcome.state.closed) == len(outcome.state.gaps) == system.contacts
    assert unbalanced(system, outcome.state.forces) <= 2 * outcome.residual + 1e-15


@EVERY
def test_no_method_finds_forces_where_there_are_none(method) -> None:
    """An exact method proves the collapse or says that it gave up; floating point proves none."""
    scene = nt60(3).without([(3, 1), (3, 3)])
    if method.name == "lemke-float64":  # a ray, and a matrix that exists
        assert method.run(contact_system(nt60(4).without([(4, 1)]))).claim == "unresolved"
    with few_steps():
        solution = solve(scene, method.name)
    assert solution.status == ("unstable" if method.name in ("proved", "lemke") else "unresolved")
    assert solution.status == "unstable" or solution.record.proof.startswith("none: ")


@pytest.mark.parametrize("method", ["proved", "lemke", "z"])
def test_a_disc_that_is_blown_along_a_floor_flies(method) -> None:
    """It may move to the right or up, and the load drives it: 2 x - y > 0."""
    disc = Disc(1, (0, 1), (2, -1), (None, None))
    floor = Contact(1, "floor", (0, 1))
    solution = solve(Scene([disc], [floor], supports=("floor",)), method)
    assert solution.status == "unstable"
    assert "motion" in solution.record.proof
    x, y = solution.collapse
    assert y >= 0
    assert 2 * x - y > 0


@pytest.mark.parametrize("method", FLOAT)
@pytest.mark.parametrize("push", ["1e400", "1e39"])
def test_numbers_beyond_floats_are_no_error(method, push) -> None:
    """float32 ends at 3.4e38, float64 at 1.8e308."""
    arithmetic = METHODS[method].arithmetic
    with few_steps():
        solution = solve(nt60(3, push=push), method)
    if push == "1e400" or arithmetic == "float32":
        told = f"none: the scene has numbers beyond the range of {arithmetic}"
        assert (solution.status, solution.record.proof) == ("unresolved", told)
        assert solution.record.pivots == 0
    else:
        assert "the range of" not in solution.record.proof


@EVERY
@pytest.mark.parametrize("floor", ["0", "1"])
def test_a_method_without_a_form_for_a_scene_says_so(method, floor) -> None:
    scene = nt60(3, floor_compliance=floor)
    if floor == "1":
        scene = replace(scene, contacts=tuple(replace(c, bilateral=True) for c in scene.contacts))
    solution = solve(scene, method.name)
    springs_only = method.name.startswith("lemke-float") or (method.name == "fire" and floor == "0")
    assert solution.status == ("unresolved" if springs_only else "solved")
    assert "rigid" in solution.record.proof or not springs_only


def test_unknown_methods_are_refused_with_all_names() -> None:
    with pytest.raises(InputError, match="one of proved, lemke, z, newton, fire, gauss-seidel"):
        solve(nt60(2), "simplex")
