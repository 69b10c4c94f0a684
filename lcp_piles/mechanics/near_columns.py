"""The columns of the LCP of a contact system in floats, with rigorous bounds of their errors.

Column k is how all contacts answer to a unit of contact k (`held_set`): a gap of a closed one, of
right-hand side b = E_k B_k, or a force of an open one, b = e B_k. With a proved lower bound mu of
the least eigenvalue of K, displacements U of floats that leave a residual r = b - K U are within
|K^-1 r| <= |r| / mu of the true ones, so the strain B_i U of a contact is within |B_i| |r| / mu of
its own, in Euclidean norms. B, E and K are integers that floats hold exactly; the bounds contain
every rounding, as in `pivoting.near_basis`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..linear.banded import Cholesky, band_order, cholesky, lower_band
from ..linear.definite import least_eigenvalue
from ..linear.integer_matrix import BigMatrix, largest_entry
from ..linear.rearrangement import columns_of
from ..numbers.floats import LOST, UNIT, UP, Bounded, FloatArray
from .held_set import HeldSet

_EXACT = 2**52  # integers below are floats without rounding
_LOST_SQUARES = 2.0**-480  # more than the root of a sum of squares that underflow
_ALPHAS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-10)


@dataclass(frozen=True, eq=False, repr=False)
class NearColumns:
    """What the columns of a held set in floats are made of.

    K and B in floats with their entries' sizes, the factors of K and `least`, below its least
    eigenvalue. `cause` is what a row of B is multiplied by for the right-hand side of its contact,
    `factor` what a strain is for the answer, and `own` the answer of a contact to itself beside
    that. `lengths` are those of the rows of B, `rounding` that of a sum of products.
    """

    K: csr_array
    B: csr_array
    factors: Cholesky
    least: float
    cause: FloatArray
    factor: FloatArray
    own: FloatArray
    lengths: FloatArray
    rounding: float

    def __repr__(self) -> str:
        return f"<NearColumns of {self.B.shape[0]} contacts>"

    def of(self, contacts: Sequence[int]) -> Bounded:
        """The columns of some contacts, a row for each."""
        chosen = np.asarray(contacts)
        b = self.B[chosen].toarray().T * self.cause[chosen]
        U = self.factors.solve(b)
        U += self.factors.solve(b - self.K @ U)
        size = np.abs(U)
        with np.errstate(all="ignore"):
            rest = self.rounding * (abs(self.K) @ size + np.abs(b))
            rest += np.abs(b - self.K @ U) * (1 + 4 * UNIT)
            norm = np.sqrt((rest * rest).sum(axis=0)) * UP + _LOST_SQUARES
            found = self.factor[:, None] * (self.B @ U)
            lost = self.lengths[:, None] * (norm / self.least)
            lost += self.rounding * (abs(self.B) @ size)
            radius = np.abs(self.factor)[:, None] * lost * UP
            places, own = np.arange(len(chosen)), self.own[chosen]
            found[chosen, places] += own
            radius[chosen, places] += np.abs(own) * (4 * UNIT)
            radius += np.abs(found) * (4 * UNIT)
        return Bounded(found.T, radius.T * UP + LOST)


def near_columns(held: HeldSet) -> NearColumns | None:
    """The columns of a held set (`HeldSet.columns`, but over no denominator) in floats.

    None where floats cannot tell: with rigid contacts, negative compliances, numbers that are long
    or of very different sizes.
    """
    equations, system = held.equations, held.system
    if equations.explicit or isinstance(system.B, BigMatrix):
        return None
    E, e, closed = np.array(equations.E, dtype=np.float64), float(equations.scale), held.closed
    K = equations.solver.A
    whole = columns_of(system.B, equations.free) if equations.pinned else system.B
    longest = max(largest_entry(K), largest_entry(whole), max(equations.E), equations.scale)
    if isinstance(K, BigMatrix) or longest >= _EXACT or E.min(initial=0) < 0 or not K.shape[0]:
        return None
    least = least_eigenvalue(K, _ALPHAS)
    order = band_order(K)
    band = lower_band(K, order) if least > 0 else None
    factors = None if band is None else cholesky(band, order)
    if factors is None:
        return None
    K, B = (csr_array(A, dtype=np.float64) for A in (K, whole))
    terms = int(max(np.diff(A.indptr).max(initial=0) for A in (K, B)))
    compliance = np.array([float(c) for c in system.compliance])
    return NearColumns(
        K,
        B,
        factors,
        least,
        np.where(closed, E, e),
        np.where(closed, -E / e, 1.0),
        np.where(closed, E / e, compliance),
        np.sqrt(B.power(2).sum(axis=1)) * UP,
        (terms + 8) * UNIT * UP,
    )
