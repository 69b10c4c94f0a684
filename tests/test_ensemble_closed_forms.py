"""Ensembles whose statistics can be had by hand: one disc on two springs, and copies of forces."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from math import sqrt

import numpy as np
import pytest

from lcp_piles import Contact, Disc, Scene, Uniform, ensemble, nt60
from lcp_piles.ensembles.force_distribution import EDGES
from lcp_piles.ensembles.statistics import Statistics, statistics_of
from lcp_piles.ensembles.tally import Estimate

SAMPLES = 2000


@pytest.fixture(scope="module")
def on_two_springs() -> Statistics:
    """A disc of weight w that rests on two floors at once, whose gaps are uniform in [-1, 1].

    The springs share the weight: f1 + f2 = 1 and f1 - f2 = g2 - g1 = d while |d| < 1, beyond which
    one of them bears all. d has the density (2 - |d|) / 4 on [-2, 2].
    """
    ball = Disc("ball", (0, 0), (0, -1), (0, None))
    floors = [Contact("ball", name, (0, 1)) for name in ("floor", "shelf")]
    scene = Scene([ball], floors, supports=("floor", "shelf"))
    with ThreadPoolExecutor(1) as pool:
        found = ensemble(scene, Uniform(1), SAMPLES, seed=7, executor=pool).statistics
    assert found is not None
    return found


def assert_within(estimate: Estimate, truth: float) -> None:
    """Within twice the 95 per cent band, which is about four standard errors."""
    assert np.abs(estimate.value - truth).max() < 2 * estimate.error.max()


def test_the_share_of_closed_contacts_of_two_springs(on_two_springs: Statistics) -> None:
    """P(|d| < 1) = 3/4: both carry then, else one; a freedom, so 3/4 of a self-stress."""
    numbers = on_two_springs.numbers
    assert_within(numbers["contacts with force"], 7 / 4)
    assert_within(numbers["contacts less freedoms"], 3 / 4)
    assert_within(numbers["self-stresses"], 3 / 4)
    assert_within(on_two_springs.closing, 7 / 8)
    assert float(numbers["mechanisms"].value) == 0


def test_mean_and_spread_of_the_forces_of_two_springs(on_two_springs: Statistics) -> None:
    """<(f - 1/2)^2> is the integral of d^2 / 4 for |d| < 1, 5/96, and 1/4 of 1/4 beyond."""
    assert_within(on_two_springs.forces, 1 / 2)
    assert_within(on_two_springs.force_spread, sqrt(11 / 96))


def test_the_base_below_two_springs_bears_the_weight(on_two_springs: Statistics) -> None:
    assert on_two_springs.base_pressure.value == pytest.approx([1.0])
    assert on_two_springs.base_spread.value == pytest.approx([0.0], abs=1e-6)


def test_forces_that_add_up_to_the_weight_are_opposed(on_two_springs: Statistics) -> None:
    """f1 + f2 = 1 makes the correlation of the one pair -1, whatever the samples."""
    found = on_two_springs.correlation
    assert float(found.value[0]) == pytest.approx(-1.0)
    assert np.isnan(found.value[1:]).all()


def test_the_density_of_the_forces_of_two_springs(on_two_springs: Statistics) -> None:
    """A quarter of the samples has one force, x = 1; else x = 1 + d, of density (2 - |d|) / 3.

    Counted by force, 6/7 of them have that density on [0, 2] and 1/7 are at x = 1.
    """

    def share(a: float, b: float) -> float:
        inside = (EDGES[:-1] >= a * (1 - 1e-9)) & (EDGES[1:] <= b * (1 + 1e-9))
        return float((on_two_springs.density.value * np.diff(EDGES))[inside].sum())

    low, high = 10**-0.5, 10**0.25
    forces = 7 / 4 * SAMPLES
    # Of d from -1 to low - 1 the integral of (2 + d) / 3, and likewise from high - 1 to 1.
    below = 6 / 7 * (low + low**2 / 2) / 3
    above = 6 / 7 * ((2 - high) + (2 - high) ** 2 / 2) / 3
    for a, b, truth in ((1e-6, low, below), (high, 10.0, above), (low, high, 1 - below - above)):
        assert share(a, b) == pytest.approx(truth, abs=4 * sqrt(2 * truth * (1 - truth) / forces))


def copied(copies: int) -> Statistics:
    """Exponential forces on the contacts of some pile, in each sample so many copies of them."""
    scene = nt60(16)
    count, loaded = len(scene.contacts), len(scene.contacts) // 8 * 8
    random = np.random.default_rng(3)
    rest = {"error": 0.0, "mechanisms": 0, "verdict": "stable", "road": "proved"}
    lines = []
    for k in range(300):
        forces = np.zeros(count)
        forces[:loaded] = np.repeat(random.exponential(size=loaded // copies), copies)
        lines.append(json.dumps({"k": k, "forces": forces.tolist()} | rest))
    found = statistics_of(scene, 0, lines)
    assert found is not None
    return found


def test_forces_that_depend_on_each_other_widen_the_bands() -> None:
    """Eight copies of a force tell no more than one: errors are sqrt(8) times those without."""
    alone, together = copied(1), copied(8)
    for name in ("exponential_tail", "small_forces"):
        one, other = (getattr(found, name).parameter for found in (alone, together))
        assert float(other.error / one.error) == pytest.approx(sqrt(8), rel=0.3)
    # And the fit is not refused for it, as tables for independent numbers would have it.
    assert together.exponential_tail.p_value > 0.01
