"""Problems of any size: drawn matrices, a membrane above a floor, games and programmes."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csr_array, diags_array, eye_array, kron

from lcp_piles.numbers.vectors import IntArray

SEED = 1997


def definite(n: int) -> tuple[IntArray, IntArray]:
    """M = L L^T with a regular L (n, n) of integers from -9 to 9; q from -9 to 9."""
    rng = np.random.default_rng(SEED)
    L = rng.integers(-9, 10, (n, n))
    return L @ L.T, rng.integers(-9, 10, n)


def semidefinite(n: int, rank: int) -> tuple[IntArray, IntArray]:
    """M = L L^T with L (n, rank) of such integers, and a solution of small integers."""
    rng = np.random.default_rng(SEED)
    L = rng.integers(-9, 10, (n, rank))
    return _solvable(L @ L.T, rng)


def dominant(n: int) -> tuple[IntArray, IntArray]:
    """A matrix that is not symmetric, and a P-matrix by its dominant diagonal; q from -9 to 9."""
    rng = np.random.default_rng(SEED)
    M = rng.integers(-9, 10, (n, n))
    np.fill_diagonal(M, 0)
    np.fill_diagonal(M, np.abs(M).sum(axis=1) + 1)
    return M, rng.integers(-9, 10, n)


def tridiagonal(n: int) -> tuple[csr_array, IntArray]:
    """(-1, 4, -1), as of splines; q from -9 to 9."""
    rng = np.random.default_rng(SEED)
    M = diags_array([-1, 4, -1], offsets=[-1, 0, 1], shape=(n, n), dtype=np.int64)
    return csr_array(M), rng.integers(-9, 10, n)


def membrane(k: int, depth: int) -> tuple[csr_array, IntArray]:
    """A membrane on k x k points, clamped all around, under its weight above a floor.

    z is its height above the floor, which is `depth` below the frame, and w the floor's pressure.
    """
    M = laplacian(k)
    return M, 1 - depth * (M @ np.ones(k * k, dtype=np.int64))


def grid(k: int) -> tuple[csr_array, IntArray]:
    """The five-point matrix of k x k points, with a solution of small integers."""
    return _solvable(laplacian(k), np.random.default_rng(SEED))


def laplacian(k: int) -> csr_array:
    """The five-point matrix of k x k points inside a frame."""
    line = diags_array([-1, 2, -1], offsets=[-1, 0, 1], shape=(k, k), dtype=np.int64)
    one = eye_array(k, dtype=np.int64)
    return csr_array(kron(line, one) + kron(one, line)).astype(np.int64)


def game(n: int) -> tuple[IntArray, IntArray]:
    """Payoffs from 0 to 100 of n x n strategies."""
    rng = np.random.default_rng(SEED)
    return rng.integers(0, 101, (n, n)), rng.integers(0, 101, (n, n))


def programme(n: int) -> dict[str, Any]:
    """P, c, G, h, lower of a convex programme with n variables, n // 2 inequalities, x >= 0."""
    rng = np.random.default_rng(SEED)
    L, G = rng.integers(-3, 4, (n, n)), rng.integers(-3, 4, (n // 2, n))
    h = G @ rng.integers(0, 3, n) + rng.integers(0, 3, n // 2)
    c = rng.integers(-9, 10, n)
    return {"P": L @ L.T, "c": c, "G": G, "h": h, "lower": np.zeros(n, dtype=np.int64)}


def _solvable(M: Any, rng: np.random.Generator) -> tuple[Any, IntArray]:
    kind = rng.integers(0, 2, M.shape[0])
    z = np.where(kind == 0, rng.integers(1, 99, M.shape[0]), 0)
    return M, np.where(kind == 1, rng.integers(1, 99, M.shape[0]), 0) - M @ z
