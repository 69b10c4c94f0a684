"""A convex quadratic programme as a value, read from what the user has; and what proves its ends.

    minimise x . P x / 2 + c . x  subject to  A x = b,  G x <= h,  lower <= x <= upper

* optimal: x feasible, multipliers z, l, u >= 0 of G, of the lower and of the upper bounds, zero
  where there is room, and P x + c + A^T y + G^T z - l + u = 0 (Karush, Kuhn and Tucker; enough,
  because P is positive semidefinite);
* infeasible: z, l, u >= 0 with A^T y + G^T z - l + u = 0 and b . y + h . z - lower . l + upper . u
  below zero (Farkas: that sum is at least (A^T y + G^T z - l + u) . x = 0 for any feasible x);
* unbounded: x feasible and a ray d with P d = 0, A d = 0, G d <= 0, d >= 0 where there is a lower
  and d <= 0 where there is an upper bound, and c . d < 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import fmpq, fmpq_mat

from ..errors import InputError, NotConvexError
from ..numbers.rational_matrix import fractions, rational_column, rational_matrix
from .convexity import negative_direction

Bounds = tuple[fmpq | None, ...]


@dataclass(frozen=True, eq=False)
class QuadraticData:
    """The data of a programme; bounds are None where there is none."""

    P: fmpq_mat
    c: fmpq_mat
    A: fmpq_mat
    b: fmpq_mat
    G: fmpq_mat
    h: fmpq_mat
    lower: Bounds
    upper: Bounds


@dataclass(frozen=True, eq=False)
class Multipliers:
    """The multipliers of A x = b, of G x <= h, of lower and of upper bounds, as columns."""

    y: fmpq_mat
    z: fmpq_mat
    lower: fmpq_mat
    upper: fmpq_mat


def quadratic_data(
    P: Any, c: Any, A: Any, b: Any, G: Any, h: Any, lower: Any, upper: Any
) -> QuadraticData:
    """Read a programme; `InputError` for wrong shapes, `NotConvexError` where P is not convex."""
    cost = rational_column(c, "c")
    n = cost.nrows()
    quadratic = _rows(P, "P", n)
    if quadratic.nrows() != n or quadratic != quadratic.transpose():
        shape = (quadratic.nrows(), n)
        raise InputError(
            "P",
            P if shape == (n, n) else shape,
            f"a symmetric matrix of size {n}",
            "(P + P^T)/2 gives the same objective",
        )
    d = negative_direction(quadratic)
    if d is not None:
        raise NotConvexError("P", P, fractions(d))
    equations, b_column = _constraints(A, b, n, "A", "b")
    limits, h_column = _constraints(G, h, n, "G", "h")
    bounds = (_bounds(lower, n, "lower"), _bounds(upper, n, "upper"))
    return QuadraticData(quadratic, cost, equations, b_column, limits, h_column, *bounds)


def gradient(data: QuadraticData, multipliers: Multipliers) -> fmpq_mat:
    """A^T y + G^T z - l + u."""
    return (
        data.A.transpose() * multipliers.y
        + data.G.transpose() * multipliers.z
        - multipliers.lower
        + multipliers.upper
    )


def is_feasible(data: QuadraticData, x: fmpq_mat) -> bool:
    """Whether A x = b, G x <= h and x is within its bounds."""
    return (
        data.A * x == data.b
        and max((data.G * x - data.h).entries(), default=0) <= 0
        and all(v is None or s >= v for s, v in zip(x.entries(), data.lower, strict=True))
        and all(v is None or s <= v for s, v in zip(x.entries(), data.upper, strict=True))
    )


def is_optimal(data: QuadraticData, x: fmpq_mat, multipliers: Multipliers) -> bool:
    """Whether x and the multipliers satisfy the conditions of Karush, Kuhn and Tucker."""
    if not (is_feasible(data, x) and _have_signs(data, multipliers)):
        return False
    room = (data.h - data.G * x).entries()
    tight = [
        all(m == 0 or r == 0 for m, r in zip(multipliers.z.entries(), room, strict=True)),
        all(m == 0 or v == s for m, v, s in _bounded(multipliers.lower, data.lower, x)),
        all(m == 0 or v == s for m, v, s in _bounded(multipliers.upper, data.upper, x)),
    ]
    nothing = fmpq_mat(x.nrows(), 1)
    return all(tight) and data.P * x + data.c + gradient(data, multipliers) == nothing


def is_farkas(data: QuadraticData, multipliers: Multipliers) -> bool:
    """Whether the multipliers prove that there is no feasible point."""
    if not _have_signs(data, multipliers):
        return False
    if gradient(data, multipliers) != fmpq_mat(data.c.nrows(), 1):
        return False
    return bound_of(data, multipliers) < 0


def bound_of(data: QuadraticData, multipliers: Multipliers) -> fmpq:
    """The sum b . y + h . z - lower . l + upper . u."""
    sums = data.b.transpose() * multipliers.y + data.h.transpose() * multipliers.z
    total = sums[0, 0]
    for sign, own, bounds in (
        (-1, multipliers.lower, data.lower),
        (1, multipliers.upper, data.upper),
    ):
        for m, v in zip(own.entries(), bounds, strict=True):
            total += 0 if v is None else sign * m * v
    return total


def is_ray(data: QuadraticData, d: fmpq_mat) -> bool:
    """Whether the objective falls without end along d from any feasible point."""
    steps = d.entries()
    return (
        data.P * d == fmpq_mat(data.c.nrows(), 1)
        and data.A * d == fmpq_mat(data.b.nrows(), 1)
        and max((data.G * d).entries(), default=0) <= 0
        and all(v is None or s >= 0 for s, v in zip(steps, data.lower, strict=True))
        and all(v is None or s <= 0 for s, v in zip(steps, data.upper, strict=True))
        and (data.c.transpose() * d)[0, 0] < 0
    )


def _have_signs(data: QuadraticData, multipliers: Multipliers) -> bool:
    """Whether all are >= 0 but those of equations, and zero where there is no bound."""
    signed = (multipliers.z, multipliers.lower, multipliers.upper)
    if any(m < 0 for column in signed for m in column.entries()):
        return False
    pairs = ((multipliers.lower, data.lower), (multipliers.upper, data.upper))
    return all(
        v is not None or m == 0
        for own, bounds in pairs
        for m, v in zip(own.entries(), bounds, strict=True)
    )


def _bounded(own: fmpq_mat, bounds: Bounds, x: fmpq_mat) -> list[tuple[fmpq, fmpq | None, fmpq]]:
    return list(zip(own.entries(), bounds, x.entries(), strict=True))


def _constraints(
    rows: Any, right: Any, n: int, name: str, right_name: str
) -> tuple[fmpq_mat, fmpq_mat]:
    if rows is None and right is None:
        return fmpq_mat(0, n), fmpq_mat(0, 1)
    for given, missing, other in ((rows, name, right_name), (right, right_name, name)):
        if given is None:
            raise InputError(missing, None, f"the {missing} that belongs to {other}")
    matrix, column = _rows(rows, name, n), rational_column(right, right_name)
    if column.nrows() != matrix.nrows():
        rows_of = f"{matrix.nrows()}, the rows of {name}"
        raise InputError(f"the length of {right_name}", column.nrows(), rows_of)
    return matrix, column


def _rows(values: Any, name: str, n: int) -> fmpq_mat:
    """A matrix of n columns, which one without rows does not tell."""
    matrix = rational_matrix(values, name)
    if not matrix.nrows():
        return fmpq_mat(0, n)
    if matrix.ncols() != n:
        raise InputError(f"the columns of {name}", matrix.ncols(), f"{n}, the length of c")
    return matrix


def _bounds(values: Any, n: int, name: str) -> Bounds:
    """One bound a variable; None, for all or for one of them, where there is none."""
    if values is None:
        return (None,) * n
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise InputError(name, values, "a bound or None for each variable")
    given = list(values)
    if len(given) != n:
        raise InputError(f"the length of {name}", len(given), f"{n}, the length of c")
    numbers = iter(rational_column([x for x in given if x is not None], name).entries())
    return tuple(None if x is None else next(numbers) for x in given)
