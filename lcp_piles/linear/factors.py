"""Triangular factors of a sparse matrix in floating point, by SuperLU."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from scipy.sparse import csc_array, csr_array

if TYPE_CHECKING:
    from scipy.sparse.linalg import SuperLU

_SYMMETRIC: dict[str, Any] = {
    "permc_spec": "MMD_AT_PLUS_A",
    "diag_pivot_thresh": 0.0,
    "options": {"SymmetricMode": True},
}
"""SuperLU's options for a symmetric matrix that needs no pivoting."""


def sparse_factors(A: csr_array | csc_array, *, symmetric: bool = False) -> SuperLU:
    """Factors of a square matrix; `RuntimeError` where it is singular in floating point.

    A matrix whose pattern alone makes it singular never reaches SuperLU, which reads beyond its
    arrays where a column is left without an entry to divide by.
    """
    from scipy.sparse.csgraph import structural_rank  # both are slow to import
    from scipy.sparse.linalg import splu

    if structural_rank(A) < A.shape[0]:
        raise RuntimeError("the pattern of the matrix makes it singular")
    return splu(csc_array(A), **(_SYMMETRIC if symmetric else {}))
