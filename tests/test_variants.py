"""Loads on one disc, bilateral networks and vacancies.

Responses are held against separate solutions by Lemke's method, without continuation; chains are
worked out by hand; discs without support are found by brute force.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    bilateral,
    falling,
    loaded,
    nt30,
    nt60,
    point_load,
    rattlers,
    slab,
    solve,
    surd,
    tbs,
)
from lcp_piles.cli.report import summary


def below(scene: Scene, method: str = "lemke") -> dict[object, object]:
    """What every held disc below, or floor under a disc, bears, by x: solved from a cold start."""
    solution = solve(scene, method)
    borne: dict[object, object] = {}
    for c, f in zip(scene.contacts, solution.forces, strict=True):
        if c.b == "floor" or (not isinstance(c.b, str) and scene.disc(c.b).fixed):
            x = str(scene.disc(c.a if c.b == "floor" else c.b).position[0])
            borne[x] = borne.get(x, surd(0)) + f * c.normal[1]
    return borne


@pytest.mark.parametrize(
    ("scene", "top"),
    [(slab(7, 3), (1, 4)), (slab(6, 4, floor="smooth"), (1, 3)), (nt30(4), (1, 1))],
)
def test_the_response_is_that_of_separate_solutions(scene: Scene, top: tuple[int, int]) -> None:
    load = point_load(scene, top, until=30)
    unloaded = below(scene)
    for split in load.splits:
        for force in (split.load - Fraction(1, 10**9), split.load, split.load + Fraction(1, 10**9)):
            borne = below(loaded(scene, top, (0, -force)))
            shares = [(borne[str(x)] - unloaded[str(x)]) / force for x in load.positions]
            assert shares == list(load.response(force))
            largest = [x for x, y in zip(load.positions, shares, strict=True) if y == max(shares)]
            assert largest == list(load.peaks(force))
            if split.load > force:
                assert largest == list(split.before)
            elif split.load < force:
                assert largest == list(split.after)
            else:
                assert set(largest) >= {*split.before, *split.after}


@pytest.mark.parametrize("floor", ["bumpy", "smooth"])
def test_one_peak_while_contacts_hold_tension_and_two_when_they_do_not(floor: str) -> None:
    scene, top = slab(9, 3, floor=floor), (1, 5)
    linear = point_load(bilateral(scene), top)
    assert linear.path.breakpoints == ()
    assert linear.splits == ()
    middle = linear.peaks(1)
    assert linear.response(1) == linear.response(1000)
    assert middle == ((-1, 1) if floor == "bumpy" else (0,))  # one place, or the two around it
    load = point_load(scene, top)
    first = load.splits[0]
    assert load.peaks(first.load / 2) == first.before == middle
    left, right = first.after
    assert left == -right
    assert not set(first.after) & set(middle)
    assert sum(load.response(first.load)) == 1  # smooth walls take nothing of the load


@pytest.mark.parametrize(("width", "height"), [(5, 2), (9, 4), (13, 5), (16, 6)])
def test_without_gravity_two_chains_bear_all(width: int, height: int) -> None:
    """Straight down at 60 degrees: forces of 1/2 over cos 30, height contacts on either side."""
    top = (1, (width + height % 2) // 2)
    scene = slab(width, height, sides="free", weight=0)
    solution = solve(loaded(scene, top, (0, -1)))
    ends = {}
    for contact, force in zip(scene.contacts, solution.forces, strict=True):
        if force:
            assert force == surd("1/3*sqrt(3)")
            ends[contact.a, contact.b] = contact.normal[0]
    assert len(ends) == 2 * height
    assert sorted(n.sign() for n in ends.values()) == [-1] * height + [1] * height
    on_chains = {id for pair in ends for id in pair if not scene.disc(id).fixed}
    free = {disc.id for disc in scene.discs if not disc.fixed}
    assert set(rattlers(solution)) == free - on_chains
    assert len(on_chains) == 2 * height - 1
    assert f" {len(free) - len(on_chains)} discs that no force holds" in summary(solution)


def test_nothing_under_gravity_is_a_rattler() -> None:
    for scene in (nt30(5), nt60(4, push=3), tbs(4), slab(5, 3)):
        assert rattlers(solve(scene)) == ()
        assert rattlers(solve(scene, "newton")) == ()


@given(st.sets(st.integers(0, 24), max_size=4), st.booleans())
@settings(max_examples=25)
def test_vacancies_are_solved_or_collapse(gone: set[int], wide: bool) -> None:
    """A disc with no contact below it falls; what the collapse moves is what moves in it."""
    whole = slab(5, 5) if wide else tbs(6)
    free = [disc.id for disc in whole.discs if not disc.fixed]
    scene = whole.without([free[k % len(free)] for k in gone])
    solution = solve(scene)
    supported = {c.a for c in scene.contacts if c.normal[1] > 0}
    supported |= {c.b for c in scene.contacts if c.normal[1] < 0}
    hanging = {d.id for d in scene.discs if not d.fixed} - supported
    if solution.status == "solved":
        assert not hanging
        assert rattlers(solution) == ()
        return
    motion = list(solution.collapse)
    moved = falling(solution)
    for k, disc in enumerate(scene.discs):
        assert (disc.id in moved) == any(motion[2 * k : 2 * k + 2])
    assert moved
    said = summary(solution)
    assert f"collapse  {len(moved)} disc" in said


def test_a_load_is_added_and_checked() -> None:
    pile = nt60(3)
    twice = loaded(loaded(pile, (1, 1), (1, "sqrt(3)")), (1, 1), (1, 0))
    assert twice.disc((1, 1)).load == (2, surd("-1 + sqrt(3)"))
    assert twice.contacts == pile.contacts
    assert [d.load for d in twice.discs[1:]] == [d.load for d in pile.discs[1:]]
    with pytest.raises(InputError, match=r"force on disc \(1,1\) is .* expected 2 components"):
        loaded(pile, (1, 1), (1, 2, 3))
    with pytest.raises(InputError, match="the disc"):
        loaded(pile, (9, 9), (0, 1))
    with pytest.raises(InputError, match="the load is '0', expected a positive number"):
        point_load(pile, (1, 1), until=1).response(0)
    ball = Scene(
        [Disc(1, (0, 0, 0), (0, 0, -1), (None, None, None))], [Contact(1, "floor", (0, 0, 1))]
    )
    with pytest.raises(InputError, match="the dimension is 3"):
        point_load(ball, 1)
