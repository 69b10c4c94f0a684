"""The paper's letters against the angles of the figure, measured from the lattice points."""

import math

import pytest

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    contact_by_letter,
    letter_force,
    nt30,
    nt60,
    solve,
    tbs,
    tss,
)
from lcp_piles.numbers.exact import ONE, ZERO

TILTED = dict(zip("abcdef", range(30, 360, 60), strict=True))
UNTILTED = {**dict(zip("abcdef", range(0, 360, 60), strict=True)), "p": 270}
PILES = [(tbs(4), TILTED), (tss(5), TILTED), (nt60(5), UNTILTED), (nt30(4), UNTILTED)]


@pytest.mark.parametrize(("scene", "angles"), PILES, ids=lambda value: getattr(value, "kind", ""))
def test_every_contact_has_one_letter_on_each_of_its_discs(scene, angles):
    named = {}
    for disc in scene.discs:
        for letter, angle in angles.items():
            contact = contact_by_letter(scene, disc.id, letter)
            if contact is None:
                continue
            a, b = contact
            other = b if a == disc.id else a
            if isinstance(other, str):
                assert angle == 270
            else:
                there = scene.disc(other).position
                x, y = (float(q - p) for p, q in zip(disc.position, there, strict=True))
                assert round(math.degrees(math.atan2(y, x)), 9) % 360 == angle
            named.setdefault(contact, []).append(disc.id)
    expected = {(c.a, c.b): 1 if c.b == "floor" else 2 for c in scene.contacts}
    assert {contact: len(ends) for contact, ends in named.items()} == expected


def test_the_left_flank_as_the_paper_has_it():
    """b_(i,1) and c_(i,1) do not exist, nor e_(N-1,j); e_(N,j) is the floor (TSS)."""
    pile = tss(6)
    for i in range(1, 7):
        assert contact_by_letter(pile, (i, 1), "b") is None
        assert contact_by_letter(pile, (i, 1), "c") is None
    for j in range(1, 6):
        assert contact_by_letter(pile, (5, j), "e") is None
    for j in range(2, 6):
        assert contact_by_letter(pile, (6, j), "e") == ((6, j), "floor")


def test_p_is_the_floor_of_the_base_row_only():
    pile = nt30(3)
    assert contact_by_letter(pile, (3, 2), "p") == ((3, 2), "floor")
    assert contact_by_letter(pile, (2, 2), "p") is None
    assert contact_by_letter(pile, (3, 1), "p") is None  # a held corner stone


def test_forces_by_letter_balance_a_disc():
    """Disc (2, 1) of TSS has a, d, e, f only: its balance is what the letters must satisfy."""
    pile = solve(tss(7))
    a, d, e, f = (letter_force(pile, (2, 1), letter) for letter in "adef")
    assert d - a - f == 0
    assert (d + f - a) / 2 + e == 1
    assert letter_force(pile, (2, 1), "b") is None


def test_open_contact_has_force_zero():
    pile = solve(tss(6))
    assert pile.state((2, 1), (3, 2)) == "open"
    assert letter_force(pile, (2, 1), "f") == 0


def test_refuses_unknown_letters_discs_and_lattices():
    with pytest.raises(InputError, match="one of a, b, c, d, e, f"):
        contact_by_letter(tss(3), (2, 1), "p")
    with pytest.raises(InputError, match="one of the 6 discs"):
        contact_by_letter(tss(3), (4, 1), "a")
    free = (None, None)
    discs = tuple(Disc((k,), (ONE * (2 * k), ZERO), (ZERO, -ONE), free) for k in (1, 2))
    floor = tuple(Contact((k,), "floor", (ZERO, ONE)) for k in (1, 2))
    with pytest.raises(InputError, match="triangular lattice"):
        contact_by_letter(Scene(discs, floor), (1,), "e")
    upright = Contact((1,), (2,), (ZERO, ONE))
    beside = Contact((1,), (3,), (-ONE, ZERO))
    discs = tuple(
        Disc((k,), place, (0, -1), free) for k, place in ((1, (0, 2)), (2, (0, 0)), (3, (2, 2)))
    )
    with pytest.raises(InputError, match="triangular lattice"):
        contact_by_letter(Scene(discs, (upright, beside)), (1,), "e")
