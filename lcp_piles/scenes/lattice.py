"""Scenes on the triangular lattice: the cells of discs, which of them are held, and supports.

A cell is (column, row): columns count half the distance of two neighbours in a row, to the right,
and rows go up. Untilted, a disc touches its neighbours in its own row; tilted, the one straight
above it, two rows up. All discs have radius 1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, sqrt_of, surd
from .grid import Grid, Hold, Support, on_grid
from .names import DiscId, end_name
from .scene import Scene

SQRT3 = sqrt_of(3)
UP = (ZERO, ONE)
UNTILTED, TILTED = "untilted", "tilted"

Cell = tuple[int, int]
_HALF = surd("1/2")

ORIENTATIONS = {
    UNTILTED: Grid(
        (ONE, SQRT3),
        (
            ((2, 0), (-ONE, ZERO)),
            ((-1, -1), (_HALF, SQRT3 * _HALF)),
            ((1, -1), (-_HALF, SQRT3 * _HALF)),
        ),
    ),
    TILTED: Grid(
        (SQRT3, ONE),
        (
            ((-1, -1), (SQRT3 * _HALF, _HALF)),
            ((1, -1), (-SQRT3 * _HALF, _HALF)),
            ((0, -2), UP),
        ),
    ),
}


def lattice(
    cells: Mapping[DiscId, Cell],
    held: Mapping[DiscId, Hold],
    supports: Sequence[Support] = (),
    orientation: str = UNTILTED,
    *,
    weight: Exact = 1,
) -> Scene:
    """Discs in some cells of the triangular lattice, with the contacts that can carry a force.

    A cell is (column, row): columns count half the distance of two neighbours in a row. All
    neighbours are contacts, except where nothing can change the distance of two held discs.

    Parameters
    ----------
    cells : mapping of id to tuple of int
        The cell (column, row) of every disc, held ones too. The sum of the two is even for all
        discs, or odd for all.
    held : mapping of id to Hold
        The discs that are not free.
    supports : sequence of Support, optional
        Flat ones.
    orientation : {"untilted", "tilted"}, default "untilted"
        Untilted, a disc touches its neighbours in its own row; tilted, the one straight above it,
        two rows up.
    weight : exact number, default 1
        That of a disc (w).

    Returns
    -------
    Scene
        The discs in the order of `cells`, of radius 1.

    Raises
    ------
    InputError
        For a cell that is off the lattice or taken, and for an id without a cell.

    Examples
    --------
    >>> arch = {"left": (-1, 0), "right": (1, 0), "top": (0, 1)}
    >>> lattice(arch, {"left": Hold(), "right": Hold()})
    <Scene: 3 discs, 2 contacts>
    """
    if orientation not in ORIENTATIONS:
        raise InputError("the orientation", orientation, "one of " + ", ".join(ORIENTATIONS))
    parity = sum(next(iter(cells.values()), (0, 0))) % 2
    for id, cell in cells.items():
        if sum(cell) % 2 != parity:
            expected = "a point of the lattice: column + row even for all discs, or odd for all"
            raise InputError(f"the cell of disc {end_name(id)}", cell, expected)
    return on_grid(ORIENTATIONS[orientation], cells, held, supports, weight)
