"""The matrix of springs K = B^T C^-1 B in floating point, with a proved bound of how weak it is.

K is scaled by D, powers of two that make the diagonal of D K D about one, which rounds nothing. Of
the exact matrix the floats B and C are known to a relative error of 1.01 u, u = 2^-53, so the
entries of S = C^(-1/2) B D come out within 5 u of the exact ones, and with m the largest number of
springs at a freedom, those of the computed S^T S within (m + 20) u |S|^T |S|. In the norm of
largest row sums that bounds the change of every eigenvalue (`definite` proves those of the
computed matrix).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array

from ..numbers.floats import UNIT, UP
from ..numbers.vectors import FloatArray
from .banded import Cholesky, band_order, cholesky, lower_band
from .definite import least_eigenvalue

_FARTHEST = 2.0**900  # times 2^-1074 it is lost in the rounding that `UP` is for


@dataclass(frozen=True, eq=False)
class Springs:
    """The scaled matrix D K D of springs: its factors, and `least`, below its least eigenvalue.

    `least` is 0 where nothing is proved; there may be no factors then.
    """

    D: FloatArray
    least: float
    factors: Cholesky | None

    def solve(self, force: FloatArray) -> FloatArray:
        """K^-1 times a force on every freedom, in floating point."""
        if self.factors is None:
            raise ValueError("the springs have no factors")
        return self.D * self.factors.solve(self.D * force)


def springs(B: csr_array, C: FloatArray) -> Springs:
    """The springs of the rows of B with compliances C > 0, both floats of exact numbers.

    >>> B = csr_array(np.array([[1.0, 0.0], [-0.6, 0.8]]))
    >>> held = springs(B, np.array([1.0, 1e-6]))
    >>> held.solve(np.array([0.0, -8.0])).round(6).tolist(), held.least > 1e-8
    ([-6.0, -4.500012], True)
    """
    scaling = scaled_rows(B, C)
    if scaling is None:
        return Springs(np.ones(B.shape[1]), 0.0, None)
    D, S, rounding = scaling
    K = csr_array(S.T @ S)
    K.sum_duplicates()
    least = least_eigenvalue(K)
    order = band_order(K)
    band = lower_band(K, order)
    factors = None if band is None else cholesky(band, order)
    proved = least - rounding
    return Springs(D, proved if factors is not None and proved > 0 else 0.0, factors)


def scaled_rows(B: csr_array, C: FloatArray) -> tuple[FloatArray, csr_array, float] | None:
    """(D, S, rounding) with S = C^(-1/2) B D; None where a freedom has no spring in floats' range.

    No eigenvalue of S^T S in floats, or of that of some of the rows, is off by more than
    `rounding`.
    """
    roots = csr_array(diags_array(np.sqrt(1 / C)) @ B)
    diagonal = np.asarray(roots.power(2).sum(axis=0), dtype=np.float64)
    if not (np.isfinite(diagonal).all() and (diagonal > 0).all()):
        return None
    D = np.ldexp(1.0, -np.rint(np.log2(diagonal) / 2).astype(np.int64))
    # An entry of B below the range of floats is off by up to 2^-1074, of S by nothing then.
    if not float(np.sqrt(1 / C).max(initial=0.0)) * float(D.max(initial=0.0)) < _FARTHEST:
        return None
    S = csr_array(roots @ diags_array(D))
    size = abs(S)
    most = int(np.bincount(S.indices).max(initial=0))
    row_sums = size.T @ (size @ np.ones(B.shape[1]))
    return D, S, (most + 20) * UNIT * float(row_sums.max(initial=0.0)) * UP
