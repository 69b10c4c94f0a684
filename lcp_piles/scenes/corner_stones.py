"""Piles on a smooth floor between two corner stones, which are held, and may be pushed together.

Disc (i, j) is the j-th from the left of the i-th row from the apex down; rows are centred on x = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from ..numbers.exact import ZERO, Surd
from .grid import Hold, Support
from .kind import Push
from .lattice import SQRT3, UP, Cell, lattice
from .names import DiscId
from .parameters import HELD, RESTING
from .scene import Scene

PUSH_OF_CORNER_STONES = Push("push", SQRT3)
UNIQUE_ABOVE = Fraction(-2, 3)
"""Above this floor compliance the energy of the piles on a smooth floor is strictly convex on the
forces that balance (notes/paper.md, section 2)."""

_FLOOR = "floor"


def rows(lengths: list[int]) -> dict[DiscId, Cell]:
    """The cells of rows of these lengths from the apex down, all centred on one axis.

    >>> rows([1, 2])
    {(1, 1): (0, 1), (2, 1): (-1, 0), (2, 2): (1, 0)}
    """
    return {
        (i, j): (2 * j - count - 1, len(lengths) - i)
        for i, count in enumerate(lengths, start=1)
        for j in range(1, count + 1)
    }


def smooth_pile(
    length: Callable[[int], int],
    orientation: str,
    layers: int,
    push: Surd,
    floor_compliance: Fraction,
    corner_stones: str,
) -> Scene:
    """A pile with `length(i)` discs in row i, on a smooth floor between two corner stones."""
    base = length(layers)
    vertical = None if corner_stones == RESTING else ZERO
    held: dict[DiscId, Hold] = {
        (layers, 1): Hold((push, vertical)),
        (layers, base): Hold((-push, vertical)),
    }
    resting = range(1, base + 1) if corner_stones == RESTING else range(2, base)
    floor = Support(_FLOOR, UP, [(layers, j) for j in resting], floor_compliance)
    cells = rows([length(i) for i in range(1, layers + 1)])
    return lattice(cells, held, [floor], orientation)


def floor_contacts(base: int, corner_stones: str) -> int:
    """How many discs of a base row touch the floor."""
    return base - 2 if corner_stones == HELD else base
