"""Continuum readings on made-up stress, and what the paper says of its piles."""

from dataclasses import replace

import numpy as np
import pytest

from lcp_piles import Contact, continuum, nt30, nt60, solve, stress, tbs, tss
from lcp_piles.fields.continuum import axis_spread, buried_discs, supported_discs
from lcp_piles.fields.stress import Stress
from lcp_piles.numbers.exact import sqrt_of


def ids(scene, mask) -> set:
    return {disc.id for disc, chosen in zip(scene.discs, mask, strict=True) if chosen}


def test_buried_discs_are_those_inside_the_flanks():
    pile = tss(5)
    inside = {(i, j) for i in range(3, 6) for j in range(2, i)}
    assert ids(pile, buried_discs(pile)) == inside
    pile = nt60(4)
    assert ids(pile, buried_discs(pile)) == {(3, 2), (4, 2), (4, 3)}
    pile = nt30(4)  # the outer two discs on either side of each row lie open
    inside = {(i, j) for i in range(2, 5) for j in range(3, 3 * i - 3)}
    assert ids(pile, buried_discs(pile)) == inside


def test_supported_discs_touch_the_floor_or_a_held_disc():
    pile = nt30(3)
    assert ids(pile, supported_discs(pile)) == {(3, j) for j in range(1, 8)}
    pile = tss(5)
    base = {(5, j) for j in range(1, 6)}
    assert ids(pile, supported_discs(pile)) == base | {(4, 1), (4, 4)}
    pile = tbs(3)
    assert ids(pile, supported_discs(pile)) == {d.id for d in pile.discs if d.id[0] >= 2}


def test_a_disc_that_hangs_from_a_held_one_is_supported():
    pile = tss(3)
    ends = [(c.a, c.b, c.normal) for c in pile.contacts if not isinstance(c.b, str)]
    turned = [Contact(b, a, tuple(-n for n in normal)) for a, b, normal in ends]
    scene = replace(pile, contacts=tuple(turned))
    assert ids(scene, supported_discs(scene)) == {(2, 1), (2, 2), (3, 1), (3, 3)}


def test_zones_part_the_movable_discs():
    for pile in (tbs(5), tss(6), nt60(5), nt30(5)):
        found = continuum(stress(solve(pile)))
        zones = np.stack([found.base, found.surface, found.inner]).sum(axis=0)
        assert zones.tolist() == [0 if disc.fixed else 1 for disc in pile.discs]


def made_up(pile, tensor) -> Stress:
    """A field of stress: `tensor` gives (xx, xy, yy) at (x, y)."""
    values = [tensor(*(float(p) for p in disc.position)) for disc in pile.discs]
    return Stress(pile, np.array(values, dtype=float).ravel())


def along(angle, s1, s2):
    """Stress with pressure s1 along the axis at this angle and s2 across it."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return -(s1 * c * c + s2 * s * s), -(s1 - s2) * s * c, -(s1 * s * s + s2 * c * c)


def test_a_fixed_principal_axis_is_recognised():
    def field(x, y):
        return along(-60 if x > 0 else 60, 2 + abs(x), 1)

    pile = tbs(8)
    found = continuum(made_up(pile, field))
    off_axis = np.array([disc.position[0] != 0 for disc in pile.discs])
    assert found.inner_axis.count == (found.inner & off_axis).sum() < found.yielding.count
    assert found.inner_axis.mean == pytest.approx(-60)
    assert found.surface_axis.mean == pytest.approx(-60)
    assert found.inner_axis.deviation == pytest.approx(0, abs=1e-12)
    assert found.yielding.deviation > 0.1


def test_incipient_failure_everywhere_is_recognised():
    def field(x, y):
        return along(-90 + 5 * x, 3 * (1 + y * y), 1 + y * y)

    found = continuum(made_up(tbs(8), field))
    assert found.yielding.mean == pytest.approx(0.5)
    assert found.yielding.deviation == pytest.approx(0, abs=1e-12)
    assert found.inner_axis.deviation > 5


def test_arrays_are_placed_and_mirrored():
    pile = nt60(3)
    found = continuum(made_up(pile, lambda x, y: along(20 if x else 90, 2, 1)))
    np.testing.assert_allclose(found.x, [0, -1, 1, -2, 0, 2])
    np.testing.assert_allclose(found.depth, np.sqrt(3) * np.array([0, 1, 1, 2, 2, 2]))
    np.testing.assert_allclose(found.angle, [90, -20, 20, -20, 90, 20])
    np.testing.assert_allclose(found.sin_phi, 1 / 3)
    upright = continuum(made_up(pile, lambda x, y: (-1, 0, -2)))
    assert (upright.angle == 90).all()


def test_axis_spread_of_axes():
    for angles in ([10.0, 50.0], [-170.0, 50.0], [10.0, 230.0, np.nan]):
        found = axis_spread(np.array(angles))
        assert found.mean == pytest.approx(30)
        assert found.count == 2
        # R = cos(2 * 20 degrees) for two axes 20 degrees off their mean.
        expected = np.degrees(np.sqrt((1 - np.cos(np.radians(40))) / 2))
        assert found.deviation == pytest.approx(expected)
    small = np.random.default_rng(3).normal(0, 0.5, 400)
    assert axis_spread(small).deviation == pytest.approx(small.std(), rel=1e-3)
    assert axis_spread(np.array([0.0, 90.0])).deviation == pytest.approx(np.degrees(np.sqrt(0.5)))
    empty = axis_spread(np.array([np.nan]))
    assert empty.count == 0
    assert np.isnan([empty.mean, empty.deviation]).all()


def test_unloaded_and_isotropic_discs_are_left_out():
    found = continuum(made_up(nt60(5), lambda x, y: (0, 0, 0) if x > 0 else (-1, 0, -1)))
    assert found.inner_axis.count == 0
    assert np.isnan(found.sin_phi[found.x > 0]).all()
    assert found.yielding.mean == 0


def test_tss_surface_lies_along_the_slope_and_the_inner_part_upright_or_flat():
    """The paper on TSS with 10 layers: three regions, no fixed principal axis."""
    solution = solve(tss(10))
    found = continuum(stress(solution))
    assert found.surface_axis.mean == pytest.approx(-30, abs=5)
    # Upright or flat exactly: xy = 0 off the axis, where symmetry does not ask for it.
    tensors = stress(solution)
    for disc in [(7, 5), (8, 6), (9, 6), (10, 7), (10, 8), (10, 9)]:
        assert tensors.of(disc)[0][1] == 0
    assert found.inner_axis.deviation > 20


@pytest.mark.parametrize("pile", [tbs(11), nt30(6)], ids=["tbs", "nt30"])
def test_buried_discs_do_not_keep_the_axis_of_the_surface(pile):
    """The paper: no FPA in TBS and NT30, smooth variation as under IFE."""
    found = continuum(stress(solve(pile)))
    assert abs(found.surface_axis.mean - found.inner_axis.mean) > 15
    assert found.yielding.deviation < 0.1


def test_wings_of_the_fully_pushed_pile_have_a_fixed_axis_and_fail_everywhere():
    """Closed form: with horizontal and steep contacts only, a disc's weight splits into 2/sqrt(3)
    along the slope of 60 degrees and 1/sqrt(3) along the row. Both add up disc by disc, so that
    xx = yy: the axis is at exactly 45 degrees, and sin(phi) = 1/sqrt(3)."""
    solution = solve(nt30(8, push=1000))
    tensors = stress(solution)
    found = continuum(tensors)
    wing = [(3, 6), (4, 8), (5, 10), (5, 12), (6, 12), (6, 14), (7, 14), (7, 17)]
    for disc in wing:
        (xx, xy), (_, yy) = tensors.of(disc)
        assert xx == yy
        assert xy * sqrt_of(3) == -xx
        at = solution.scene.disc_index(disc)
        assert found.angle[at] == -45
        assert found.sin_phi[at] == pytest.approx(3**-0.5)
