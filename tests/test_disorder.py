"""Random initial gaps: the draws, and the proof of a sample against exact arithmetic."""

from __future__ import annotations

import hashlib
from math import erf, sqrt

import numpy as np
import pytest
from scipy import stats

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Normal,
    Radii,
    Scene,
    SolveError,
    Uniform,
    bilateral,
    drawn,
    nt30,
    nt60,
    pile_family,
    proved_sample,
    pyramid,
    silo,
    solve,
    tbs,
    tss,
)
from lcp_piles.disorder import draws
from lcp_piles.disorder.bounds import fixed_points, held_state
from lcp_piles.disorder.draws import UNIT, Disorder, sample_words
from lcp_piles.disorder.gap_grid import drawn_steps, gap_grid, step_floats
from lcp_piles.disorder.pinned import pinned_springs
from lcp_piles.methods.newton import minimum
from lcp_piles.solution.solution import Solved


def gaps(scene: Scene) -> list[str]:
    return [str(contact.gap) for contact in scene.contacts]


def test_a_sample_is_the_same_whatever_was_drawn_before() -> None:
    scene = nt30(3)
    alone = gaps(drawn(scene, Uniform(5), seed=2, k=7))
    for k in range(9):
        again = gaps(drawn(scene, Uniform(5), seed=2, k=k))
        assert (again == alone) == (k == 7)
    assert gaps(drawn(scene, Uniform(5), seed=3, k=7)) != alone


@pytest.mark.parametrize(
    ("disorder", "digest"),
    [
        (Uniform("1/3"), "991fe7db12ad4ba8"),
        (Normal(2), "a49350df4c62486a"),
        (Radii(10), "95913bda9088780b"),
    ],
    ids=["uniform", "normal", "radii"],
)
def test_the_draws_stay_what_they_are(disorder: Disorder, digest: str) -> None:
    """Recorded once: whoever changes them changes every ensemble that anybody has published."""
    found = hashlib.sha256("\n".join(gaps(drawn(nt30(4), disorder, 1, 5))).encode()).hexdigest()
    assert found[:16] == digest


def test_uniform_draws_are_uniform() -> None:
    x = draws._uniform(sample_words(1, 0)(100_000)) / UNIT
    assert stats.kstest(x, stats.uniform(-1, 2).cdf).pvalue > 1e-3
    assert -1 <= x.min() < -0.9999 < 0.9999 < x.max() < 1


def test_normal_draws_are_those_of_the_distribution_cut_off_at_three() -> None:
    x = draws._normal(sample_words(1, 0)(100_000)) / UNIT
    assert stats.kstest(x, stats.truncnorm(-3, 3).cdf).pvalue > 1e-3
    assert np.abs(x).max() < 3


def test_a_near_tie_of_a_normal_draw_is_decided_exactly() -> None:
    """The quantile of u is below t just where the distribution at t is above u; erf says that."""
    for twice in (1, -5, 2 * UNIT + 1, -3 * UNIT // 2 * 2 + 1):
        t = twice / (2 * UNIT)
        at = (erf(t / sqrt(2)) + erf(3 / sqrt(2))) / (2 * erf(3 / sqrt(2)))
        odd = int(at * 2**53) | 1
        assert draws._past(odd + 2**20, twice) is True
        assert draws._past(odd - 2**20, twice) is False


def test_gaps_of_radii_are_minus_the_sums_of_two() -> None:
    """Over a triangle of contacts the three gaps give all three radii, and the fourth the sum."""
    scene, amplitude = tss(4), 6
    made = drawn(scene, Radii(amplitude), seed=4, k=0)
    radius = {
        disc.id: float(x) / UNIT * amplitude
        for disc, x in zip(
            scene.discs, draws._uniform(sample_words(4, 0)(len(scene.discs))), strict=True
        )
    }
    for contact in made.contacts:
        wanted = -(radius[contact.a] + radius.get(contact.b, 0.0))
        # Rounded to a multiple of sqrt(s) amplitude / UNIT.
        assert abs(float(contact.gap) - wanted) < 2 * amplitude / UNIT


def test_gaps_keep_one_radicand() -> None:
    solution = solve(drawn(nt30(3), Radii(20), seed=0, k=0), whole=True)
    assert isinstance(solution, Solved)
    assert all(
        len(solution.force(c.a, c.b).as_ordered_terms()) == 1 for c in solution.scene.contacts
    )


SCENES = {
    "nt30": nt30(5),
    "nt30 pushed": nt30(4, push="20"),
    "nt60": nt60(6),
    "tss": tss(6),
    "tbs": tbs(6),
    "silo": silo(4, 3),
    "spheres": pyramid(3),
    "compliances": nt60(4, floor_compliance="1/1000"),
}


@pytest.mark.parametrize("amplitude", ["1/100", "1", "10", "1000"])
@pytest.mark.parametrize("name", SCENES)
def test_a_sample_agrees_with_exact_arithmetic(name: str, amplitude: str) -> None:
    scene = SCENES[name]
    family = pile_family(scene)
    for k, disorder in enumerate((Uniform(amplitude), Normal(amplitude), Radii(amplitude))):
        sample = proved_sample(family, disorder, seed=11, k=k)
        exact = solve(drawn(scene, disorder, seed=11, k=k), whole=True)
        assert isinstance(exact, Solved)
        assert [state == "closed" for state in exact.states] == sample.closed.tolist()
        assert np.abs(sample.forces - exact.force_array).max() <= sample.error * (1 + 1e-9)
        assert sample.error < 1e-5 * max(1.0, np.abs(sample.forces).max())
        assert sample.mechanisms == exact.stability.mechanisms
        assert sample.verdict == exact.stability.verdict


def test_the_fast_road_serves_ordinary_piles_at_every_amplitude() -> None:
    family = pile_family(nt30(6))
    roads = [
        proved_sample(family, Uniform(a), seed=5, k=k).road
        for a in ("1/100", 1, 10, 100, 1000)
        for k in range(10)
    ]
    assert roads.count("proved") >= 0.95 * len(roads)


def test_rigid_contacts_take_the_exact_road() -> None:
    family = pile_family(nt60(3, floor_compliance=0))
    sample = proved_sample(family, Uniform(1), seed=0, k=0)
    assert sample.road == "exact"
    assert sample.error < 1e-14


def test_bilateral_contacts_may_pull() -> None:
    scene = bilateral(nt30(4))
    sample = proved_sample(pile_family(scene), Uniform(100), seed=0, k=0)
    exact = solve(drawn(scene, Uniform(100), seed=0, k=0), whole=True)
    assert sample.road == "proved"
    assert isinstance(exact, Solved)
    assert sample.forces.min() < 0
    assert np.abs(sample.forces - exact.force_array).max() <= sample.error


def test_a_force_that_is_exactly_zero_is_not_proved_by_floats() -> None:
    """Without disorder NT60 has contacts that just touch, which only exact arithmetic can tell."""
    sample = proved_sample(pile_family(nt60(3)), Uniform(0), seed=0, k=0)
    exact = solve(nt60(3), whole=True)
    assert isinstance(exact, Solved)
    assert "osculatory" in exact.states
    assert sample.road == "exact"
    assert [state == "closed" for state in exact.states] == sample.closed.tolist()


def test_a_sample_without_balance_says_so() -> None:
    ball = Disc("ball", (0, 0), (1, -1), (None, None))
    scene = Scene([ball], [Contact("ball", "floor", (0, 1))])
    with pytest.raises(SolveError, match="sample 3 of seed 8 is unstable"):
        proved_sample(pile_family(scene), Uniform(1), seed=8, k=3)


def test_bounds_hold_for_displacements_that_are_off(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without corrections the state is that of displacements off by a millionth."""
    scene, disorder = nt60(6), Uniform("1/10")
    springs = pile_family(scene).springs
    assert springs is not None
    exact = solve(drawn(scene, disorder, seed=1, k=0), whole=True)
    assert isinstance(exact, Solved)
    closed = np.array([state == "closed" for state in exact.states])
    pinned = pinned_springs(springs, closed)
    assert pinned is not None
    assert not len(pinned.pins)
    steps = drawn_steps(scene, gap_grid(scene), disorder, seed=1, k=0)
    o = springs.gap + step_floats(gap_grid(scene), steps, disorder.amplitude)
    near = minimum(springs.energy, o, springs.start)
    monkeypatch.setattr("lcp_piles.disorder.bounds._ROUNDS", 1)
    rng = np.random.default_rng(0)
    for size in (1e-6, 1e-9):
        off = near.U + size * rng.standard_normal(len(near.U))
        points = fixed_points(springs.integers, steps, disorder.amplitude, off)
        assert points is not None
        state = held_state(springs, pinned, closed, points)
        wrong = np.abs(state.forces.middle - exact.force_array)
        assert (wrong <= state.forces.radius).all()
        assert wrong.max() > size / 10
        wrong = np.abs(state.gaps.middle - exact.gap_array)[~closed]
        assert (wrong <= state.gaps.radius[~closed]).all()
        assert wrong.max() > size / 10


def test_a_loaded_motion_or_one_read_off_wrongly_proves_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = tss(4)
    springs = pile_family(scene).springs
    assert springs is not None
    a, _ = scene.ends
    every = np.ones(len(scene.contacts), dtype=bool)
    free = solve(scene, whole=True)
    assert isinstance(free, Solved)
    loaded = np.array([state == "closed" for state in free.states])
    found = pinned_springs(springs, loaded)
    assert found is not None
    assert free.stability is not None
    assert len(found.pins) == free.stability.mechanisms > 0
    # A disc that nothing below it bears falls.
    assert pinned_springs(springs, every & (a != len(scene.discs) // 2)) is None

    def doubled(X: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
        X[-2] += 1  # along a row, where no load works
        return np.ones(X.shape[1], dtype=np.int64)

    monkeypatch.setattr("lcp_piles.disorder.pinned.common_denominators", doubled)
    assert pinned_springs(springs, loaded) is None


@pytest.mark.parametrize("value", [-1, 0.5, "sqrt(2)", float("nan"), None])
def test_amplitudes_that_are_none(value: object) -> None:
    with pytest.raises(InputError, match="the amplitude"):
        Uniform(value)  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [-1, 0.5, True, "1"])
def test_seeds_and_numbers_that_are_none(value: object) -> None:
    with pytest.raises(InputError, match="the seed"):
        drawn(nt60(2), Uniform(1), seed=value, k=0)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="the number of a sample"):
        drawn(nt60(2), Uniform(1), seed=0, k=value)  # type: ignore[arg-type]
