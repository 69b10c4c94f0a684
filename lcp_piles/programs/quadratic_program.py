"""Convex quadratic programmes, exactly, by the mixed LCP of their optimality conditions.

Variables with a bound become x = lower + v or x = upper - v with v >= 0; a second bound is a row of
G. In v, y and z the conditions of Karush, Kuhn and Tucker are

    [P  A^T G^T]   [v]   [c]
    [-A  0   0 ] . [y] + [b],    v free or >= 0, y free, z >= 0,
    [-G  0   0 ]   [z]   [h]

a mixed LCP with a positive semidefinite matrix, so that Lemke's method ends with a solution or a
proof that there is none (Cottle, Pang and Stone, "The Linear Complementarity Problem", theorem
4.4.12). Such a proof (d, p, m) has P d = 0: either (p, m) is a Farkas vector, or d is a ray. Every
end is checked on the data as given (`quadratic_data`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Literal

from flint import fmpq, fmpq_mat

from ..bases.mixed_lcp import MixedResult, mixed_lcp
from ..errors import VerificationError
from ..numbers.rational_matrix import fractions, rational_column
from .quadratic_data import (
    Multipliers,
    QuadraticData,
    bound_of,
    gradient,
    is_farkas,
    is_feasible,
    is_optimal,
    is_ray,
    quadratic_data,
)

Progress = Callable[[int], None]
Numbers = tuple[Fraction, ...]


@dataclass(frozen=True, eq=False, repr=False)
class QuadraticProgramResult:
    """A proved end of min x . P x / 2 + c . x subject to A x = b, G x <= h, lower <= x <= upper.

    status      value     x            y, z, lower, upper    ray
    optimal     least     attains it   multipliers           empty
    infeasible  None      empty        a Farkas vector       empty
    unbounded   None      feasible     empty                 direction of a fall without end

    `y` belongs to A, `z` to G, `lower` and `upper` to the bounds; what each end means stands in
    `quadratic_data`. `pivots` is how many exact ones Lemke's method took.
    """

    status: Literal["optimal", "infeasible", "unbounded"]
    value: Fraction | None
    x: Numbers
    y: Numbers
    z: Numbers
    lower: Numbers
    upper: Numbers
    ray: Numbers
    pivots: int

    def __repr__(self) -> str:
        return f"<QuadraticProgramResult {self.status} after {self.pivots} pivots>"


def quadratic_program(
    P: Any,
    c: Any,
    A: Any = None,
    b: Any = None,
    *,
    G: Any = None,
    h: Any = None,
    lower: Any = None,
    upper: Any = None,
    progress: Progress | None = None,
) -> QuadraticProgramResult:
    """Minimise x . P x / 2 + c . x subject to A x = b, G x <= h and bounds, with a checked proof.

    Rows may depend on each other.

    Parameters
    ----------
    P : matrix of exact rationals, shape (n, n)
        Symmetric and positive semidefinite.
    c : sequence of exact rationals, shape (n,)
        The linear part.
    A : matrix of exact rationals, shape (m, n), optional
        The equations.
    b : sequence of exact rationals, shape (m,), optional
        Their right-hand sides.
    G : matrix of exact rationals, shape (k, n), optional
        The inequalities.
    h : sequence of exact rationals, shape (k,), optional
        Their right-hand sides.
    lower : sequence of exact rationals or None, shape (n,), optional
        A lower bound for each variable; it is free without any.
    upper : sequence of exact rationals or None, shape (n,), optional
        An upper bound for each variable.
    progress : callable, optional
        Called with the number of pivots after each.

    Returns
    -------
    QuadraticProgramResult
        The `status` ("optimal", "infeasible" or "unbounded"), `value`, `x` and multipliers, or a
        ray.

    Raises
    ------
    NotConvexError
        Where P is not positive semidefinite; its `direction` proves it.
    InputError
        For other data, floats among them.

    Examples
    --------
    >>> nearest = quadratic_program([[1, 0], [0, 1]], [-2, 0], [[1, 1]], [1], lower=[0, 0])
    >>> nearest.status, nearest.x, nearest.value
    ('optimal', (Fraction(1, 1), Fraction(0, 1)), Fraction(-3, 2))
    """
    data = quadratic_data(P, c, A, b, G, h, lower, upper)
    form = _form(data)
    end = _solved(form, form.data.P, form.data.c, progress)
    if end.status == "solved":
        return _optimal(data, form, end)
    multipliers, ray = _certificate(data, form, end)
    if bound_of(data, multipliers) < 0:
        return _infeasible(data, multipliers, end.pivots)
    n = data.c.nrows()
    point = _solved(form, fmpq_mat(n, n), fmpq_mat(n, 1), progress)
    pivots = end.pivots + point.pivots
    if point.status == "infeasible":
        return _infeasible(data, _certificate(data, form, point)[0], pivots)
    x = form.point(rational_column(point.z[:n], "x"))
    if not (is_feasible(data, x) and is_ray(data, ray)):
        raise VerificationError("the ray of the quadratic programme proves nothing")
    none: Numbers = ()
    rays = fractions(ray)
    return QuadraticProgramResult("unbounded", None, fractions(x), *(none,) * 4, rays, pivots)


@dataclass(frozen=True, eq=False)
class _Form:
    """The programme in v >= 0 or free: x_i = origin_i + sign_i v_i, second bounds as rows of G.

    `rows` are the variables that those rows, after the ones given, belong to.
    """

    data: QuadraticData
    origin: fmpq_mat
    signs: tuple[int, ...]
    free: tuple[int, ...]
    rows: tuple[int, ...]

    def point(self, v: fmpq_mat) -> fmpq_mat:
        """The x of a v."""
        return self.origin + self.step(v)

    def step(self, v: fmpq_mat) -> fmpq_mat:
        """The change of x with a change of v."""
        turned = [s * x for s, x in zip(self.signs, v.entries(), strict=True)]
        return fmpq_mat(len(turned), 1, turned)


def _form(data: QuadraticData) -> _Form:
    n = data.c.nrows()
    bounds = list(zip(data.lower, data.upper, strict=True))
    signs = tuple(-1 if low is None and up is not None else 1 for low, up in bounds)
    origin = fmpq_mat(n, 1, [low if low is not None else up or fmpq(0) for low, up in bounds])
    free = tuple(i for i, pair in enumerate(bounds) if pair == (None, None))
    rows = tuple(i for i, pair in enumerate(bounds) if None not in pair)
    limits = data.G.tolist() + [[fmpq(i == j) for j in range(n)] for i in rows]
    tops = [up for low, up in bounds if low is not None and up is not None]
    G = fmpq_mat(len(limits), n, [x for row in limits for x in row])
    h = fmpq_mat(len(limits), 1, data.h.entries() + tops)

    turn = fmpq_mat(n, n)
    for i, sign in enumerate(signs):
        turn[i, i] = fmpq(sign)
    turned = replace(
        data,
        P=turn * data.P * turn,
        c=turn * (data.P * origin + data.c),
        A=data.A * turn,
        b=data.b - data.A * origin,
        G=G * turn,
        h=h - G * origin,
    )
    return _Form(turned, origin, signs, free, rows)


def _solved(form: _Form, P: fmpq_mat, c: fmpq_mat, progress: Progress | None) -> MixedResult:
    """The mixed LCP of the programme with this objective."""
    data = form.data
    n, m, k = c.nrows(), data.b.nrows(), data.h.nrows()
    rows = [
        [*own, *of_y, *of_z]
        for own, of_y, of_z in zip(
            P.tolist(), _columns(data.A, n), _columns(data.G, n), strict=True
        )
    ]
    rows += [[-x for x in row] + [fmpq(0)] * (m + k) for row in data.A.tolist() + data.G.tolist()]
    right = c.entries() + data.b.entries() + data.h.entries()
    return mixed_lcp(rows, right, [*form.free, *range(n, n + m)], progress=progress)


def _columns(matrix: fmpq_mat, n: int) -> list[list[fmpq]]:
    return matrix.transpose().tolist() if matrix.nrows() else [[] for _ in range(n)]


def _multipliers(data: QuadraticData, form: _Form, yz: Numbers, rest: fmpq_mat) -> Multipliers:
    """All multipliers from those of A and of the rows of the form.

    Those of the first bounds follow from P x + c = rest and the condition that the sum vanishes.
    """
    n, m, k = data.c.nrows(), data.b.nrows(), data.h.nrows()
    y, z = rational_column(yz[:m], "y"), rational_column(yz[m : m + k], "z")
    lower, upper = fmpq_mat(n, 1), fmpq_mat(n, 1)
    for i, x in zip(form.rows, rational_column(yz[m + k :], "z").entries(), strict=True):
        upper[i, 0] = x
    slope = rest + gradient(data, Multipliers(y, z, lower, upper))
    for i in range(n):
        if data.lower[i] is not None:
            lower[i, 0] = slope[i, 0]
        elif data.upper[i] is not None:
            upper[i, 0] = -slope[i, 0]
    return Multipliers(y, z, lower, upper)


def _optimal(data: QuadraticData, form: _Form, end: MixedResult) -> QuadraticProgramResult:
    n = data.c.nrows()
    x = form.point(rational_column(end.z[:n], "x"))
    multipliers = _multipliers(data, form, end.z[n:], data.P * x + data.c)
    if not is_optimal(data, x, multipliers):
        raise VerificationError("the end of the quadratic programme is not optimal")
    value = x.transpose() * (data.P * x * fmpq(1, 2) + data.c)
    (least,) = fractions(value)
    return QuadraticProgramResult(
        "optimal", least, fractions(x), *_plain(multipliers), (), end.pivots
    )


def _infeasible(
    data: QuadraticData, multipliers: Multipliers, pivots: int
) -> QuadraticProgramResult:
    if not is_farkas(data, multipliers):
        raise VerificationError("the Farkas vector of the quadratic programme proves nothing")
    return QuadraticProgramResult("infeasible", None, (), *_plain(multipliers), (), pivots)


def _certificate(
    data: QuadraticData, form: _Form, end: MixedResult
) -> tuple[Multipliers, fmpq_mat]:
    """The multipliers and the direction of a proof that the mixed LCP has no solution."""
    n = data.c.nrows()
    proof = end.certificate or ()
    multipliers = _multipliers(data, form, proof[n:], fmpq_mat(n, 1))
    return multipliers, form.step(rational_column(proof[:n], "ray"))


def _plain(multipliers: Multipliers) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    return (
        fractions(multipliers.y),
        fractions(multipliers.z),
        fractions(multipliers.lower),
        fractions(multipliers.upper),
    )
