"""Piles of spheres, layer on layer: what all of them have in common.

Gravity is along z, the axis is x = y = 0, and z = 0 at the lowest layer of spheres that are not all
held. On a smooth floor some spheres of that layer are held.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction

from ..numbers.exact import ONE, ZERO
from .grid import Cell, Grid, Hold, Support, on_grid
from .names import DiscId
from .parameters import choice_of
from .scene import Scene

HELD_BASE, EDGES, CORNERS = "held", "edges", "corners"

BASE = choice_of(
    "base",
    (HELD_BASE, EDGES, CORNERS),
    "held spheres, one more layer (default); or a smooth floor with the edges, or just the "
    "corners, of the lowest layer held",
    "base: {} held",
)

_STILL = (ZERO, ZERO, ZERO)


def stack(
    grid: Grid,
    layer: Callable[[int], Mapping[DiscId, Cell]],
    corners: Callable[[int], set[DiscId]],
    edges: Callable[[int], set[DiscId]],
    layers: int,
    base: str,
    floor_compliance: Fraction,
) -> Scene:
    """The scene of a pile of spheres on one of the bases.

    `layer(r)` has the cells of layer r from the apex down, 1 on the axis; `corners(r)` and
    `edges(r)` the spheres of it that are at its corners and along its edges.
    """
    deepest = layers + 1 if base == HELD_BASE else layers
    cells = {id: cell for r in range(1, deepest + 1) for id, cell in layer(r).items()}
    lowest = layer(layers)
    cells = {id: (*across, down + layers - 1) for id, (*across, down) in cells.items()}
    if base == HELD_BASE:
        hold = Hold(_STILL, (ZERO, ZERO, ZERO), floor_compliance)
        return on_grid(grid, cells, dict.fromkeys(layer(deepest), hold))
    held = corners(layers) if base == CORNERS else edges(layers)
    resting = [id for id in lowest if id not in held]
    floor = Support("floor", (ZERO, ZERO, ONE), resting, floor_compliance)
    return on_grid(grid, cells, dict.fromkeys(held, Hold(_STILL)), [floor])


def stack_size(
    spheres: Callable[[int], int],
    steep: int,
    beside: Callable[[int], int],
    held: Callable[[int, str], tuple[int, int]],
    layers: int,
    base: str,
) -> tuple[int, int]:
    """The number of spheres and contacts of a stack.

    `spheres(n)` of its first n layers; every sphere has `steep` neighbours in the next layer, and
    `beside(r)` pairs of layer r touch. `held(r, base)` are how many spheres of the lowest layer are
    held, and how many pairs of these touch.
    """
    among = sum(beside(r) for r in range(1, layers + 1))
    if base == HELD_BASE:
        return spheres(layers + 1), steep * spheres(layers) + among
    stones, pairs = held(layers, base)
    resting = spheres(layers) - spheres(layers - 1) - stones
    return spheres(layers), steep * spheres(layers - 1) + among - pairs + resting
