"""Exact numbers in floating point: their floats, and rigorous bounds of the errors of those.

A float operation rounds its exact result by a factor of 1 + d, |d| <= `UNIT`, unless it leaves the
range of normal floats. Above that the result is infinite, and what is made of it infinite or NaN;
below, an error of at most 2^-1022 comes to it, whether subnormal floats are kept or flushed to
zero. A bound that adds `LOST`, 2^22 times as much, for every factor of a sum of fewer than a
million products therefore holds for all floats. An infinite or NaN bound is no bound, so whoever
compares with one has to write the comparison so that NaN leaves a doubt.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ldexp, nan, sqrt
from typing import Any

import numpy as np
from flint import fmpz

FloatArray = np.ndarray[Any, np.dtype[np.float64]]
UNIT = 2.0**-53
LOST = 2.0**-1000
UP = 1 + 2.0**-20
"""More than the rounding of sums and products of fewer than 2^30 non-negative floats."""
ENTRY = 10 * UNIT
"""The relative error of the float of a rational in `ExactVector.array`."""
_SAFE_BITS = 900  # quotients within 2^-900 and 2^900 and ...
_SAFE_FACTOR = 50  # ... factors within 2^-50 and 2^50: no product of two of them loses digits


@dataclass(frozen=True, eq=False, repr=False)
class Bounded:
    """Floats with rigorous bounds: entry i is within radius[i] of middle[i], if that is finite."""

    middle: FloatArray
    radius: FloatArray

    def __repr__(self) -> str:
        return f"<Bounded floats of {len(self.middle)} entries>"

    def signs(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        """-1 or 1 where the sign is proved, 0 where zero is within the bounds."""
        return np.where(np.abs(self.middle) > self.radius, np.sign(self.middle), 0).astype(np.int64)

    def __add__(self, other: Bounded) -> Bounded:
        with np.errstate(all="ignore"):
            middle = self.middle + other.middle
            radius = self.radius + other.radius
            return Bounded(middle, radius * (1 + 4 * UNIT) + np.abs(middle) * (2 * UNIT) + LOST)


def quotients(numbers: list[fmpz], den: fmpz, r: int) -> FloatArray:
    """The floats sqrt(r) numbers / den, rounded a few times; NaN where they may leave the range."""
    root, root_exponent = _root(r)
    if den.bit_length() <= _SAFE_BITS and root_exponent == 0:
        try:
            quotients: FloatArray = np.array([float(int(x)) for x in numbers]) / float(int(den))
            return quotients * root
        except OverflowError:
            pass
    den_mantissa, den_exponent = _split(den)
    values = np.zeros(len(numbers))
    for i, x in enumerate(numbers):
        if x != 0:
            mantissa, exponent = _split(x)
            exponent += root_exponent - den_exponent
            safe = abs(exponent) <= _SAFE_BITS
            values[i] = ldexp(mantissa / den_mantissa * root, exponent) if safe else nan
    return values


def if_safe(factor: float) -> float:
    """The factor, or NaN where a product with it might leave the range of normal floats."""
    return factor if 2.0**-_SAFE_FACTOR < factor < 2.0**_SAFE_FACTOR else nan


def _root(r: int) -> tuple[float, int]:
    """(m, e) with sqrt(r) = m 2^e to a few units in the last place, m in the range of floats."""
    shift = max(r.bit_length() - 62, 0) // 2
    return sqrt(r >> 2 * shift), shift


def _split(x: fmpz) -> tuple[float, int]:
    """(m, e) with x = m 2^e to 62 bits, m within the range of a float."""
    shift = max(int(x.bit_length()) - 62, 0)
    return float(int(x >> shift)), shift
