"""Walls: straight lines, or planes, that discs lean on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from ..errors import InputError
from .check import in_range

SIDES = {
    "floor": (-1, 1.0),
    "ceiling": (-1, -1.0),
    "left": (0, 1.0),
    "right": (0, -1.0),
    "front": (1, 1.0),
    "back": (1, -1.0),
}
"""Walls that a number alone describes: its axis, and whether discs are above it or below."""


@dataclass(frozen=True)
class Wall:
    """A flat wall of a packing.

    Attributes
    ----------
    point : tuple of float, shape (axes,)
        A point of the wall, in the packing's unit of length.
    normal : tuple of float, shape (axes,)
        The direction to where the discs are, of any length but zero.

    Raises
    ------
    InputError
        Where these are no numbers, too large or small, or the normal is zero.

    Examples
    --------
    >>> Wall(point=(0, 0), normal=(1, 1))
    Wall(point=(0.0, 0.0), normal=(1.0, 1.0))
    """

    point: tuple[float, ...]
    normal: tuple[float, ...]

    def __post_init__(self) -> None:
        for name in ("point", "normal"):
            try:
                vector = tuple(float(x) for x in getattr(self, name))
            except (TypeError, ValueError, OverflowError):
                raise InputError(
                    f"the {name} of a wall", getattr(self, name), "a tuple of numbers"
                ) from None
            object.__setattr__(self, name, vector)
            if not in_range(np.array(vector)).all():
                raise InputError(f"the {name} of a wall", vector, "numbers of a size to 1e45")
        if not any(self.normal):
            raise InputError("the normal of a wall", self.normal, "a vector that is not zero")


def walls_of(supports: Any, dimension: int) -> dict[str, Wall]:
    """Named walls: each a `Wall`, a pair of point and inward normal, or where one of `SIDES` is.

    >>> walls_of({"floor": 0, "slope": ((0, 0), (1, 2))}, 2)["floor"]
    Wall(point=(0.0, 0.0), normal=(0.0, 1.0))
    """
    if supports is None:
        return {}
    if not isinstance(supports, Mapping):
        expected = 'a mapping of names to walls, such as {"floor": 0}'
        raise InputError("the supports", supports, expected)
    found = {name: _wall(name, given, dimension) for name, given in supports.items()}
    for name, wall in found.items():
        if not isinstance(name, str) or not name:
            raise InputError("the name of a wall", name, "a text that is not empty")
        if not len(wall.point) == len(wall.normal) == dimension:
            raise InputError(f"the wall {name}", wall, f"{dimension} components throughout")
    return found


def _wall(name: str, given: Any, dimension: int) -> Wall:
    if isinstance(given, Wall):
        return given
    if not isinstance(given, bool) and isinstance(given, Real):
        axes = ("left", "right", "floor", "ceiling", *(("front", "back") * (dimension > 2)))
        if name not in axes:
            remedy = "a wall of another name needs a point and an inward normal"
            raise InputError(f"the wall {name}", given, "one of " + ", ".join(axes), remedy)
        axis, sign = SIDES[name]
        vectors = [0.0] * dimension, [0.0] * dimension
        vectors[0][axis], vectors[1][axis] = float(given), sign
        return Wall(tuple(vectors[0]), tuple(vectors[1]))
    if isinstance(given, Sequence) and not isinstance(given, str) and len(given) == 2:
        return Wall(*given)
    raise InputError(f"the wall {name}", given, "a Wall, or a pair of point and inward normal")
