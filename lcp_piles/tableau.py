"""The revised tableau of an LCP with a covering column: exact pivots on integers.

The system is  w = q + M z + d z0. Variables are numbered w_0..w_(n-1), z_0..z_(n-1), z0. A basis
writes n of them (the basic ones) as affine functions of the other n + 1; call J the set of i with
w_i not basic. Then the z that are basic, with z0 where it is, solve the m x m system of the rows J,
and its inverse

    T[x, i] = d x / d w_i   (x a basic z or z0, i in J)

is all that has to be kept beside the columns of M that have entered: m grows only with the number
of pivots, so a pile with thousands of contacts pivots on a table of a few dozen. All entries of T
are integers over one denominator (fraction-free; the common content is divided out after every
pivot), and so are the values of the variables. Cost of a pivot: n m products for the entering
column, m^2 for T, n for the values, on integers of about the bits of det M_JJ.

The values are carried for each radicand of q separately (q in Q(sqrt r)), since pivots never mix
them: M and d are rational.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from random import Random

from flint import fmpz, fmpz_mat

from .exact import surd_sign
from .lcp import LCP
from .vectors import ExactVector, content

_WEIGHTS = Random(0)

Direction = list[fmpz]
"""A change of all 2n + 1 variables, up to a positive factor."""


class Tableau:
    """The state of a pivoting method; `values` are those of all variables at the present basis.

    Attributes: `size` n; `values` maps each radicand to 2n + 1 integers over `denominator`.
    A variable is basic where `is_basic`. `direction`, `blocking` and `pivot` are the three steps.
    """

    def __init__(self, problem: LCP, d: Sequence[int]) -> None:
        n = len(problem)
        self.size = n
        self.z0 = 2 * n
        zeros = [fmpz(0)] * (n + 1)
        self.values = {r: list(column) + zeros for r, column in problem.q.numerators.items()}
        self.denominator = problem.q.denominator
        self.is_basic = [True] * n + [False] * (n + 1)
        self._columns = _Columns(problem, d)
        self._active: list[int] = []  # basic z and z0: the rows of T
        self._left: list[int] = []  # J, the columns of T
        self._T = fmpz_mat(0, 0)
        self._T_den = fmpz(1)

    def complement(self, variable: int) -> int:
        """z_i for w_i and w_i for z_i."""
        return variable + self.size if variable < self.size else variable - self.size

    def direction(self, entering: int) -> Direction:
        """How all variables change while a nonbasic one increases (up to a positive factor)."""
        n = self.size
        columns = self._columns
        if entering < n:
            place = self._left.index(entering)
            moves = [self._T[k, place] for k in range(len(self._active))]
            factor = self._T_den
        else:
            columns.fetch(entering)
            right = fmpz_mat(
                len(self._left), 1, [-x for x in columns.entries(entering, self._left)]
            )
            moves = (self._T * right).entries()
            factor = self._T_den * columns.scale
        # The basic z move by moves / factor; the w follow, over factor times the columns' scale.
        common = content(moves, factor)
        weights = dict(zip(self._active, (x // common for x in moves), strict=True))
        weights[entering] = factor // common
        change = columns.combine({v: x for v, x in weights.items() if v >= n})
        result = change + [fmpz(0)] * (n + 1)
        for variable, weight in weights.items():
            result[variable] = weight * columns.scale
        common = content(result, result[entering])
        return result if common == 1 else [x // common for x in result]

    def blocking(self, direction: Direction, *, stop_at_tie: bool = False) -> int | None:
        """The basic variable that reaches zero first, or None on a ray.

        Ties are broken by the lexicographic rule, that is, as if q were q + (t, t^2, ..., t^n) for
        a small t > 0, under which no basis repeats. With `stop_at_tie` z0 comes before the rule.
        """
        falling = [v for v, x in enumerate(direction) if x < 0 and self.is_basic[v]]
        first = self._least(falling, direction)
        if stop_at_tie and self.z0 in first:
            return self.z0
        return self._lexicographic(first, direction)

    def first_row(self, d: Sequence[int]) -> int:
        """Where z0 enters: the w_i that a rising z0 lifts to zero last, ties lexicographically."""
        covered = [i for i in range(self.size) if d[i] > 0]
        direction = [fmpz(0)] * (2 * self.size + 1)
        for i in covered:
            direction[i] = fmpz(-d[i])
        chosen = self._lexicographic(self._least(covered, direction), direction)
        assert chosen is not None
        return chosen

    def pivot(self, entering: int, leaving: int, direction: Direction) -> None:
        """Exchange two variables; `direction` is that of the entering one."""
        pivot = -direction[leaving]
        row, row_factor = self._row(leaving)
        self._move(leaving, pivot, direction)
        # T_r + direction_r T_s / pivot, the row of the entering variable starting from zero; a
        # leaving w_s adds its own column, -direction_r / pivot.
        keep = [k for k, i in enumerate(self._left) if i != entering]
        rows = {
            v: [old[c] for c in keep]
            for v, old in zip(self._active, self._T.tolist(), strict=True)
            if v != leaving
        }
        if entering >= self.size:
            rows[entering] = [fmpz(0)] * len(keep)
        stretch = row_factor * pivot
        line = [row[c] for c in keep]
        whole = self._T_den * row_factor
        table = []
        for v, old in rows.items():
            move = direction[v]
            new = [x * stretch + move * y for x, y in zip(old, line, strict=True)]
            table.append([*new, -move * whole] if leaving < self.size else new)
        self._active = list(rows)
        self._left = [self._left[c] for c in keep] + [leaving] * (leaving < self.size)
        self._T, self._T_den = _reduced(table, self._T_den * stretch)
        self.is_basic[entering], self.is_basic[leaving] = True, False

    def replace_cover(self, d: Sequence[int | fmpz]) -> None:
        """Put another covering column in the place of d, while z0 is not basic."""
        if self.is_basic[self.z0]:
            raise ValueError("z0 is basic: its column cannot be replaced")
        self._columns.replace_cover(d)

    def sign(self, variable: int) -> int:
        """Sign of a variable's value, exactly."""
        return surd_sign([(r, column[variable], 1) for r, column in self.values.items()])

    def vector(self, first: int, last: int) -> ExactVector:
        """The values of the variables first..last-1."""
        parts = {r: column[first:last] for r, column in self.values.items()}
        return ExactVector(parts, self.denominator)

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

    def _move(self, leaving: int, pivot: fmpz, direction: Direction) -> None:
        """All values, after the step that brings the leaving variable to zero."""
        den = self.denominator * pivot
        moved = {}
        for r, column in self.values.items():
            step = column[leaving]
            if step == 0:
                moved[r] = [x * pivot for x in column]
            else:
                moved[r] = [
                    x * pivot + move * step for x, move in zip(column, direction, strict=True)
                ]
        common = den
        for column in moved.values():
            common = content(column, common)
        if den < 0:
            common = -common
        self.values = {r: [x // common for x in column] for r, column in moved.items()}
        self.denominator = den // common

    def _least(self, candidates: list[int], direction: Direction) -> list[int]:
        """Those whose value / -direction is least."""
        parts = list(self.values.items())
        best: list[int] = []
        for v in candidates:
            if not best:
                best = [v]
                continue
            b = best[0]
            x, y = direction[b], direction[v]
            if len(parts) == 1:
                column = parts[0][1]
                left, right = column[v] * x, column[b] * y  # both sides times a negative number
                order = (left < right) - (left > right)
            else:
                order = surd_sign([(r, c[b] * y - c[v] * x, 1) for r, c in parts])
            if order < 0:
                best = [v]
            elif order == 0:
                best.append(v)
        return best

    def _lexicographic(self, tied: list[int], direction: Direction) -> int | None:
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
                ratios[v] = Fraction(int(share), int(den * -direction[v]))
            least = min(ratios.values())
            tied = [v for v in tied if ratios[v] == least]
            if len(tied) == 1:
                return tied[0]
        raise AssertionError("two rows of a basis inverse are never proportional")


class _Columns:
    """The columns of M that have entered, and d, as integers over one common `scale`.

    They stand side by side in one FLINT matrix, so that a combination of them is one product.
    """

    def __init__(self, problem: LCP, d: Sequence[int]) -> None:
        self.scale = fmpz(1)
        self._problem = problem
        self._size = len(problem)
        self._place = {2 * self._size: 0}
        self._matrix = fmpz_mat(self._size, 1, list(d))

    def fetch(self, variable: int) -> None:
        """Make the column of a z, if it is not there yet; `scale` may grow by it."""
        if variable in self._place:
            return
        numbers, den = self._problem.column(variable - self._size)
        common = self.scale.lcm(den)
        if common != self.scale:
            self._matrix = self._matrix * (common // self.scale)
            self.scale = common
        self._add(variable, numbers, common // den)

    def entries(self, variable: int, rows: Sequence[int]) -> list[fmpz]:
        """Some entries of the column of a z or of z0, over `scale`."""
        at = self._place[variable]
        return [self._matrix[i, at] for i in rows]

    def replace_cover(self, d: Sequence[int | fmpz]) -> None:
        """Put d in the place of the column of z0."""
        for i, x in enumerate(d):
            self._matrix[i, 0] = x * self.scale

    def combine(self, weights: Mapping[int, fmpz]) -> list[fmpz]:
        """The sum of the variables' columns with these weights."""
        line = [fmpz(0)] * self._matrix.ncols()
        for variable, weight in weights.items():
            line[self._place[variable]] = weight
        return (self._matrix * fmpz_mat(len(line), 1, line)).entries()

    def row(self, i: int, variables: Sequence[int]) -> list[fmpz]:
        """Entry i of the variables' columns."""
        return [self._matrix[i, self._place[v]] for v in variables]

    def _add(self, variable: int, numbers: list[fmpz], factor: fmpz) -> None:
        at = len(self._place)
        if at == self._matrix.ncols():  # double the room
            room = [0] * at
            wider = [x for row in self._matrix.tolist() for x in row + room]
            self._matrix = fmpz_mat(self._size, 2 * at, wider)
        for i, x in enumerate(numbers):
            self._matrix[i, at] = x * factor
        self._place[variable] = at


def _reduced(table: list[list[fmpz]], den: fmpz) -> tuple[fmpz_mat, fmpz]:
    """The same fractions over the smallest common denominator.

    The common divisor of thousands of entries is guessed from a random positive combination of
    the rows and then proved: were any entry not divisible, the rest left over by the division
    would be positive in some column of the combination, because no weight is zero.
    """
    if not table or not table[0]:
        return fmpz_mat(len(table), len(table[0]) if table else 0), fmpz(1)
    rows, columns = len(table), len(table[0])
    if den < 0:
        table, den = [[-x for x in row] for row in table], -den
    weights = fmpz_mat(1, rows, [_WEIGHTS.randrange(1, 1 << 30) for _ in range(rows)])
    mixed = (weights * fmpz_mat(rows, columns, [x for row in table for x in row])).entries()
    common = content(mixed, den)
    numbers = fmpz_mat(rows, columns, [x // common for row in table for x in row])
    if any(x * common != y for x, y in zip((weights * numbers).entries(), mixed, strict=True)):
        common = den
        for row in table:
            common = content(row, common)
        numbers = fmpz_mat(rows, columns, [x // common for row in table for x in row])
    return numbers, den // common
