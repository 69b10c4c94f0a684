"""The mixed LCP: some variables are free, and their rows are equations.

    w = M z + q;    z_i free and w_i = 0 for i in F;    z_i, w_i >= 0 and z_i w_i = 0 elsewhere.

A basis that holds all of F is proposed in floating point and proved by one exact solve, as for an
LCP without free variables (`solve_lcp`). Where none is right, Lemke's method solves an LCP, to
which there are two ways, both z = T z' + t, w' = S^T w:

* the block M_FF is regular: its rows give z_F, and S makes them vanish from the others (the Schur
  complement; Cottle, Pang and Stone, "The Linear Complementarity Problem", section 1.4);
* otherwise z_F = u - s (1, ..., 1) with u, s >= 0, S = T. Then w_F >= 0 and -sum w_F >= 0, so that
  w_F = 0. M' is positive semidefinite where M is, and Lemke's method then ends with a proof.

A certificate y' of the LCP is y = S y' for the mixed one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from operator import index
from typing import Any, Literal, SupportsIndex

import numpy as np
from flint import fmpq, fmpq_mat

from ..errors import InputError, SolveError, VerificationError
from ..numbers.rational_matrix import fractions, rational_column
from ..numbers.vectors import ExactVector
from ..pivoting.lcp import LCP, lcp
from ..pivoting.lemke import lemke
from ..pivoting.rows import entries_of
from .exact_basis import proved
from .proposals import proposals


@dataclass(frozen=True, eq=False, repr=False)
class MixedResult:
    """A proved end of a mixed LCP.

    With `status` "solved" `z` and `w` solve it. With "infeasible" they are empty, and `certificate`
    is a y with y_i >= 0 and (M^T y)_i <= 0 outside F, (M^T y)_i = 0 in F and q . y < 0: no z with
    the right signs has w with the right signs, because y . w < 0 would follow. `pivots` is how many
    Lemke's method took, none where floating point named the basis.
    """

    status: Literal["solved", "infeasible"]
    z: tuple[Fraction, ...]
    w: tuple[Fraction, ...]
    certificate: tuple[Fraction, ...] | None
    pivots: int

    def __repr__(self) -> str:
        return f"<MixedResult {self.status} after {self.pivots} pivots>"


def mixed_lcp(
    M: Any,
    q: Any,
    free: Iterable[SupportsIndex],
    *,
    progress: Callable[[int], None] | None = None,
) -> MixedResult:
    """Solve w = M z + q with w_i = 0 for the free variables, z, w >= 0 and z . w = 0 for the rest.

    Where there are several solutions, any of them may come.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n)
        In any form that `lcp` takes.
    q : sequence of exact rationals, shape (n,)
        The w of z = 0.
    free : iterable of int
        The numbers of the free variables, whose rows are equations.
    progress : callable, optional
        Called with the number of pivots after each, if there are any.

    Returns
    -------
    MixedResult
        `z` and `w`, or the `certificate` that there are none.

    Raises
    ------
    InputError
        For other data, floats among them.
    SolveError
        Where Lemke's method ends on a ray that proves nothing, as it may for M that are not
        positive semidefinite.

    References
    ----------
    Cottle, Pang and Stone, "The Linear Complementarity Problem" (1992), section 1.4.

    Examples
    --------
    >>> result = mixed_lcp([[0, 1], [-1, 2]], [-3, 1], free=[0])
    >>> result.z, result.w
    ((Fraction(7, 1), Fraction(3, 1)), (Fraction(0, 1), Fraction(0, 1)))
    """
    column = rational_column(entries_of(q, "q"), "q")
    problem = lcp(M, column.entries())
    at = _places(free, len(problem))
    signless = np.zeros(len(problem), dtype=bool)
    signless[at] = True
    for basic in proposals(problem, signless):
        found = proved(problem, basic, signless)
        if found is not None:
            return MixedResult("solved", _plain(found[0]), _plain(found[1]), None, 0)
    return _by_pivots(problem, column, at, progress)


def _by_pivots(
    problem: LCP, column: fmpq_mat, at: list[int], progress: Callable[[int], None] | None
) -> MixedResult:
    """Where no proposal is right: Lemke's method on a problem without free variables."""
    n = len(problem)
    entries = [fmpq(x.numerator, x.denominator) for row in problem.M for x in row]
    matrix = fmpq_mat(n, n, entries)
    change = _eliminated(matrix, column, at) or _shifted(n, at)
    S = change.S.transpose()
    inner = lemke(
        (S * matrix * change.T).tolist(),
        (S * (matrix * change.t + column)).entries(),
        progress=progress,
    )
    if inner.status == "solved":
        z = change.T * rational_column(inner.z, "z") + change.t
        w = matrix * z + column
        if not _is_solution(z, w, at):
            raise VerificationError("the z that was found does not solve the mixed LCP")
        return MixedResult("solved", fractions(z), fractions(w), None, inner.pivots)
    if inner.certificate is None:
        raise SolveError(
            "Lemke's method ended on a ray that proves nothing: M is not positive semidefinite, "
            "and the mixed LCP may have a solution or not"
        )
    y = change.S * rational_column(inner.certificate, "y")
    if not _is_certificate(matrix, column, y, at):
        raise VerificationError("the certificate of the mixed LCP proves nothing")
    return MixedResult("infeasible", (), (), fractions(y), inner.pivots)


def _plain(values: ExactVector) -> tuple[Fraction, ...]:
    return tuple(x.rational() for x in values)


@dataclass(frozen=True, eq=False)
class _Change:
    """z = T z' + t and w' = S^T w."""

    T: fmpq_mat
    t: fmpq_mat
    S: fmpq_mat


def _eliminated(M: fmpq_mat, q: fmpq_mat, free: list[int]) -> _Change | None:
    """The free variables as what their rows say; None where these do not say it."""
    n = q.nrows()
    others = sorted(set(range(n)) - set(free))
    block = _part(M, free, free)
    try:
        # One matrix more than the columns of M, q, makes one solve of two.
        by_rows = block.solve(_joined(_part(M, free, others), _part(q, free, [0])))
        by_columns = block.transpose().solve(_part(M, others, free).transpose())
    except ZeroDivisionError:
        return None
    T, t, S = fmpq_mat(n, len(others)), fmpq_mat(n, 1), fmpq_mat(n, len(others))
    for k, i in enumerate(others):
        T[i, k] = S[i, k] = fmpq(1)
    for row, i in enumerate(free):
        t[i, 0] = -by_rows[row, len(others)]
        for k in range(len(others)):
            T[i, k], S[i, k] = -by_rows[row, k], -by_columns[row, k]
    return _Change(T, t, S)


def _shifted(n: int, free: list[int]) -> _Change:
    """The free variables as differences u_i - s."""
    T = fmpq_mat(n, n + 1)
    for i in range(n):
        T[i, i] = fmpq(1)
    for i in free:
        T[i, n] = fmpq(-1)
    return _Change(T, fmpq_mat(n, 1), T)


def _part(M: fmpq_mat, rows: list[int], columns: list[int]) -> fmpq_mat:
    return fmpq_mat(len(rows), len(columns), [M[i, j] for i in rows for j in columns])


def _joined(left: fmpq_mat, right: fmpq_mat) -> fmpq_mat:
    """Two matrices side by side."""
    rows = zip(left.tolist(), right.tolist(), strict=True)
    entries = [x for one, two in rows for x in (*one, *two)]
    return fmpq_mat(left.nrows(), left.ncols() + right.ncols(), entries)


def _places(free: Iterable[SupportsIndex], n: int) -> list[int]:
    """The numbers of the free variables, in order."""
    try:
        given = list(free)
        places = [index(i) for i in given]
        right = all(0 <= i < n for i in places) and not any(isinstance(i, bool) for i in given)
    except TypeError:
        places, right = [], False
    if not right:
        raise InputError("free", free, f"numbers of variables, from 0 to {n - 1}")
    return sorted(set(places))


def _is_solution(z: fmpq_mat, w: fmpq_mat, free: list[int]) -> bool:
    pairs = list(zip(z.entries(), w.entries(), strict=True))
    bound = set(range(len(pairs))) - set(free)
    return all(pairs[i][1] == 0 for i in free) and all(
        pairs[i][0] >= 0 and pairs[i][1] >= 0 and 0 in pairs[i] for i in bound
    )


def _is_certificate(M: fmpq_mat, q: fmpq_mat, y: fmpq_mat, free: list[int]) -> bool:
    slopes, weights = (M.transpose() * y).entries(), y.entries()
    bound = set(range(len(weights))) - set(free)
    return (
        all(slopes[i] == 0 for i in free)
        and all(slopes[i] <= 0 <= weights[i] for i in bound)
        and (q.transpose() * y)[0, 0] < 0
    )
