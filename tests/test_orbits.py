"""The symmetric part of piles of spheres, held against the part that knows their mirror only.

Random scenes are as symmetric as a pile: gaps, compliances and loads are the same along orbits,
which are found here by turning positions in floating point.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import product
from random import Random

import numpy as np
import pytest
from flint import fmpz
from helpers import equilibrium_faults
from scipy.spatial import cKDTree

from lcp_piles import Contact, Disc, Scene, contact_system, loaded, nt60, pile, solve, surd
from lcp_piles.linear.integer_product import times
from lcp_piles.mechanics.orbits import symmetric_part
from lcp_piles.methods import proved
from lcp_piles.numbers.vectors import ExactVector
from lcp_piles.scenes.turns import turns

PILES = [
    pytest.param(kind, base, layers, id=f"{kind}-{base}-{layers}")
    for kind, base, layers in [
        *product(("tetrahedron", "pyramid"), ("held",), (1, 2, 3, 4)),
        *product(("tetrahedron", "pyramid"), ("edges",), (2, 3, 4, 5)),
        *product(("tetrahedron", "pyramid"), ("corners",), (2, 3)),
    ]
]
ORDER = {"tetrahedron": 6, "pyramid": 8}


def symmetries(kind: str) -> list[np.ndarray]:
    """All maps of a triangle, or of a square, on itself: turns and mirrors about z."""
    sides = ORDER[kind] // 2
    found = []
    for k in range(sides):
        c, s = np.cos(2 * np.pi * k / sides), np.sin(2 * np.pi * k / sides)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        found += [turn, turn @ np.diag([-1, 1, 1])]
    return found


def images(points: np.ndarray, matrix: np.ndarray) -> list[int]:
    """Which of the points each of them goes to."""
    distances, found = cKDTree(points).query(points @ matrix.T)
    assert distances.max() < 1e-9
    assert len(set(found.tolist())) == len(points)
    return found.tolist()


def centres(scene: Scene) -> np.ndarray:
    return np.array([[float(x) for x in disc.position] for disc in scene.discs])


def orbits(kind: str, scene: Scene) -> list[frozenset[int]]:
    """The orbits of all contacts, by where their middles go."""
    places = centres(scene)
    middles = np.array(
        [places[scene.disc_index(c.a)] - [float(x) for x in c.normal] for c in scene.contacts]
    )
    ways = [images(middles, matrix) for matrix in symmetries(kind)]
    return list({frozenset(way[k] for way in ways) for k in range(len(middles))})


def without_turns(scene: Scene, monkeypatch: pytest.MonkeyPatch):
    """The solution of a scene whose mirror alone is known."""
    with monkeypatch.context() as patch:
        patch.setattr(proved, "symmetric_part", lambda system: None)
        return solve(scene)


def assert_same(one, other) -> None:
    assert one.status == other.status == "solved"
    assert list(one.forces) == list(other.forces)
    assert one.states == other.states
    assert one.gap_unique == other.gap_unique
    assert one.stability == other.stability
    assert one.forces_unique == other.forces_unique
    for g, h, unique in zip(one.gaps, other.gaps, one.gap_unique, strict=True):
        assert g == h or not unique


@pytest.mark.parametrize(("kind", "base", "layers"), PILES)
def test_the_symmetric_part_has_the_solution(kind, base, layers, monkeypatch) -> None:
    scene = pile(kind, layers, base=base, floor_compliance="1/3")
    assert_same(solve(scene), without_turns(scene, monkeypatch))


@pytest.mark.parametrize(("kind", "base"), [("tetrahedron", "edges"), ("pyramid", "held")])
@pytest.mark.parametrize("seed", range(4))
def test_scenes_with_gaps_and_loads(kind, base, seed, monkeypatch) -> None:
    """Gaps and compliances at random, the same along orbits, some contacts held closed."""
    random = Random(seed)
    scene = loaded(
        pile(kind, 4, base=base),
        (0, 0, 0) if kind == "tetrahedron" else (1, 1, 1),
        (0, 0, random.randint(-9, 0)),
    )
    contacts = list(scene.contacts)
    for orbit in orbits(kind, scene):
        gap, soft = Fraction(random.randint(-4, 4), 3), Fraction(random.randint(1, 5), 2)
        tied = random.random() < 0.1
        for k in orbit:
            contacts[k] = replace(contacts[k], gap=surd(gap), compliance=soft, bilateral=tied)
    rough = replace(scene, contacts=tuple(contacts))
    assert symmetric_part(contact_system(rough)) is not None
    solution = solve(rough)
    assert_same(solution, without_turns(rough, monkeypatch))
    assert equilibrium_faults(rough, solution) == []


@pytest.mark.parametrize(("kind", "base", "layers"), PILES)
def test_one_contact_stands_for_its_orbit(kind, base, layers) -> None:
    scene = pile(kind, layers, base=base)
    parts = symmetric_part(contact_system(scene)).part.reduction
    found = {
        frozenset(np.flatnonzero(parts.contact == r).tolist()) for r in range(len(parts.weight))
    }
    expected = set(orbits(kind, scene))
    assert found == expected
    assert sorted(parts.weight.tolist()) == sorted(map(len, expected))
    assert all(
        int(k) in np.flatnonzero(parts.contact == r) for r, k in enumerate(parts.representative)
    )


@pytest.mark.parametrize(("kind", "base", "layers"), PILES)
def test_the_freedoms_are_all_symmetric_motions(kind, base, layers) -> None:
    """By the mean of the group over random motions: its rank, and that it is spanned."""
    scene = pile(kind, layers, base=base)
    system = symmetric_part(contact_system(scene)).part
    scales = np.array([float(f) for f in system.displacement_factor] * len(scene.discs))
    spread = system.reduction.spread.toarray() * scales[:, None]
    free = np.array([[h is None for h in d.held] for d in scene.discs])
    random = np.random.default_rng(1).normal(size=(spread.shape[1] + 3, *free.shape)) * free
    means = np.zeros_like(random)
    for T in symmetries(kind):
        means[:, images(centres(scene), T)] += random @ T.T
    means = means.reshape(len(means), -1)
    if not spread.shape[1]:
        assert np.abs(means).max() < 1e-9
        return
    assert np.linalg.matrix_rank(means, tol=1e-9) == spread.shape[1]
    assert np.linalg.matrix_rank(np.vstack([means, spread.T]), tol=1e-9) == spread.shape[1]


@pytest.mark.parametrize(
    ("kind", "base"), [*product(("tetrahedron", "pyramid"), ("held", "edges"))]
)
def test_gaps_of_a_symmetric_motion_lead_back(kind: str, base: str) -> None:
    """The rates of the part, led back, are those of the motion led back, exactly."""
    of = contact_system(pile(kind, 4, base=base))
    symmetric = symmetric_part(of)
    random = Random(3)
    motion = [fmpz(random.randint(-9, 9)) for _ in range(symmetric.part.dof)]
    rates = ExactVector({1: times(symmetric.part.B, motion)}, fmpz(1))
    back = ExactVector({1: times(of.B, symmetric.motion(motion))}, fmpz(1))
    assert list(symmetric.part.whole_gaps(rates)) == list(of.whole_gaps(back))
    moved = symmetric.part.whole_displacements(ExactVector({1: motion}, fmpz(1)), False)
    again = of.whole_displacements(ExactVector({1: symmetric.motion(motion)}, fmpz(1)), False)
    assert list(moved) == list(again)


@pytest.mark.parametrize("kind", ["tetrahedron", "pyramid"])
def test_a_collapse_is_led_back(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is verified on the whole scene; here that it is symmetric, and that both ways find one."""
    scene = pile(kind, 4, base="corners")
    solution = solve(scene)
    assert solution.status == without_turns(scene, monkeypatch).status == "unstable"
    u = solution.collapse.array().reshape(-1, 3)
    for T in symmetries(kind):
        assert u[images(centres(scene), T)] == pytest.approx(u @ T.T)


def test_what_a_twenty_layer_pile_saves() -> None:
    """The numbers that the notes and the docstring name."""
    system = contact_system(pile("tetrahedron", 20))
    assert (system.contacts, symmetric_part(system).part.contacts) == (4410, 1540)


def test_only_what_leaves_the_scene_alone_counts() -> None:
    square = pile("pyramid", 3)
    assert len(turns(square)) == 2
    assert turns(nt60(3)) == ()
    pushed = loaded(square, (1, 1, 1), (0, 1, 0))
    assert turns(pushed) == ()
    assert turns(loaded(square, (1, 1, 1), (0, 0, -3))) != ()
    one = replace(square.contacts[-1], compliance=Fraction(2))
    assert turns(replace(square, contacts=(*square.contacts[:-1], one))) == ()
    assert symmetric_part(contact_system(pushed)) is None
    shifted = replace(square.discs[-1], held=(0, 0, 1))
    assert turns(replace(square, discs=(*square.discs[:-1], shifted))) == ()


def test_half_turns_and_partly_held_spheres(monkeypatch: pytest.MonkeyPatch) -> None:
    """A ball between two others in a row, which may only sink: by hand each takes a half."""
    root = surd("1/2*sqrt(2)")
    free, sunk = (None, None, None), (0, 0, None)
    balls = [
        Disc("top", (0, 0, root * 2), (0, 0, -1), free),
        Disc("left", (-root * 2, 0, 0), (0, 0, -1), sunk),
        Disc("right", (root * 2, 0, 0), (0, 0, -1), sunk),
    ]
    contacts = [
        Contact("top", "left", (root, 0, root)),
        Contact("top", "right", (-root, 0, root)),
        Contact("left", "floor", (0, 0, 1)),
        Contact("right", "floor", (0, 0, 1)),
    ]
    scene = Scene(balls, contacts)
    assert [turn.discs.tolist() for turn in turns(scene)] == [[0, 2, 1]] * 2
    part = symmetric_part(contact_system(scene)).part
    assert (part.dof, part.contacts) == (2, 2)
    solution = solve(scene)
    assert list(solution.forces) == [root, root, Fraction(3, 2), Fraction(3, 2)]
    assert_same(solution, without_turns(scene, monkeypatch))
    assert solution.stability.mechanisms == 1  # the top rolls to the front
    assert solution.stability.verdict == "saddle"
