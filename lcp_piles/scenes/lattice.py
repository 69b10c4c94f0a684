"""Piles on the triangular lattice, tilted or not, and on a smooth floor between corner stones.

Disc (i, j) is the j-th from the left of the i-th row from the apex down. All discs have radius 1
and weight 1; rows are centred on x = 0; discs two apart are neighbours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from ..numbers.exact import ONE, ZERO, Surd, sqrt_of, surd
from .kind import Push
from .names import DiscId
from .parameters import HELD, RESTING
from .scene import Contact, Disc, Numbers, Scene

SQRT3 = sqrt_of(3)
WEIGHT = (ZERO, -ONE)
FREE = (None, None)
PUSH_OF_CORNER_STONES = Push("push", SQRT3)
UNIQUE_ABOVE = Fraction(-2, 3)
"""Above this floor compliance the energy of the piles on a smooth floor is strictly convex on the
forces that balance (notes/paper.md, section 2)."""

_HALF = surd("1/2")
_UP = (ZERO, ONE)
_LEFT = (-ONE, ZERO)
_ABOVE_RIGHT = (SQRT3 * _HALF, _HALF)  # tilted: from the lower left disc to this one
_ABOVE_LEFT = (-SQRT3 * _HALF, _HALF)
_STEEP_RIGHT = (_HALF, SQRT3 * _HALF)  # untilted
_STEEP_LEFT = (-_HALF, SQRT3 * _HALF)
_FLOOR = "floor"

Below = Callable[[int, int], list[Contact]]


@dataclass(frozen=True)
class Rows:
    """The rows of a pile: how many discs each has, and how far apart rows and columns are.

    Columns count half the distance of two neighbours in a row.
    """

    layers: int
    length: Callable[[int], int]
    column: Surd
    height: Surd


def smooth_pile(
    rows: Rows, below: Below, push: Surd, floor_compliance: Fraction, corner_stones: str
) -> Scene:
    """A pile on a smooth floor between two corner stones; `below` has the contacts of each disc."""
    layers = rows.layers
    base = rows.length(layers)
    vertical = ZERO if corner_stones == HELD else None
    columns = {c: rows.column * c for c in range(-base, base + 1)}
    discs, contacts = [], []
    for i in range(1, layers + 1):
        count = rows.length(i)
        y = rows.height * (layers - i)
        for j in range(1, count + 1):
            held: tuple[Surd | None, ...] = FREE
            if i == layers and j in (1, base):
                held = (push if j == 1 else -push, vertical)
            discs.append(Disc((i, j), (columns[2 * j - count - 1], y), WEIGHT, held))
            contacts += below(i, j)
    # Two stones whose distance nothing can change carry nothing that matters to the pile.
    corners = {(layers, 1), (layers, base)}
    contacts = [c for c in contacts if not (c.a in corners and c.b in corners)]
    resting = range(1, base + 1) if corner_stones == RESTING else range(2, base)
    bilateral = floor_compliance < 0
    contacts += [
        Contact((layers, j), _FLOOR, _UP, floor_compliance, bilateral=bilateral) for j in resting
    ]
    return Scene(tuple(discs), tuple(contacts), (_FLOOR,))


def floor_contacts(base: int, corner_stones: str) -> int:
    """How many discs of a base row touch the floor."""
    return base if corner_stones == RESTING else base - 2


def tilted_below(i: int, j: int, rows: int) -> list[Contact]:
    """Contacts of disc (i, j) of a tilted lattice with the discs below it, rows of i discs."""
    found: list[tuple[DiscId, Numbers]] = []
    if i < rows:
        found += [((i + 1, j), _ABOVE_RIGHT), ((i + 1, j + 1), _ABOVE_LEFT)]
    if i + 1 < rows:
        found.append(((i + 2, j + 1), _UP))
    return [Contact((i, j), below, normal) for below, normal in found]


def untilted_below(i: int, j: int, rows: int, length: Callable[[int], int]) -> list[Contact]:
    """Contacts of disc (i, j) with its right neighbour and the discs of the next row."""
    found: list[tuple[DiscId, Numbers]] = []
    if j < length(i):
        found.append(((i, j + 1), _LEFT))
    if i < rows:
        # The next row is wider by t' - t discs; its disc j + (t' - t + 1)/2 stands one radius to
        # the right of this disc, the one before it one radius to the left.
        right = j + (length(i + 1) - length(i) + 1) // 2
        found += [((i + 1, right - 1), _STEEP_RIGHT), ((i + 1, right), _STEEP_LEFT)]
    return [Contact((i, j), below, normal) for below, normal in found]
