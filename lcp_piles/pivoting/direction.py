"""The direction of a pivot: how all variables change, exact on demand, in floats at once."""

from __future__ import annotations

from functools import cached_property

from flint import fmpz

from ..numbers.floats import Bounded
from ..numbers.vectors import ExactVector
from .columns import Columns


class Direction:
    """How all variables change while a nonbasic one increases, up to a positive factor.

    `weights` are the changes of the entering variable and of the basic z and z0; an entry of the
    whole direction is exact and computed when it is asked for.
    """

    def __init__(self, columns: Columns, weights: dict[int, fmpz]) -> None:
        self.weights = weights
        self._columns = columns
        self._z_weights = {v: x for v, x in weights.items() if v >= columns.size}

    def __getitem__(self, variable: int) -> fmpz:
        """The exact change of one variable."""
        if variable in self.weights:
            return self.weights[variable] * self._columns.scale
        if variable >= self._columns.size:
            return fmpz(0)
        return self._columns.dot(variable, self._z_weights)

    def sign(self, variable: int) -> int:
        """Sign of the change of one variable, exactly."""
        if variable < self._columns.size and variable not in self.weights:
            _, changes = self.near
            if abs(changes.middle[variable]) > changes.radius[variable]:
                return 1 if changes.middle[variable] > 0 else -1
        exact = self[variable]
        return (exact > 0) - (exact < 0)

    @cached_property
    def near(self) -> tuple[Bounded, Bounded]:
        """In floats, up to another factor: the weights in their order, and the changes of all w."""
        columns = self._columns
        longest = max(
            int(x.bit_length()) + (columns.cover_bits if v == 2 * columns.size else 0)
            for v, x in self.weights.items()
        )
        scaled = ExactVector({1: list(self.weights.values())}, fmpz(1) << longest)
        weights = columns.for_floats(list(self.weights), scaled)
        at = [k for k, v in enumerate(self.weights) if v >= columns.size]
        of_z = Bounded(weights.middle[at], weights.radius[at])
        return weights, columns.near(list(self._z_weights), of_z)
