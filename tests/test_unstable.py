"""Scenes that cannot stand: the collapse, its check, and who may stand at all."""

from dataclasses import replace

import numpy as np
import pytest
from helpers import ZERO, along, float_matrix, solved_from
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    nt30,
    nt60,
    pile,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.numbers.vectors import exact_vector

METHODS = pytest.mark.parametrize("method", ["proved", "lemke"])
BROKEN = {
    "nt60 without a corner stone": lambda: nt60(4).without([(4, 1)]),
    "nt60 without both corner stones": lambda: nt60(5).without([(5, 1), (5, 5)]),
    "nt60 of three layers without a corner stone": lambda: nt60(3).without([(3, 3)]),
    "nt30 without a corner stone": lambda: nt30(3).without([(3, 7)]),
    "tss without a corner stone": lambda: tss(4).without([(4, 4)]),
    "tss without both corner stones": lambda: tss(5).without([(5, 1), (5, 5)]),
    "tbs without two discs under a flank": lambda: tbs(3).without([(4, 1), (5, 2)]),
    "nt60 on no floor": lambda: replace(
        nt60(4), contacts=tuple(c for c in nt60(4).contacts if c.b != "floor")
    ),
    "no contact at all": lambda: replace(nt60(2), contacts=()),
    "rigid floor": lambda: nt60(4, floor_compliance=0).without([(4, 1)]),
}


def assert_collapse(scene, solution):
    """The motion moves nothing that is held, closes no contact, and the load drives it."""
    assert solution.status == "unstable"
    assert not hasattr(solution, "forces")
    numbers = list(solution.collapse)
    u = {d.id: numbers[2 * k : 2 * k + 2] for k, d in enumerate(scene.discs)}
    for disc in scene.discs:
        assert all(x == 0 for x, h in zip(u[disc.id], disc.held, strict=True) if h is not None)
    for contact in scene.contacts:
        there = [ZERO, ZERO] if isinstance(contact.b, str) else u[contact.b]
        rate = along(contact.normal, [x - y for x, y in zip(u[contact.a], there, strict=True)])
        assert rate >= 0
    assert sum((along(disc.load, u[disc.id]) for disc in scene.discs), ZERO) > 0


@METHODS
@pytest.mark.parametrize("whole", [False, True], ids=["half", "whole"])
@pytest.mark.parametrize("name", BROKEN)
def test_a_scene_that_cannot_stand_ends_in_its_collapse(name, whole, method):
    scene = BROKEN[name]()
    solution = solve(scene, method, whole=whole)
    assert_collapse(scene, solution)
    assert verify(scene, solution).ok


@settings(max_examples=10)
@given(st.sampled_from(list(BROKEN)), st.randoms(use_true_random=False))
def test_no_proposal_of_floating_point_makes_it_stand(name, random):
    scene = BROKEN[name]()
    assert_collapse(scene, solved_from(scene, random))


@METHODS
def test_a_disc_that_rolls_off_another(method):
    """One on top of a fixed one and a little aside: normal (3/5, 4/5), nothing to hold it."""
    normal = (surd("3/5"), surd("4/5"))
    discs = (
        Disc((1,), (surd("6/5"), surd("8/5")), (surd(0), surd(-1)), (None, None)),
        Disc((2,), (surd(0), surd(0)), (surd(0), surd(-1)), (surd(0), surd(0))),
    )
    scene = Scene(discs, (Contact((1,), (2,), normal),))
    assert_collapse(scene, solve(scene, method))


@settings(max_examples=25)
@given(st.sampled_from(["nt60", "nt30", "tss", "tbs"]), st.integers(2, 4), st.data())
def test_a_scene_stands_exactly_where_a_linear_programme_finds_forces(kind, layers, data):
    """Any discs taken away: forces f >= 0 with B^T f = -p, or else a collapse."""
    full = pile(kind, min(layers, 3) if kind == "nt30" else layers)
    gone = data.draw(st.sets(st.sampled_from([d.id for d in full.discs[1:]]), max_size=3))
    scene = full.without(gone)
    B, _, p = float_matrix(scene)
    # Elastic: the least sum of unbalanced loads, zero exactly where the forces exist.
    dof = B.shape[1]
    A = np.hstack([B.T, np.eye(dof), -np.eye(dof)])
    cost = np.append(np.zeros(len(B)), np.ones(2 * dof))
    programme = linprog(cost, A_eq=A, b_eq=-p)
    assert programme.status == 0
    solution = solve(scene)
    if programme.fun < 1e-7:
        assert solution.status == "solved"
        assert verify(scene, solution).ok
    else:
        assert_collapse(scene, solution)


@pytest.mark.parametrize("name", BROKEN)
def test_tampered_collapses_are_refused(name):
    scene = BROKEN[name]()
    good = solve(scene)
    held = next(
        2 * k + axis
        for k, disc in enumerate(scene.discs)
        for axis in (0, 1)
        if disc.held[axis] is not None or disc.id == scene.discs[-1].id
    )
    numbers = list(good.collapse)
    moved = list(numbers)
    moved[held] += 1
    backwards, still = [-x for x in numbers], [ZERO] * len(numbers)
    upwards = [ZERO, surd(1)] * len(scene.discs)
    for bad in (backwards, still, upwards):
        check = verify(scene, replace(good, collapse=exact_vector(bad)))
        assert not check.ok
        assert check.faults
    if any(h is not None for disc in scene.discs for h in disc.held):
        assert any(
            "held" in fault
            for fault in verify(scene, replace(good, collapse=exact_vector(moved))).faults
        )


def test_a_collapse_of_the_wrong_size_is_refused():
    scene = nt60(4).without([(4, 1)])
    good = solve(scene)
    with pytest.raises(InputError, match="the collapse"):
        verify(scene, replace(good, collapse=exact_vector([1, 2, 3])))


def test_a_collapse_is_no_answer_for_a_pile_that_stands():
    """Claiming the collapse of the broken pile for the whole one fails on the contacts put back."""
    whole = nt60(4)
    broken = whole.without([(4, 1)])
    numbers = iter(solve(broken).collapse)
    motion = [ZERO if d.id == (4, 1) else next(numbers) for d in whole.discs for _ in (0, 1)]
    claim = replace(solve(broken), scene=whole, collapse=exact_vector(motion))
    assert any("close it further" in fault for fault in verify(whole, claim).faults)


def test_reading_forces_of_an_unstable_scene_says_why_and_what_to_do():
    solution = solve(nt60(4).without([(4, 1)]))
    wanted = "'unstable', expected \"solved\", to have force;.*`collapse` is how"
    with pytest.raises(InputError, match=wanted):
        solution.force((1, 1), (2, 1))
    with pytest.raises(AttributeError, match="no attribute 'fores'"):
        solution.fores  # noqa: B018
    assert getattr(solution, "stability", "none") == "none"
