"""Silos: a block of the triangular lattice between two vertical walls.

What a silo does without: wall discs that touch no free disc, contacts between held discs, and with
smooth walls the walls' friction and every force along them. Its mirror halves the rest, where the
lattice has one.
"""

from __future__ import annotations

from typing import Any

from ..numbers.exact import Exact
from .block import (
    BUMPY,
    FLOOR_HELP,
    HEIGHT,
    ORIENTATION,
    SMOOTH,
    WIDTH,
    Block,
    block,
    block_size,
)
from .kind import Kind
from .parameters import SOFT_FLOOR, choice_of, compliance_of, extent_of
from .scene import Scene

WALLS = choice_of(
    "walls",
    (BUMPY, SMOOTH),
    "bumpy: of held discs on the lattice (default); smooth: without friction",
    "{} walls",
)
FLOOR = choice_of("floor", (SMOOTH, BUMPY), FLOOR_HELP, "{} floor")
WALL_COMPLIANCE = compliance_of("wall_compliance", "of contacts with the walls")


def silo(
    width: int,
    height: int,
    walls: str = WALLS.default,
    floor: str = FLOOR.default,
    orientation: str = ORIENTATION.default,
    wall_compliance: Exact = WALL_COMPLIANCE.default,
    floor_compliance: Exact = SOFT_FLOOR.default,
) -> Scene:
    """Discs between two vertical walls, on a floor, filled to an even height.

    Parameters
    ----------
    width : int
        The discs in the lowest row (rows of one less lie between; untilted), or the columns
        (tilted); 2 or more.
    height : int
        The rows of discs, 1 or more.
    walls : {"bumpy", "smooth"}, default "bumpy"
        Bumpy ones are made of held discs on the lattice; smooth ones are without friction.
    floor : {"smooth", "bumpy"}, default "smooth"
        As the walls.
    orientation : {"untilted", "tilted"}, default "untilted"
        Untilted, discs touch those beside them; tilted, those straight above.
    wall_compliance : exact number, default 1
        That of the contacts with the walls (tau), 0 (rigid) or more.
    floor_compliance : exact number, default 1
        That of the contacts with the floor (tau), 0 (rigid) or more.

    Returns
    -------
    Scene
        The silo; disc (i, j) is the j-th from the left of the i-th row from the top.

    Raises
    ------
    InputError
        For a parameter that is none of these.

    Examples
    --------
    >>> silo(4, 10, walls="smooth")
    <Scene Silo, width 4, height 10, walls smooth: 35 discs, 93 contacts>
    """
    return SILO.scene(
        width=width,
        height=height,
        walls=walls,
        floor=floor,
        orientation=orientation,
        wall_compliance=wall_compliance,
        floor_compliance=floor_compliance,
    )


def _build(**parameters: Any) -> Scene:
    return block(Block(**parameters))


def _size(**parameters: Any) -> tuple[int, int]:
    return block_size(Block(**parameters))


SILO = Kind(
    name="silo",
    title="Silo",
    help="a block of the lattice between vertical walls",
    parameters=(
        extent_of("silo", "width", 2, WIDTH, "width {}"),
        extent_of("silo", "height", 1, HEIGHT, "height {}"),
        WALLS,
        FLOOR,
        ORIENTATION,
        WALL_COMPLIANCE,
        SOFT_FLOOR,
    ),
    build=_build,
    size=_size,
)
