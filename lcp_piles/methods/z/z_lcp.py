"""The Z iteration on any exact LCP: the Newton-min method, which may cycle.

For w = M z + q, z >= 0, w >= 0, z . w = 0 the set Z holds the indices whose z is basic, as a
removed contact has its gap for an unknown: w_i = 0 on Z and z_i = 0 elsewhere. An index leaves Z
where z_i <= 0 and enters where w_i < 0. (Ben Gharbia and Gilbert 2012, "Nonconvergence of the plain
Newton-min algorithm for linear complementarity problems with a P-matrix", have the examples.)
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpq_mat

from ...errors import InputError
from ...numbers.exact import ZERO, Exact, Surd, sqrt_of, surd
from ...pivoting.lcp import LCP, lcp
from .z_iteration import Solved, ZStatus, ZStep, iterate

_Pair = tuple[tuple[Surd, ...], tuple[Surd, ...]]


@dataclass(frozen=True, eq=False)
class ZLCPResult:
    """What the Z iteration did with an LCP; `z` and `w` are empty unless it is "solved".

    The sets Z in `trace` and `cycle` are those of the basic z, as numbers from 0.
    """

    status: ZStatus
    z: tuple[Fraction | Surd, ...]
    w: tuple[Fraction | Surd, ...]
    trace: tuple[ZStep, ...]
    cycle: tuple[tuple[int, ...], ...]


def z_lcp(
    M: Any, q: Sequence[Exact] | None = None, start: Iterable[int] = (), *, limit: int = 1000
) -> ZLCPResult:
    """The Z iteration of the paper on any LCP, exact, from a set of basic z.

    It may cycle. Where a system is singular but solvable, the z that depend on earlier ones stay
    zero; where it has no solution, indices leave Z one by one, that whose z and w are closest in
    the last solved state first, until it has.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n), or LCP
        In any form that `lcp` takes; of an LCP q is left out.
    q : sequence of exact numbers, shape (n,), optional
        Given unless M is an LCP.
    start : iterable of int, optional
        The first set Z, none by default.
    limit : int, default 1000
        The most systems to solve.

    Returns
    -------
    ZLCPResult
        The `status`, `z` and `w`, the sets passed (`trace`), and those that repeat (`cycle`).

    Raises
    ------
    InputError
        For other data, floats among them, and an index that is none.

    Examples
    --------
    >>> result = z_lcp([[1, 0, 2], [2, 1, 0], [0, 2, 1]], [1, 1, 1], start=[0])
    >>> result.status, result.cycle
    ('cycle', ((0,), (1,), (2,)))
    """
    if isinstance(M, LCP):
        problem = M
    elif q is None:
        raise InputError("q", q, "a vector of exact numbers")
    else:
        problem = lcp(M, q)
    size = len(problem)
    Z = frozenset(start)
    for i in Z:
        if not isinstance(i, int) or not 0 <= i < size:
            raise InputError("an index of the start", i, f"a number from 0 to {size - 1}")
    rows = problem.M
    right = list(problem.q)

    def step(basic: frozenset[int]) -> Solved[_Pair] | None:
        at = sorted(basic)
        found = _solve([[rows[i][j] for j in at] for i in at], [-right[i] for i in at])
        if found is None:
            return None
        values, rank = found
        z = [ZERO] * size
        for i, value in zip(at, values, strict=True):
            z[i] = value
        w = [
            ZERO if i in basic else right[i] + sum((z[j] * rows[i][j] for j in at), ZERO)
            for i in range(size)
        ]
        w_signs, z_signs = [x.sign() for x in w], [x.sign() for x in z]
        distances = [a - b for a, b in zip(z, w, strict=True)]
        return Solved(w_signs, z_signs, distances, rank, len(at) - rank, (tuple(z), tuple(w)))

    outcome = iterate(step, Z, [-x for x in right], limit)
    z, w = outcome.last.state if outcome.status == "solved" and outcome.last else ((), ())
    return ZLCPResult(outcome.status, _plain(z), _plain(w), outcome.trace, outcome.cycle)


def _solve(A: list[list[Fraction]], b: list[Surd]) -> tuple[list[Surd], int] | None:
    """A solution of A x = b with x zero on dependent columns, and the rank; None without one."""
    size = len(A)
    radicands = sorted({r for x in b for r, _ in x.terms})
    parts = [dict(x.terms) for x in b]
    entries = [
        fmpq(x.numerator, x.denominator)
        for row, part in zip(A, parts, strict=True)
        for x in [*row, *(part.get(r, Fraction(0)) for r in radicands)]
    ]
    width = size + len(radicands)
    reduced, rank = fmpq_mat(size, width, entries).rref()
    x = [ZERO] * size
    column = 0
    for i in range(rank):
        while reduced[i, column] == 0:
            column += 1
        if column >= size:
            return None
        x[column] = sum(
            (surd(reduced[i, size + k]) * sqrt_of(r) for k, r in enumerate(radicands)), ZERO
        )
    return x, rank


def _plain(values: tuple[Surd, ...]) -> tuple[Fraction | Surd, ...]:
    return tuple(x.rational() if x.is_rational else x for x in values)
