"""Bases of an LCP that floating point proposes, one method after the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.sparse import diags_array, issparse

from ..linear.threads import one_thread
from ..numbers.vectors import FloatArray, IntArray, Mask
from ..pivoting.lcp import LCP
from .interior_point import interior_point
from .newton_min import newton_min

_ROUNDS = 4
_FULL = 4  # a matrix is dense where one in so many of its entries is not zero
_SMALL = 100


def proposals(problem: LCP, free: Mask | None = None) -> Iterator[Mask]:
    """Masks of the basic z that should solve an LCP, where `free` z have any sign and no w.

    >>> from lcp_piles import lcp
    >>> [basic.tolist() for basic in proposals(lcp([[2, 1], [1, 2]], [-5, -1]))][0]
    [True, False]
    """
    scaled = _scaled(*_floats(problem))
    if scaled is None:
        return
    signless = np.zeros(len(problem), dtype=bool) if free is None else free
    for method in (newton_min, interior_point):
        with one_thread(), np.errstate(all="ignore"):
            basic = method(*scaled, signless)
        if basic is not None:
            yield basic


def _floats(problem: LCP) -> tuple[Any, FloatArray]:
    size = len(problem)
    rows = problem.rows
    if rows is None or size <= _SMALL or len(rows.A.data) * _FULL > size**2:
        return problem.floats()
    return problem.sparse()


def _scaled(M: Any, q: FloatArray) -> tuple[Any, FloatArray] | None:
    """M and q in units, powers of two, that bring the entries of M near one; signs stay.

    None where they are beyond the range of floats.
    """
    with np.errstate(all="ignore"):
        sizes = abs(M)
        rows = columns = np.zeros(len(q), dtype=np.int64)
        for _ in range(_ROUNDS if len(q) else 0):
            now = _times(sizes, rows, columns)
            rows = rows - _half_exponents(now.max(axis=1))
            columns = columns - _half_exponents(now.max(axis=0))
        scaled, right = _times(M, rows, columns), np.ldexp(q, rows)
    return (scaled, right) if np.isfinite([scaled.sum(), right.sum()]).all() else None


def _times(M: Any, rows: IntArray, columns: IntArray) -> Any:
    """M with rows and columns times these powers of two."""
    left, right = np.ldexp(1.0, rows), np.ldexp(1.0, columns)
    if issparse(M):
        return (diags_array(left) @ M @ diags_array(right)).tocsr()
    return left[:, None] * M * right


def _half_exponents(largest: Any) -> IntArray:
    # One row or column, of one or two axes by the version of scipy.
    values = largest.toarray().ravel() if issparse(largest) else largest
    return np.asarray(np.frexp(np.asarray(values, dtype=np.float64))[1], dtype=np.int64) // 2
