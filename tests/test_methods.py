"""Every method of the registry, on the same scenes, by the same call."""

import numpy as np
import pytest

from lcp_piles import InputError, SolveError, contact_system, nt30, nt60, solve, tbs, verify
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
    try:
        solution = solve(scene, method.name)
    except SolveError:
        assert method.name.startswith("lemke-float")
        return
    assert solution.status == ("unstable" if method.name in ("proved", "lemke") else "unresolved")
    assert solution.status == "unstable" or solution.record.proof.startswith("none: ")


def test_unknown_methods_are_refused_with_all_names() -> None:
    with pytest.raises(InputError, match="one of proved, lemke, z, newton, fire, gauss-seidel"):
        solve(nt60(2), "simplex")
