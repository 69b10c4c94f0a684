"""A basis of a monotone LCP by an interior-point method, in floating point: nothing is proved here.

The predictor-corrector method of Mehrotra (1992, "On the implementation of a primal-dual interior
point method", SIAM J. Optim. 2) from z = w = (s, ..., s), which need not satisfy w = M z + q. For a
positive semidefinite M with a solution it ends near one, in 10 to 30 linear systems, where as many
z and w as possible are positive. A basis is what is left of that when basic variables have been
moved along the kernel of their matrix to zero until the rest of the matrix is regular.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import diags_array, issparse

from ..numbers.vectors import FloatArray, Mask
from .newton_min import solved

_MOST = 60
_CLOSE, _APART = 1e-10, 1e-14
"""The residual and the mean of z w, relative to q and z, where it is seen which of them is zero."""
_BACK = 0.99
_RANK = 1e-9
"""Singular values below this, relative to the largest, count as none."""
_LARGEST_KERNEL = 3000


def interior_point(M: Any, q: FloatArray, free: Mask) -> Mask | None:
    """The basic z of a basis that seems to solve w = M z + q, z >= 0, w >= 0, z . w = 0.

    Parameters as of `newton_min`. None where the method does not converge.

    >>> M, q = np.ones((2, 2)), np.array([-1.0, -1.0])
    >>> int(interior_point(M, q, np.array([False, False])).sum())
    1
    """
    end = _end(M, q, free)
    return None if end is None else purified(M, end[0], free | (end[0] > end[1]), free)


def _end(M: Any, q: FloatArray, free: Mask) -> tuple[FloatArray, FloatArray] | None:
    """Where the method ends: z and w."""
    bound = ~free
    size = float(np.abs(q).max(initial=0.0)) or 1.0
    z, w = np.where(free, 0.0, size), np.where(free, 0.0, size)
    count = max(int(bound.sum()), 1)
    for _ in range(_MOST):
        value = M @ z + q
        mean = float(z[bound] @ w[bound]) / count
        off = float(np.abs(w - value).max(initial=0.0))
        largest = float(np.abs(z).max(initial=0.0))
        if off <= _CLOSE * (size + largest) and mean <= _APART * (size + largest) ** 2:
            return z, w
        weights = np.divide(w, z, out=np.zeros_like(z), where=bound)
        A = M + (diags_array(weights) if issparse(M) else np.diag(weights))
        step = _direction(M, A, value, z, w, bound, np.zeros_like(z))
        if step is None:
            return None
        dz, dw = step
        t = _longest(z, w, dz, dw, bound)
        target = (float((z + t * dz)[bound] @ (w + t * dw)[bound]) / count / mean) ** 3 * mean
        step = _direction(M, A, value, z, w, bound, np.where(bound, target - dz * dw, 0.0))
        if step is None:
            return None
        dz, dw = step
        t = min(1.0, _BACK * _longest(z, w, dz, dw, bound, 2.0))
        z, w = z + t * dz, w + t * dw
    return None


def _direction(
    M: Any,
    A: Any,
    value: FloatArray,
    z: FloatArray,
    w: FloatArray,
    bound: Mask,
    aim: FloatArray,
) -> tuple[FloatArray, FloatArray] | None:
    """(dz, dw) towards w = M z + q and z w = aim, with A = M + diag(w / z)."""
    right = np.divide(aim, z, out=np.zeros_like(z), where=bound) - value
    dz = solved(A, right)
    return None if dz is None else (dz, np.where(bound, M @ dz + value - w, 0.0))


def _longest(
    z: FloatArray, w: FloatArray, dz: FloatArray, dw: FloatArray, bound: Mask, most: float = 1.0
) -> float:
    """The longest step, up to `most`, that keeps z and w non-negative."""
    values = np.concatenate([z[bound], w[bound]])
    steps = np.concatenate([dz[bound], dw[bound]])
    falling = steps < 0
    return float((values[falling] / -steps[falling]).min(initial=most))


def purified(M: Any, z: FloatArray, basic: Mask, free: Mask) -> Mask | None:
    """The basis without the z that the kernel of its matrix can move to zero.

    For a positive semidefinite M no w changes on the way.
    """
    places = np.flatnonzero(basic)
    if not len(places):
        return basic
    if len(places) > _LARGEST_KERNEL:
        return basic
    block = M[places][:, places]
    _, sizes, turned = np.linalg.svd(block.toarray() if issparse(block) else block)
    kernel = turned[sizes <= _RANK * sizes[0]].T
    values, bound = z[places], ~free[places]
    kept = np.ones(len(places), dtype=bool)
    while kernel.shape[1]:
        falling, kernel = kernel[:, 0], kernel[:, 1:]
        movable = bound & kept & (np.abs(falling) > _RANK * np.abs(falling).max())
        if not movable.any():
            return None
        if not (falling[movable] > 0).any():
            falling = -falling
        times = np.full(len(places), np.inf)
        down = movable & (falling > 0)
        times[down] = values[down] / falling[down]
        first = int(np.argmin(times))
        values = values - times[first] * falling
        kept[first] = False
        kernel = kernel - np.outer(falling, kernel[first] / falling[first])
    found = np.zeros_like(basic)
    found[places[kept]] = True
    return found
