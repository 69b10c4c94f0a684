"""The revised tableau of an LCP with a covering column: exact pivots on integers.

The system is  w = q + M z + d z0. Variables are numbered w_0..w_(n-1), z_0..z_(n-1), z0. A basis
writes n of them (the basic ones) as affine functions of the other n + 1; call J the set of i with
w_i not basic. Then the z that are basic, with z0 where it is, solve the m x m system of the rows J,
and its inverse

    T[x, i] = d x / d w_i   (x a basic z or z0, i in J)

with their values is all that has to be kept beside the columns of M that have entered: m grows only
with the number of pivots, so a pile with thousands of contacts pivots on a table of a few dozen.
All entries of T are integers over one denominator (fraction-free; the common content is divided out
after every pivot), and so are the values.

The basic w, most of all variables, are not kept. Floats with error bounds tell which of them could
reach zero first, and only those are computed exactly and compared exactly: the filter saves n m
products of long integers a pivot and can change nothing. Cost of a pivot: n m products of floats,
and about m^2 of integers of about the bits of det M_JJ.

Values are kept for each radicand of q separately (q in Q(sqrt r)), since pivots never mix them:
M and d are rational.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpz, fmpz_mat

from ..numbers.exact import surd_sign
from ..numbers.floats import Bounded
from ..numbers.vectors import ExactVector, content
from .columns import Columns
from .direction import Direction
from .doubt import in_doubt
from .lcp import LCP
from .reduced import reduced


class Tableau:
    """The state of a pivoting method: `direction`, `blocking` and `pivot` are its three steps.

    `size` is n, the variable 2n is `z0`, and a variable is basic where `is_basic`. All w are basic
    at first, or it is founded on the basis of the basic z and z0 of `active` and the rows J of
    `left`, as many, whose matrix has to be regular.
    """

    def __init__(
        self,
        problem: LCP,
        d: Sequence[int | fmpz],
        active: Sequence[int] = (),
        left: Sequence[int] = (),
    ) -> None:
        n = len(problem)
        self.size = n
        self.z0 = 2 * n
        self.is_basic = [True] * n + [False] * (n + 1)
        self._q = problem.q.plain()
        self._q_near = self._q.bounded()
        self._columns = Columns(problem, d)
        self._active: list[int] = []  # basic z and z0: the rows of T
        self._left: list[int] = []  # J, the columns of T
        self._T = fmpz_mat(0, 0)
        self._T_den = fmpz(1)
        self._x: dict[int, list[fmpz]] = {r: [] for r in self._q.numerators}
        self._x_den = fmpz(1)
        self._w_near: Bounded | None = None
        if active:
            self._found(list(active), list(left))

    def _found(self, active: list[int], left: list[int]) -> None:
        """T and x from the columns: T = G^-1 and x = -T q_J with G = M_JA."""
        columns, size = self._columns, len(active)
        for v in active:
            if v != self.z0:
                columns.fetch(v)
        G = fmpz_mat(size, size, [x for i in left for x in columns.row(i, active)])
        inverse: Any = G.inv()
        numerators, den = inverse.numer_denom()
        self._T, self._T_den = reduced((numerators * columns.scale).tolist(), den)
        self._x_den = self._T_den * self._q.denominator
        for r, q in self._q.numerators.items():
            right = fmpz_mat(size, 1, [-q[i] for i in left])
            self._x[r] = (self._T * right).entries()
        self._active, self._left = active, left
        for i, v in zip(left, active, strict=True):
            self.is_basic[i], self.is_basic[v] = False, True

    def complement(self, variable: int) -> int:
        """z_i for w_i and w_i for z_i."""
        return variable + self.size if variable < self.size else variable - self.size

    def direction(self, entering: int) -> Direction:
        """How all variables change while a nonbasic one increases."""
        columns = self._columns
        if entering < self.size:
            place = self._left.index(entering)
            moves = [self._T[k, place] for k in range(len(self._active))]
            factor = self._T_den
        else:
            columns.fetch(entering)
            right = [-x for x in columns.entries(entering, self._left)]
            moves = (self._T * fmpz_mat(len(right), 1, right)).entries()
            factor = self._T_den * columns.scale
        common = content(moves, factor)
        weights = dict(zip(self._active, (x // common for x in moves), strict=True))
        weights[entering] = factor // common
        return Direction(columns, weights)

    def blocking(self, direction: Direction, *, stop_at_tie: bool = False) -> int | None:
        """The basic variable that reaches zero first, or None on a ray.

        Ties are broken by the lexicographic rule, that is, as if q were q + (t, t^2, ..., t^n) for
        a small t > 0, under which no basis repeats. With `stop_at_tie` z0 comes before the rule.
        """
        falling = {}
        for v in self._in_doubt(direction):
            change = direction[v]
            if change < 0:
                falling[v] = change
        first = self._least(falling)
        if stop_at_tie and self.z0 in first:
            return self.z0
        return self._lexicographic(first, falling)

    def first_row(self, d: Sequence[int]) -> int:
        """Where z0 enters: the w_i that a rising z0 lifts to zero last, ties lexicographically."""
        falling = {i: fmpz(-x) for i, x in enumerate(d) if x > 0}
        chosen = self._lexicographic(self._least(falling), falling)
        assert chosen is not None
        return chosen

    def pivot(self, entering: int, leaving: int, direction: Direction) -> None:
        """Exchange two variables; `direction` is that of the entering one."""
        row, row_factor = self._row(leaving)
        basic = [v for v in self._active if v != leaving]
        if entering >= self.size:
            basic.append(entering)
        moves = {v: direction[v] for v in basic}
        pivot = -direction[leaving]
        self._move(basic, leaving, direction)
        common = content(list(moves.values()), pivot)
        moves, pivot = {v: x // common for v, x in moves.items()}, pivot // common
        # T_r + direction_r T_s / pivot, the row of the entering variable starting from zero; a
        # leaving w_s adds its own column, -direction_r / pivot.
        keep = [k for k, i in enumerate(self._left) if i != entering]
        old_rows = dict(zip(self._active, self._T.tolist(), strict=True))
        nothing = [fmpz(0)] * len(self._left)
        stretch = row_factor * pivot
        line = [row[c] for c in keep]
        whole = self._T_den * row_factor
        table = []
        for v in basic:
            move, old = moves[v], old_rows.get(v, nothing)
            new = [old[c] * stretch + move * y for c, y in zip(keep, line, strict=True)]
            table.append([*new, -move * whole] if leaving < self.size else new)
        self._active = basic
        self._left = [self._left[c] for c in keep] + [leaving] * (leaving < self.size)
        self._T, self._T_den = reduced(table, self._T_den * stretch)
        self.is_basic[entering], self.is_basic[leaving] = True, False
        self._w_near = None

    def replace_cover(self, d: Sequence[int | fmpz]) -> None:
        """Put another covering column in the place of d, while z0 is not basic."""
        if self.is_basic[self.z0]:
            raise ValueError("z0 is basic: its column cannot be replaced")
        self._columns.replace_cover(d)

    def sign(self, variable: int) -> int:
        """Sign of a variable's value, exactly."""
        if variable < self.size:
            near = self._near_w()
            if abs(near.middle[variable]) > near.radius[variable]:
                return 1 if near.middle[variable] > 0 else -1
        return surd_sign([(r, x, 1) for r, x in self._value(variable).items()])

    def vector(self, first: int, last: int) -> ExactVector:
        """The values of the variables first..last-1."""
        n = self.size
        unit = self._unit if first < n else fmpz(1)
        numerators: dict[int, list[fmpz]] = {}
        place = {v: k for k, v in enumerate(self._active)}
        for r, x in self._x.items():
            q = self._q.numerators[r]
            column: list[fmpz] = []
            if first < n:
                moved = self._columns.combine(dict(zip(self._active, x, strict=True)))
                up, across = self._x_den * self._columns.scale, self._q.denominator
                column = [a * up + b * across for a, b in zip(q, moved, strict=True)][first:last]
            for v in range(max(first, n), last):
                column.append(x[place[v]] * unit if v in place else fmpz(0))
            numerators[r] = column
        return ExactVector(numerators, self._x_den * unit)

    @property
    def _unit(self) -> fmpz:
        """Values of w stand over this times `_x_den`."""
        return self._q.denominator * self._columns.scale

    def _value(self, variable: int) -> dict[int, fmpz]:
        """The exact value, for each radicand, over `_x_den * _unit`."""
        if variable < self.size:
            up, across = self._x_den * self._columns.scale, self._q.denominator
            return {
                r: self._q.numerators[r][variable] * up
                + self._columns.dot(variable, dict(zip(self._active, x, strict=True))) * across
                for r, x in self._x.items()
            }
        if variable not in self._active:
            return {r: fmpz(0) for r in self._x}
        place, unit = self._active.index(variable), self._unit
        return {r: x[place] * unit for r, x in self._x.items()}

    def _near_x(self) -> Bounded:
        """The values of the basic z and z0 in floats (of z0 in the unit of its column)."""
        return self._columns.for_floats(self._active, ExactVector(self._x, self._x_den))

    def _near_w(self) -> Bounded:
        """The values of all w in floats."""
        if self._w_near is None:
            self._w_near = self._q_near + self._columns.near(self._active, self._near_x())
        return self._w_near

    def _in_doubt(self, direction: Direction) -> list[int]:
        """Basic variables that may fall and may be the first to reach zero."""
        weights, changes = direction.near
        w, x, active = self._near_w(), self._near_x(), len(self._active)
        variables = np.array([*range(self.size), *self._active], dtype=np.int64)
        value = Bounded(*map(np.concatenate, ([w.middle, x.middle], [w.radius, x.radius])))
        change = Bounded(
            np.concatenate([changes.middle, weights.middle[:active]]),
            np.concatenate([changes.radius, weights.radius[:active]]),
        )
        places = in_doubt(value, change, np.array(self.is_basic)[variables])
        doubtful: list[int] = variables[places].tolist()
        return doubtful

    def _row(self, variable: int) -> tuple[list[fmpz], fmpz]:
        """(R, s): the variable depends on w_J as R / (s T_den)."""
        if variable >= self.size:
            at = self._active.index(variable)
            return [self._T[at, c] for c in range(len(self._left))], fmpz(1)
        weights = self._columns.row(variable, self._active)
        row = (fmpz_mat(1, len(weights), weights) * self._T).entries()
        # Minors of M have about the bits of T: nearly all of the scale cancels.
        common = content(row, self._columns.scale)
        return [x // common for x in row], self._columns.scale // common

    def _move(self, basic: list[int], leaving: int, direction: Direction) -> None:
        """The values of the next basic z and z0, after the step that brings a variable to zero."""
        gone = self._value(leaving)  # over x_den * unit
        pivot = -direction[leaving]  # over scale, as the weights times scale are
        place = {v: k for k, v in enumerate(self._active)}
        stretch = pivot * self._q.denominator
        moved = {}
        for r, x in self._x.items():
            step = gone[r]
            moved[r] = [
                (x[place[v]] * stretch if v in place else fmpz(0)) + direction.weights[v] * step
                for v in basic
            ]
        den = self._x_den * stretch
        common = den
        for column in moved.values():
            common = content(column, common)
        if den < 0:
            common = -common
        self._x = {r: [x // common for x in column] for r, column in moved.items()}
        self._x_den = den // common

    def _least(self, falling: Mapping[int, fmpz]) -> list[int]:
        """Those whose value / -change is least."""
        best: list[int] = []
        least: dict[int, fmpz] = {}
        for v, change in falling.items():
            value = self._value(v)
            if best:
                against = falling[best[0]]
                # value / -change < least / -against, both sides times a positive number.
                order = surd_sign(
                    [(r, least[r] * change - x * against, 1) for r, x in value.items()]
                )
                if order > 0:
                    continue
                if order == 0:
                    best.append(v)
                    continue
            best, least = [v], value
        return best

    def _lexicographic(self, tied: list[int], falling: Mapping[int, fmpz]) -> int | None:
        """The one of the tied variables that a perturbed q would let reach zero first."""
        if len(tied) <= 1:
            return tied[0] if tied else None
        rows = {v: self._row(v) for v in tied}
        places = {i: k for k, i in enumerate(self._left)}
        for i in sorted({*self._left, *(v for v in tied if v < self.size)}):
            ratios = {}
            for v in tied:
                row, factor = rows[v]
                den = factor * self._T_den
                share = -row[places[i]] if i in places else (den if v == i else fmpz(0))
                ratios[v] = Fraction(int(share), int(den * -falling[v]))
            least = min(ratios.values())
            tied = [v for v in tied if ratios[v] == least]
            if len(tied) == 1:
                return tied[0]
        raise AssertionError("two rows of a basis inverse are never proportional")
