"""Slabs: a layer of discs on a floor, to put a load on (`variants.loaded`).

A slab without weight may end freely: what nothing presses on does not fall. With weight it stands
between two smooth walls, which are at the pressure of the discs and take none of their weight.
"""

from __future__ import annotations

from typing import Any

from ..numbers.exact import Exact
from .block import (
    BUMPY,
    FLOOR_HELP,
    FREE,
    HEIGHT,
    ORIENTATION,
    SMOOTH,
    WIDTH,
    Block,
    block,
    block_size,
)
from .kind import Kind, Parameter
from .parameters import SOFT_FLOOR, ExactNumber, choice_of, extent_of
from .scene import Scene

SIDES = choice_of(
    "sides", (SMOOTH, FREE), "between smooth walls (default), or free, without walls", "{} sides"
)
FLOOR = choice_of("floor", (BUMPY, SMOOTH), FLOOR_HELP, "{} floor")
WEIGHT = Parameter(
    name="weight",
    check=ExactNumber("weight"),
    read=ExactNumber("weight"),
    default=1,
    help="of a disc, exact; 0 is without gravity, default 1",
    title="weight ${}$",
    metavar="W",
)


def slab(
    width: int,
    height: int,
    sides: str = SIDES.default,
    floor: str = FLOOR.default,
    orientation: str = ORIENTATION.default,
    weight: Exact = WEIGHT.default,
    floor_compliance: Exact = SOFT_FLOOR.default,
) -> Scene:
    """A layer of discs on a floor, to put a load on (`loaded`, `point_load`).

    Parameters
    ----------
    width : int
        The discs in the lowest row (untilted) or the columns (tilted), 2 or more; as of `silo`.
    height : int
        The rows of discs, 1 or more.
    sides : {"smooth", "free"}, default "smooth"
        Between smooth walls, or without walls.
    floor : {"bumpy", "smooth"}, default "bumpy"
        Bumpy ones are made of held discs on the lattice.
    orientation : {"untilted", "tilted"}, default "untilted"
        Untilted, discs touch those beside them; tilted, those straight above.
    weight : exact number, default 1
        That of a disc (w); 0 is without gravity.
    floor_compliance : exact number, default 1
        That of the contacts with the floor (tau), 0 (rigid) or more.

    Returns
    -------
    Scene
        The slab; disc (i, j) is the j-th from the left of the i-th row from the top.

    Raises
    ------
    InputError
        For a parameter that is none of these.

    Examples
    --------
    >>> slab(5, 2, sides="free", weight=0)
    <Scene Slab, width 5, height 2, sides free, weight 0: 15 discs, 25 contacts>
    """
    return SLAB.scene(
        width=width,
        height=height,
        sides=sides,
        floor=floor,
        orientation=orientation,
        weight=weight,
        floor_compliance=floor_compliance,
    )


def _build(sides: str, **parameters: Any) -> Scene:
    return block(Block(walls=sides, **parameters))


def _size(sides: str, **parameters: Any) -> tuple[int, int]:
    return block_size(Block(walls=sides, **parameters))


SLAB = Kind(
    name="slab",
    title="Slab",
    help="a layer of discs on a floor, with or without gravity",
    parameters=(
        extent_of("slab", "width", 2, WIDTH, "width {}"),
        extent_of("slab", "height", 1, HEIGHT, "height {}"),
        SIDES,
        FLOOR,
        ORIENTATION,
        WEIGHT,
        SOFT_FLOOR,
    ),
    build=_build,
    size=_size,
)
