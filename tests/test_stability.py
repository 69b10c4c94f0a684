"""Mechanisms and the verdict, against singular values of the whole pile's matrix."""

import numpy as np
import pytest
from helpers import float_matrix, nullity
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import pile, solve

PILES = [f"tss-{n}" for n in range(2, 11)] + [f"nt30-{n}" for n in range(2, 11)]
PILES += [f"nt60-{n}" for n in range(2, 8)] + [f"tbs-{n}" for n in range(1, 6)]


def named(name, **parameters):
    kind, layers = name.split("-")
    return pile(kind, int(layers), **parameters)


def assert_stability_by_singular_values(solution):
    scene, found = solution.scene, solution.stability
    B, _, _ = float_matrix(scene)
    states = np.array(solution.states)
    touching = B[states != "open"]
    assert found.mechanisms == nullity(B[states == "closed"])
    assert found.free == nullity(touching)
    # The free motions, and what they do across the loaded contacts between discs.
    _, sizes, directions = np.linalg.svd(touching)
    motions = directions[int((sizes > 1e-9).sum()) :]
    free = np.array([h is None for disc in scene.discs for h in disc.held])
    u = np.zeros((len(motions), len(free)))
    u[:, free] = motions
    u = u.reshape(len(motions), len(scene.discs), scene.dimension)
    a, b = scene.ends
    between = (states == "closed") & (b >= 0)
    slip = np.abs(u[:, a[between]] - u[:, b[between]]).max(initial=0.0)
    verdict = "stable" if not len(motions) else "saddle" if slip > 1e-9 else "neutral"
    assert found.verdict == verdict
    moved = np.abs(B @ motions.T).max(axis=1, initial=0.0) > 1e-9
    assert list(solution.gap_unique) == (~moved).tolist()


@pytest.mark.parametrize("method", ["proved", "lemke"])
@pytest.mark.parametrize("name", PILES)
def test_mechanisms_and_verdict_of_the_piles(name, method):
    assert_stability_by_singular_values(solve(named(name), method))


@pytest.mark.parametrize("name", PILES[::3])
def test_both_halves_together_are_the_whole_pile(name):
    half, whole = solve(named(name)), solve(named(name), whole=True)
    assert half.record.part == "even"
    assert whole.record.part == "whole"
    assert half.stability == whole.stability
    assert half.states == whole.states
    assert half.gap_unique == whole.gap_unique


@settings(max_examples=15)
@given(
    st.sampled_from(["tss-4", "tss-5", "nt30-3", "nt60-5"]),
    st.integers(-40, 40),
    st.sampled_from([0, 1]),
    st.sampled_from(["held", "resting"]),
)
def test_mechanisms_of_pushed_and_pulled_piles(name, push, floor, corner_stones):
    scene = named(name, push=push, floor_compliance=floor, corner_stones=corner_stones)
    assert_stability_by_singular_values(solve(scene))


def test_nt30_is_stable_below_seven_layers_and_mostly_a_saddle_from_there_on():
    """Ten layers are an exception, which the singular values above confirm."""
    counts = {layers: solve(pile("nt30", layers)).stability.mechanisms for layers in range(2, 14)}
    assert [layers for layers, count in counts.items() if count] == [7, 8, 9, 11, 12, 13]


def test_tss_has_mechanisms_from_three_layers_on():
    assert solve(pile("tss", 2)).stability.mechanisms == 0
    for layers in range(3, 12):
        assert solve(pile("tss", layers)).stability.verdict == "saddle"


def test_the_mechanism_of_tss_3_is_antisymmetric():
    """All 8 contacts are closed, and the symmetric half alone has 4 freedoms and no mechanism."""
    solution = solve(pile("tss", 3))
    assert solution.count("closed") == 8
    assert solution.stability.mechanisms == 1
    B, _, _ = float_matrix(solution.scene)
    motion = np.linalg.svd(B)[2][-1].reshape(-1, 2)  # free discs (1,1), (2,1), (2,2), (3,2)
    assert np.abs(B @ motion.ravel()).max() < 1e-12
    image = motion[[0, 2, 1, 3]] * [-1, 1]
    assert np.allclose(image, -motion)


def test_an_indefinite_scene_is_undecided():
    assert solve(pile("nt30", 4, floor_compliance="-1/2")).stability.verdict == "undecided"
