"""Dips: the definition by brute force, and the profiles that the paper shows."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from scipy.signal import find_peaks, peak_prominences

from lcp_piles import base_pressure, depressions, dip, pile, sags, solve, surd
from lcp_piles.fields.base_pressure import BaseForce
from lcp_piles.numbers.exact import ZERO


def profile(values, step=2) -> list[BaseForce]:
    """A profile of these normal forces, symmetric about x = 0."""
    middle = len(values) - 1
    return [
        BaseForce((k,), surd(Fraction(step * (2 * k - middle), 2)), surd(value), ZERO, False)
        for k, value in enumerate(values)
    ]


def solved(kind, layers, **parameters) -> tuple[BaseForce, ...]:
    return base_pressure(solve(pile(kind, layers, **parameters)))


def test_a_profile_by_hand():
    found = depressions(profile([1, 5, 3, 3, 7, 4, 6, 2, 1, 3]))
    places = [(d.left, d.right, d.bottom, d.depth, d.width) for d in found]
    #  x:           -9 -7 -5 -3 -1 1 3 5 7 9
    assert places == [(-5, -3, 3, 2, 6), (1, 1, 4, 2, 4), (7, 7, 1, 2, 10)]
    assert [(d.left_rim, d.right_rim) for d in found] == [
        ((-7, 5), (-1, 7)),
        ((-1, 7), (3, 6)),
        ((-1, 7), (9, 3)),
    ]


def test_rims_are_the_highest_before_the_bottom_is_reached_again():
    """Twin minima keep to their own side of the ridge, which is their common rim."""
    twins = depressions(profile([9, 2, 4, 2, 8]))
    assert [(d.left_rim, d.right_rim, d.depth) for d in twins] == [
        ((-4, 9), (0, 4), 2),
        ((0, 4), (4, 8), 2),
    ]
    centre = dip(profile([1, 9, 3, 4, 2, 4, 3, 9, 1]))
    assert (centre.left_rim, centre.right_rim, centre.depth) == ((-6, 9), (6, 9), 7)
    plateau = dip(profile([1, 5, 5, 2, 5, 5, 1]))
    assert (plateau.left_rim, plateau.right_rim) == ((-2, 5), (2, 5))


@pytest.mark.parametrize(
    "values", [[], [3], [1, 2, 3, 2, 1], [2, 2, 2], [3, 2, 1], [3, 1], [3, 1, 1]]
)
def test_concave_monotone_and_short_profiles_have_none(values):
    assert depressions(profile(values)) == ()
    assert dip(profile(values)) is None


def test_dip_spans_the_axis():
    assert dip(profile([1, 3, 2, 3, 1])).left == 0
    even = dip(profile([1, 3, 2, 2, 3, 1]))
    assert (even.left, even.right, even.width) == (-1, 1, 6)
    assert dip(profile([1, 3, 2, 4, 2, 3, 1])) is None


def test_depths_are_prominences():
    """scipy's peak prominence of the negative, for profiles without ties."""
    random = np.random.default_rng(5)
    for _ in range(50):
        values = random.permutation(20)
        peaks, _ = find_peaks(-values)
        found = depressions(profile(values.tolist()))
        assert [d.bottom for d in found] == values[peaks].tolist()
        depths = peak_prominences(-values, peaks)[0]
        assert [d.depth.rational() for d in found] == depths.tolist()


@pytest.mark.parametrize("exact", [True, False], ids=["exact", "float"])
def test_sags_are_the_distance_to_the_concave_hull(exact):
    """The hull at a point is the highest chord over it, by trying all pairs."""
    random = np.random.default_rng(7)
    for _ in range(30):
        values = random.integers(0, 8, size=9).tolist()
        points = profile(values)
        if not exact:
            points = [BaseForce(p.disc, p.x, float(p.normal), 0.0, False) for p in points]
        hull = [
            max(
                Fraction(values[i] * (j - k) + values[j] * (k - i), j - i) if i < j else values[k]
                for i, j in product(range(k + 1), range(k, len(values)))
            )
            for k in range(len(values))
        ]
        below = {p.x: h - v for p, h, v in zip(points, hull, values, strict=True)}
        found = sags(points)
        for sag in found:
            inside = [x for x in below if sag.left < x < sag.right]
            assert float(sag.depth) == pytest.approx(float(max(below[x] for x in inside)))
            assert not exact or sag.depth == below[sag.lowest] == max(below[x] for x in inside)
            assert below[sag.left] == below[sag.right] == 0
        if exact:
            covered = {x for sag in found for x in below if sag.left < x < sag.right}
            assert covered == {x for x, depth in below.items() if depth > 0}


@pytest.mark.parametrize(("kind", "layers"), [("tbs", 17), ("tss", 13)])
def test_tilted_piles_have_a_maximum_and_no_dip(kind, layers):
    points = solved(kind, layers)
    assert dip(points) is None
    assert depressions(points) == ()
    centre = points[len(points) // 2]
    assert centre.x == 0
    assert all(p.normal < centre.normal for p in points if p.x != 0)


@pytest.mark.parametrize("floor", [1, 0, "-1/2"])
def test_nt30_with_6_layers_has_a_small_dip_under_the_apex(floor):
    points = solved("nt30", 6, floor_compliance=floor)
    found = dip(points)
    assert (found.left, found.right) == (-1, 1)
    assert (found.left_rim[0], found.right_rim[0]) == (-3, 3)
    assert 0 < found.depth < surd("1/4")
    # "a small depression at the shoulders of the pile": sagging, not yet a minimum.
    assert depressions(points) == (found,)
    shoulders = [sag for sag in sags(points) if abs(sag.lowest) > 3]
    assert [sag.lowest for sag in shoulders] == [-9, 9]


def test_nt30_with_5_layers_has_its_minima_near_the_apex_on_the_paper_s_floor():
    """ "a shallow minimum under the apex of the pile or near it"."""
    points = solved("nt30", 5, floor_compliance="-1/2")
    assert dip(points) is None
    assert [d.left for d in depressions(points)] == [-2, 2]
    # The physical floor moves it under the apex, and makes it very small.
    found = dip(solved("nt30", 5))
    assert (found.left, found.right) == (0, 0)
    assert 0 < found.depth < surd("1/100")


def test_a_dip_is_not_a_matter_of_even_layers():
    """The paper could compute six layers; seven have a deeper dip than six."""
    assert dip(solved("nt30", 7)).depth > dip(solved("nt30", 6)).depth


def test_pushed_flank_depressions_move_to_the_centre_and_become_the_dip():
    """The paper's push sequence on its own floor: the first minimum turns into a maximum."""
    places = []
    for push in (12, 30, 45, 62, 160):
        points = solved("nt30", 6, push=push, floor_compliance="-1/2")
        places.append([d.right for d in depressions(points) if d.right > 0])
        assert (dip(points) is not None) == (push == 160)
    assert places == [[9], [7], [5], [3], [1]]
    deep = dip(points)
    assert (deep.bottom, deep.depth) == (surd("3/2"), 4)
