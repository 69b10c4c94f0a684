"""Blocks of the triangular lattice: rows of equal width, between walls or free at their sides.

Silos and slabs are blocks. Row 0 is the lowest. Untilted, even rows have `width` discs and odd rows
one less; tilted, the block has `width` columns, and every second of them stands one radius higher.
A bumpy wall or floor is made of held discs on the lattice, just those that touch a free one.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby

from ..numbers.exact import ONE, ZERO, Surd
from .grid import Hold, Support
from .lattice import ORIENTATIONS, TILTED, UNTILTED, UP, Cell, lattice
from .names import DiscId
from .parameters import choice_of
from .scene import Scene

SMOOTH, BUMPY, FREE = "smooth", "bumpy", "free"

HEIGHT = "rows of discs"
WIDTH = "discs in the lowest row (untilted), or columns (tilted)"
FLOOR_HELP = (
    "smooth, or bumpy: of held discs on the lattice; by default smooth for a silo, bumpy for a slab"
)
ORIENTATION = choice_of(
    "orientation",
    (UNTILTED, TILTED),
    "untilted: discs touch those beside them (default); tilted: those straight above",
    "{}",
)

_RIGHT, _LEFT = (ONE, ZERO), (-ONE, ZERO)
_NOTHING = (ZERO, ZERO)


@dataclass(frozen=True)
class Block:
    """A block of the lattice: its size, and what is beside and below it.

    `walls` are "smooth", "bumpy" or "free" (there are none), the `floor` "smooth" or "bumpy";
    compliances in tau.
    """

    width: int
    height: int
    walls: str
    floor: str
    orientation: str
    wall_compliance: Fraction = Fraction(1)
    floor_compliance: Fraction = Fraction(1)
    weight: Surd = ONE

    @property
    def sides(self) -> tuple[int, int]:
        """The first and the last column that has discs."""
        if self.orientation == UNTILTED:
            return 1 - self.width, self.width - 1
        first = -((self.width - 1) // 2)
        return first, first + self.width - 1

    def row(self, r: int) -> range:
        """The columns of the discs in a row."""
        first, last = self.sides
        return range(first + r % 2, last + 1, 2)


def block(of: Block) -> Scene:
    """The scene of a block.

    Disc (i, j) is the j-th from the left of the i-th row from the top. Held discs of a wall have
    j = 0 or come last in their row, those of a floor have i above the height.
    """
    free = {(c, r) for r in range(of.height) for c in of.row(r)}
    cells: dict[DiscId, Cell] = {}
    held: dict[DiscId, Hold] = {}
    in_order = sorted(free | _held(of, free), key=lambda cell: (-cell[1], cell[0]))
    for r, row in groupby(in_order, key=lambda cell: cell[1]):
        line = list(row)
        compliance = of.floor_compliance if r < 0 else of.wall_compliance
        hold = Hold(load=_NOTHING, compliance=compliance)
        for j, cell in enumerate(line, start=int(r < 0 or line[0] in free)):
            id = (of.height - r, j)
            cells[id] = cell
            if cell not in free:
                held[id] = hold
    return lattice(
        cells,
        held,
        _supports(of, {id: cell for id, cell in cells.items() if id not in held}),
        of.orientation,
        weight=of.weight,
    )


def _held(of: Block, free: set[Cell]) -> set[Cell]:
    """The cells of the discs that bumpy walls and a bumpy floor are made of."""
    first, last = of.sides
    steps = [step for step, _ in ORIENTATIONS[of.orientation].neighbours]
    steps += [(-right, -up) for right, up in steps]
    around = {(c + right, r + up) for c, r in free for right, up in steps} - free
    floor = of.floor == BUMPY
    return {
        (c, r)
        for c, r in around
        if r < of.height
        and (floor and (first <= c <= last or of.walls != SMOOTH) if r < 0 else of.walls == BUMPY)
    }


def _supports(of: Block, free: dict[DiscId, Cell]) -> list[Support]:
    """The smooth floor and the smooth walls, as far as there are any, and what touches them."""
    found = []
    if of.floor == SMOOTH:
        lowest = [id for id, (_, r) in free.items() if r == 0]
        found.append(Support("floor", UP, lowest, of.floor_compliance))
    if of.walls == SMOOTH:
        for name, normal, side in zip(
            ("left wall", "right wall"), (_RIGHT, _LEFT), of.sides, strict=True
        ):
            along = [id for id, (c, r) in free.items() if c == side]
            found.append(Support(name, normal, along, of.wall_compliance))
    return found


def block_size(of: Block) -> tuple[int, int]:
    """The number of discs and of contacts of the scene of a block, without building it."""
    w, h = of.width, of.height
    even, odd = (h + 1) // 2, h // 2  # rows
    smooth, bumpy = of.walls == SMOOTH, of.walls == BUMPY
    if of.orientation == UNTILTED:
        discs = even * w + odd * (w - 1)
        contacts = even * (w - 1) + odd * (w - 2) + 2 * (h - 1) * (w - 1)
        at_walls, wall_discs, wall_contacts = 2 * even, 2 * h, 2 * h + 2 * (h - 1)
        beside = 0 if smooth else 2
        floor_discs, floor_contacts, resting = w - 1 + beside, 2 * (w - 1) + beside, w
    else:
        wide, narrow = (w + 1) // 2, w // 2  # discs of even and odd rows
        discs = even * wide + odd * narrow
        contacts = (h - 1) * (w - 1) + max(discs - w, 0)
        at_walls = even + (even if w % 2 else odd)
        wall_discs = 0 if h == 1 else odd + (odd if w % 2 else even)
        wall_contacts = 2 * (h - 1)
        beside = 0 if smooth else 1 + w % 2
        floor_discs = w + beside
        floor_contacts = w - 1 + wide + (narrow if h > 1 else 0) + beside
        resting = wide
    if smooth:
        contacts += at_walls
    elif bumpy:
        discs, contacts = discs + wall_discs, contacts + wall_contacts
    if of.floor == BUMPY:
        return discs + floor_discs, contacts + floor_contacts
    return discs, contacts + resting
