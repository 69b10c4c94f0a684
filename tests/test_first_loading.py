"""First loading with friction: every solution is checked from the geometry alone, in plain Surds.

Expected values come from an independent trial in rational arithmetic (the whole piles), from closed
forms derived beside the test, or from the frictionless solver.
"""

import pytest
from test_friction import assert_admissible

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    all_first_loadings,
    first_loading,
    force_bounds,
    nt30,
    nt60,
    pile,
    solve,
    surd,
    tbs,
    tss,
)
from lcp_piles.friction import first_loading as module
from lcp_piles.friction.first_loading import UnresolvedError
from lcp_piles.friction.loading import loading_problem
from lcp_piles.friction.loading_proof import point_of

ZERO = surd(0)


def assert_loaded(scene, found, mu, rough=(), ratio=1):
    """Coulomb's law with springs, contact by contact, and balance."""
    mu = surd(mu)
    assert_admissible(scene, found.network, mu, rough)
    flat = list(found.displacements)
    moves = {}
    for k, disc in enumerate(scene.discs):
        u = flat[3 * k : 3 * k + 3]
        for axis, held in enumerate(disc.held):
            assert held is None or not u[axis]
            u[axis] += held or ZERO
        assert not (disc.fixed and u[2])
        moves[disc.id] = u
    for contact, state, f, s in zip(
        scene.contacts, found.states, found.network.normal, found.network.tangential, strict=True
    ):
        n = contact.normal
        t = (-n[1], n[0])
        a, b = moves[contact.a], moves.get(contact.b, [ZERO] * 3)
        gap = sum((n[axis] * (a[axis] - b[axis]) for axis in (0, 1)), contact.gap)
        slide = sum((t[axis] * (a[axis] - b[axis]) for axis in (0, 1)), a[2] + b[2])
        gap += f * contact.compliance
        smooth = contact.b in scene.supports and contact.b not in rough
        spring = -slide * ratio / contact.compliance
        if state == "open":
            assert gap >= 0
            assert f == s == 0
            continue
        assert gap == 0
        limit = ZERO if smooth else mu * f
        expected = min(max(spring, -limit), limit)
        assert s == expected
        assert state == "closed" if smooth else state in ("stick", "slip+", "slip-")
        if state == "stick":
            assert s == spring
        elif state != "closed":
            assert s == (limit if state == "slip+" else -limit)


def normal_force(scene, found, *ends):
    k = next(k for k, c in enumerate(scene.contacts) if (c.a, c.b) == ends)
    return found.network.normal[k]


@pytest.mark.parametrize(
    ("kind", "layers", "mu", "rough", "forces"),
    [
        ("tbs", 1, "1/5*sqrt(3)", (), {((1, 1), (2, 1)): "5/18", ((1, 1), (3, 2)): "5/9"}),
        ("tbs", 2, "1/10*sqrt(3)", (), {((1, 1), (2, 1)): "130/1429"}),
        ("tbs", 2, "1/10*sqrt(3)", (), {((1, 1), (3, 2)): "1260/1429"}),
        ("tss", 3, "1/5*sqrt(3)", (), {((3, 2), "floor"): "43/18"}),
        ("tss", 3, "1/5*sqrt(3)", ("floor",), {((3, 2), "floor"): "43/18"}),
        ("tss", 4, "1/10*sqrt(3)", ("floor",), {((4, 3), "floor"): "3335/1092"}),
        ("nt30", 2, "1/5*sqrt(3)", (), {((2, 2), "floor"): "4/3"}),
    ],
)
def test_piles_of_known_forces(kind, layers, mu, rough, forces):
    scene = pile(kind, layers)
    found = first_loading(scene, mu, rough)
    assert_loaded(scene, found, mu, rough)
    for ends, force in forces.items():
        assert normal_force(scene, found, *ends) == surd(force)


@pytest.mark.parametrize(
    ("scene", "mu", "rough", "ratio"),
    [
        (nt30(3, push=1), "3/10", ("floor",), 1),
        (nt30(4), "1/10*sqrt(3)", (), "1/3"),
        (nt60(4), "3/10", ("floor",), 2),
        (tss(5, floor_compliance="1/2"), "1/2*sqrt(3)", ("floor",), 1),
        (tbs(4), "1/10*sqrt(3)", (), "2/7"),
    ],
    ids=str,
)
def test_laws_hold_contact_by_contact(scene, mu, rough, ratio):
    found = first_loading(scene, mu, rough, ratio=ratio)
    assert_loaded(scene, found, mu, rough, surd(ratio))
    assert {"stick", "slip+"} <= set(found.states)


def test_degenerate_states_of_a_pile_whose_proposals_tie():
    # Contacts of NT60 6 touch without force in the solution: floats see them open and closed.
    scene = nt60(6)
    assert_loaded(scene, first_loading(scene, "1/10*sqrt(3)"), "1/10*sqrt(3)")


def test_one_disc_on_a_slope_and_a_wall():
    # Free to roll, held by a smooth wall: torque forbids any tangential force, so it rolls until
    # the spring is relaxed, and forces are those without friction.
    disc = Disc("disc", (0, 0), (0, -1), (None, None))
    slope = Contact("disc", "slope", ("-1/2", "1/2*sqrt(3)"))
    wall = Contact("disc", "wall", (1, 0))
    scene = Scene([disc], [slope, wall], supports=("slope", "wall"))
    found = first_loading(scene, "1/3", ("slope",))
    assert_loaded(scene, found, "1/3", ("slope",))
    assert [str(f) for f in found.network.normal] == ["2/3*sqrt(3)", "1/3*sqrt(3)"]
    assert found.states == ("stick", "closed")


def test_a_wedged_disc_that_slips():
    # Two contacts at +-30 degrees from the horizontal: 2 (f/2 + mu sqrt(3)/2 f) = 1 where they
    # slip, and where they stick the tangential springs bear three times what the normal ones do.
    root = "1/2*sqrt(3)"
    disc = Disc("disc", (0, 0), (0, -1), (None, None))
    contacts = [
        Contact("disc", "left", (root, "1/2")),
        Contact("disc", "right", (f"-{root}", "1/2")),
    ]
    scene = Scene([disc], contacts, supports=("left", "right"))
    walls = ("left", "right")
    slips = first_loading(scene, "1/3*sqrt(3)", walls)
    assert [str(f) for f in slips.network.normal] == ["1/2", "1/2"]
    assert set(slips.states) == {"slip+", "slip-"}
    sticks = first_loading(scene, 2, walls)
    assert [str(f) for f in sticks.network.normal] == ["1/4", "1/4"]
    assert sticks.states == ("stick", "stick")
    for found, mu in ((slips, "1/3*sqrt(3)"), (sticks, 2)):
        assert_loaded(scene, found, mu, walls)


@pytest.mark.parametrize("kind", ["nt30", "nt60", "tss", "tbs"])
def test_without_friction_they_are_the_forces_of_the_solver(kind):
    scene = pile(kind, 4)
    assert list(first_loading(scene, 0).network.normal) == list(solve(scene).forces)


def test_first_loading_lies_within_the_bounds():
    scene = nt30(3)
    found = first_loading(scene, "3/10", ("floor",))
    for k in (5, len(scene.contacts) - 1):
        contact = scene.contacts[k]
        bounds = force_bounds(scene, "3/10", {(contact.a, contact.b): 1}, ("floor",))
        assert bounds.least.value <= found.network.normal[k]
        assert bounds.largest.value is None or found.network.normal[k] <= bounds.largest.value


def test_the_search_of_all_states_finds_the_only_solution():
    for scene, mu in ((tbs(1), "1/5*sqrt(3)"), (nt60(2), "3/10")):
        every = all_first_loadings(scene, mu)
        assert every.unique
        assert_loaded(scene, every.solutions[0], mu)
        one = first_loading(scene, mu)
        assert list(every.solutions[0].network.normal) == list(one.network.normal)


@pytest.mark.slow
@pytest.mark.parametrize("mu", ["1/5*sqrt(3)", "1/2*sqrt(3)"])
def test_nt30_of_two_layers_has_one_solution(mu):
    every = all_first_loadings(nt30(2), mu)
    assert every.unique
    assert_loaded(nt30(2), every.solutions[0], mu)


def test_a_loose_disc_has_forces_that_are_unique_and_motions_that_are_not():
    # A disc with a smooth floor alone turns as it likes: the equations are singular.
    loose = Disc("loose", (0, 0), (0, -1), (0, None))
    scene = Scene([loose], [Contact("loose", "floor", (0, 1))])
    every = all_first_loadings(scene, "1/2")
    assert every.unique
    assert every.solutions[0].network.normal[0] == 1
    assert first_loading(scene, "1/2").states == ("closed",)


def test_a_pile_that_cannot_stand_is_unresolved_and_has_no_solution():
    disc = Disc("disc", (0, 0), (0, -1), (None, None))
    scene = Scene([disc], [Contact("disc", "wall", (1, 0))], supports=("wall",))
    with pytest.raises(UnresolvedError, match="nothing is proved"):
        first_loading(scene, "1/2", ("wall",))
    assert all_first_loadings(scene, "1/2", ("wall",)).solutions == ()


def test_wrong_states_are_refuted(monkeypatch):
    problem = loading_problem(tbs(1), "1/5*sqrt(3)")
    right = ("slip+", "slip-", "stick")
    assert point_of(problem, right) is not None
    for wrong in (("stick",) * 3, ("slip-", "slip+", "stick"), ("open", "open", "stick")):
        assert point_of(problem, wrong) is None
    monkeypatch.setattr(module, "proposals", lambda _: [("stick",) * 3, right])
    assert first_loading(tbs(1), "1/5*sqrt(3)").states == right
    monkeypatch.setattr(module, "proposals", lambda _: [("stick",) * 3])
    with pytest.raises(UnresolvedError):
        first_loading(tbs(1), "1/5*sqrt(3)")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: first_loading(nt30(2, floor_compliance=0), "1/2"), "compliance"),
        (lambda: first_loading(nt30(2), "1/2", ratio=0), "ratio"),
        (lambda: first_loading(nt30(2), "1/2", ratio="sqrt(2)"), "ratio"),
        (lambda: first_loading(nt30(2), "-1/2"), "mu"),
        (lambda: first_loading(nt30(2), "1/2", ("wall",)), "rough support"),
        (lambda: all_first_loadings(nt30(4), "1/2"), "number of contacts"),
    ],
)
def test_what_means_nothing_is_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()
