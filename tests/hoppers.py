"""Hoppers: rows of the triangular lattice that get narrower downwards, between sloping walls."""

from __future__ import annotations

from fractions import Fraction

from random_scenes import SUPPORTS

from lcp_piles import Scene, Support, lattice


def hopper(width: int, height: int) -> Scene:
    """Rows of `width`, `width + 1`, ... discs, `height` in all, between rigid walls of 60 degrees.

    The floor is rigid too.
    """
    cells = {
        (height - r, j): (2 * j - width - r - 1, r)
        for r in range(height)
        for j in range(1, width + r + 1)
    }
    touching = {
        "floor": [(height, j) for j in range(1, width + 1)],
        "left slope": [(height - r, 1) for r in range(height)],
        "right slope": [(height - r, width + r) for r in range(height)],
    }
    supports = [Support(name, SUPPORTS[name], ids, Fraction(0)) for name, ids in touching.items()]
    return lattice(cells, {}, supports)
