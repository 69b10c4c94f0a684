"""The square pyramid of spheres: square layers, every sphere on four of the next one.

Sphere (r, i, j) is the i-th from the left and the j-th from the front of layer r from the apex.
Cells are in the units 1, 1 and sqrt(2).
"""

from __future__ import annotations

from fractions import Fraction

from ..numbers.exact import ONE, ZERO, Exact, sqrt_of, surd
from .grid import Cell, Grid
from .kind import Kind
from .names import DiscId
from .parameters import SOFT_FLOOR, layers_of
from .scene import Scene
from .stack import BASE, CORNERS, stack, stack_size

_ROOT2 = sqrt_of(2)
_HALF = surd("1/2")
_GRID = Grid(
    (ONE, ONE, _ROOT2),
    (
        ((2, 0, 0), (-ONE, ZERO, ZERO)),
        ((0, 2, 0), (ZERO, -ONE, ZERO)),
        *(((x, y, -1), (-x * _HALF, -y * _HALF, _ROOT2 * _HALF)) for x in (-1, 1) for y in (-1, 1)),
    ),
)


def pyramid(
    layers: int,
    base: str = BASE.default,
    floor_compliance: Exact = SOFT_FLOOR.default,
) -> Scene:
    """The square pyramid of spheres (face-centred cubic, a square layer at the bottom).

    Parameters
    ----------
    layers : int
        The layers that are not all held, 1 or more.
    base : {"held", "edges", "corners"}, default "held"
        A further layer of held spheres; or a smooth floor, with the spheres at the edges or just at
        the corners of the lowest layer held.
    floor_compliance : exact number, default 1
        That of the contacts with the base (tau), 0 (rigid) or more.

    Returns
    -------
    Scene
        The pile; sphere (r, i, j) is the i-th from the left and the j-th from the front of layer r
        from the apex.

    Raises
    ------
    InputError
        For a parameter that is none of these.

    Examples
    --------
    >>> pyramid(2)
    <Scene Pyramid, layers 2: 14 discs, 24 contacts>
    """
    return PYRAMID.scene(layers=layers, base=base, floor_compliance=floor_compliance)


def _layer(r: int) -> dict[DiscId, Cell]:
    numbers = range(1, r + 1)
    return {(r, i, j): (2 * i - r - 1, 2 * j - r - 1, 1 - r) for i in numbers for j in numbers}


def _corners(r: int) -> set[DiscId]:
    return {(r, i, j) for i in (1, r) for j in (1, r)}


def _edges(r: int) -> set[DiscId]:
    numbers = range(1, r + 1)
    return {(r, i, j) for i in numbers for j in numbers if {i, j} & {1, r}}


def _build(layers: int, base: str, floor_compliance: Fraction) -> Scene:
    return stack(_GRID, _layer, _corners, _edges, layers, base, floor_compliance)


def _held(r: int, base: str) -> tuple[int, int]:
    """How many spheres are held at the corners or edges of layer r, and how many pairs touch."""
    if r == 1:
        return 1, 0
    if base == CORNERS:
        return 4, 4 if r == 2 else 0
    return 4 * (r - 1), 4 * (r - 1)


def _size(layers: int, base: str, floor_compliance: Fraction) -> tuple[int, int]:
    return stack_size(
        lambda n: n * (n + 1) * (2 * n + 1) // 6,
        4,
        lambda r: 2 * r * (r - 1),
        _held,
        layers,
        base,
    )


PYRAMID = Kind(
    name="pyramid",
    title="Pyramid",
    help="spheres in square layers, three dimensions",
    parameters=(layers_of("pyramid", 1), BASE, SOFT_FLOOR),
    build=_build,
    size=_size,
)
