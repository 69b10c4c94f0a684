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
    """A layer of discs on a floor; `width`, `height`, `orientation` and `floor` as of `silo`.

    Parameters: `sides`, "smooth" walls or "free"; `weight` of a disc (exact, 0 is without gravity).

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
