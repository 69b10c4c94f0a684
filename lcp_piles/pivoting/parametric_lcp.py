"""The LCP with q = q0 + t q1, for all t from 0 on: z as a piecewise linear function of t.

From the solved tableau at t = 0 Lemke's scheme goes on with t in the place of the covering variable
(parametric principal pivoting; Cottle, Pang and Stone, "The Linear Complementarity Problem",
section 4.5). For a positive semidefinite M, and for a P-matrix, t never falls along the path.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Literal

from flint import fmpq, fmpq_mat

from ..errors import InputError, SolveError, VerificationError
from ..numbers.exact import Exact, rational
from ..numbers.rational_matrix import rational_column, rational_matrix
from .direction import Direction
from .lcp import lcp
from .lemke import solved_table
from .tableau import Tableau

Numbers = tuple[Fraction, ...]
ParametricEnd = Literal["reached", "asymptotic", "infeasible", "turned", "lost"]


@dataclass(frozen=True, repr=False)
class ParametricPiece:
    """z(t) = start + (t - first) rate for first <= t <= last, without end where `last` is None."""

    first: Fraction
    last: Fraction | None
    start: Numbers
    rate: Numbers

    def __repr__(self) -> str:
        return f"<ParametricPiece from {self.first} to {self.last}>"

    def z(self, t: Exact) -> Numbers:
        """The solution at a t of the piece."""
        value = rational(t, "t")
        if value < self.first or (self.last is not None and value > self.last):
            raise InputError("t", value, f"a number from {self.first} to {self.last}")
        step = value - self.first
        return tuple(x + step * r for x, r in zip(self.start, self.rate, strict=True))


@dataclass(frozen=True, repr=False)
class ParametricPath:
    """The solutions for t from 0 on, and how they end.

    `end` is "reached" (the last t that was asked for), "asymptotic" (the last piece has no end),
    "infeasible" (no solution at any larger t, proved by `certificate`: y >= 0 with M^T y <= 0,
    y . q1 < 0 and y . q <= 0 at the last t), "turned" (the path goes back to smaller t) or "lost"
    (it ends on a ray); the last two prove nothing about larger t, and do not happen where M is
    positive semidefinite. There is at least one piece: the point t = 0 where there is no other.
    """

    pieces: tuple[ParametricPiece, ...]
    end: ParametricEnd
    certificate: Numbers | None
    pivots: int

    def __repr__(self) -> str:
        return f"<ParametricPath of {len(self.pieces)} pieces, {self.end}>"

    @property
    def breakpoints(self) -> Numbers:
        """Each t where one piece gives way to the next."""
        return tuple(piece.first for piece in self.pieces[1:])

    def z(self, t: Exact) -> Numbers:
        """The solution at t; where two pieces meet, that of the first."""
        value = rational(t, "t")
        for piece in self.pieces:
            if piece.first <= value and (piece.last is None or value <= piece.last):
                return piece.z(value)
        raise InputError("t", value, f"a number from 0 to {self.pieces[-1].last}")


def parametric_lcp(
    M: Any,
    q0: Any,
    q1: Any,
    *,
    until: Exact | None = None,
    progress: Callable[[int], None] | None = None,
) -> ParametricPath:
    """Solve w = M z + q0 + t q1, z, w >= 0, z . w = 0 for all t from 0 on, exactly.

    Every piece is checked from M, q0 and q1. Where z is not unique it may jump from one piece to
    the next.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n)
        Lists or a matrix.
    q0 : sequence of exact rationals, shape (n,)
        The q of t = 0.
    q1 : sequence of exact rationals, shape (n,)
        The change of q with t.
    until : exact rational, optional
        The last t wanted, at least 0.
    progress : callable, optional
        Called with the number of pivots after each.

    Returns
    -------
    ParametricPath
        Its `breakpoints`, `z(t)`, and how it ends.

    Raises
    ------
    InputError
        For other data, floats among them.
    SolveError
        Where Lemke's method finds no solution at t = 0.

    References
    ----------
    Cottle, Pang and Stone, "The Linear Complementarity Problem" (1992), section 4.5.

    Examples
    --------
    >>> path = parametric_lcp([[2, 1], [1, 2]], [-1, 1], [0, -1])
    >>> path.breakpoints, path.end, path.z(1)
    ((Fraction(3, 2), Fraction(3, 1)), 'asymptotic', (Fraction(1, 2), Fraction(0, 1)))
    """
    matrix = rational_matrix(M, "M")
    start, rate = rational_column(q0, "q0"), rational_column(q1, "q1")
    if rate.nrows() != start.nrows():
        raise InputError("the length of q1", rate.nrows(), f"{start.nrows()}, as of q0")
    limit = None if until is None else rational(until, "until")
    if limit is not None and limit < 0:
        raise InputError("until", limit, "a number of at least 0")
    table = solved_table(lcp(matrix.tolist(), start.entries()))
    if table is None:
        raise SolveError("Lemke's method ends on a ray at t = 0, so there is nothing to continue")
    path = _walk(table, rate, limit, progress)
    for piece in path.pieces:
        if not _is_right(matrix, start, rate, piece):
            raise VerificationError("a piece of the parametric path is no solution")
    if path.end != "lost":
        return path
    y, last = rational_column(path.certificate or (), "y"), path.pieces[-1].last
    if last is not None and _is_certificate(matrix, start + rate * _fmpq(last), rate, y):
        return replace(path, end="infeasible")
    return replace(path, certificate=None)


def _walk(
    table: Tableau,
    rate: fmpq_mat,
    limit: Fraction | None,
    progress: Callable[[int], None] | None,
) -> ParametricPath:
    """The pivots; a path that ends on a ray is "lost", with the z of the ray for a certificate."""
    n = table.size
    d, scale = rate.numer_denom()
    unit = Fraction(int(scale))  # t = unit z0
    table.replace_cover(d.entries())
    t, entering, pivots = Fraction(0), table.z0, 0
    pieces = [ParametricPiece(t, t, _z(table), (Fraction(0),) * n)]
    ray = None
    end: ParametricEnd = "reached"
    while t != limit:
        direction = table.direction(entering)
        rise, leaving = direction[table.z0], table.blocking(direction)
        if rise < 0:
            end = "turned"
            break
        if leaving is None and rise == 0:
            end, ray = "lost", tuple(Fraction(int(x)) for x in _changes(direction, n))
            break
        if rise > 0 and (leaving is None or table.sign(leaving) > 0):
            rates = tuple(Fraction(int(x), int(rise)) / unit for x in _changes(direction, n))
            _add(pieces, ParametricPiece(t, None, _z(table), rates))
        if leaving is None:
            end = "asymptotic"
            break
        table.pivot(entering, leaving, direction)
        pivots += 1
        if progress is not None:
            progress(pivots)
        entering = table.complement(leaving)
        t = table.vector(table.z0, table.z0 + 1)[0].rational() * unit
        if limit is not None:
            t = min(t, limit)
        if t > pieces[-1].first:
            pieces[-1] = replace(pieces[-1], last=t)
    if limit is not None and pieces[-1].last is None:
        pieces[-1], end = replace(pieces[-1], last=limit), "reached"
    return ParametricPath(tuple(pieces), end, ray, pivots)


def _add(pieces: list[ParametricPiece], piece: ParametricPiece) -> None:
    """Add a piece, or make it part of the last one if that goes on like this; drop a mere point."""
    last = pieces[-1]
    if last.last == last.first:
        pieces[-1] = piece
    elif last.rate == piece.rate and last.z(piece.first) == piece.start:
        pieces[-1] = replace(last, last=None)
    else:
        pieces.append(piece)


def _z(table: Tableau) -> Numbers:
    return tuple(x.rational() for x in table.vector(table.size, 2 * table.size))


def _changes(direction: Direction, n: int) -> list[Any]:
    """The changes of all z."""
    return [direction[v] for v in range(n, 2 * n)]


def _is_right(M: fmpq_mat, q0: fmpq_mat, q1: fmpq_mat, piece: ParametricPiece) -> bool:
    """Whether z and w are >= 0 and complementary on the whole piece: both are linear on it."""
    z, dz = rational_column(piece.start, "z"), rational_column(piece.rate, "rate")
    w, dw = M * z + q0 + q1 * _fmpq(piece.first), M * dz + q1
    if piece.last is None:
        ends = [z, w, dz, dw]
    else:
        step = _fmpq(piece.last - piece.first)
        ends = [z, w, z + dz * step, w + dw * step]
    columns = [column.entries() for column in (z, dz, w, dw)]
    if piece.last == piece.first:  # a point does not move
        columns[1] = columns[3] = [fmpq(0)] * len(columns[0])
    return all(x >= 0 for column in ends for x in column.entries()) and all(
        x == 0 == dx or y == 0 == dy for x, dx, y, dy in zip(*columns, strict=True)
    )


def _is_certificate(M: fmpq_mat, q: fmpq_mat, q1: fmpq_mat, y: fmpq_mat) -> bool:
    """Whether y proves that w = M z + q + s q1 has no z, w >= 0 for any s > 0."""
    return (
        min(y.entries()) >= 0
        and max((M.transpose() * y).entries()) <= 0
        and (q.transpose() * y)[0, 0] <= 0
        and (q1.transpose() * y)[0, 0] < 0
    )


def _fmpq(x: Fraction) -> fmpq:
    return fmpq(x.numerator, x.denominator)
