"""Silos and hoppers: patches of the triangular lattice between rigid walls, on a rigid floor."""

from __future__ import annotations

from fractions import Fraction

from random_scenes import NORMALS, ROOT, SUPPORTS, ZERO, custom

from lcp_piles import Contact, Disc, Scene, surd


def silo(width: int, height: int) -> Scene:
    """Rows of `width` and `width - 1` discs in turns, `height` in all, between vertical walls."""
    return _between([width - row % 2 for row in range(height)], ("left wall", "right wall"))


def hopper(width: int, height: int) -> Scene:
    """Rows of `width`, `width + 1`, ... discs, `height` in all, between walls of 60 degrees."""
    return _between([width + row for row in range(height)], ("left slope", "right slope"))


def _between(lengths: list[int], walls: tuple[str, str]) -> Scene:
    """Rows of these lengths from the floor up; the ends of those that reach a wall touch it.

    Discs have weight and compliance 1, walls and floor none.
    """
    straight = walls == ("left wall", "right wall")
    rigid = Fraction(0)
    ends = [(1 - n, n - 1) for n in lengths]
    places = [(x, row) for row, (a, b) in enumerate(ends) for x in range(a, b + 1, 2)]
    known = set(places)
    contacts = []
    for a in places:
        for (right, up), normal in NORMALS.items():
            b = (a[0] + right, a[1] + up)
            if b in known:
                contacts.append(Contact(a, b, normal))
        if a[1] == 0:
            contacts.append(Contact(a, "floor", SUPPORTS["floor"], rigid))
        for name, end in zip(walls, ends[0 if straight else a[1]], strict=True):
            if a[0] == end:
                contacts.append(Contact(a, name, SUPPORTS[name], rigid))
    free, weight = (None, None), (ZERO, surd(-1))
    return custom([Disc(p, (surd(p[0]), ROOT * p[1]), weight, free) for p in places], contacts)
