"""The pushed corner stones and the continuation under them.

A path says what the solution is at every push; `solve` says it at one, by another method and from
the scene alone. So paths are held against `solve` on both sides of and on every breakpoint, and
where forces are not unique (a negative floor compliance) against the equilibrium conditions of
`helpers`, written apart from the package.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest
from helpers import brute_force, equilibrium_faults, image_contacts

from lcp_piles import (
    Scene,
    SolveError,
    contact_lcp,
    contact_system,
    nt30,
    nt60,
    pile,
    solve,
    surd,
    tss,
)
from lcp_piles.errors import InputError
from lcp_piles.files.write_path import to_json
from lcp_piles.mechanics.system import ContactSystem
from lcp_piles.push.continuation import continuation
from lcp_piles.push.push_path import force_curve, push_path

SQRT3 = surd("sqrt(3)")
CASES = [
    ("nt30", 3, {}),
    ("nt30", 4, {"floor_compliance": "0"}),
    ("nt30", 3, {"corner_stones": "resting"}),
    ("nt60", 5, {}),
    ("nt60", 7, {"floor_compliance": "0"}),  # simultaneous changes at 4/3 sqrt(3)
    ("tss", 6, {"floor_compliance": "0"}),  # mechanisms, simultaneous changes at 59/6 sqrt(3)
    ("tss", 7, {"floor_compliance": "1/2"}),
]
IDS = [f"{kind} {N} {' '.join(p.values())}".strip() for kind, N, p in CASES]


def between_and_beyond(path):
    """A push inside every piece of a path without end."""
    marks = [path.start] + [r.push for r in path.rearrangements]
    inside = [(a + b) / 2 for a, b in pairwise(marks)]
    return [*inside, marks[-1] + path.unit * Fraction(7, 3)]


def loaded(solution):
    return {k for k, sign in enumerate(solution.forces.signs()) if sign}


def numbers(scene, contacts):
    return {scene.contacts.index(contact) for contact in contacts}


def assert_is_the_solution(path, push):
    scene = path.scene.origin.scene(push=push)
    here, fresh = path.solution(push), solve(scene, "lemke")
    assert here.status == "solved"
    assert list(here.forces) == list(fresh.forces)
    assert here.states == fresh.states
    assert not equilibrium_faults(scene, here)
    k = len(scene.contacts) // 2
    contact = scene.contacts[k]
    constant, slope = path.linear_force(contact.a, contact.b, push)
    assert path.force(contact.a, contact.b, push) == fresh.forces[k] == constant + slope * push


# --- a path is the solution at every push ---


@pytest.mark.parametrize(("kind", "layers", "parameters"), CASES, ids=IDS)
def test_forces_at_any_push_are_those_of_the_solved_pile(kind, layers, parameters):
    path = push_path(kind, layers, **parameters)
    for text in ("0", "7/2", "5/3*sqrt(3)", "20", "9 - 2/7*sqrt(3)", "1000"):
        assert_is_the_solution(path, surd(text))


@pytest.mark.parametrize(("kind", "layers", "parameters"), CASES, ids=IDS)
def test_the_solved_pile_changes_at_the_breakpoints_and_nowhere_else(kind, layers, parameters):
    path = push_path(kind, layers, **parameters)
    scene = path.scene
    solved = [
        solve(pile(kind, layers, push=push, **parameters)) for push in between_and_beyond(path)
    ]
    assert len(path.rearrangements) == len(solved) - 1 > 2
    for change, (before, after) in zip(path.rearrangements, pairwise(solved), strict=True):
        assert loaded(before) - loaded(after) == numbers(scene, change.opens)
        assert loaded(after) - loaded(before) == numbers(scene, change.closes)
        at = path.solution(change.push)
        for contact in change.opens + change.closes:
            assert at.force(contact.a, contact.b) == 0
            assert path.force(contact.a, contact.b, change.push) == 0


@pytest.mark.parametrize(("kind", "layers", "parameters"), CASES, ids=IDS)
def test_changes_come_with_their_mirror_images(kind, layers, parameters):
    path = push_path(kind, layers, **parameters)
    image = image_contacts(path.scene)
    for change in path.rearrangements:
        for contacts in (change.opens, change.closes):
            found = numbers(path.scene, contacts)
            assert {image[k] for k in found} == found


@pytest.mark.parametrize(("kind", "layers", "parameters"), CASES, ids=IDS)
def test_the_way_back_has_the_same_changes_in_reverse(kind, layers, parameters):
    path = push_path(kind, layers, **parameters)
    far = path.rearrangements[-1].push + 1
    back = push_path(kind, layers, start=far, until=0, **parameters)
    assert back.end in ("reached", "asymptotic")  # the last piece may have no end
    assert [r.push for r in back.rearrangements] == [r.push for r in path.rearrangements][::-1]
    for there, here in zip(reversed(path.rearrangements), back.rearrangements, strict=True):
        assert set(there.opens) == set(here.closes)
        assert set(there.closes) == set(here.opens)


@pytest.mark.parametrize(
    ("kind", "layers", "floor", "push", "opens", "closes"),
    [
        ("tss", 6, "0", "59/6*sqrt(3)", 4, 0),
        ("nt60", 7, "0", "4/3*sqrt(3)", 0, 4),
        ("nt30", 8, "1", "369197298555199052/77169571730415435*sqrt(3)", 0, 4),
    ],
)
def test_pairs_that_change_at_the_same_push_are_one_rearrangement(
    kind, layers, floor, push, opens, closes
):
    path = push_path(kind, layers, floor_compliance=floor, until=surd(push) + 1)
    (change,) = [r for r in path.rearrangements if r.push == surd(push)]
    assert (len(change.opens), len(change.closes)) == (opens, closes)
    # Other changes may lie near the push: only the four contacts are asked about.
    near = [surd(push) - Fraction(1, 100), surd(push) + Fraction(1, 100)]
    sides = [solve(pile(kind, layers, floor_compliance=floor, push=x)) for x in near]
    for k in numbers(path.scene, change.opens + change.closes):
        assert [bool(s.forces[k]) for s in sides] == ([True, False] if opens else [False, True])


def test_two_piles_side_by_side_change_twice_at_each_push():
    """Every event of the pair is simultaneous, and the pair has no mirror half."""

    def pair(push):
        one = nt30(3, push=push)
        shift = surd("50 + sqrt(3)")

        def moved(end):
            return end if isinstance(end, str) else (2, *end)

        discs = [replace(d, id=(1, *d.id)) for d in one.discs] + [
            replace(d, id=(2, *d.id), position=(d.position[0] + shift, d.position[1]))
            for d in one.discs
        ]
        contacts = [
            replace(c, a=(1, *c.a), b=c.b if isinstance(c.b, str) else (1, *c.b))
            for c in one.contacts
        ] + [replace(c, a=moved(c.a), b=moved(c.b)) for c in one.contacts]
        return Scene(tuple(discs), tuple(contacts))

    alone = push_path("nt30", 3)
    path = continuation(pair(0), pair(SQRT3))
    assert path.end == "asymptotic"
    count = len(alone.scene.contacts)
    assert [b.t for b in path.breakpoints] == [b.t for b in alone.path.breakpoints]
    for mine, one in zip(path.breakpoints, alone.path.breakpoints, strict=True):
        assert mine.opens == one.opens + tuple(k + count for k in one.opens)
        assert mine.closes == one.closes + tuple(k + count for k in one.closes)


# --- the paper's floor ---


@pytest.mark.parametrize(("kind", "layers"), [("nt30", 4), ("nt60", 5), ("tss", 7)])
def test_states_on_the_path_of_a_negative_floor_are_solutions(kind, layers):
    path = push_path(kind, layers, floor_compliance="-1/2")
    assert path.end == "asymptotic"
    for push in [*between_and_beyond(path), *(r.push for r in path.rearrangements)]:
        here = path.solution(push)
        assert not equilibrium_faults(here.scene, here)


@pytest.mark.parametrize(("floor", "solutions"), [("-1/2", 1), ("-2", 5)])
def test_the_papers_floor_leaves_one_solution_where_a_worse_one_leaves_five(floor, solutions):
    """All 2^10 sets of open contacts of the half are tried: see notes/paper.md for a proof."""
    problem = contact_lcp(contact_system(nt30(3, floor_compliance=floor))).problem
    columns = [problem.column(j) for j in range(len(problem))]
    M = [[Fraction(int(column[i]), int(d)) for column, d in columns] for i in range(len(problem))]
    found = {tuple(map(str, w)) for _, w in brute_force(M, list(problem.q))}
    assert len(found) == solutions


# --- directions and ends ---


@pytest.mark.parametrize("floor", ["1", "0"])
@pytest.mark.parametrize(("kind", "layers"), [("nt30", 6), ("nt30", 9), ("nt60", 8), ("tss", 8)])
def test_pulling_changes_no_force(kind, layers, floor):
    """The paper: insensitive to positive q, for all piles on a smooth surface."""
    path = push_path(kind, layers, floor_compliance=floor, pull=True)
    assert path.rearrangements == ()
    assert path.end == "asymptotic"
    pulled = solve(pile(kind, layers, floor_compliance=floor, push="-1000"))
    assert list(pulled.forces) == list(solve(path.scene).forces)


def test_a_small_pile_on_a_soft_floor_is_not_insensitive():
    path = push_path("nt30", 4, pull=True)
    (change,) = path.rearrangements
    assert change.push == surd("-53/30*sqrt(3)")
    assert loaded(solve(nt30(4, push=-3))) != loaded(solve(nt30(4, push=-4)))


def test_until_stops_the_path_and_drops_what_lies_beyond():
    whole = push_path("nt30", 4)
    pushes = [r.push for r in whole.rearrangements]
    stop = (pushes[2] + pushes[3]) / 2
    path = push_path("nt30", 4, until=stop)
    assert path.end == "reached"
    assert [r.push for r in path.rearrangements] == pushes[:3]
    assert list(path.solution(stop).forces) == list(solve(nt30(4, push=stop)).forces)
    with pytest.raises(InputError, match="t is"):
        path.solution(pushes[3])


def test_until_below_the_start_pulls():
    path = push_path("tss", 6, start=30, until="10*sqrt(3)")
    assert path.unit == -SQRT3
    assert list(path.solution(25).forces) == list(solve(tss(6, push=25)).forces)


@pytest.mark.parametrize("floor", ["1", "0", "-1/2"])
@pytest.mark.parametrize("layers", [2, 3, 4, 6, 7])
def test_at_last_all_horizontal_contacts_are_closed_and_the_apex_force_stays(layers, floor):
    """The paper: many vertical contacts absent, all of the horizontal neighbours in contact."""
    path = push_path("nt30", layers, floor_compliance=floor)
    push = 10 * path.rearrangements[-1].push
    far = path.solution(push)
    for contact, state in zip(far.scene.contacts, far.states, strict=True):
        if contact.b != "floor" and contact.a[0] == contact.b[0]:
            assert state == "closed", contact
    middle = (3 * layers - 2 + 1) // 2
    constant, slope = path.linear_force((layers, middle), "floor", push)
    assert slope == 0
    assert constant == far.forces[far.contact_index((layers, middle), "floor")]


def test_piles_without_corner_stones_and_wrong_ways_are_refused():
    with pytest.raises(InputError, match="one that can be pushed: nt30, nt60, tss"):
        push_path("tbs", 4)
    with pytest.raises(InputError, match="until"):
        push_path("nt30", 3, until=5, pull=True)


# --- the file ---


def test_json_has_the_breakpoints_in_order_with_both_images():
    path = push_path("nt30", 6, floor_compliance="-1/2")
    data = to_json(path)
    assert data["scene"] == {
        "kind": "nt30",
        "layers": 6,
        "push": "0",
        "floor_compliance": "-1/2",
        "corner_stones": "held",
    }
    assert (data["direction"], data["end"]) == ("push", "asymptotic")
    assert "this is the only path" in data["promise"]
    far = push_path("nt30", 3, floor_compliance="-7/10", until=1)
    assert "other solutions may exist" in to_json(far)["promise"]
    decimals = [entry["decimal"] for entry in data["breakpoints"]]
    assert decimals == sorted(decimals)
    last = data["breakpoints"][-1]
    assert last["push"] == "266/3*sqrt(3)"  # the paper's q_23, without its sign
    assert sorted(last["changes"], key=str) == [
        {"a": [2, 2], "b": [3, 4], "change": "opens"},
        {"a": [2, 3], "b": [3, 4], "change": "opens"},
    ]


def test_json_of_a_definite_pull():
    data = to_json(push_path("nt30", 4, pull=True))
    assert data["direction"] == "pull"
    assert "unique" in data["promise"]
    (entry,) = data["breakpoints"]
    assert surd(entry["push"]) == surd("-53/30*sqrt(3)")
    assert {change["change"] for change in entry["changes"]} == {"opens"}


# --- other parameters ---


def with_load(scene, disc, load):
    discs = tuple(
        replace(d, load=tuple(map(surd, load))) if d.id == disc else d for d in scene.discs
    )
    return Scene(discs, scene.contacts)


@pytest.mark.parametrize(
    ("disc", "start", "towards"),
    [
        ((1, 1), (0, -1), (0, -3)),  # symmetric
        ((2, 1), (0, -1), (0, -6)),  # not
        ((3, 4), ("1/3*sqrt(3)", 0), ("4/3*sqrt(3)", -1)),
        ((2, 3), (0, -1), ("1/2", -1)),
    ],
)
def test_a_single_load_is_continued(disc, start, towards):
    base = nt30(4)
    path = continuation(with_load(base, disc, start), with_load(base, disc, towards))
    start, towards = [[surd(x) for x in load] for load in (start, towards)]
    for t in (Fraction(0), Fraction(1, 3), Fraction(1), Fraction(5, 2)):
        load = [a + (b - a) * t for a, b in zip(start, towards, strict=True)]
        fresh = solve(with_load(base, disc, load))
        if path.end == "unstable" and path.segments[-1].last < t:
            assert fresh.status == "unstable"
            continue
        piece = path.segment(t)
        for k, force in enumerate(fresh.forces):
            constant, slope = piece.linear_force(k)
            assert constant + slope * t == force


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("number", [0, 7, 20])
def test_one_initial_gap_is_continued(number, sign):
    """A disc a little too small or too large at one contact, as it grows."""
    base = nt30(4)

    def gapped(size):
        contacts = list(base.contacts)
        contacts[number] = replace(contacts[number], gap=surd(size))
        return Scene(base.discs, tuple(contacts))

    path = continuation(gapped(0), gapped(sign))
    assert path.end == "asymptotic"
    for t in (Fraction(1, 2), Fraction(4), Fraction(40)):
        fresh = solve(gapped(sign * t), "lemke")
        piece = path.segment(t)
        gaps = piece.linear_gap(number)
        assert gaps[0] + gaps[1] * t == fresh.gaps[number] or not fresh.gap_unique[number]
        for k, force in enumerate(fresh.forces):
            constant, slope = piece.linear_force(k)
            assert constant + slope * t == force


def test_a_load_that_no_contacts_can_balance_ends_the_path():
    """A disc on two fixed ones, pushed sideways: beyond tan 30 degrees it rolls over one."""
    base = nt60(2)
    path = continuation(with_load(base, (1, 1), (0, -1)), with_load(base, (1, 1), (1, -1)))
    assert path.end == "unstable"
    assert path.segments[-1].last == SQRT3 / 3
    assert solve(with_load(base, (1, 1), ("1/3*sqrt(3)", -1))).status == "solved"
    assert solve(with_load(base, (1, 1), ("4/7", -1))).status == "solved"
    assert solve(with_load(base, (1, 1), ("3/5", -1))).status == "unstable"


def test_scenes_that_differ_in_more_than_gaps_and_loads_are_refused():
    with pytest.raises(InputError, match="the second scene"):
        continuation(nt30(3), nt30(4))
    with pytest.raises(InputError, match="the second scene"):
        continuation(nt30(3), nt30(3, floor_compliance=0))


def test_a_direction_on_two_roots_is_refused():
    base = nt30(3)
    with pytest.raises(InputError, match="one of them at a time"):
        continuation(base, with_load(base, (1, 1), (1, -2)))


def test_a_scene_that_cannot_stand_has_no_path():
    falling = nt60(3).without([(3, 1)])
    with pytest.raises(SolveError):
        continuation(falling, falling)


def test_pieces_that_differ_only_in_what_holds_a_mechanism_are_no_rearrangement():
    """TSS of six layers: pivots exchange contacts without force, which changes no network."""
    path = push_path("tss", 6)
    assert len(path.path.segments) > len(path.rearrangements) + 1 == 4
    for change in path.rearrangements:
        assert change.opens or change.closes


def test_a_curve_of_all_contacts_spreads_one_vector_a_corner(monkeypatch):
    path = push_path("nt30", 4)
    calls = []
    spread = ContactSystem.whole_forces
    monkeypatch.setattr(ContactSystem, "whole_forces", lambda *a: calls.append(1) or spread(*a))
    pushes, curves = force_curve(path, list(range(len(path.scene.contacts))))
    assert len(calls) == len(pushes) == len(path.path.segments) + 1
    assert pushes[-1] == pushes[-2] * Fraction(11, 10) + SQRT3  # an endless piece, a bit of it
    for contact, curve in zip(path.scene.contacts, curves, strict=True):
        assert curve == [path.force(contact.a, contact.b, push) for push in pushes]
