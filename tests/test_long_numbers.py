"""Scenes whose normals and compliances have long numerators and denominators, solved exactly.

Every answer is held against the scene alone by `verify`, which shares no matrix with the solver.
"""

import random
from dataclasses import replace
from fractions import Fraction
from itertools import cycle
from math import isqrt

import numpy as np
import pytest
from flint import fmpq, fmpq_mat
from helpers import fmpq_of
from scipy.sparse import csr_array

from lcp_piles import (
    Contact,
    Disc,
    FirstOrder,
    Scene,
    contact_system,
    continuation,
    first_order,
    load,
    nt30,
    prove_contacts,
    save,
    solve,
    surd,
    verify,
)
from lcp_piles.linear.kernel import kernel

_PLANES = (("right", -1), ("left", 1))


def _unit(p: int, q: int) -> tuple[Fraction, Fraction]:
    """A rational unit vector, nearly upright, with the denominator p^2 + q^2."""
    return Fraction(2 * p * q, p * p + q * q), Fraction(p * p - q * q, p * p + q * q)


def _tower(*sizes: int, discs: int = 30) -> Scene:
    """Discs on each other, each between two planes; normals have denominators of these sizes.

    The planes push to the left and to the right, so that some forces balance any weight.
    """
    draw = random.Random(sizes[0])
    turns = cycle(sizes)

    def normal(side: int) -> tuple[Fraction, Fraction]:
        size = next(turns)
        q = draw.randrange(isqrt(size) // 3, isqrt(size) // 2)
        x, y = _unit(isqrt(size - q * q), q)
        return side * x, y

    contacts = [Contact(k, name, normal(s)) for k in range(discs) for name, s in _PLANES]
    contacts += [Contact(k, k - 1, normal((-1) ** k)) for k in range(1, discs)]
    piled = tuple(Disc(k, (0, 2 * k + 1), (0, -1), (None, None)) for k in range(discs))
    return Scene(piled, tuple(contacts), supports=("left", "right"), geometric=False)


@pytest.mark.parametrize("size", [10**3, 10**6, 10**9, 10**12, 10**15])
def test_normals_with_long_denominators(size):
    scene = _tower(size)
    solution = solve(scene)
    assert solution.status == "solved"
    assert verify(scene, solution).ok


@pytest.mark.parametrize("compliance", [Fraction(10**40 + 1, 3**50), Fraction(int("9" * 400))])
def test_compliances_of_any_length(compliance):
    scene = nt30(3, floor_compliance=compliance)
    solution = solve(scene)
    assert solution.status == "solved"
    assert verify(scene, solution).ok


def test_stiffnesses_at_the_end_of_int64():
    """Compliances 2^-e: from some e on the products of B^T E B would wrap."""
    told = []
    for e in range(48, 64, 2):
        scene = nt30(3, floor_compliance=Fraction(1, 2**e))
        told.append(contact_system(scene).stiffness is None)
        assert verify(scene, solve(scene)).ok
    assert told == sorted(told)
    assert set(told) == {False, True}


@pytest.mark.parametrize("method", ["proved", "lemke"])
def test_nothing_touches_and_the_compliance_is_long(method):
    disc = Disc(1, (0, 1), (0, 0), (None, None))
    floor = Contact(1, "floor", (0, 1), Fraction(10**40 + 1, 3**50), gap=1)
    solution = solve(Scene([disc], [floor], supports=("floor",)), method)
    assert solution.states == ("open",)
    assert next(iter(solution.gaps)) > 0


def _rational(x):
    number = surd(x).rational()
    return fmpq_of(number)


def _with_these_closed(scene: Scene, closed: list[int]) -> tuple[list[fmpq], list[fmpq]]:
    """Forces and gaps of all contacts where these are closed, by one dense rational solve.

    The unknowns are displacements and forces: N^T f = -p, and N u + c f = -o at the closed ones.
    """
    normals = []
    for contact in scene.contacts:
        row = [fmpq(0)] * (2 * len(scene.discs))
        for end, side in ((contact.a, 1), (contact.b, -1)):
            for axis in range(2 if not isinstance(end, str) else 0):
                row[2 * scene.disc_index(end) + axis] += side * _rational(contact.normal[axis])
        normals.append(row)
    size, count = 2 * len(scene.discs), len(closed)
    A, right = fmpq_mat(size + count, size + count), fmpq_mat(size + count, 1)
    for j in range(size):
        right[j, 0] = -_rational(scene.discs[j // 2].load[j % 2])
    for i, k in enumerate(closed, size):
        for j in range(size):
            A[i, j] = A[j, i] = normals[k][j]
        A[i, i] = _rational(scene.contacts[k].compliance)
        right[i, 0] = -_rational(scene.contacts[k].gap)
    x = A.solve(right).entries()
    forces = [fmpq(0)] * len(normals)
    for i, k in enumerate(closed, size):
        forces[k] = x[i]
    gaps = []
    for contact, row, f in zip(scene.contacts, normals, forces, strict=True):
        stretch = sum((n * u for n, u in zip(row, x[:size], strict=True)), fmpq(0))
        gaps.append(stretch + _rational(contact.gap) + _rational(contact.compliance) * f)
    return forces, gaps


def _soft(scene: Scene) -> Scene:
    """The scene with long compliances, gaps and loads, all different."""
    contacts = tuple(
        replace(
            contact,
            compliance=Fraction(10**40 + k, 3**85),
            gap=Fraction(k % 3, 10**50 + 7),
        )
        for k, contact in enumerate(scene.contacts)
    )
    discs = tuple(
        replace(disc, load=(0, Fraction(-(10**60) - k, 10**60)))
        for k, disc in enumerate(scene.discs)
    )
    return replace(scene, discs=discs, contacts=contacts)


@pytest.mark.parametrize(
    "scene",
    [
        _tower(10**15, discs=10),
        _tower(10**30, discs=10),
        _tower(10**30, 10**3, 10**12, discs=10),
        _soft(_tower(10**30, 10**6, discs=6)),
        _tower(10**100, discs=6),
    ],
    ids=["15 digits", "30 digits", "3 to 30 digits", "all numbers long", "100 digits"],
)
def test_rows_of_any_length_against_a_dense_rational_solve(scene, tmp_path):
    solution = solve(scene)
    closed = [k for k, state in enumerate(solution.states) if state == "closed"]
    forces, gaps = _with_these_closed(scene, closed)
    assert all(
        f > 0 if k in closed else g > 0 for k, (f, g) in enumerate(zip(forces, gaps, strict=True))
    )
    assert [_rational(f) for f in solution.forces] == forces
    assert [_rational(g) for g in solution.gaps] == gaps
    assert verify(scene, solution).ok
    assert solution.stability.verdict == "stable"
    proof = prove_contacts(scene)
    assert proof.proved
    assert np.flatnonzero(proof.loaded).tolist() == closed
    for f, middle, radius in zip(forces, proof.forces.middle, proof.forces.radius, strict=True):
        low, high = (fmpq_of(Fraction(middle) + side * Fraction(radius)) for side in (-1, 1))
        assert low <= f <= high
        assert radius < 1e-12
    save(solution, tmp_path / "long.json")
    assert list(load(tmp_path / "long.json").forces) == list(solution.forces)


@pytest.mark.parametrize("method", ["lemke", "z"])
def test_every_exact_method_takes_long_rows(method):
    scene = _tower(10**30, 10**3, discs=6)
    assert list(solve(scene, method).forces) == list(solve(scene).forces)


def test_a_path_of_long_rows_ends_where_the_target_is_solved():
    scene = _tower(10**30, discs=6)
    discs = tuple(replace(disc, load=(0, -1 - 40 * (disc.id == 3))) for disc in scene.discs)
    target = replace(scene, discs=discs)
    path = continuation(scene, target, until=1)
    assert len(path.segments) > 1  # contacts change on the way
    assert list(path.segment(1).forces(1)) == list(solve(target).forces)


_LONG = {
    "30 digits": _unit(10**15, 3 * 10**14 + 1),
    "1000 digits": _unit(10**500, 3 * 10**499 + 1),
    "1000 digits, all but upright": _unit(10**500, 7),
}


@pytest.mark.parametrize("normal", _LONG.values(), ids=_LONG)
@pytest.mark.parametrize("method", ["proved", "lemke", "z"])
def test_a_disc_between_a_slope_and_a_wall_by_hand(normal, method):
    """f (x, y) + h (-1, 0) = (0, 1): f = 1 / y, h = x / y. The odd half has long rows too."""
    x, y = normal
    disc = Disc("a", (0, 0), (0, -1), (None, None))
    contacts = [Contact("a", "slope", normal), Contact("a", "wall", (-1, 0))]
    solution = solve(Scene([disc], contacts, supports=("slope", "wall")), method)
    assert list(solution.forces) == [surd(1 / y), surd(x / y)]
    sides = [Contact("a", "left", normal), Contact("a", "right", (-x, y))]
    groove = solve(Scene([disc], sides, supports=("left", "right")), method)
    assert groove.record.part == "even"
    assert list(groove.forces) == [surd(1 / (2 * y))] * 2
    assert groove.stability.verdict == "stable"


def test_bounds_where_a_normal_is_below_the_floats():
    x, y = _LONG["1000 digits, all but upright"]
    disc = Disc("a", (0, 0), (0, -1), (None, None))
    contacts = [Contact("a", "slope", (x, y)), Contact("a", "wall", (-1, 0))]
    proof = prove_contacts(Scene([disc], contacts, supports=("slope", "wall")))
    # The wall's force, x / y, is no float: it is not told from zero.
    assert float(x) == 0
    assert proof.unproved == (1,)
    assert abs(proof.forces.middle[0] - 1) <= proof.forces.radius[0] < 1e-12


def _leaning(normal: tuple[Fraction, Fraction], load: tuple[Fraction, ...], discs: int) -> Scene:
    """Discs in a straight line on a slope, which nothing keeps from sliding."""
    x, y = normal
    ways = [(2 * k + 1) for k in range(discs)]
    piled = [Disc(k, (way * x, way * y), load, (None, None)) for k, way in enumerate(ways)]
    contacts = [Contact(0, "slope", normal)]
    contacts += [Contact(k, k - 1, normal) for k in range(1, discs)]
    return Scene(piled, contacts, supports=("slope",))


@pytest.mark.parametrize("normal", _LONG.values(), ids=_LONG)
def test_mechanisms_of_long_rows_by_hand(normal):
    """A load along the line is carried by all below; each disc can slide along the slope."""
    x, y = normal
    scene = _leaning(normal, (-x, -y), 3)
    solution = solve(scene)
    assert list(solution.forces) == [3, 2, 1]
    stability = solution.stability
    assert (stability.mechanisms, stability.free, stability.verdict) == (3, 3, "saddle")
    assert verify(scene, solution).ok


@pytest.mark.parametrize("normal", _LONG.values(), ids=_LONG)
@pytest.mark.parametrize("method", ["proved", "lemke"])
def test_a_collapse_of_long_rows(normal, method):
    scene = _leaning(normal, (0, -1), 3)
    solution = solve(scene, method)
    assert solution.status == "unstable"
    assert verify(scene, solution).ok


def test_the_first_order_of_a_pile_with_long_rows():
    """A column on three discs' normals: its own check is exact, and holds the geometry alone."""
    normal = _LONG["30 digits"]
    scene = _leaning(normal, (0, -1), 3)
    walls = tuple(Contact(disc.id, "wall", (-1, 0)) for disc in scene.discs)
    held = replace(scene, contacts=(*scene.contacts, *walls), supports=("slope", "wall"))
    solution = solve(held)
    soft = first_order(solution)
    # By hand, as in a disc between slope and wall: the column carries n (1 / y) of all above.
    assert list(solution.forces)[:3] == [surd(k / normal[1]) for k in (3, 2, 1)]
    assert isinstance(soft, FirstOrder)


def test_the_kernel_of_entries_whose_squares_do_not_fit():
    # By hand: (b, -a) is the kernel of the row (a, b). The square of 2^32 is 0 in 64 bits.
    a, b = 2**32, 2**32 * 3 + 1
    basis, pinned = kernel(csr_array(np.array([[a, b]], dtype=np.int64)))
    assert len(basis) == len(pinned) == 1
    assert basis[0][0] * a + basis[0][1] * b == 0
    assert any(basis[0])
    assert kernel(csr_array(np.array([[2**32]], dtype=np.int64))) == ([], [])
