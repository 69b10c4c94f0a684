"""Arrays of numbers as unevaluated sums of two floats, about 106 bits, with proved error bounds.

Every operation here returns its exact result but for a relative error of at most `ERROR`, as long
as no intermediate result leaves the range from 2^-900 to 2^900; below, an error of at most `LOST`
(`numbers.floats`) comes to it. The algorithms and their bounds, with u = 2^-53:

    sum         3 u^2 + 13 u^3, of the sum itself, however much cancels        algorithm 6
    product     5 u^2, of Muller and Rideau (2022) for what was 7 u^2          algorithm 10
    quotient    15 u^2 + 56 u^3                                                algorithm 17
    root        25/8 u^2, Lefevre, Louvet, Muller, Picot and Rideau (2023)

by number in Joldes, Muller and Popescu (2017), "Tight and rigorous error bounds for basic building
blocks of double-word arithmetic", ACM TOMS 44. The exact product of two floats is Dekker's (1971),
because numpy has no fused multiplication; the two agree where nothing underflows.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .floats import UNIT, FloatArray

ERROR = 16 * UNIT * UNIT
"""Relative error of one operation: 2^-102."""
_SPLIT = 2.0**27 + 1


@dataclass(frozen=True, eq=False, repr=False)
class DoubleDouble:
    """The numbers high + low; high is the nearest float of each.

    >>> third = DoubleDouble.of(1.0) / DoubleDouble.of(3.0)
    >>> bool((third * DoubleDouble.of(3.0) - DoubleDouble.of(1.0)).high < 2.0**-102)
    True
    """

    high: FloatArray
    low: FloatArray

    @classmethod
    def of(cls, floats: ArrayLike) -> DoubleDouble:
        """Floats, exactly."""
        high = np.asarray(floats, dtype=np.float64)
        return cls(high, np.zeros_like(high))

    def __repr__(self) -> str:
        return f"<DoubleDouble of shape {self.high.shape}>"

    def __len__(self) -> int:
        return len(self.high)

    def __getitem__(self, index: Any) -> DoubleDouble:
        return DoubleDouble(self.high[index], self.low[index])

    def __neg__(self) -> DoubleDouble:
        return DoubleDouble(-self.high, -self.low)

    def __add__(self, other: DoubleDouble) -> DoubleDouble:
        s, s_low = _sum(self.high, other.high)
        t, t_low = _sum(self.low, other.low)
        v, v_low = _ordered_sum(s, s_low + t)
        return DoubleDouble(*_ordered_sum(v, t_low + v_low))

    def __sub__(self, other: DoubleDouble) -> DoubleDouble:
        return self + -other

    def __mul__(self, other: DoubleDouble) -> DoubleDouble:
        c, c_low = _product(self.high, other.high)
        cross = self.high * other.low + self.low * other.high
        return DoubleDouble(*_ordered_sum(c, c_low + cross))

    def __truediv__(self, other: DoubleDouble) -> DoubleDouble:
        t = self.high / other.high
        r, r_low = _times_float(other, t)
        rest = (self.high - r) + (self.low - r_low)
        return DoubleDouble(*_ordered_sum(t, rest / other.high))

    def sqrt(self) -> DoubleDouble:
        """The roots; of zero, zero."""
        s = np.sqrt(self.high)
        square, square_low = _product(s, s)
        rest = self.low + ((self.high - square) - square_low)
        step = np.divide(rest, 2 * s, out=np.zeros_like(s), where=s > 0)
        return DoubleDouble(*_ordered_sum(s, step))


def difference(x: FloatArray, y: FloatArray) -> DoubleDouble:
    """The difference x - y of floats, exactly."""
    return DoubleDouble(*_sum(x, -y))


def _sum(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The rounded x + y and what rounding lost (Knuth)."""
    s = x + y
    x_part = s - y
    return s, (x - x_part) + (y - (s - x_part))


def _ordered_sum(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """As `_sum`, where x is zero or not below y in exponent (Dekker)."""
    s = x + y
    return s, y - (s - x)


def _product(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The rounded x y and what rounding lost (Dekker)."""
    p = x * y
    x_high, x_low = _halves(x)
    y_high, y_low = _halves(y)
    return p, x_low * y_low - (((p - x_high * y_high) - x_low * y_high) - x_high * y_low)


def _halves(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two floats of 26 bits whose sum is x (Veltkamp)."""
    big = _SPLIT * x
    high = big - (big - x)
    return high, x - high


def _times_float(x: DoubleDouble, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The product with floats y: algorithm 7."""
    c, c_low = _product(x.high, y)
    t, t_low = _ordered_sum(c, x.low * y)
    return _ordered_sum(t, t_low + c_low)
