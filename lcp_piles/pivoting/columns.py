"""The columns of M that have entered a tableau, and its covering column: exact, and as floats.

The exact ones stand side by side in one FLINT matrix over one denominator, so that a combination of
them is one product. The floats beside them serve as a filter: a combination in floats comes with a
bound of its error, and exact entries are computed only for the rows that the bound leaves in doubt.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from flint import fmpz, fmpz_mat

from ..numbers.floats import ENTRY, LOST, UNIT, Bounded, FloatArray
from ..numbers.vectors import ExactVector
from .lcp import LCP


class Columns:
    """Columns by variable: n..2n-1 are those of M, 2n is the covering column d.

    Entries are integers over `scale`, which grows as columns come in.
    """

    def __init__(self, problem: LCP, d: Sequence[int | fmpz]) -> None:
        self.scale = fmpz(1)
        self.size = len(problem)
        self._problem = problem
        self._place = {2 * self.size: 0}
        self._exact = fmpz_mat(self.size, 1, list(d))
        self._floats = np.zeros((self.size, 1))
        self._set_cover_floats(d)

    def fetch(self, variable: int) -> None:
        """Make the column of a z, if it is not there yet; `scale` may grow by it."""
        if variable in self._place:
            return
        numbers, den = self._problem.column(variable - self.size)
        common = self.scale.lcm(den)
        if common != self.scale:
            self._exact = self._exact * (common // self.scale)
            self.scale = common
        at = len(self._place)
        if at == self._exact.ncols():  # double the room
            room = [0] * at
            wider = [x for row in self._exact.tolist() for x in row + room]
            self._exact = fmpz_mat(self.size, 2 * at, wider)
            self._floats = np.hstack([self._floats, np.zeros((self.size, at))])
        factor = common // den
        exact = self._exact
        for i, x in enumerate(numbers):
            if x != 0:
                exact[i, at] = x * factor
        self._floats[:, at] = _floats(numbers, den)
        self._place[variable] = at

    def replace_cover(self, d: Sequence[int | fmpz]) -> None:
        """Put another column in the place of d."""
        for i, x in enumerate(d):
            self._exact[i, 0] = x * self.scale
        self._set_cover_floats(d)

    def _set_cover_floats(self, d: Sequence[int | fmpz]) -> None:
        # `for_floats` multiplies the weights of z0 by what this column is divided by.
        self._floats[:, 0], self.cover_bits = cover_floats(d)

    def for_floats(self, variables: Sequence[int], values: ExactVector) -> Bounded:
        """Values of these variables in floats; those of z0 in a unit that fits its column."""
        cover = 2 * self.size
        if cover in variables:
            at = list(variables).index(cover)
            shifted = {r: list(column) for r, column in values.numerators.items()}
            for column in shifted.values():
                column[at] = column[at] << self.cover_bits
            values = ExactVector(shifted, values.denominator)
        return values.bounded()

    def entries(self, variable: int, rows: Sequence[int]) -> list[fmpz]:
        """Some entries of a column."""
        at = self._place[variable]
        return [self._exact[i, at] for i in rows]

    def row(self, i: int, variables: Sequence[int]) -> list[fmpz]:
        """Entry i of some columns."""
        return [self._exact[i, self._place[v]] for v in variables]

    def dot(self, i: int, weights: Mapping[int, fmpz]) -> fmpz:
        """Entry i of the combination with these weights."""
        exact, place = self._exact, self._place
        return sum((exact[i, place[v]] * x for v, x in weights.items()), fmpz(0))

    def combine(self, weights: Mapping[int, fmpz]) -> list[fmpz]:
        """The whole combination with these weights."""
        line = [fmpz(0)] * self._exact.ncols()
        for variable, weight in weights.items():
            line[self._place[variable]] = weight
        return (self._exact * fmpz_mat(len(line), 1, line)).entries()

    def near(self, variables: Sequence[int], weights: Bounded) -> Bounded:
        """The combination in floats (not over `scale`), with the weights of `for_floats`.

        Let an exact entry a have the float A and a weight w the float W, |w - W| <= R. Since
        |a - A| <= k |A| + v, with k = `ENTRY` and v what underflow loses,

            |a w - A W| <= |A| R + |w| (k |A| + v) <= |A| (R + k |W|) + v |W|

        but for terms of second order, and summing m products in any order adds m u sum |A| |W| and
        m v, and also v sum |A| for products A W that underflow. The radius returned doubles the
        terms of first order, for those of second order and its own roundings, and has `LOST` in
        the place of v.
        """
        floats = self._floats[:, [self._place[v] for v in variables]]
        sizes = np.abs(weights.middle)
        with np.errstate(all="ignore"):
            shares = weights.radius + sizes * (ENTRY + len(variables) * UNIT)
            radius = np.abs(floats) @ (2 * shares + LOST) + LOST * (1 + sizes.sum())
            return Bounded(floats @ weights.middle, radius)


def cover_floats(d: Sequence[int | fmpz]) -> tuple[FloatArray, int]:
    """The floats of d / 2^bits, and bits: d may be integers beyond the range of floats."""
    numbers = [fmpz(x) for x in d]
    bits = max((int(x.bit_length()) for x in numbers), default=0)
    return _floats(numbers, fmpz(1) << bits), bits


def _floats(numbers: list[int | fmpz] | list[fmpz], den: fmpz) -> FloatArray:
    with np.errstate(all="ignore"):
        return ExactVector({1: [fmpz(x) for x in numbers]}, den).array()
