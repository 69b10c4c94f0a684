"""Ways down from saddles: where they end is known from the exact rigid limit, or by hand."""

from fractions import Fraction

import numpy as np
import pytest
from helpers import float_matrix

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    deform,
    first_order,
    nt30,
    nt60,
    slide,
    solve,
    surd,
    tss,
)


def exact_stops(solution, start):
    """Displacements (w tau) at both ends of the only free motion, as tau goes to 0.

    The motion goes on until a gap that it changes is closed: from the null space of the touching
    contacts and the gaps of the rigid solution.
    """
    scene = solution.scene
    B, _, _ = float_matrix(scene)
    touching = np.array(solution.states) != "open"
    _, sizes, rows = np.linalg.svd(B[touching])
    (motion,) = rows[int((sizes > 1e-9).sum()) :]
    rates, gaps = B @ motion, start.start_gaps.array()
    free = np.array([h is None for disc in scene.discs for h in disc.held])
    ends = []
    for sign in (1, -1):
        closing = ~touching & (sign * rates < -1e-9)
        far = sign * (gaps[closing] / -(sign * rates[closing])).min()
        u = start.start.array()
        u[free] += far * motion
        ends.append(u.reshape(-1, 2))
    return ends


@pytest.mark.parametrize("scene", [nt30(7), nt30(9), nt60(9)], ids=str)
def test_a_saddle_with_one_free_motion_slides_to_its_stops(scene):
    """The end is a few tau away for every tau, and leans to one side: the motion is odd."""
    solution = solve(scene)
    first = first_order(solution)
    ends = exact_stops(solution, first)
    tau = 1e-6
    saddle = deform(first, tau)
    reached = []
    for sign in (1, -1):
        way = slide(saddle, 0, sign)
        assert way.settled
        assert way.is_odd
        assert (way.lowest > 0).all()
        assert (np.diff(way.energies) <= 1e-9).all()
        errors = [np.abs(way.displacements - end).max() for end in ends]
        assert min(errors) < 1e-3 * np.abs(ends[0] - ends[1]).max()
        reached.append(int(np.argmin(errors)))
        # The forces are those of the rigid limit all the same, to order tau.
        assert way.forces == pytest.approx(solution.force_array, abs=1e4 * tau)
    assert sorted(reached) == [0, 1]


def test_both_sides_are_mirror_images():
    saddle = deform(first_order(solve(tss(3))), 1e-3)
    one, two = slide(saddle, 0, 1), slide(saddle, 0, -1)
    assert one.drop == pytest.approx(two.drop, rel=1e-9)
    assert one.asymmetry == pytest.approx(two.asymmetry, rel=1e-6)
    assert one.asymmetry > 1  # radii: this pile rearranges altogether


def test_an_even_motion_keeps_the_symmetry():
    """NT30 8: along its even motion one way ends symmetric, a few tau away."""
    saddle = deform(first_order(solve(nt30(8))), 1e-4)
    ends = [slide(saddle, 0, sign) for sign in (1, -1)]
    assert [way.is_odd for way in ends] == [False, False]
    assert min(way.asymmetry for way in ends) < 1e-12
    assert all(way.settled for way in ends)


def test_a_saddle_on_the_way_is_left_too():
    """TSS 4: the even motion leads either way to an end like that of the odd one.

    One way passes a symmetric saddle, 0.99 radii from the start, where exact symmetry would stay.
    """
    start = deform(solve(tss(4)), 1e-3)
    ways = [slide(start, mode, sign) for mode in (0, 1) for sign in (1, -1)]
    assert {way.is_odd for way in ways} == {True, False}
    for way in ways:
        assert way.settled
        assert (way.lowest > 0).all()
        assert way.drop == pytest.approx(ways[0].drop, rel=1e-6)
        assert way.distance == pytest.approx(ways[0].distance, rel=1e-6)


def test_a_stable_pile_comes_back():
    rest = deform(first_order(solve(nt30(6))), 1e-4)
    way = slide(rest)
    assert way.settled
    assert way.distance < 1e-9
    assert way.drop == pytest.approx(0, abs=1e-9)


def ball_on_ball(floor):
    """A disc on top of a held one, and a third on a floor at the height of the second."""
    free, fixed = (None, None), (surd(0), surd(0))
    zero, weight = (surd(0), surd(0)), (surd(0), surd(-1))
    up = (surd(0), surd(1))
    discs = (
        Disc((1,), (surd(0), surd(2)), weight, free),
        Disc((2,), zero, zero, fixed),
        Disc((3,), (surd(20), surd(0)), weight, (surd(0), None)),
    )
    contacts = [Contact((1,), (2,), up)]
    if floor:
        contacts.append(Contact((3,), "floor", up, compliance=Fraction(3)))
    return Scene(discs if floor else discs[:2], tuple(contacts))


def test_discs_meet_supports_that_the_scene_did_not_foresee():
    """The upper disc rolls off and comes to rest on the floor, whose compliance is 3."""
    tau = 1e-3
    way = slide(deform(solve(ball_on_ball(True)), tau), 0, 1)
    assert way.settled
    x, y = tau * way.displacements[0] + (0, 2)
    assert y == pytest.approx(-3 * tau, rel=1e-6)
    assert 2 <= abs(x) < 2.001  # where it just leaves the ball


def test_what_falls_for_ever_is_said_to_fall():
    way = slide(deform(solve(ball_on_ball(False)), 1e-2), 0, 1)
    assert not way.settled
    assert way.distance > 10


def test_what_is_refused():
    rest = deform(solve(nt30(3)), 1e-3)
    with pytest.raises(InputError, match="sign"):
        slide(rest, 0, 2)
    with pytest.raises(InputError, match="mode"):
        slide(rest, 1000)
    published = deform(solve(nt30(3, floor_compliance="-1/2")), 1e-3)
    with pytest.raises(InputError, match="scene"):
        slide(published)
