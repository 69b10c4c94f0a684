"""Full Newton steps against exact solutions, and the piles that they are not for."""

from __future__ import annotations

import numpy as np
import pytest

from lcp_piles import Scene, contact_system, nt30, nt60, solve, tbs, tss
from lcp_piles.methods.full_steps import full_steps
from lcp_piles.methods.proved import float_guess


@pytest.mark.parametrize("scene", [nt30(5), nt60(8), tbs(9), nt30(4, push="20")], ids=str)
def test_forces_are_the_exact_ones(scene: Scene) -> None:
    system = contact_system(scene)
    found, exact = full_steps(system), solve(scene, "lemke")
    assert found is not None
    assert found.converged
    forces = (found.forces / system.reduction.weight)[system.reduction.contact]
    assert np.abs(forces - exact.force_array).max() < 1e-9 * exact.force_array.max()
    off = np.abs(found.gaps[system.reduction.contact] - exact.gap_array)
    assert off[np.array(exact.gap_unique)].max() < 1e-8 * max(1.0, exact.gap_array.max())


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(nt30(7), id="a mechanism at the end"),
        pytest.param(nt30(6), id="a cycle"),
        pytest.param(nt30(8), id="contacts without force that hold a mechanism"),
        pytest.param(tss(6), id="contacts that only touch"),
        pytest.param(nt60(8, floor_compliance="0"), id="a rigid floor"),
        pytest.param(nt30(20), id="too large"),
        pytest.param(nt60(2).without([(2, 2)]), id="a collapse"),
    ],
)
def test_what_they_do_not_serve_for_is_left_to_the_safe_method(scene: Scene) -> None:
    system = contact_system(scene)
    assert full_steps(system) is None
    assert len(float_guess(system).closed) == system.contacts
