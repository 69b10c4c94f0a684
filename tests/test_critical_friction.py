"""The least friction at which piles stand: closed forms, and ends checked from the geometry."""

from fractions import Fraction

import pytest
import sympy
from flint import fmpq_poly
from test_friction import assert_admissible

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    critical_friction,
    force_bounds,
    pile,
    surd,
)
from lcp_piles.friction.algebraic import AlgebraicNumber, sign_at
from lcp_piles.friction.critical_friction import free_standing
from lcp_piles.friction.force_bounds import InadmissibleError
from lcp_piles.friction.threshold_in_roots import is_least, threshold_in_roots

ROOT = sympy.sqrt(3)
M = sympy.Symbol("m")
NT30_3 = 8 * M**6 - 36 * M**5 + 39 * M**4 + 12 * M**3 - 30 * M**2 + 3


def assert_slides(scene, mu, motion):
    """The loads do work on the motion, and every contact opens at least as fast as it slips."""
    flat = list(motion)
    moves = {disc.id: flat[3 * k : 3 * k + 3] for k, disc in enumerate(scene.discs)}
    still = [surd(0)] * 3
    work = surd(0)
    for disc in scene.discs:
        for axis, held in enumerate(disc.held):
            assert held is None or not moves[disc.id][axis]
            work += disc.load[axis] * moves[disc.id][axis]
        assert not (disc.fixed and moves[disc.id][2])
    assert work > 0
    for contact in scene.contacts:
        n, t = contact.normal, (-contact.normal[1], contact.normal[0])
        a, b = moves[contact.a], moves.get(contact.b, still)
        apart = sum((n[axis] * (a[axis] - b[axis]) for axis in (0, 1)), surd(0))
        along = sum((t[axis] * (a[axis] - b[axis]) for axis in (0, 1)), surd(0)) + a[2] + b[2]
        assert apart >= mu * abs(along)


def assert_ends(found, width):
    assert 0 <= found.upper - found.lower <= width
    assert_admissible(found.scene, found.network, found.upper, found.scene.supports)
    assert_slides(found.scene, found.lower, found.motion)


@pytest.mark.parametrize(
    ("kind", "layers", "expected"),
    [
        ("nt60", 2, 2 - ROOT),
        ("nt30", 2, 2 - ROOT),
        ("nt60", 3, sympy.sqrt((9 - 4 * ROOT) / 11)),
        ("tss", 2, 1 / ROOT),
        ("tss", 4, 1 / ROOT),
        ("tss", 6, 1 / ROOT),
        ("nt30", 3, sympy.CRootOf(NT30_3, 2)),
    ],
)
def test_closed_forms(kind, layers, expected):
    found = critical_friction(pile(kind, layers))
    assert_ends(found, Fraction(1, 10**12))
    value = found.exact
    minimal = sympy.Poly(sympy.minimal_polynomial(expected, M), M)
    assert minimal.all_coeffs()[::-1] == list(value.polynomial)
    assert abs(sympy.N(expected, 40) - sympy.Float(value.decimal(40), 40)) < 1e-38


def test_nt30_3_to_many_digits():
    found = critical_friction(pile("nt30", 3), Fraction(1, 10**9))
    assert_ends(found, Fraction(1, 10**9))
    assert found.exact.decimal(24) == "0.370213235178606002116222"
    assert found.lower < found.exact.narrowed(200)[0] < found.exact.narrowed(200)[1] <= found.upper
    assert repr(found.exact).endswith(f"a root of {NT30_3}>")


def test_ends_as_near_as_asked_for():
    width = Fraction(1, 10**40)
    found = critical_friction(pile("nt60", 2), width)
    assert_ends(found, width)
    assert found.lower < surd("2 - sqrt(3)") <= found.upper


def test_the_bumpy_bed_needs_no_friction():
    found = critical_friction(pile("tbs", 3))
    assert (found.lower, found.upper, found.motion) == (0, 0, None)
    assert_admissible(found.scene, found.network, 0)
    assert float(found.exact) == 0
    assert found.scene == pile("tbs", 3)


def test_a_large_pile_is_bracketed_and_not_recognised():
    found = critical_friction(pile("nt60", 9), Fraction(1, 1000))
    assert_ends(found, Fraction(1, 1000))
    assert found.exact is None


@pytest.mark.parametrize("layers", [4, 6])
def test_tilted_piles_need_one_over_root_three_at_every_size(layers):
    scene = free_standing(pile("tss", layers))
    everywhere = {(c.a, c.b): 1 for c in scene.contacts}
    bounds = force_bounds(scene, "sqrt(3)/3", everywhere, scene.supports)
    assert_admissible(scene, bounds.least.network, "sqrt(3)/3", scene.supports)
    less = surd("sqrt(3)/3") - Fraction(1, 10**9)
    with pytest.raises(InadmissibleError) as caught:
        force_bounds(scene, less, everywhere, scene.supports)
    assert_slides(scene, less, caught.value.motion)


def test_what_stands_with_no_friction_at_all():
    wall = Contact("disc", "wall", (1, 0))
    scene = Scene([Disc("disc", (0, 0), (0, -1), (None, None))], [wall], supports=("wall",))
    with pytest.raises(InadmissibleError) as caught:
        critical_friction(scene)
    assert_slides(scene, 2**20, caught.value.motion)


def test_discs_that_are_let_go_stand_on_the_floor_and_touch():
    scene = free_standing(pile("nt60", 2))
    assert all(disc.held == (None, None) for disc in scene.discs)
    ends = [{c.a, c.b} for c in scene.contacts]
    assert {(2, 1), (2, 2)} in ends
    assert {(2, 1), "floor"} in ends
    resting = free_standing(pile("nt60", 4, corner_stones="resting"))
    assert len(resting.contacts) == len(pile("nt60", 4, corner_stones="resting").contacts)
    two = Scene(
        [Disc(1, (0, 0), (0, -1), (0, 0)), Disc(2, (2, 0), (0, -1), (None, None))],
        [Contact(2, "floor", (0, 1))],
        supports=("floor", "wall"),
    )
    with pytest.raises(InputError, match="disc 1"):
        free_standing(two)


def test_progress_and_a_width_that_means_nothing():
    said = []
    found = critical_friction(
        pile("nt60", 2), "1/100", progress=lambda low, high: said.append((low, high))
    )
    assert said[-1] == (found.lower, found.upper)
    for width in (0, -1, "sqrt(3)", 0.5):
        with pytest.raises(InputError):
            critical_friction(pile("nt60", 2), width)


def test_signs_at_an_algebraic_number():
    # x = 2 - sqrt(3): x + sqrt(3) - 2 is zero, and its conjugate x - sqrt(3) - 2 is not.
    x = AlgebraicNumber((1, -4, 1), Fraction(1, 4), Fraction(1, 3))
    shifted, one = fmpq_poly([-2, 1]), fmpq_poly([1])
    assert sign_at(x, {1: shifted, 3: one}) == 0
    assert sign_at(x, {1: shifted, 3: -one}) == -1
    assert sign_at(x, {1: -shifted, 3: one}) == 1
    assert sign_at(x, {1: fmpq_poly([1, -4, 1])}) == 0
    assert sign_at(x, {1: fmpq_poly([-1, 0, 14])}) == 1  # 14 x^2 > 1 > 13 x^2
    assert sign_at(x, {1: fmpq_poly([-1, 0, 13])}) == -1
    assert sign_at(x, {}) == 0
    # The last of a and b with a^2 - 3 b^2 = 1 so large that 96 bits do not tell a from sqrt(3) b.
    a, b = 1, 0
    for _ in range(90):
        a, b = 2 * a + 3 * b, a + 2 * b
    assert sign_at(x, {1: fmpq_poly([a]), 3: fmpq_poly([-b])}) == 1
    assert sign_at(x, {1: fmpq_poly([-a]), 3: fmpq_poly([b])}) == -1


def test_an_algebraic_number_reads_as_one():
    half = AlgebraicNumber((-1, 2), Fraction(0), Fraction(1))
    assert (half.narrowed(5), float(half), half.sympy()) == (
        (Fraction(1, 2), Fraction(1, 2)),
        0.5,
        sympy.Rational(1, 2),
    )
    cubic = AlgebraicNumber((-2, 0, 0, 1), Fraction(1), Fraction(2))
    assert cubic.decimal(15) == "1.25992104989487"
    assert cubic.sympy() == sympy.cbrt(2)


def test_a_wrong_number_in_roots_is_not_the_least_friction():
    scene = free_standing(pile("nt60", 2))
    least = surd("2 - sqrt(3)")
    assert threshold_in_roots(scene, Fraction(267949, 10**6), Fraction(26795, 10**5)) == least
    for wrong in ("1/4", "1/3", "3 - 3/2*sqrt(3)"):  # below, above, above by roots
        assert not is_least(scene, surd(wrong))
    assert threshold_in_roots(scene, Fraction(3, 10), Fraction(30001, 10**5)) is None
