"""Scenes whose normals and compliances have long numerators and denominators, solved exactly.

Every answer is held against the scene alone by `verify`, which shares no matrix with the solver.
"""

import random
from fractions import Fraction
from math import isqrt

import numpy as np
import pytest
from scipy.sparse import csr_array

from lcp_piles import Contact, Disc, Scene, SolveError, contact_system, nt30, solve, verify
from lcp_piles.linear.kernel import kernel

_PLANES = (("right", -1), ("left", 1))


def _unit(p: int, q: int) -> tuple[Fraction, Fraction]:
    """A rational unit vector, nearly upright, with the denominator p^2 + q^2."""
    return Fraction(2 * p * q, p * p + q * q), Fraction(p * p - q * q, p * p + q * q)


def _tower(size: int, discs: int = 30) -> Scene:
    """Discs on each other, each between two planes; normals have denominators of about `size`.

    The planes push to the left and to the right, so that some forces balance any weight.
    """
    draw = random.Random(size)

    def normal(side: int) -> tuple[Fraction, Fraction]:
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


def test_normals_beyond_the_integers_of_a_system_are_refused_with_what_to_do():
    with pytest.raises(SolveError, match="round the normals"):
        solve(_tower(10**30, discs=2))


def test_the_kernel_of_entries_whose_squares_do_not_fit():
    # By hand: (b, -a) is the kernel of the row (a, b). The square of 2^32 is 0 in 64 bits.
    a, b = 2**32, 2**32 * 3 + 1
    basis, pinned = kernel(csr_array(np.array([[a, b]], dtype=np.int64)))
    assert len(basis) == len(pinned) == 1
    assert basis[0][0] * a + basis[0][1] * b == 0
    assert any(basis[0])
    assert kernel(csr_array(np.array([[2**32]], dtype=np.int64))) == ([], [])
