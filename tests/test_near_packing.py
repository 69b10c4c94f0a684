"""Exact solutions of rational scenes near packings, and how far these are from each other."""

from fractions import Fraction
from itertools import pairwise
from math import pi

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from packed import ROOT3, heap_places, rough_lattice, settled, squeezed

from lcp_piles import (
    Contact,
    Disc,
    FileFormatError,
    InputError,
    Scene,
    from_contacts,
    load_scene,
    packing,
    prove_packing,
    rational_scene,
    save_scene,
    solve,
    solve_packing,
    stress,
    verify,
)
from lcp_piles.numbers.double_double import DoubleDouble
from lcp_piles.numbers.simplest import simplest_between
from lcp_piles.packings.geometry import unit_normals
from lcp_piles.packings.rational import unit_vector


@given(
    st.lists(st.floats(-1, 1), min_size=2, max_size=3).filter(lambda v: max(map(abs, v)) > 1e-3),
    st.sampled_from([1e-3, 1e-9, 1e-15, 1e-23]),
)
@mpmath.workdps(80)
def test_unit_vectors_are_rational_and_as_near_as_said(vector, angle: float) -> None:
    normal = unit_normals(DoubleDouble.of([vector]))[0][0]
    n = unit_vector(normal, angle)
    assert sum(x * x for x in n) == 1
    given_ = [mpmath.mpf(x) for x in vector]
    length = mpmath.sqrt(sum(x * x for x in given_))
    pairs = zip(n, given_, strict=True)
    chord = mpmath.sqrt(
        sum((mpmath.mpf(x.numerator) / x.denominator - y / length) ** 2 for x, y in pairs)
    )
    assert 2 * mpmath.asin(chord / 2) <= angle


@given(st.fractions(), st.fractions())
def test_no_fraction_between_has_a_smaller_denominator(one: Fraction, other: Fraction) -> None:
    """Against all denominators up to that found."""
    low, high = min(one, other), max(one, other)
    if low == high:
        return
    found = simplest_between(low, high)
    assert low <= found <= high
    for d in range(1, min(found.denominator, 300)):
        assert -(-low.numerator * d // low.denominator) > high * d


def test_what_is_level_stays_level() -> None:
    """A component that is zero: else discs that slide along that axis would lean on something."""
    normals, _ = unit_normals(DoubleDouble.of([[0.3, 0.9, 0.0], [0.0, -0.2, 0.7], [0, 0, -2]]))
    for k, zero in ((0, 2), (1, 0), (2, 0), (2, 1)):
        assert unit_vector(normals[k], 1e-4)[zero] == 0


def test_short_fractions_for_coarse_angles() -> None:
    assert unit_vector(DoubleDouble.of([0.6, -0.8]), 1e-3) == (Fraction(3, 5), Fraction(-4, 5))
    assert unit_vector(DoubleDouble.of([0.0, -1.0]), 1e-3) == (0, -1)


def test_the_settled_packing_both_ways() -> None:
    """All states equal, forces as near as the angle lets expect."""
    near = solve_packing(settled(), 1e-8)
    assert near.warning == ""
    assert near.differing == ()
    assert near.angle <= 1e-8
    largest = near.proof.forces.middle.max()
    assert near.force_change < 1e-6 * largest
    forces = np.maximum(-1e4 * near.packing.gaps.high, 0)
    assert np.abs(near.solution.force_array - forces).max() < 1e-5 * largest
    assert [state == "closed" for state in near.solution.states] == (forces > 0).tolist()
    assert verify(near.solution.scene, near.solution).ok


@pytest.mark.parametrize("seed", range(3))
def test_smaller_angles_are_nearer(seed: int) -> None:
    """The forces go to those of the packing with the angle, as fast as it does."""
    p = rough_lattice(3, 3, 1e-3, 100, seed)
    changes = [solve_packing(p, angle).force_change for angle in (1e-4, 1e-7, 1e-10, 1e-14)]
    assert changes[0] < 0.1
    assert all(b < a / 100 for a, b in pairwise(changes))


def test_a_period_and_rattlers_both_ways() -> None:
    near = solve_packing(squeezed(3, 0.95), 1e-7)
    assert near.warning == ""
    assert near.solution.stability.free > 1
    assert not near.solution.scene.geometric


def test_spheres_both_ways() -> None:
    base = [(0, 0, 0), (2, 0, 0), (1, ROOT3, 0)]
    p = packing(
        [*base, (1, 0.577, 1.63)], 1, held=[True] * 3 + [False], weights=[0, 0, 0, 1], stiffness=1e3
    )
    near = solve_packing(p, 1e-6)
    assert near.warning == ""
    assert near.force_change < 1e-4
    assert near.solution.force_array.sum() == pytest.approx(6**0.5 / 2, abs=1e-2)


@given(st.integers(0, 2**31))
@settings(max_examples=12, deadline=None)
def test_both_ways_agree_on_random_packings(seed: int) -> None:
    """Heaps of unlike discs in boxes with and without lids, some held, some weightless, in 2D, 3D.

    Most fall, some stand, a few come apart: the two ways share neither arithmetic nor contact sets.
    """
    rng = np.random.default_rng(seed)
    axes = int(rng.integers(2, 4))
    x = heap_places(axes, int(rng.integers(1, 5 - axes // 2)))
    x = x[rng.random(len(x)) > 0.1]
    if not len(x):
        return
    x = x + rng.choice([1e-3, 0.02]) * rng.standard_normal(x.shape)
    low, high = x.min(axis=0) - 1, x.max(axis=0) + 1
    names = [("left", "right"), *([("front", "back")] * (axes > 2)), ("floor", "ceiling")]
    walls = {
        w: b[k] for k, pair in enumerate(names) for w, b in zip(pair, (low, high), strict=True)
    }
    for name in rng.permutation(list(walls))[: rng.integers(0, 3)]:
        del walls[name]
    p = packing(
        x,
        rng.uniform(0.98, 1.02, len(x)),
        weights=rng.choice([0.0, 1.0, 3.0], len(x)) if rng.random() < 0.3 else 1,
        supports={name: float(b) for name, b in walls.items()},
        tolerance=0.05,
        stiffness=10.0 ** rng.integers(1, 6),
        held=rng.random(x.shape) < rng.choice([0, 0.1]),
    )
    near = solve_packing(p, 1e-8 if axes == 2 else 1e-6)
    if near.proof is None or near.proof.unproved:
        return
    assert near.warning == ""
    if near.proof.proved:
        assert near.force_change < 1e-3 * max(near.proof.forces.middle.max(initial=0.0), 1)


def test_a_verdict_that_differs_is_said() -> None:
    """A column a hair out of line falls; within the angle it stands, and is a saddle."""
    column = packing([(0, 1), (1e-4, 3)], 1, supports={"floor": 0}, stiffness=100)
    assert prove_packing(column).collapse is not None
    near = solve_packing(column, 1e-3)
    assert near.solution.status == "solved"
    assert near.warning == "the packing is unstable, the rational scene solved"
    assert near.force_change == float("inf")
    assert solve_packing(column, 1e-6).solution.status == "unstable"


def test_a_state_that_differs_is_said() -> None:
    """On a floor that is hardly tilted a disc leans on one wall, on a level one on none."""
    ends = ["floor", "left", "right"]
    corner = from_contacts([0] * 3, ends, [(-1e-5, 1), (1, 0), (-1, 0)], supports=ends)
    near = solve_packing(corner, 1e-4)
    assert near.solution.states == ("closed", "osculatory", "osculatory")
    assert near.differing == (1, 2)
    assert near.warning == "contacts 0-left, 0-right have another state in the packing"
    assert solve_packing(corner, 1e-7).warning == ""


def test_unproved_contacts_are_said() -> None:
    near = solve_packing(packing([(0, 1), (2, 1)], 1, supports={"floor": 0}))
    assert near.warning == "contacts 0-1 are not told in the packing"
    assert near.differing == ()


def test_angles_are_checked() -> None:
    for angle in (0, -1, 0.1, 1e-30, "wide"):
        with pytest.raises(InputError, match="the angle"):
            rational_scene(settled(), angle)


def test_numbers_of_a_scene_are_those_of_the_packing() -> None:
    p = settled()
    scene = rational_scene(p, 1e-6)
    assert [float(disc.radius) for disc in scene.discs] == p.geometry.radii.tolist()
    assert [[float(x) for x in d.position] for d in scene.discs] == p.geometry.centres.tolist()
    assert [disc.load[1].rational() for disc in scene.discs] == list(map(Fraction, p.loads[:, 1]))
    assert {c.compliance for c in scene.contacts} == {Fraction(1, 10**4)}
    assert scene.supports == ("floor", "left", "right")
    bare = from_contacts([0], ["floor"], [(1, 1)])
    assert not rational_scene(bare).geometric


# --- radii of discs in scenes ---


def test_stress_of_a_disc_of_any_radius() -> None:
    """Under its own weight on the floor: sigma_yy = -w R / (pi R^2)."""
    disc = Disc("a", (0, 3), (0, -2), (None, None), radius=3)
    solution = solve(Scene([disc], [Contact("a", "floor", (0, 1))]))
    assert stress(solution).of("a")[1][1] == Fraction(-2, 3)
    floating = solve(Scene([disc], [Contact("a", "floor", (0, 1))]), "newton")
    assert stress(floating).array[0, 1, 1] == pytest.approx(-2 / (3 * pi))


@pytest.mark.parametrize("radius", [0, -1, "sqrt(2)", 0.5, None])
def test_radii_are_positive_rationals(radius) -> None:
    with pytest.raises(InputError, match="radius of disc a"):
        Disc("a", (0, 3), (0, -2), (None, None), radius)


def test_radii_survive_a_file(tmp_path) -> None:
    scene = rational_scene(settled(), 1e-4)
    save_scene(scene, tmp_path / "scene.json")
    assert load_scene(tmp_path / "scene.json") == scene
    text = (tmp_path / "scene.json").read_text()
    first = str(scene.discs[0].radius)
    for wrong in ("0", "-1/2", "sqrt(2)", "x"):
        (tmp_path / "wrong.json").write_text(text.replace(f'"{first}"', f'"{wrong}"'))
        with pytest.raises(FileFormatError, match="radius"):
            load_scene(tmp_path / "wrong.json")
