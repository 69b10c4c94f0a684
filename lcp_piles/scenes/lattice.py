"""Scenes on the triangular lattice: the cells of discs, which of them are held, and supports.

A cell is (column, row): columns count half the distance of two neighbours in a row, to the right,
and rows go up. Untilted, a disc touches its neighbours in its own row; tilted, the one straight
above it, two rows up. All discs have radius 1.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, Surd, sqrt_of, surd
from .names import DiscId, end_name
from .scene import Contact, Disc, Numbers, Scene

SQRT3 = sqrt_of(3)
UP = (ZERO, ONE)
UNTILTED, TILTED = "untilted", "tilted"

Cell = tuple[int, int]
_SOFT = Fraction(1)
_HALF = surd("1/2")


@dataclass(frozen=True, slots=True)
class Orientation:
    """The distances of columns and rows, and the neighbours of a cell.

    `neighbours` has half of them, to the right and below: where they are, and the normal from there
    to here. For each the cell on the other side is a neighbour as well.
    """

    column: Surd
    row: Surd
    neighbours: tuple[tuple[Cell, Numbers], ...]


ORIENTATIONS = {
    UNTILTED: Orientation(
        ONE,
        SQRT3,
        (
            ((2, 0), (-ONE, ZERO)),
            ((-1, -1), (_HALF, SQRT3 * _HALF)),
            ((1, -1), (-_HALF, SQRT3 * _HALF)),
        ),
    ),
    TILTED: Orientation(
        SQRT3,
        ONE,
        (
            ((-1, -1), (SQRT3 * _HALF, _HALF)),
            ((1, -1), (-SQRT3 * _HALF, _HALF)),
            ((0, -2), UP),
        ),
    ),
}


@dataclass(frozen=True, slots=True)
class Hold:
    """How a disc is held: prescribed displacements (w tau), or None where it is free.

    `load` is the load on it, its weight by default; `compliance` (tau) that of its contacts, which
    are held closed where it is negative.
    """

    displacement: tuple[Surd | None, Surd | None] = (ZERO, ZERO)
    load: Numbers | None = None
    compliance: Fraction = _SOFT


_FREE = Hold((None, None))


@dataclass(frozen=True, slots=True)
class Support:
    """A flat support: its name, its unit normal, the discs that touch it, and its compliance (tau).

    With a negative compliance its contacts are held closed.
    """

    name: str
    normal: Numbers
    touching: Collection[DiscId]
    compliance: Fraction = _SOFT


def lattice(
    cells: Mapping[DiscId, Cell],
    held: Mapping[DiscId, Hold],
    supports: Sequence[Support] = (),
    orientation: str = UNTILTED,
    *,
    weight: Exact = 1,
) -> Scene:
    """Discs in some cells of the triangular lattice, with the contacts that can carry a force.

    Parameters: `cells`, the cell of every disc, held ones too; `held`, those that are not free;
    `supports`, flat ones; `orientation`, "untilted" or "tilted"; `weight`, that of a disc in w.
    All neighbours are contacts, except where nothing can change the distance of two held discs.
    Raises `InputError` for a cell that is off the lattice or taken, and for an id without a cell.

    >>> arch = {"left": (-1, 0), "right": (1, 0), "top": (0, 1)}
    >>> lattice(arch, {"left": Hold(), "right": Hold()})
    <Scene: 3 discs, 2 contacts>
    """
    _check(cells, held, supports, orientation)
    grid = ORIENTATIONS[orientation]
    columns = {c: grid.column * c for c in {c for c, _ in cells.values()}}
    rows = {r: grid.row * r for r in {r for _, r in cells.values()}}
    pull = (ZERO, -surd(weight))
    discs = []
    for id, (c, r) in cells.items():
        hold = held.get(id, _FREE)
        load = pull if hold.load is None else hold.load
        discs.append(Disc(id, (columns[c], rows[r]), load, hold.displacement))
    contacts = _contacts(cells, held, grid)
    for support in supports:
        bilateral = support.compliance < 0
        contacts += [
            Contact(id, support.name, support.normal, support.compliance, bilateral=bilateral)
            for id in support.touching
        ]
    return Scene(tuple(discs), tuple(contacts), tuple(support.name for support in supports))


def _contacts(
    cells: Mapping[DiscId, Cell], held: Mapping[DiscId, Hold], grid: Orientation
) -> list[Contact]:
    """The contacts of all neighbours that can carry a force, disc by disc."""
    at = {cell: id for id, cell in cells.items()}
    found = []
    for a, (c, r) in cells.items():
        for (right, up), normal in grid.neighbours:
            b = at.get((c + right, r + up))
            if b is None:
                continue
            if held:
                one, two = held.get(a), held.get(b)
                if one is not None and two is not None and _fixed_distance(one, two, normal):
                    continue
                hold = one or two
                if hold is not None and hold.compliance is not _SOFT:
                    soft = hold.compliance
                    found.append(Contact(a, b, normal, soft, bilateral=soft < 0))
                    continue
            found.append(Contact(a, b, normal))
    return found


def _fixed_distance(one: Hold, two: Hold, normal: Numbers) -> bool:
    """Whether two held discs are held along their contact."""
    pairs = zip(normal, one.displacement, two.displacement, strict=True)
    return all(x is not None and y is not None for n, x, y in pairs if n)


def _check(
    cells: Mapping[DiscId, Cell],
    held: Mapping[DiscId, Hold],
    supports: Sequence[Support],
    orientation: str,
) -> None:
    if orientation not in ORIENTATIONS:
        raise InputError("the orientation", orientation, "one of " + ", ".join(ORIENTATIONS))
    for id in [*held, *(id for support in supports for id in support.touching)]:
        if id not in cells:
            raise InputError("a held or supported disc", id, "one that has a cell")
    taken: dict[Cell, DiscId] = {}
    parity = sum(next(iter(cells.values()), (0, 0))) % 2
    for id, cell in cells.items():
        if sum(cell) % 2 != parity:
            expected = "a point of the lattice: column + row even for all discs, or odd for all"
            raise InputError(f"the cell of disc {end_name(id)}", cell, expected)
        other = taken.setdefault(cell, id)
        if other is not id:
            expected = f"one that disc {end_name(other)} is not in"
            raise InputError(f"the cell of disc {end_name(id)}", cell, expected)
