"""Proofs of packings in floats: bounds against 50 digits, collapses, what cannot be told."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from packed import ROOT3, heap_places, rough_lattice, settled, settled_forces, squeezed, true_forces
from scipy.optimize import nnls

from lcp_piles import (
    InputError,
    SolveError,
    from_contacts,
    packing,
    prove_packing,
    rational_scene,
)
from lcp_piles.deformation.watch import crowd_of
from lcp_piles.methods.packings import prove

HEAP = [(0, 1), (2, 1), (1, 1 + ROOT3)]
BOX = {"floor": 0.0, "left": -1.0, "right": 3.0}


@mpmath.workdps(50)
def _hold(forces, bounded) -> bool:
    """Whether every force in 50 digits is within its bounds."""
    ends = zip(forces, bounded.middle.tolist(), bounded.radius.tolist(), strict=True)
    return all(abs(f - mpmath.mpf(m)) <= mpmath.mpf(r) for f, m, r in ends)


PACKINGS = {
    "disc on a floor": packing([(0, 1)], 1, supports={"floor": 0}),
    "disc in a groove": packing(
        [(0, 1.4)], 1, supports={"l": ((0, 0), (1, 1)), "r": ((0, 0), (-1, 1.02))}, stiffness=300
    ),
    "steep groove": packing(
        [(0, 1)],
        1,
        supports={"l": ((-1e-9, 0), (1, 1e-9)), "r": ((1e-9, 0), (-1, 1e-9))},
        stiffness=100,
        tolerance=2,
    ),
    "heap between walls": packing(HEAP, 1, supports=BOX, stiffness=100),
    "column": packing([(0, 1), (0, 3), (0, 5)], (1, 1, 1), supports={"floor": 0}, stiffness=9),
    "unlike weights and stiffnesses": packing(
        HEAP, 1, weights=(1, 1e-9, 1e5), supports=BOX, stiffness=1e3, wall_stiffness=7e8
    ),
    "rough": rough_lattice(5, 4, 1e-3, 1e4),
    "very rough and soft": rough_lattice(5, 5, 1e-2, 50),
    "stiff": rough_lattice(4, 5, 1e-4, 1e9, seed=3),
    "spheres in a box": packing(
        heap_places(3, 2) + 1e-3 * np.random.default_rng(0).standard_normal((8, 3)),
        1,
        supports={"floor": -1, "left": -1, "right": 4, "front": -1, "back": 1 + 4 / 3 * ROOT3},
        tolerance=0.05,
        stiffness=1e4,
    ),
    "spheres": packing(
        [(0, 0, 1), (2, 0, 1), (1, ROOT3, 1), (1, 0.57, 2.63)],
        1,
        held=[True] * 3 + [False],
        stiffness=1e3,
    ),
}


@pytest.mark.parametrize("name", PACKINGS)
def test_bounds_hold_the_forces_in_fifty_digits(name: str) -> None:
    proof = prove_packing(PACKINGS[name])
    assert proof.proved
    forces = true_forces(PACKINGS[name], proof.loaded)
    assert _hold(forces, proof.forces)
    assert proof.forces.radius.max() < 1e-12 * proof.forces.middle.max()


@given(
    st.integers(0, 2**31), st.integers(2, 4), st.sampled_from([1e-4, 1e-3, 1e-2]),
    st.sampled_from([20.0, 1e3, 1e6]),
)  # fmt: skip
@settings(max_examples=12, deadline=None)
def test_bounds_of_random_packings(seed: int, rows: int, noise: float, stiffness: float) -> None:
    p = rough_lattice(3, rows, noise, stiffness, seed)
    proof = prove_packing(p)
    assert proof.proved
    assert _hold(true_forces(p, proof.loaded), proof.forces)


@pytest.mark.parametrize("seed", range(4))
def test_forces_are_those_of_least_squares(seed: int) -> None:
    """The energy in one more way: f >= 0 least |C^(1/2) f + C^(-1/2) o|^2 with a stiff balance.

    The stiffness costs digits, in older versions of scipy all but four.
    """
    p = rough_lattice(4, 3, 3e-3, 30, seed)
    B, stiff = prove.normals_matrix(p).toarray(), 1e5
    c = 1 / p.stiffness
    A = np.vstack([np.diag(np.sqrt(c)), stiff * B.T])
    right = np.append(-p.gaps.high / np.sqrt(c), -stiff * p.loads.ravel())
    forces, _ = nnls(A, right, maxiter=10_000)
    proof = prove_packing(p)
    assert np.abs(forces - proof.forces.middle).max() < 2e-4


def test_forces_of_lammps() -> None:
    """States and forces of a packing at rest, whose overlaps are its forces."""
    p, pairs = settled(), settled_forces()
    proof = prove_packing(p)
    assert proof.proved
    assert proof.forces.radius.max() < 1e-14 * proof.forces.middle.max()
    assert proof.loaded.tolist() == (p.gaps.high < 0).tolist()
    between = {frozenset(p.contact_ends(k)) for k in np.flatnonzero(proof.loaded & (p.b >= 0))}
    assert between == set(pairs)
    largest = proof.forces.middle.max()
    for k in np.flatnonzero(proof.loaded).tolist():
        theirs = pairs[frozenset(p.contact_ends(k))] if p.b[k] >= 0 else -1e4 * p.gaps.high[k]
        assert abs(proof.forces.middle[k] - theirs) < 1e-10 * largest


def test_forces_of_lammps_from_where_nothing_balances() -> None:
    """Every disc is moved first, which changes the overlaps by as much as the least of them."""
    p, pairs = settled(shift=1e-6), settled_forces()
    proof = prove_packing(p)
    largest = proof.forces.middle.max()
    assert np.abs(-1e4 * p.gaps.high - proof.forces.middle)[proof.loaded].max() > 5e-4 * largest
    between = np.flatnonzero(p.b >= 0).tolist()
    theirs = np.array([pairs.get(frozenset(p.contact_ends(k)), 0.0) for k in between])
    assert np.abs(theirs - proof.forces.middle[between]).max() < 1e-5 * largest
    assert (proof.loaded[between] == (theirs > 0)).all()


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("shrink", [0.95, 0.99])
def test_rattlers_and_free_translations(seed: int, shrink: float) -> None:
    """In a period between plates everything slides along them, and rattlers go where they like."""
    proof = prove_packing(squeezed(seed, shrink))
    assert proof.proved
    p = proof.scene
    B = prove.normals_matrix(p)
    assert np.abs(B.T @ proof.forces.middle).max() < 1e-12 * proof.forces.middle.max()
    alone = np.bincount(
        np.append(p.a, p.b[p.b >= 0]), np.append(proof.loaded, proof.loaded[p.b >= 0])
    )
    assert (alone == 0).sum() >= (1 if shrink < 0.97 else 0)
    assert (proof.gaps.middle[~proof.loaded] > 0).all()


def test_a_packing_that_does_not_need_its_walls_is_the_same_without_positions() -> None:
    p = PACKINGS["heap between walls"]
    ends = [p.contact_ends(k) for k in range(len(p.a))]
    i, j = zip(*ends, strict=True)
    bare = from_contacts(i, j, p.normals.high, p.gaps.high, supports=p.supports, stiffness=100)
    one, other = prove_packing(p), prove_packing(bare)
    assert np.abs(one.forces.middle - other.forces.middle).max() < 1e-14
    assert one.loaded.tolist() == other.loaded.tolist()


FALLING = {
    "nothing below": packing([(0, 1)], 1),
    "no walls": packing(HEAP, 1, supports={"floor": 0}, stiffness=100),
    "column out of line": packing([(0, 1), (1e-3, 3)], 1, supports={"floor": 0}, stiffness=100),
    "one falls, one is squeezed": packing(
        [(0, 1), (10, 5)], 1, supports=BOX | {"right": 99.0, "ceiling": 6.05}, tolerance=0.1
    ),
    "over the edge of a stone": packing([(0, 1), (0.5, 2.9)], 1, held=[True, False]),
    "a sphere on two": packing(
        [(0, 0, 0), (2, 0, 0), (1, 1e-3, ROOT3)], 1, held=[True, True, False]
    ),
}


@pytest.mark.parametrize("name", FALLING)
@mpmath.workdps(50)
def test_a_collapse_is_proved(name: str) -> None:
    """The motion closes no contact and lowers the loads, in 50 digits, so no forces balance."""
    p = FALLING[name]
    proof = prove_packing(p)
    assert not proof.proved
    assert proof.unproved == ()
    u = [[mpmath.mpf(t) for t in row] for row in proof.collapse.tolist()]
    pulls = [
        (mpmath.mpf(t), s)
        for row, v in zip(p.loads.tolist(), u, strict=True)
        for t, s in zip(row, v, strict=True)
    ]
    assert not proof.collapse[p.held].any()
    assert sum(t * s for t, s in pulls) > 0
    x = p.geometry.centres.tolist()
    for k in range(len(p.a)):
        a, b = int(p.a[k]), int(p.b[k])
        there = u[b] if b >= 0 else [mpmath.mpf(0)] * p.dimension
        line = p.geometry.walls[p.supports[p.support[k]]].normal if b < 0 else [
            mpmath.mpf(s) - mpmath.mpf(t) for s, t in zip(x[a], x[b], strict=True)
        ]  # fmt: skip
        assert sum(n * (s - t) for n, s, t in zip(line, u[a], there, strict=True)) >= 0


def test_ties_are_named() -> None:
    """Two discs that just touch, side by side on a floor: the contact may or may not carry."""
    proof = prove_packing(packing([(0, 1), (2, 1)], 1, supports={"floor": 0}))
    assert [proof.scene.contact_name(k) for k in proof.unproved] == ["0-1"]
    assert proof.forces.middle.tolist() == [0, 1, 1]


def test_a_contact_is_told_to_the_last_bits_of_its_gap() -> None:
    """The same, 2^-50 and -2^-50 apart: forces and gaps of 1e-15, with their signs."""
    for step, carries in ((2.0**-50, False), (-(2.0**-50), True)):
        walls = {"floor": 0.0, "left": -1.0, "right": 3.0 + step}
        proof = prove_packing(packing([(0, 1), (2 + step, 1)], 1, supports=walls))
        assert (0 in proof.unproved) or proof.loaded[0] == carries
    apart = packing([(0, 1), (2 + 2.0**-50, 1)], 1, supports={"floor": 0})
    proof = prove_packing(apart)
    assert proof.proved
    assert proof.loaded.tolist() == [False, True, True]


def test_a_wrong_proposal_is_repaired_or_nothing_is_claimed(monkeypatch) -> None:
    p = rough_lattice(5, 5, 1e-3, 1e3)
    true = prove_packing(p)
    honest = prove.newton_on
    outcomes = []
    for seed in range(12):
        flip = np.random.default_rng(seed).random(len(p.a)) < (0.02 if seed % 2 else 0.15)

        def corrupted(*args, flip=flip):
            guess = honest(*args)
            forces = np.where(flip, 1.0 - guess.closed, guess.forces)
            return replace(guess, closed=guess.closed ^ flip, forces=forces)

        monkeypatch.setattr(prove, "newton_on", corrupted)
        try:
            proof = prove_packing(p)
        except SolveError:
            continue
        assert proof.collapse is None
        assert not proof.proved or proof.loaded.tolist() == true.loaded.tolist()
        outcomes.append(proof.proved)
    assert any(outcomes)


def test_numbers_of_any_units_give_the_same_forces() -> None:
    """A millimetre and a micronewton, or a light year and the weight of a star."""
    x, k = np.array([(1 + 2 * i, 1 + 1e-4 * i * i) for i in range(4)]), 1e3
    one = prove_packing(packing(x, 1, supports={"floor": 0, "left": 0}, stiffness=k, tolerance=0.1))
    for length, force in ((1e-3, 1e-6), (1e16, 1e31)):
        other = prove_packing(
            packing(
                x * length, length, weights=force, stiffness=k * force / length,
                supports={"floor": 0, "left": 0}, tolerance=0.1,
            )
        )  # fmt: skip
        assert other.loaded.tolist() == one.loaded.tolist()
        assert np.abs(other.forces.middle / force - one.forces.middle).max() < 1e-12


def test_a_disc_twice_is_refused_and_weightless_discs_rest_anywhere() -> None:
    with pytest.raises(InputError, match="one disc twice"):
        packing([(0, 1), (0, 1)], 1)
    proof = prove_packing(packing([(0, 1), (5, 1)], 1, weights=0, supports={"floor": 0}))
    assert not proof.loaded.any()


def test_the_disc_that_is_not_held_is_named() -> None:
    """Weightless discs in a row that two walls squeeze, along no axis: they may leave sideways."""
    line = np.array([0.6, 0.8])
    walls = {"a": (-line, line), "b": (4.99 * line, -line)}
    p = packing([0 * line, 2 * line, 4 * line], 1, weights=0, supports=walls, stiffness=100)
    with pytest.raises(SolveError, match=r"hold disc [012] too weakly"):
        prove_packing(p)


def test_slides_refuse_discs_of_other_radii() -> None:
    with pytest.raises(InputError, match="discs of radius 1"):
        crowd_of(rational_scene(packing([(0, 2)], 2, supports={"floor": 0})))
