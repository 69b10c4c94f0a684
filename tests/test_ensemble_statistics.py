"""Statistics of ensembles: against plain calculations, and against distributions that are known."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from math import exp
from pathlib import Path

import numpy as np
import pytest

from lcp_piles import (
    Contact,
    Disc,
    Scene,
    Solved,
    Uniform,
    drawn,
    ensemble,
    nt30,
    nt60,
    pyramid,
    solve,
    tbs,
)
from lcp_piles.ensembles import force_distribution as ends
from lcp_piles.ensembles.ensemble import Ensemble
from lcp_piles.ensembles.observables import central_dip, observables
from lcp_piles.ensembles.parts import all_lines
from lcp_piles.ensembles.statistics import Statistics, statistics_of
from lcp_piles.ensembles.tally import REPLICATES, tally
from lcp_piles.errors import FileFormatError
from lcp_piles.fields.base_pressure import base_pressure
from lcp_piles.fields.depressions import dip
from lcp_piles.fields.stress import stress

SAMPLES = 60


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Ensemble:
    with ThreadPoolExecutor(1) as pool:
        folder = tmp_path_factory.mktemp("samples")
        return ensemble(nt30(4), Uniform(20), SAMPLES, seed=2, executor=pool, out=folder)


@pytest.fixture(scope="module")
def solved() -> list[Solved]:
    """The same samples by exact arithmetic."""
    found = [solve(drawn(nt30(4), Uniform(20), seed=2, k=k), whole=True) for k in range(SAMPLES)]
    assert all(isinstance(solution, Solved) for solution in found)
    return found  # type: ignore[return-value]


def statistics(made: Ensemble) -> Statistics:
    assert made.statistics is not None
    return made.statistics


def test_numbers_are_plain_means_over_exact_solutions(made: Ensemble, solved: list[Solved]) -> None:
    found = statistics(made)
    closed = [solution.count("closed") for solution in solved]
    stabilities = [solution.stability for solution in solved]
    freedoms = sum(held is None for disc in nt30(4).discs for held in disc.held)
    numbers = {name: float(estimate.value) for name, estimate in found.numbers.items()}
    assert numbers["contacts with force"] == pytest.approx(np.mean(closed))
    assert numbers["contacts less freedoms"] == pytest.approx(np.mean(closed) - freedoms)
    mechanisms = np.mean([s.mechanisms for s in stabilities if s is not None])
    assert numbers["mechanisms"] == pytest.approx(mechanisms)
    assert numbers["self-stresses"] == pytest.approx(np.mean(closed) - freedoms + mechanisms)
    saddles = np.mean([s is not None and s.verdict == "saddle" for s in stabilities])
    assert numbers["share of saddles"] == pytest.approx(saddles)


def test_fields_are_plain_means_over_exact_solutions(made: Ensemble, solved: list[Solved]) -> None:
    found = statistics(made)
    normal = np.array([[float(p.normal) for p in base_pressure(s)] for s in solved])
    forces = np.array([s.force_array for s in solved])
    tensors = np.array([np.pi * stress(s).array for s in solved])
    assert found.base_pressure.value == pytest.approx(normal.mean(axis=0), abs=1e-8)
    assert found.base_spread.value == pytest.approx(normal.std(axis=0), abs=1e-6)
    assert found.forces.value == pytest.approx(forces.mean(axis=0), abs=1e-8)
    assert found.force_spread.value == pytest.approx(forces.std(axis=0), abs=1e-6)
    assert found.closing.value == pytest.approx((forces > 0).mean(axis=0))
    wanted = tensors[:, :, [0, 0, 1], [0, 1, 1]].reshape(SAMPLES, -1)
    assert found.stress.value == pytest.approx(wanted.mean(axis=0), abs=1e-8)
    assert found.stress_spread.value == pytest.approx(wanted.std(axis=0), abs=1e-6)


def test_correlations_are_those_of_numpy(made: Ensemble, solved: list[Solved]) -> None:
    scene = nt30(4)
    forces = np.array([s.force_array for s in solved])
    covariance = np.cov(forces.T, bias=True)
    at = {disc.id: np.array([float(x) for x in disc.position]) for disc in scene.discs}
    points = [at[c.a] - np.array([float(x) for x in c.normal]) for c in scene.contacts]
    steps: dict[int, list[float]] = {}
    for i, p in enumerate(points):
        for j in range(i):
            nearest = int(np.linalg.norm(p - points[j]) + 0.5)
            steps.setdefault(nearest, []).append(covariance[i, j])
    found = statistics(made).correlation.value * covariance.trace() / len(forces.T)
    counts = statistics(made).observables.pairs.counts
    for step in range(1, 12):
        assert len(steps[step]) == counts[step]
        assert found[step] == pytest.approx(np.mean(steps[step]), abs=1e-9)


def test_the_dip_of_the_middle_is_that_of_the_profile_without_disorder() -> None:
    for scene in (nt30(6), nt30(9), nt30(6, push=28), tbs(5), nt60(7)):
        solution = solve(scene)
        assert isinstance(solution, Solved)
        profile = base_pressure(solution)
        found = dip(profile)
        depth = central_dip(observables(scene).base, np.array([[float(p.normal) for p in profile]]))
        if found is None:
            assert depth[0] <= 1e-12
        elif found.under_apex:
            assert depth[0] >= float(found.depth) - 1e-12


def test_bands_are_as_wide_as_the_standard_error() -> None:
    """For a mean of n independent numbers 1.96 sigma / sqrt(n), to the noise of 200 replicates."""
    x = np.random.default_rng(0).exponential(size=(4000, 3))
    chunks = ((list(range(i, i + 100)), {"x": x[i : i + 100]}) for i in range(0, 4000, 100))
    found = tally(chunks, seed=1)
    assert found is not None
    estimate = found.mean("x")
    assert estimate.value == pytest.approx(x.mean(axis=0))
    assert estimate.error == pytest.approx(1.96 * x.std(axis=0) / 4000**0.5, rel=0.25)


def test_a_tally_does_not_depend_on_chunks() -> None:
    x = np.random.default_rng(0).integers(0, 1000, size=(90, 2)).astype(float)

    def by(size: int) -> object:
        chunks = (
            (list(range(i, min(i + size, 90))), {"x": x[i : i + size]}) for i in range(0, 90, size)
        )
        found = tally(chunks, seed=1)
        assert found is not None
        return found.sums.tolist(), found.replicates.tolist(), found.weights.tolist()

    assert by(1) == by(7) == by(90)


def known(make: object, samples: int = 400, contacts: int = 200, seed: int = 0) -> Statistics:
    """Statistics of independent forces of a known distribution, on contacts of some scene."""
    scene = nt60(16)
    rng = np.random.default_rng(seed)
    count = len(scene.contacts)
    lines = [
        json.dumps(
            {
                "k": k,
                "forces": make(rng, count).tolist(),  # type: ignore[operator]
                "error": 0.0,
                "mechanisms": 0,
                "verdict": "stable",
                "road": "proved",
            }
        )
        for k in range(samples)
    ]
    found = statistics_of(scene, 0, lines)
    assert found is not None
    return found


def test_exponential_forces_are_found_to_be_that() -> None:
    """P(x) = exp(-x): beta = 1, and P is flat below, alpha = 0 to the slope of exp(-x)."""
    found = known(lambda rng, count: rng.exponential(size=count))
    tail = found.exponential_tail
    assert tail.parameter.low < 1.003
    assert tail.parameter.high > 0.997
    assert tail.distance < 0.01
    assert tail.p_value > 0.01
    assert found.normal_tail.p_value < 0.01
    assert float(found.small_forces.parameter.value) == pytest.approx(-0.02, abs=0.03)


def test_forces_of_a_half_normal_distribution_are_found_to_be_that() -> None:
    """|g| of deviation s has mean s sqrt(2 / pi), so gamma = 1 / (2 s^2) = 1 / pi with mean one."""
    found = known(lambda rng, count: np.abs(rng.standard_normal(count)), seed=1)
    tail = found.normal_tail
    assert float(tail.parameter.value) == pytest.approx(1 / np.pi, rel=0.02)
    assert tail.p_value > 0.01
    assert found.exponential_tail.p_value < 0.01


@pytest.mark.parametrize("alpha", [-0.5, 0.5, 2.0])
def test_the_exponent_of_small_forces_is_found(alpha: float) -> None:
    """f = u^(1 / (1 + alpha)) has the density (1 + alpha) f^alpha on (0, 1)."""
    found = known(lambda rng, count: rng.random(count) ** (1 / (1 + alpha)))
    fit = found.small_forces
    assert float(fit.parameter.low) - 0.02 < alpha < float(fit.parameter.high) + 0.02
    assert fit.p_value > 0.001


def test_p_values_are_uniform_where_the_distribution_is_right() -> None:
    values = [
        known(
            lambda rng, count: rng.exponential(size=count), samples=60, seed=s
        ).exponential_tail.p_value
        for s in range(12)
    ]
    assert min(values) < 0.8
    assert max(values) > 0.2
    assert np.mean(values) == pytest.approx(0.5, abs=0.35)


def test_the_density_integrates_to_one(made: Ensemble) -> None:
    density = statistics(made).density
    assert float(density.value @ np.diff(ends.EDGES)) == pytest.approx(1.0)
    assert (density.low <= density.value + 1e-12).all()


def test_the_mean_of_a_normal_tail() -> None:
    """<x^2> of exp(-gamma x^2) beyond t by quadrature is what the fit is solved for."""
    from scipy.integrate import quad

    t = ends.TAIL

    def part(x: float, power: int, gamma: float) -> float:
        return x**power * exp(-gamma * (x * x - t * t))

    for gamma in (0.05, 0.3, 2.0):
        over, under = (quad(part, t, t + 40, args=(power, gamma))[0] for power in (2, 0))
        sums = np.array([0.0, 0.0, 1.0, 1.0, over / under])
        assert ends.tail_square(sums) == pytest.approx(gamma, rel=1e-6)


def test_a_scene_in_space_has_numbers_and_no_base() -> None:
    with ThreadPoolExecutor(1) as pool:
        found = ensemble(pyramid(2), Uniform(1), 5, executor=pool)
    assert found.statistics is not None
    assert "share with a dip" not in found.statistics.numbers
    assert not found.statistics.base_pressure.value.size


@pytest.mark.parametrize(
    "change", [{"forces": [1.0]}, {"forces": "x"}, {"error": None}, {"verdict": ...}]
)
def test_lines_of_another_scene_are_refused(change: dict[str, object], made: Ensemble) -> None:
    assert made.folder is not None
    content = json.loads(next(all_lines(Path(made.folder)))) | change
    line = json.dumps({name: value for name, value in content.items() if value is not ...})
    for bad in (line, line[:-3] + "}"):
        with pytest.raises(FileFormatError, match="one of 1 samples"):
            statistics_of(nt30(4), 0, [bad])


def test_a_scene_of_one_disc_has_no_spread() -> None:
    """A disc on a floor presses on it with its weight, whatever the gap."""
    ball = Disc("ball", (0, 0), (0, -1), (0, None))
    scene = Scene([ball], [Contact("ball", "floor", (0, 1))])
    with ThreadPoolExecutor(1) as pool:
        found = ensemble(scene, Uniform(5), 40, executor=pool).statistics
    assert found is not None
    assert found.forces.value.tolist() == pytest.approx([1.0])
    assert found.force_spread.value.tolist() == pytest.approx([0.0], abs=1e-6)
    assert len(found.tally.weights) == REPLICATES
