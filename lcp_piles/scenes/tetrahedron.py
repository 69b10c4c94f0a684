"""The tetrahedral pile of spheres: triangular layers, every sphere on three of the next one.

Sphere (a, b, c) of layer a + b + c + 1 is a, b and c steps away from the apex along the three
edges. Cells are in the units 1, 1/sqrt(3) and 2/3 sqrt(6), in which the pile has its mirror x -> -x
and its turns by a third.
"""

from __future__ import annotations

from fractions import Fraction

from ..numbers.exact import ONE, Exact, sqrt_of, surd
from .grid import Cell, Grid
from .kind import Kind
from .names import DiscId
from .parameters import SOFT_FLOOR, layers_of
from .scene import Numbers, Scene
from .stack import BASE, CORNERS, stack, stack_size

_UNITS = (ONE, sqrt_of(3) * surd("1/3"), sqrt_of(6) * surd("2/3"))
_STEPS: tuple[Cell, ...] = (
    (2, 0, 0),
    (1, 3, 0),
    (-1, 3, 0),
    (0, 2, -1),
    (-1, -1, -1),
    (1, -1, -1),
)
"""To half of the neighbours: those beside, then those below."""


def _normal(step: Cell) -> Numbers:
    """The unit vector from the end of a step to its start: half of it, reversed."""
    return tuple(unit * surd(-x) / 2 for unit, x in zip(_UNITS, step, strict=True))


_GRID = Grid(_UNITS, tuple((step, _normal(step)) for step in _STEPS))


def tetrahedron(
    layers: int,
    base: str = BASE.default,
    floor_compliance: Exact = SOFT_FLOOR.default,
) -> Scene:
    """The tetrahedral pile of spheres (face-centred cubic, a close-packed layer at the bottom).

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
        The pile; sphere (a, b, c) is a, b and c steps from the apex along the three edges.

    Raises
    ------
    InputError
        For a parameter that is none of these.

    Examples
    --------
    >>> tetrahedron(3)
    <Scene Tetrahedron, layers 3: 20 discs, 42 contacts>
    """
    return TETRAHEDRON.scene(layers=layers, base=base, floor_compliance=floor_compliance)


def _layer(r: int) -> dict[DiscId, Cell]:
    return {
        (a, b, r - 1 - a - b): (r - 1 - a - 2 * b, 3 * a - r + 1, 1 - r)
        for a in range(r)
        for b in range(r - a)
    }


def _corners(r: int) -> set[DiscId]:
    return {(r - 1, 0, 0), (0, r - 1, 0), (0, 0, r - 1)}


def _edges(r: int) -> set[DiscId]:
    return {id for id in _layer(r) if isinstance(id, tuple) and 0 in id}


def _build(layers: int, base: str, floor_compliance: Fraction) -> Scene:
    return stack(_GRID, _layer, _corners, _edges, layers, base, floor_compliance)


def _held(r: int, base: str) -> tuple[int, int]:
    """How many spheres are held at the corners or edges of layer r, and how many pairs touch."""
    if r == 1:
        return 1, 0
    if base == CORNERS:
        return 3, 3 if r == 2 else 0
    return 3 * (r - 1), 3 * (r - 1) + (3 if r > 2 else 0)


def _size(layers: int, base: str, floor_compliance: Fraction) -> tuple[int, int]:
    return stack_size(
        lambda n: n * (n + 1) * (n + 2) // 6,
        3,
        lambda r: 3 * r * (r - 1) // 2,
        _held,
        layers,
        base,
    )


TETRAHEDRON = Kind(
    name="tetrahedron",
    title="Tetrahedron",
    help="spheres in triangular layers, three dimensions",
    parameters=(layers_of("tetrahedron", 1), BASE, SOFT_FLOOR),
    build=_build,
    size=_size,
)
