"""Lemke's method for the LCP, exact, with the lexicographic rule.

Lemke (1965); Cottle, Pang and Stone, "The Linear Complementarity Problem" (1992), algorithm 4.4.5
and section 4.9 for the rule against cycles. A covering vector d > 0 makes w = q + M z + d z0
feasible for a large z0; complementary pivots then lower z0 to zero, or end on a secondary ray.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from operator import index
from typing import Any, Literal, SupportsIndex

from flint import fmpz

from ..errors import InputError
from ..numbers.exact import Exact, Surd, rational, surd
from ..numbers.vectors import ExactVector, content, exact_vector
from .checks import checked_dw, is_certificate
from .direction import Direction
from .lcp import LCP, lcp_of
from .path import lemke_path
from .rows import entries_of
from .tableau import Tableau

Status = Literal["solved", "infeasible", "ray", "limit"]


@dataclass(frozen=True, eq=False, repr=False)
class Ray:
    """The secondary ray (z, z0) + t (dz, dz0), t >= 0, that Lemke's method ended on.

    `z` and `z0` are its foot; along it w + t dw stays non-negative and complementary too.
    """

    z: tuple[Surd, ...]
    z0: Surd
    dz: tuple[Fraction, ...]
    dw: tuple[Fraction, ...]
    dz0: Fraction

    def __repr__(self) -> str:
        return f"<Ray of {len(self.z)} variables>"


@dataclass(frozen=True, eq=False, repr=False)
class LemkeResult:
    """What Lemke's method found.

    `status` is "solved" (then `z` and `w` solve the LCP), "infeasible" (no z >= 0 has
    M z + q >= 0), "ray" (`ray` says where the method ended, which proves nothing) or "limit" (the
    caller's limit on pivots). What is infeasible has, beside the ray that gave it, a `certificate`:
    y >= 0 with M^T y <= 0 and q . y < 0, so that 0 <= y . (M z + q) < 0 would follow. It has been
    checked. For a positive semidefinite M every ray gives one.
    """

    status: Status
    z_vector: ExactVector | None
    w_vector: ExactVector | None
    pivots: int
    ray: Ray | None = None
    certificate: tuple[Fraction, ...] | None = None

    def __repr__(self) -> str:
        return f"<LemkeResult {self.status} after {self.pivots} pivots>"

    @property
    def success(self) -> bool:
        """Whether z and w are a solution."""
        return self.status == "solved"

    @property
    def z(self) -> tuple[Fraction | Surd, ...]:
        """The solution z; empty where there is none."""
        return plain_numbers(self.z_vector)

    @property
    def w(self) -> tuple[Fraction | Surd, ...]:
        """The solution's w = M z + q; empty where there is none."""
        return plain_numbers(self.w_vector)


def lemke(
    M: Any,
    q: Sequence[Exact] | None = None,
    d: Sequence[Exact] | None = None,
    *,
    max_pivots: SupportsIndex | None = None,
    progress: Callable[[int], None] | None = None,
) -> LemkeResult:
    """Solve w = M z + q, z >= 0, w >= 0, z . w = 0 exactly, by Lemke's method.

    Pivots are exact, and the lexicographic rule keeps them from cycling. A positive semidefinite M
    ends in a solution or in a proof that there is none.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n), or LCP
        In any form that `lcp` takes; of an LCP q is left out.
    q : sequence of exact numbers, shape (n,), optional
        Given unless M is an LCP.
    d : sequence of exact numbers, shape (n,), optional
        The covering vector, non-negative and positive where q is negative; all ones by default.
    max_pivots : int, optional
        After so many pivots the status is "limit".
    progress : callable, optional
        Called with the number of pivots after each.

    Returns
    -------
    LemkeResult
        The `status` ("solved", "infeasible", "ray" or "limit"), `z` and `w`, or the `ray` and what
        it proves.

    Raises
    ------
    InputError
        For other data, floats among them.

    References
    ----------
    Lemke, Management Science 11 (1965) 681. Cottle, Pang and Stone, "The Linear Complementarity
    Problem" (1992), algorithm 4.4.5 and section 4.9.

    Examples
    --------
    >>> result = lemke([[2, 1], [1, 2]], [-5, -6])
    >>> result.status, result.z, result.pivots
    ('solved', (Fraction(4, 3), Fraction(7, 3)), 3)
    """
    problem = lcp_of(M, q)
    most = pivot_limit(max_pivots)
    cover, scale = _cover(problem.q.signs(), d)
    path = lemke_path(problem, cover, most, progress, stop_at_tie=True)
    if path.solution is not None:
        return LemkeResult("solved", *path.solution, path.pivots)
    if path.ray is None:
        return LemkeResult("limit", None, None, path.pivots)
    ray = _ray(problem, *path.ray, cover, scale)
    certificate = _certificate(problem, ray.dz)
    status: Status = "ray" if certificate is None else "infeasible"
    return LemkeResult(status, None, None, path.pivots, ray, certificate)


def solved_table(problem: LCP) -> Tableau | None:
    """The tableau at the end of Lemke's method, to pivot on from there; None on a ray.

    Its basis is lexicographically positive: pivots that go on from it under the same rule never
    repeat a basis.
    """
    cover = [1] * len(problem)
    path = lemke_path(problem, cover, stop_at_tie=False)
    if path.solution is None:
        return None
    return Tableau(problem, cover, path.active, path.left)


def pivot_limit(max_pivots: SupportsIndex | None) -> int | None:
    """The limit as an int, whoever's integer it is."""
    try:
        limit = None if max_pivots is None else index(max_pivots)
    except TypeError:
        limit = -1
    if isinstance(max_pivots, bool) or (limit is not None and limit < 0):
        raise InputError("max_pivots", max_pivots, "a whole number of at least 0, or None")
    return limit


def _cover(signs: list[int], d: Sequence[Exact] | None) -> tuple[list[int], int]:
    """The covering vector times a positive integer that makes it one of integers, and that."""
    if d is None:
        return [1] * len(signs), 1
    values = entries_of(d, "d")
    if len(values) != len(signs):
        raise InputError("the length of d", len(values), f"{len(signs)}, the size of M")
    exact = [rational(x, "an entry of d") for x in values]
    for i, (x, sign) in enumerate(zip(exact, signs, strict=True)):
        if x < 0 or (x == 0 and sign < 0):
            raise InputError(f"d[{i}]", x, "a positive number, or 0 where q is not negative")
    den = lcm(*(x.denominator for x in exact))
    return [int(x * den) for x in exact], den


def _ray(problem: LCP, table: Tableau, direction: Direction, cover: list[int], scale: int) -> Ray:
    """The ray, checked; z0 of the table belongs to `scale` times the caller's covering vector."""
    n = table.size
    z0, dz0 = table.vector(table.z0, table.z0 + 1)[0], direction[table.z0]
    changes = [direction[v] for v in range(n, 2 * n)]
    common = content(changes, dz0)
    z, dz = table.vector(n, 2 * n), ExactVector({1: [x // common for x in changes]}, fmpz(1))
    step = surd(dz0 // common)
    dw = checked_dw(problem, exact_vector(cover), (z, z0), (dz, step))
    return Ray(
        tuple(z),
        z0 * scale,
        tuple(x.rational() for x in dz),
        tuple(x.rational() for x in dw),
        step.rational() * scale,
    )


def _certificate(problem: LCP, dz: Sequence[Fraction]) -> tuple[Fraction, ...] | None:
    """The z part of a ray, in integers, if it proves that there is no solution."""
    common = content([fmpz(x.numerator) for x in dz], fmpz(0))
    if common == 0:
        return None
    y = tuple(x / int(common) for x in dz)
    return y if is_certificate(problem, y) else None


def plain_numbers(vector: ExactVector | None) -> tuple[Fraction | Surd, ...]:
    """Fractions where the numbers are rational, Surds elsewhere."""
    if vector is None:
        return ()
    return tuple(x.rational() if x.is_rational else x for x in vector)
