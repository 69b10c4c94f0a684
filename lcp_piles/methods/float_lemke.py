"""Lemke's method on a dense tableau of floats, with a tolerance: what textbooks print.

No lexicographic rule: of the rows that tie, z0 comes first, then the lowest one. Rounding and
ties can therefore make it cycle, stop at a ray that is none, or end at a wrong basis; `lemke` is
the exact method. Each pivot is one update of rank one, n^2 operations.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

import numpy as np

from ..errors import InputError, SolveError
from ..mechanics.system import ContactSystem
from ..numbers.vectors import FloatArray, Mask
from .float_state import FloatState, unbalanced
from .method import Arithmetic, Method, Outcome, Progress, float_outcome

Status = Literal["solved", "ray", "limit"]


@dataclass(frozen=True, eq=False)
class FloatLemkeResult:
    """Where floating-point pivots ended.

    `status` is where they believe to be: "solved" (z0 left), "ray" (no row blocks) or "limit".
    `basis` marks the basic ones of w, z and z0 (2n + 1 variables), `z` are the
    values there, `w` is M z + q; `residual` is max |min(z, w)| over max |q|, and
    `converged` says that the status is "solved" and the residual within the tolerance.
    """

    status: Status
    z: FloatArray
    w: FloatArray
    basis: Mask
    pivots: int
    residual: float
    converged: bool


def float_lemke(
    M: Any,
    q: Any,
    *,
    dtype: Any = np.float64,
    tolerance: float | None = None,
    max_pivots: int | None = None,
) -> FloatLemkeResult:
    """Solve w = M z + q, z >= 0, w >= 0, z . w = 0 in floats, covering vector (1, ..., 1).

    Parameters: `M` (n, n) and `q` (n); `dtype`, float64 or float32; `tolerance`, the residual that
    counts as solved, sqrt(eps) of the type by default; `max_pivots`, 100 n by default. An entry of
    the entering column counts as a pivot above eps^(2/3) of the largest one, and ratios that differ
    by less than eps^(2/3), relative where they are above one, tie.

    Source: Cottle, Pang and Stone, algorithm 4.4.5.

    >>> result = float_lemke([[2, 1], [1, 2]], [-5, -6])
    >>> result.status, result.converged, result.z.round(6).tolist()
    ('solved', True, [1.333333, 2.333333])
    """
    kind = np.dtype(dtype)
    matrix, right = np.array(M, dtype=kind), np.array(q, dtype=kind)
    size = len(right)
    if matrix.shape != (size, size):
        raise InputError("the shape of M", matrix.shape, f"({size}, {size})")
    table = np.hstack([matrix, np.ones((size, 1), dtype=kind)])
    eps = float(np.finfo(kind).eps)
    slack = eps ** (2 / 3)
    limit = 100 * size if max_pivots is None else max_pivots
    # basic = values + table @ nonbasic; w_i is i, z_i is size + i, z0 is 2 size.
    values = right.copy()
    basic = np.arange(size)
    nonbasic = np.arange(size, 2 * size + 1)
    status: Status = "solved"
    pivots = 0
    column, row = size, int(np.argmin(values)) if size else 0
    if size and values[row] < 0:
        status = "limit"
        while pivots < limit:
            with np.errstate(all="ignore"):
                _exchange(table, values, row, column)
            basic[row], nonbasic[column] = nonbasic[column], basic[row]
            pivots += 1
            left = int(nonbasic[column])
            if left == 2 * size:
                status = "solved"
                break
            partner = left + size if left < size else left - size
            column = int(np.flatnonzero(nonbasic == partner)[0])
            blocking = _blocking(table[:, column], values, basic == 2 * size, slack)
            if blocking is None:
                status = "ray"
                break
            row = blocking
    marked = np.isin(np.arange(2 * size + 1), basic)
    z = np.zeros(size, dtype=kind)
    in_basis = (basic >= size) & (basic < 2 * size)
    z[basic[in_basis] - size] = values[in_basis]
    w = matrix @ z + right
    largest = float(np.abs(right).max(initial=0.0)) or 1.0
    residual = float(np.abs(np.minimum(z, w)).max(initial=0.0)) / largest
    accepted = eps**0.5 if tolerance is None else tolerance
    return FloatLemkeResult(
        status, z, w, marked, pivots, residual, status == "solved" and residual <= accepted
    )


def float_lcp(system: ContactSystem) -> tuple[FloatArray, FloatArray]:
    """(M, q) of a contact system in floats, z the gaps and w the forces of all its contacts.

    M = E - E B K^-1 B^T E and q = -E (B U_0 + o), as in `contact_lcp`, by one dense factorisation.
    Raises `SolveError` where that form does not exist: rigid or bilateral contacts, or motions that
    no contact resists.

    >>> from lcp_piles import contact_system, nt60
    >>> M, q = float_lcp(contact_system(nt60(3)))
    >>> float_lemke(M, q).converged
    True
    """
    sparse, C, o, p = system.floats()
    if system.bilateral.any() or not C.all():
        raise SolveError("rigid or bilateral contacts have no such form: use contact_lcp")
    B = sparse.toarray()
    E = 1 / C
    try:
        factor = np.linalg.cholesky(B.T @ (E[:, None] * B))
    except np.linalg.LinAlgError as error:
        raise SolveError("a motion is free although all contacts are closed") from error
    half = np.linalg.solve(factor, B.T * E)
    U = np.linalg.solve(factor.T, np.linalg.solve(factor, p - B.T @ (E * o)))
    return np.diag(E) - half.T @ half, -E * (B @ U + o)


def run_float_lemke(
    arithmetic: Arithmetic, system: ContactSystem, progress: Progress | None = None
) -> Outcome:
    """`float_lemke` on the LCP of all contacts, as a method of `solve`."""
    try:
        M, q = float_lcp(system)
    except SolveError as error:
        return Outcome(0, f"none: {error}")
    result = float_lemke(M, q, dtype=arithmetic)
    size = system.contacts
    B, C, o, _ = system.floats()
    forces, gaps = result.w.astype(np.float64), result.z.astype(np.float64)
    U = np.linalg.lstsq(B.toarray(), gaps - o - C * forces, rcond=None)[0]
    # A pile that moves freely may still be factored, by rounding: its forces do not balance then.
    residual = max(result.residual, unbalanced(system, forces))
    converged = result.converged and residual <= _tolerance(arithmetic)
    closed = result.basis[:size]
    return float_outcome(FloatState(U, forces, gaps, closed, result.pivots, residual, converged))


def _tolerance(arithmetic: Arithmetic) -> float:
    return float(np.finfo(np.dtype(arithmetic)).eps ** 0.5)


def _method(arithmetic: Arithmetic) -> Method:
    return Method(
        f"lemke-{arithmetic}",
        f"Lemke's method on a dense tableau in {arithmetic}",
        arithmetic,
        partial(run_float_lemke, arithmetic),
        _tolerance(arithmetic),
    )


LEMKE_FLOAT64, LEMKE_FLOAT32 = _method("float64"), _method("float32")


def _exchange(table: FloatArray, values: FloatArray, row: int, column: int) -> None:
    """Make the nonbasic variable of a column basic in a row, in place."""
    pivot = table[row, column]
    line = -table[row] / pivot
    line[column] = 1 / pivot
    value = -values[row] / pivot
    entering = table[:, column].copy()
    table[:, column] = 0
    table += np.outer(entering, line)
    values += entering * value
    table[row], values[row] = line, value


def _blocking(entering: FloatArray, values: FloatArray, is_z0: Mask, slack: float) -> int | None:
    """The row that reaches zero first, z0 before the lowest of those that tie."""
    falling = np.flatnonzero(entering < -slack * np.abs(entering).max())
    if not len(falling):
        return None
    ratios = values[falling] / -entering[falling]
    least = float(ratios.min())
    tied = falling[ratios <= least + slack * max(1.0, least)]
    first = tied[is_z0[tied]]
    return int(first[0] if len(first) else tied[0])
