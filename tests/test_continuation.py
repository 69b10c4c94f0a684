"""Paths that the paper's push does not take: any loads, supports and gaps, and free motions.

`solve` says at one t, by another method and from that scene alone, what a path says at every t.
Where forces are not unique (rigid contacts), the conditions of equilibrium are checked instead.
"""

from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

import pytest
from helpers import equilibrium_faults, float_matrix, nullity, rough_piles
from hypothesis import given, settings
from hypothesis import strategies as st
from random_scenes import ROOT, custom, random_scene

from lcp_piles import Contact, Disc, InputError, SolveError, contact_system, nt30, nt60, solve, surd
from lcp_piles.mechanics.contact_lcp import contact_lcp
from lcp_piles.mechanics.held_set import held_set
from lcp_piles.mechanics.motions import CollapseError, free_motions
from lcp_piles.mechanics.system import with_loads_of
from lcp_piles.numbers.vectors import exact_vector
from lcp_piles.push.continuation import continuation
from lcp_piles.solution.solution import Solved

ZERO, ONE = surd(0), surd(1)


def numbers(*values):
    return tuple(None if value is None else surd(value) for value in values)


def disc_on_floor(load, held=(None, None)):
    disc = Disc((1,), (ZERO, ONE), numbers(*load), numbers(*held))
    return custom([disc], [Contact((1,), "floor", (ZERO, ONE))])


def between(start, towards, t):
    """The scene at t of the line from one scene to another."""

    def mix(a, b):
        return a if a is None else a + (b - a) * t

    discs = [
        replace(
            a,
            load=tuple(map(mix, a.load, b.load)),
            held=tuple(map(mix, a.held, b.held)),
        )
        for a, b in zip(start.discs, towards.discs, strict=True)
    ]
    contacts = [
        replace(a, gap=mix(a.gap, b.gap))
        for a, b in zip(start.contacts, towards.contacts, strict=True)
    ]
    return custom(discs, contacts)


def assert_follows(start, towards, times):
    """The path from one scene to another says what `solve` says at each of these t."""
    if constrained(start):
        return None
    try:
        path = continuation(start, towards)
    except SolveError:
        assert not stands(start)
        return None
    last = path.segments[-1].last
    marks = [b.t for b in path.breakpoints]
    ends = [] if last is None else [last, last + Fraction(1, 1000)]
    for t in [*times, *marks, *ends]:
        scene = between(start, towards, surd(t))
        if last is not None and t > last:
            assert_ended(path.end, scene)
            continue
        fresh = solve(scene)
        assert fresh.status == "solved", t
        piece = path.segment(t)
        state = piece.state(t)
        system = piece.system
        forces = list(system.whole_forces(state.forces))
        if fresh.forces_unique:
            assert forces == list(fresh.forces)
        there = with_loads_of(system, scene)
        told = Solved(
            scene,
            fresh.record,
            system.whole_forces(state.forces),
            system.whole_gaps(state.gaps),
            there.whole_displacements(state.displacements),
            fresh.states,
            fresh.gap_unique,
            fresh.forces_unique,
            fresh.stability,
        )
        assert equilibrium_faults(scene, told) == []
    return path


def stands(scene):
    try:
        return solve(scene).status == "solved"
    except SolveError:
        return False


def constrained(scene):
    """Whether rigid bilateral contacts depend on each other, which the exact methods refuse."""
    B, _, _ = float_matrix(scene)
    rows = B[[c.bilateral and c.compliance == 0 for c in scene.contacts]]
    return nullity(rows.T) > 0


def assert_ended(end, scene):
    """The scene beyond the end of a path has no solution, for the reason that the path gives."""
    if end == "unstable":
        assert solve(scene).status == "unstable"
    else:
        assert end == "overlap"
        with pytest.raises(SolveError, match="overlap"):
            solve(scene)


TIMES = [Fraction(0), Fraction(1, 7), Fraction(1), Fraction(5, 2), Fraction(40)]


# --- loads on motions that no contact resists ---


def test_a_load_along_the_floor_makes_the_path_unstable_from_its_start():
    """A disc on a smooth floor rolls off under any load along it, however small."""
    start, towards = disc_on_floor((0, -1)), disc_on_floor((1, -1))
    path = assert_follows(start, towards, TIMES)
    assert path.end == "unstable"
    assert [(piece.first, piece.last) for piece in path.segments] == [(ZERO, ZERO)]
    assert list(path.segment(0).forces(0)) == [ONE]
    with pytest.raises(InputError, match="t is"):
        path.segment(Fraction(1, 10**30))
    assert continuation(start, towards, until=0).end == "reached"


def test_a_load_that_leaves_the_free_motion_alone_is_followed():
    path = assert_follows(disc_on_floor((0, -1)), disc_on_floor((0, -3)), TIMES)
    assert path.end == "asymptotic"
    assert path.segment(7).linear_force(0) == (1, 2)


def test_at_the_edge_of_stability_the_path_is_its_start():
    """A disc on two fixed ones whose load points exactly along one contact: tan 30 degrees."""
    base = nt60(2)

    def pulled(x):
        discs = (replace(base.discs[0], load=(x, -ONE)), *base.discs[1:])
        return replace(base, discs=discs)

    path = assert_follows(pulled(ROOT / 3), pulled(2 * ROOT / 3), TIMES)
    assert path.end == "unstable"
    assert path.segments[-1].last == 0
    back = assert_follows(pulled(ROOT / 3), pulled(ZERO), TIMES)
    assert back.segments[-1].last == 2  # the same edge on the other side


def test_loads_on_other_axes_at_the_end_than_at_the_start_have_one_gauge():
    """The axis that is loaded sets the gauge: pulled along x alone, then pressed down as well."""
    normals = [(ROOT / 2, surd("1/2")), (-ROOT / 2, surd("1/2"))]

    def scene(*load):
        disc = Disc((1,), (ZERO, ZERO), numbers(*load), (None, None))
        walls = zip(("left", "right"), normals, strict=True)
        return custom([disc], [Contact((1,), name, n, bilateral=True) for name, n in walls])

    assert assert_follows(scene(1, 0), scene(1, "-1/2"), TIMES[:4]) is not None
    assert assert_follows(scene(0, -1), scene(1, -1), TIMES[:4]) is not None


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.randoms(use_true_random=False))
def test_any_line_of_scenes_is_followed(seed, random):
    """Loads, held displacements and gaps of random scenes, rigid contacts among them."""
    start = random_scene(seed)
    whole = random.random() < 0.2

    def moved(x, chance):
        if x is None or not (whole or random.random() < chance):
            return x
        return x + Fraction(random.randint(-6, 6), random.choice([1, 2, 3]))

    discs = [
        replace(
            disc,
            load=tuple(moved(x, 0.2) for x in disc.load),
            held=tuple(moved(x, 0.3) for x in disc.held),
        )
        for disc in start.discs
    ]
    contacts = [replace(c, gap=moved(c.gap, 0.2)) for c in start.contacts]
    with suppress(InputError):  # a direction on two roots
        assert_follows(start, custom(discs, contacts), TIMES)


@settings(max_examples=8)
@given(rough_piles(), st.randoms(use_true_random=False))
def test_loads_gaps_and_stones_of_a_pile_may_change_at_once(start, random):
    """All changes on the one root that the gauge of the pile gives to each of them."""
    untilted = any(len(x.terms) and x.terms[0][0] == 3 for d in start.discs for x in d.position[1:])

    def some(chance):
        return random.choice([-3, -1, 1, 4]) if random.random() < chance else 0

    discs = [
        replace(
            disc,
            load=(disc.load[0], disc.load[1] - some(0.3)),
            held=tuple(
                h if h is None else h + some(0.5) * root
                for h, root in zip(disc.held, (ROOT, ONE), strict=True)
            ),
        )
        for disc in start.discs
    ]
    contacts = [
        replace(c, gap=c.gap + some(0.2) * (ROOT if untilted and c.b != "floor" else ONE))
        for c in start.contacts
    ]
    assert_follows(start, custom(discs, contacts), TIMES)


def test_a_scene_towards_itself_never_changes():
    for scene in (nt30(3), disc_on_floor((0, -1)), disc_on_floor((0, -1), held=(0, 0))):
        path = assert_follows(scene, scene, TIMES)
        assert (path.end, len(path.segments), path.breakpoints) == ("asymptotic", 1, ())


def test_no_contact_and_no_freedom_is_still_a_path():
    disc = Disc((1,), (ZERO, ZERO), (ZERO, -ONE), (ZERO, ZERO))
    for contacts in ([], [Contact((1,), "floor", (ZERO, ONE), gap=ONE)]):
        start = custom([disc], contacts)
        towards = custom([replace(disc, held=(ZERO, surd(-4)))], contacts)
        path = assert_follows(start, towards, TIMES)
        assert path.end == "asymptotic"
    assert [b.t for b in path.breakpoints] == [Fraction(1, 4)]


def test_rigid_walls_that_close_in_end_the_path_in_an_overlap():
    """A rigid disc between rigid walls two radii and a gap of 1 apart: full at t = 1/2."""

    def walls(gap):
        disc = Disc((1,), (ZERO, ZERO), (ZERO, ZERO), (None, ZERO))
        sides = [("left", (ONE, ZERO)), ("right", (-ONE, ZERO))]
        return custom([disc], [Contact((1,), b, n, Fraction(0), surd(gap)) for b, n in sides])

    path = assert_follows(walls("1/2"), walls("-1/2"), TIMES)
    assert (path.end, path.segments[-1].last) == ("overlap", Fraction(1, 2))


def test_where_nothing_is_proved_the_path_says_that_it_is_lost():
    """Negative compliances: no solution may lie beyond, or many (notes/formulation.md, 11)."""
    scene = nt30(4, floor_compliance=-1)
    ends = set()
    for k in (0, 4, 9):
        discs = list(scene.discs)
        discs[k] = replace(discs[k], load=(ZERO, surd(-9)))
        try:
            path = continuation(scene, custom(discs, list(scene.contacts)))
        except SolveError:
            continue
        ends.add(path.end)
    assert ends <= {"asymptotic", "turned", "lost", "unstable"}


# --- the held set that all of this stands on ---


def test_a_held_set_checks_the_work_of_every_load_on_its_free_motions():
    """One disc on a floor: whichever load is asked for first, the sideways one has no balance."""
    system = contact_system(disc_on_floor((0, -1)), "whole")
    held = held_set(system, ~system.bilateral)
    assert held.free.basis == [[1, 0]]
    gap, down, aside = (exact_vector(x) for x in ([0], [0, -1], [1, -1]))
    assert list(held.state(gap, down).forces) == [ONE]
    for load in (aside, exact_vector([-1, 0])):
        with pytest.raises(CollapseError) as caught:
            held.state(gap, load)
        assert [x * load[k].sign() for k, x in enumerate(caught.value.motion)] == [1, 0]
    assert list(held.state(gap, down).forces) == [ONE]


def test_the_force_of_an_open_contact_counts_as_a_load():
    """A wall that pushes the disc along the floor is nothing that the floor can balance."""
    wall = Contact((1,), "wall", (ONE, ZERO))
    scene = disc_on_floor((0, -1))
    system = contact_system(custom(list(scene.discs), [*scene.contacts, wall]))
    floor_only = ~system.bilateral
    floor_only[1] = False
    held = held_set(system, floor_only)
    with pytest.raises(CollapseError):
        held.state(system.gap, system.load, exact_vector([0, 1]))
    with pytest.raises(CollapseError):
        held.columns([1])
    with pytest.raises(SolveError, match="start that one closed too"):
        contact_lcp(system, floor_only)


def test_motions_that_are_known_serve_only_for_their_own_set():
    system = contact_system(nt30(7))
    everything = ~system.bilateral
    part = everything.copy()
    part[::2] = False
    known = [None, free_motions(system, everything), free_motions(system, part)]
    assert free_motions(system, part, known) is known[2]
    assert free_motions(system, everything, known) is known[1]
    other = contact_system(nt30(7))
    assert free_motions(other, part, known).system is other
    assert len(free_motions(other, part, known)) == len(known[2]) > 0
