"""Packings from centres and radii: contacts, normals and gaps against brute force and mpmath."""

from fractions import Fraction
from math import inf, nan

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import InputError, Wall, from_contacts, packing
from lcp_piles.packings.packing import NORMAL_ERROR

SLOPE = Wall((0.3, -30.0), (0.1, 0.7))


def _scattered(seed: int, axes: int, period: float | None = None):
    """Discs of unlike sizes on a rough grid, every neighbour a touch or a gap apart."""
    rng = np.random.default_rng(seed)
    places = np.stack(np.meshgrid(*[np.arange(4.0)] * axes), axis=-1).reshape(-1, axes)
    radii = rng.uniform(0.3, 0.52, len(places)) * rng.choice([1.0, 0.1], len(places), p=[0.8, 0.2])
    return packing(
        places + 0.01 * rng.standard_normal(places.shape),
        radii,
        supports={"floor": -0.5, "left": -0.5} if period is None else {"floor": -0.5},
        tolerance=0.2,
        period=period,
    )


def _pairs(p, period: float | None) -> set[tuple[int, int, int]]:
    """All contacts between discs, pair by pair."""
    x, r = p.geometry.centres, p.geometry.radii
    found = set()
    for i in range(len(x)):
        for j in range(i + 1, len(x)):
            for image in (0,) if period is None else (-1, 0, 1):
                line = x[i] - x[j]
                line[0] -= image * (period or 0)
                if np.hypot.reduce(line) <= 1.2 * (r[i] + r[j]):
                    found.add((i, j, image))
    return found


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("period", [None, 4.0])
def test_contacts_are_those_of_brute_force(axes: int, period: float | None) -> None:
    p = _scattered(1, axes, period)
    pairs = p.b >= 0
    ends = (p.a[pairs], p.b[pairs], p.geometry.image[pairs])
    assert set(zip(*(e.tolist() for e in ends), strict=True)) == _pairs(p, period)
    assert pairs.sum() >= 5
    near = {
        (k, wall)
        for k, (x, r) in enumerate(zip(p.geometry.centres, p.geometry.radii, strict=True))
        for wall, axis in (("floor", -1), ("left", 0))
        if wall in p.supports and x[axis] + 0.5 <= 1.2 * r
    }
    assert {p.contact_ends(k) for k in np.flatnonzero(~pairs).tolist()} == near


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("period", [None, 4.0])
def test_normals_and_gaps_are_those_of_the_given_floats(axes: int, period: float | None) -> None:
    """Against 60 digits of mpmath, contact by contact."""
    p = _scattered(2, axes, period)
    x, r = p.geometry.centres, p.geometry.radii
    with mpmath.workdps(60):
        for k, (a, b) in enumerate(zip(p.a.tolist(), p.b.tolist(), strict=True)):
            if b >= 0:
                line = [mpmath.mpf(s) - mpmath.mpf(t) for s, t in zip(x[a], x[b], strict=True)]
                line[0] -= mpmath.mpf(period or 0) * int(p.geometry.image[k])
                length = mpmath.sqrt(sum(t * t for t in line))
                gap = length - mpmath.mpf(r[a]) - mpmath.mpf(r[b])
            else:
                wall = p.geometry.walls[p.supports[p.support[k]]]
                line = [mpmath.mpf(t) for t in wall.normal]
                length = mpmath.sqrt(sum(t * t for t in line))
                there = zip(line, x[a], wall.point, strict=True)
                gap = sum(t * (mpmath.mpf(s) - mpmath.mpf(o)) for t, s, o in there) / length
                gap -= mpmath.mpf(r[a])
            for axis in range(axes):
                n = mpmath.mpf(p.normals.high[k, axis]) + mpmath.mpf(p.normals.low[k, axis])
                assert abs(n - line[axis] / length) <= NORMAL_ERROR * abs(line[axis] / length)
            found = mpmath.mpf(p.gaps.high[k]) + mpmath.mpf(p.gaps.low[k])
            assert abs(found - gap) <= p.gap_error[k] < 1e-28


def test_a_slope_is_as_far_as_its_line() -> None:
    disc = packing([(0.3, 1.0)], 0.5, supports={"slope": SLOPE}, tolerance=100)
    assert disc.gaps.high[0] == pytest.approx(31 * 0.7 / 50**0.5 * 10 - 0.5, rel=1e-15)


def test_an_image_far_away_is_exact() -> None:
    """x_a - x_b + L of three floats that need more than two together."""
    x = [(2.0**-40 / 3, 0.0), (98.0, 0.0)]
    p = packing(x, 1, period=100.0 + 2.0**-46, tolerance=0.1)
    line = Fraction(x[0][0]) - 98 + Fraction(100.0 + 2.0**-46)
    assert Fraction(p.gaps.high[0]) + Fraction(p.gaps.low[0]) == pytest.approx(line - 2, abs=1e-31)
    assert p.geometry.image.tolist() == [-1]


def test_contacts_between_held_discs_are_left_out() -> None:
    row = [(0, 1), (2, 1), (4, 1)]
    p = packing(row, 1, held=[True, True, False], supports={"floor": 0})
    assert [p.contact_name(k) for k in range(len(p.a))] == ["1-2", "2-floor"]


@given(st.lists(st.floats(0.2, 5), min_size=1, max_size=12), st.integers(0, 2**31))
@settings(max_examples=30, deadline=None)
def test_turning_the_order_of_discs_around_keeps_the_contacts(radii, seed) -> None:
    x = np.random.default_rng(seed).uniform(0, 40, (len(radii), 2)) + 10
    try:
        one = packing(x, radii, tolerance=0.5, supports={"floor": 0})
    except InputError:  # a centre within another disc
        return
    other = packing(
        x[::-1], radii[::-1], tolerance=0.5, supports={"floor": 0}, ids=range(len(radii))[::-1]
    )
    assert {frozenset(one.contact_ends(k)) for k in range(len(one.a))} == {
        frozenset(other.contact_ends(k)) for k in range(len(other.a))
    }


PAIR = [(0.0, 1.0), (2.0, 1.0)]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"centres": []}, "the shape of the centres"),
        ({"centres": [(1, 2, 3, 4)]}, "the shape of the centres"),
        ({"centres": "discs"}, "the centres is 'discs'"),
        ({"centres": [(0, nan), (2, 1)]}, "the centre of disc 0"),
        ({"centres": [(0, 1), (inf, 1)]}, "the centre of disc 1"),
        ({"centres": [(0, 1), (1e60, 1)]}, "the centre of disc 1"),
        ({"radii": (1, -1)}, "the radius of disc 1 is -1.0, expected a positive number"),
        ({"radii": 0}, "the radius of disc 0"),
        ({"radii": (1, 2, 3)}, "the shape of the radius"),
        ({"weights": (1, nan)}, "the weight of disc 1"),
        ({"centres": [(0, 1), (0, 1)]}, "the distance of discs 0-1 is 0.0"),
        ({"radii": 2.5}, "the distance of discs 0-1 is 2.0.*are these diameters"),
        ({"supports": {"floor": 3}}, "the distance of disc 0 from the wall floor is -2.0"),
        ({"supports": {"slope": 3}}, "the wall slope is 3"),
        ({"supports": {"slope": ((0, 0), (0, 0))}}, "the normal of a wall"),
        ({"supports": {"slope": ((0, 0, 0), (0, 0, 1))}}, "2 components"),
        ({"supports": ["floor"]}, "the supports"),
        ({"supports": {"floor": 0}, "ids": ["floor", "other"]}, "the name of a wall"),
        ({"ids": [1, 1]}, "the ids"),
        ({"ids": [1]}, "the number of ids"),
        ({"tolerance": -1}, "the tolerance"),
        ({"stiffness": 0}, "the stiffness"),
        ({"period": 4}, "the period is 4.0, expected more than two diameters"),
        ({"held": [1, 0]}, "held"),
        ({"centres": np.zeros((1000, 2)), "tolerance": 1.0}, "number of neighbours"),
    ],
)
def test_what_is_wrong_is_named(arguments, message: str) -> None:
    with pytest.raises(InputError, match=message):
        packing(**({"centres": PAIR, "radii": 1} | arguments))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"j": ["roof"], "ids": ["a"]}, "a contact is \\('a', 'roof'\\)"),
        ({"j": ["a"]}, "a contact"),
        ({"j": []}, "the length of j"),
        ({"normal": [(0, 0)]}, "the normal of contact a-floor"),
        ({"normal": [(0, nan)]}, "the normal of contact a-floor"),
        ({"normal": (0, 1)}, "the shape of the normals"),
        ({"gap": [1, 2]}, "the shape of the gap"),
        ({"stiffness": -1}, "the stiffness of contact a-floor"),
        ({"loads": [(0, 0, 1)]}, "the shape of the loads"),
        ({"ids": ["b"]}, "a contact"),
        ({"i": ["a"] * 2, "j": ["floor"] * 2}, "the contacts"),
        ({"i": [], "j": []}, "the number of discs"),
    ],
)
def test_what_is_wrong_with_bare_contacts_is_named(arguments, message: str) -> None:
    with pytest.raises(InputError, match=message):
        from_contacts(**({"i": ["a"], "j": ["floor"], "normal": [(0, 1)]} | arguments))
