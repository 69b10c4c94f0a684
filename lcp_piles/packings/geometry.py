"""Normals and gaps of contacts in double-double, with their error bounds.

With e = `double_double.ERROR` for every operation, and lines from b to a within u^2 of themselves:
a squared length, of at most three squares, is within 3.2 e of itself, its root within 2.6 e, and a
component of the normal within 4 e. The distance from a wall is a sum of at most three products
v_i w_i over |v|, within (3.1 + 2.6 + 1) e sum |v_i w_i| / |v|, and every gap therefore within

    8 e (size + reach),      size = distance of the centres, or sum |v_i w_i| / |v|,

reach being the sum of the radii, or the radius. 9 in place of 8 covers rounding of this bound.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..numbers.double_double import ERROR, DoubleDouble, difference
from ..numbers.floats import LOST, FloatArray
from ..numbers.vectors import IntArray
from .walls import Wall

_GAP_ERROR = 9 * ERROR


def lines_between(
    centres: FloatArray, a: IntArray, b: IntArray, image: IntArray, period: float | None
) -> DoubleDouble:
    """x_a - x_b of discs, b in its image: exact, or rounded to 106 bits where it is an image."""
    lines = difference(centres[a], centres[b])
    for k in np.flatnonzero(image).tolist():
        shift = Fraction(period or 0) * int(image[k])
        line = Fraction(centres[a[k], 0]) - Fraction(centres[b[k], 0]) - shift
        lines.high[k, 0] = float(line)
        lines.low[k, 0] = float(line - Fraction(lines.high[k, 0]))
    return lines


def unit_normals(lines: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    """Unit vectors along lines of shape (n, axes), none of them zero, and the lengths.

    >>> normals, lengths = unit_normals(DoubleDouble.of(np.array([[3.0, 4.0]])))
    >>> normals.high.tolist(), lengths.high.tolist()
    ([[0.6, 0.8]], [5.0])
    """
    squares = lines * lines
    total = squares[:, 0]
    for axis in range(1, lines.high.shape[1]):
        total = total + squares[:, axis]
    lengths = total.sqrt()
    return lines / lengths[:, None], lengths


def gaps_between(lengths: DoubleDouble, reach: DoubleDouble) -> tuple[DoubleDouble, FloatArray]:
    """Distances of centres minus sums of radii, and bounds of their errors."""
    return lengths - reach, _GAP_ERROR * (lengths.high + reach.high) + LOST


def gaps_to_wall(
    centres: FloatArray, radii: FloatArray, wall: Wall
) -> tuple[DoubleDouble, DoubleDouble, FloatArray]:
    """The unit normal of a wall, the gaps of discs to it, and bounds of the errors of those."""
    point, normal = np.array(wall.point), np.array(wall.normal)
    unit, length = unit_normals(DoubleDouble.of(normal[None, :]))
    parts = difference(centres, point[None, :]) * DoubleDouble.of(normal[None, :])
    total = parts[:, 0]
    for axis in range(1, len(normal)):
        total = total + parts[:, axis]
    size = np.abs(parts.high).sum(axis=1) / length.high
    gaps = total / length - DoubleDouble.of(radii)
    return unit[0], gaps, _GAP_ERROR * (size + radii) + LOST
