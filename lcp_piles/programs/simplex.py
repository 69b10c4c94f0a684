"""The simplex method on exact numbers, from any basis to a proved end.

It repairs what floating point proposes, and needs nothing from it: from the basis of idle rows it
solves every linear programme. A basis is a list of as many numbers as there are rows: j < n for
column j, n + i for the idle column of row i (a multiple of a unit vector: redundant rows keep
theirs, at zero), n + m for the column of the first phase.

First phase: where basic values are negative, a column -sum of those basic columns enters and lifts
them all; then the sum of its value t and of the values of the idle columns falls to its least. If
that is not zero, the multipliers are a Farkas vector. Second phase: idle columns stay at zero; one
that would move leaves at once, and none comes back.

Every step solves with the basis exactly, so nothing accumulates. The column of the most negative
reduced cost enters; after a long run of steps of length zero Bland's rule takes over until one is
longer, so that no basis comes twice (Bland 1977, "New finite pivoting rules for the simplex
method", Math. Oper. Res. 2).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

from flint import fmpz

from ..errors import SolveError
from ..linear.sparse_exact import SingularError
from ..numbers.vectors import ExactVector
from .constraints import StandardForm
from .field_solver import FieldSolver, expanded
from .roots import Column, Number, dot, less, sign, times

Status = Literal["optimal", "infeasible", "unbounded"]
Progress = Callable[[str], None]
_PATIENCE = 20  # steps of length zero before Bland's rule
_ONE = {1: fmpz(1)}


@dataclass(frozen=True, eq=False)
class SimplexEnd:
    """Where the method ended, in the units of the problem.

    `x` the point (None where infeasible), `y` the dual solution or the Farkas vector (None where
    unbounded), `ray` the direction of a fall without end.
    """

    status: Status
    basis: list[int]
    pivots: int
    x: ExactVector | None = None
    y: ExactVector | None = None
    ray: ExactVector | None = None


class _Run:
    """One set of constraints and the basis that the pivots change."""

    def __init__(self, problem: StandardForm, start: Sequence[int], progress: Progress | None):
        self.problem = problem
        self.m, self.n = problem.rows, len(problem.columns)
        self.idle = list(problem.idle)
        self.lift: Column = ()
        self.pivots = 0
        self._progress = progress
        self.set_basis(list(start))

    def column(self, k: int) -> Column:
        """The column of number k."""
        if k < self.n:
            return self.problem.columns[k]
        if k < self.n + self.m:
            return ((k - self.n, 1, self.idle[k - self.n]),)
        return self.lift

    def set_basis(self, basis: list[int]) -> None:
        self.basis = basis
        group = self.problem.group
        columns = [
            self.problem.expanded[k] if k < self.n else expanded(self.column(k), self.m, group)
            for k in basis
        ]
        self._forward = FieldSolver(columns, group)
        self._backward = FieldSolver(columns, group, transposed=True)
        self._values: ExactVector | None = None

    def values(self) -> ExactVector:
        """The basic variables at the vertex."""
        if self._values is None:
            self._values = self._forward.solve(self.problem.b)
        return self._values

    def in_basis(self, column: Column) -> ExactVector:
        """The coordinates of a column."""
        parts: dict[int, list[fmpz]] = {1: [fmpz(0)] * self.m}
        for i, r, a in column:
            parts.setdefault(r, [fmpz(0)] * self.m)[i] = fmpz(a)
        return self._forward.solve(ExactVector(parts, fmpz(1)))

    def multipliers(self, cost: Callable[[int], Number], den: fmpz) -> ExactVector:
        """The y with y . column k = cost(k) / den for the basic columns."""
        parts: dict[int, list[fmpz]] = {1: [fmpz(0)] * self.m}
        for place, k in enumerate(self.basis):
            for r, x in cost(k).items():
                parts.setdefault(r, [fmpz(0)] * self.m)[place] = x
        return self._backward.solve(ExactVector(parts, den))

    def row(self, place: int) -> ExactVector:
        """A row of the inverse of the basis."""
        unit = [fmpz(0)] * self.m
        unit[place] = fmpz(1)
        return self._backward.solve(ExactVector({1: unit}, fmpz(1)))

    def exchange(self, entering: int, place: int) -> None:
        """Put a column in the place of a basic one."""
        basis = list(self.basis)
        basis[place] = entering
        self.set_basis(basis)
        self.pivots += 1
        if self._progress is not None:
            self._progress(f"{self.pivots} exact pivots")


def simplex(
    problem: StandardForm,
    c: ExactVector,
    start: Sequence[int] | None,
    progress: Progress | None = None,
) -> SimplexEnd:
    """Minimise c . x from a basis; c is without factors.

    Without a start of the right size, or with a singular one, that is the basis of idle rows.
    """
    idle = list(range(len(problem.columns), len(problem.columns) + problem.rows))
    try:
        run = _Run(problem, start if start and len(start) == problem.rows else idle, progress)
        x = run.values()
    except SingularError:
        run = _Run(problem, idle, progress)
        x = run.values()
    farkas = _make_feasible(run, x)
    if farkas is not None:
        return SimplexEnd("infeasible", _kept(run), run.pivots, y=farkas)
    radicands = list(c.numerators)

    def cost(k: int) -> Number:
        return {r: c.numerators[r][k] for r in radicands} if k < run.n else {}

    ray, y = _minimise(run, cost, c.denominator, stuck=True)
    point = _spread(run, run.values())
    if ray is not None:
        return SimplexEnd("unbounded", _kept(run), run.pivots, x=point, ray=ray)
    return SimplexEnd("optimal", _kept(run), run.pivots, x=point, y=y)


def without_idle(problem: StandardForm, basis: Sequence[int]) -> list[int]:
    """The basis with idle columns exchanged for structural ones, as far as rows allow.

    At a vertex where idle columns are zero, as they are where it is feasible, nothing moves.
    """
    run = _Run(problem, basis, None)
    for place in range(run.m):
        if run.basis[place] < run.n:
            continue
        row = run.row(place)
        for k, column in enumerate(problem.columns):
            if k not in run.basis and any(x != 0 for x in dot(column, row.numerators).values()):
                run.exchange(k, place)
                break
    return run.basis


def multipliers_of(problem: StandardForm, basis: Sequence[int], c: ExactVector) -> ExactVector:
    """The y with y . column = cost for the columns of a basis; idle ones cost nothing."""
    run = _Run(problem, basis, None)
    parts = c.numerators.items()
    return run.multipliers(
        lambda k: {r: values[k] for r, values in parts} if k < run.n else {}, c.denominator
    )


def _make_feasible(run: _Run, x: ExactVector) -> ExactVector | None:
    """The first phase; a Farkas vector where no point is feasible."""
    signs = x.signs()
    for place, k in enumerate(run.basis):
        if k >= run.n and signs[place] < 0:
            run.idle[k - run.n] *= -1
    negative = [p for p, k in enumerate(run.basis) if k < run.n and signs[p] < 0]
    idle = [p for p, k in enumerate(run.basis) if k >= run.n and signs[p] != 0]
    if not negative and not idle:
        return None
    run.set_basis(run.basis)
    if negative:
        total: dict[tuple[int, int], int] = {}
        for place in negative:
            for i, r, a in run.column(run.basis[place]):
                total[i, r] = total.get((i, r), 0) - a
        run.lift = tuple((i, r, a) for (i, r), a in total.items() if a)
        lowest = negative[0]
        parts = list(x.numerators.items())
        for place in negative[1:]:
            if sign({r: v[place] - v[lowest] for r, v in parts}) < 0:
                lowest = place
        run.exchange(run.n + run.m, lowest)
    _, y = _minimise(run, lambda k: _ONE if k >= run.n else {}, fmpz(1), stuck=False)
    signs = run.values().signs()
    return y if any(s for s, k in zip(signs, run.basis, strict=True) if k >= run.n) else None


def _minimise(
    run: _Run, cost: Callable[[int], Number], den: fmpz, *, stuck: bool
) -> tuple[ExactVector | None, ExactVector | None]:
    """Pivots from a feasible basis to (None, multipliers) or to (ray, None).

    With `stuck`, basic columns that are not structural stay at zero.
    """
    still = 0
    seen: set[frozenset[int]] = set()
    while True:
        y = run.multipliers(cost, den)
        careful = still > _PATIENCE
        entering = _entering(run, cost, den, y, careful)
        if entering is None:
            return None, y
        move = run.in_basis(run.column(entering))
        x = run.values()
        place = _leaving(run, x, move, stuck)
        if place is None:
            return _ray(run, entering, move), None
        still = still + 1 if x.signs()[place] == 0 else 0
        run.exchange(entering, place)
        if careful or not still:
            # A longer step lowers the objective, and Bland's rule never comes back.
            key = frozenset(run.basis)
            if key in seen:
                raise SolveError("a singular basis of the linear programme seemed regular")
            seen.add(key)


def _entering(
    run: _Run, cost: Callable[[int], Number], den: fmpz, y: ExactVector, first: bool
) -> int | None:
    """A column with a negative reduced cost: the first of them, or the one of the least."""
    basic = set(run.basis)
    best: int | None = None
    least: Number = {}
    for k, column in enumerate(run.problem.columns):
        if k in basic:
            continue
        own = {r: v * y.denominator for r, v in cost(k).items()}
        reduced = less(own, {r: v * den for r, v in dot(column, y.numerators).items()})
        if sign(reduced) < 0 and (best is None or sign(less(reduced, least)) < 0):
            best, least = k, reduced
            if first:
                break
    return best


def _leaving(run: _Run, x: ExactVector, move: ExactVector, stuck: bool) -> int | None:
    """The place of the basic column that reaches zero first, of the lowest number among equals."""
    signs = move.signs()
    order = sorted(range(run.m), key=lambda p: run.basis[p])
    if stuck:
        for place in order:
            if run.basis[place] >= run.n and signs[place]:
                return place
    best: int | None = None
    for place in order:
        if signs[place] <= 0:
            continue
        if best is None:
            best = place
            continue
        one = times(_entry(x, place), _entry(move, best))
        two = times(_entry(x, best), _entry(move, place))
        if sign(less(one, two)) < 0:
            best = place
    return best


def _entry(vector: ExactVector, k: int) -> Number:
    return {r: values[k] for r, values in vector.numerators.items()}


def _ray(run: _Run, entering: int, move: ExactVector) -> ExactVector:
    """The direction in which the entering column rises without end."""
    negative = ExactVector(
        {r: [-x for x in values] for r, values in move.numerators.items()}, move.denominator
    )
    ray = _spread(run, negative)
    ray.numerators[1][entering] += move.denominator
    return ray


def _spread(run: _Run, basic: ExactVector) -> ExactVector:
    """A vector over all structural columns from one over the basis."""
    numerators = {}
    for r, values in basic.numerators.items():
        numerators[r] = [fmpz(0)] * run.n
        for k, x in zip(run.basis, values, strict=True):
            if k < run.n:
                numerators[r][k] = x
    return ExactVector(numerators, basic.denominator)


def _kept(run: _Run) -> list[int]:
    """The basis, without the column of the first phase: an idle row takes its place."""
    if run.n + run.m not in run.basis:
        return list(run.basis)
    return [k for k in run.basis if k != run.n + run.m]
