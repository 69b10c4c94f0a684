"""A proof that no forces balance the loads of a packing: a motion along which it falls.

If B u >= 0 at every contact and p . u > 0, forces f >= 0 in balance would give
0 <= f . B u = -p . u < 0 (Farkas). Where Newton's method ran away, or else a linear programme in
floats, says which discs move, and another programme moves these away from all their contacts. What
decides is rigorous: a contact's rate B_k u counts as not negative where its terms are exactly zero
or where it is above its rounding, and p . u is computed in fractions.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from scipy.sparse import csr_array, hstack, vstack

from ...numbers.double_double import ERROR, DoubleDouble
from ...numbers.vectors import FloatArray, Mask
from ...packings.packing import Packing

_STILL = 1e-7  # a disc's motion, relative to the largest, that is taken for none
_PATIENCE = 60.0  # seconds that a linear programme may take
_LEAST = 2.0**-100  # parts of a motion below this are left out, and nothing underflows


def collapse(packing: Packing, B: csr_array, runaway: FloatArray) -> FloatArray | None:
    """A motion (discs, axes) proved to be a collapse, or None where none is found.

    `runaway` are displacements (freedoms) of a method that found no balance; where it ran away,
    they are nearly such a motion.

    >>> from lcp_piles import packing
    >>> from lcp_piles.methods.packings.prove import prove_packing
    >>> float(prove_packing(packing([(0, 1.0)], 1, weights=2)).collapse[0, 1])
    -1.0
    """
    p = packing.loads[~packing.held]
    scaled = p / (np.abs(p).max(initial=0.0) or 1.0)
    found = _parted(packing, B, scaled, runaway)
    return _parted(packing, B, scaled, _furthest(B, scaled)) if found is None else found


def _parted(
    packing: Packing, B: csr_array, p: FloatArray, u: FloatArray | None
) -> FloatArray | None:
    """A proved collapse of the discs that a motion moves, made out of it."""
    largest = 0.0 if u is None else float(np.abs(u).max(initial=0.0))
    if u is None or not 0 < largest < np.inf:
        return None
    whole = np.zeros(packing.held.shape)
    whole[~packing.held] = u / largest
    moving = np.abs(whole).max(axis=1) > _STILL
    free = np.broadcast_to(moving[:, None], whole.shape)[~packing.held]
    for motion in (_apart(B, p, free), u / largest):
        if motion is not None:
            whole[~packing.held] = np.where(free & (np.abs(motion) > _LEAST), motion, 0.0)
            if _falls(packing, whole):
                return whole
    return None


def _furthest(B: csr_array, p: FloatArray) -> FloatArray | None:
    """The motion of at most one along each freedom that lets the loads fall farthest."""
    from scipy.optimize import linprog  # slow to import, seldom needed

    found = linprog(
        -p,
        A_ub=-B,
        b_ub=np.zeros(B.shape[0]),
        bounds=(-1, 1),
        method="highs",
        options={"time_limit": _PATIENCE},
    )
    return found.x if found.status == 0 and found.x @ p > 0 else None


def _apart(B: csr_array, p: FloatArray, free: Mask) -> FloatArray | None:
    """A motion of the free freedoms that parts all their contacts, and lowers the loads."""
    from scipy.optimize import linprog

    rates = csr_array(B[:, free])
    rates = rates[np.diff(rates.indptr) > 0]
    m, n = rates.shape
    falls = csr_array(np.append(-p[free], 1.0)[None, :])
    found = linprog(
        np.append(np.zeros(n), -1.0),
        A_ub=vstack([hstack([-rates, np.ones((m, 1))]), falls], format="csr"),
        b_ub=np.zeros(m + 1),
        bounds=[(-1, 1)] * n + [(None, 1.0)],
        method="highs",
        options={"time_limit": _PATIENCE},
    )
    if found.status != 0 or not found.x[-1] > 0:
        return None
    motion = np.zeros(len(p))
    motion[free] = found.x[:-1]
    return motion


def _falls(packing: Packing, u: FloatArray) -> bool:
    """Whether a motion of the discs is a collapse, rigorously."""
    there = np.append(u, np.zeros((1, packing.dimension)), axis=0)
    both = DoubleDouble.of(there[packing.a]) - DoubleDouble.of(there[packing.b])
    parts = packing.normals * both
    rate = parts[:, 0]
    for axis in range(1, packing.dimension):
        rate = rate + parts[:, axis]
    # Six for the products and one for each sum, as in `refine`.
    if not (rate.high >= 9 * ERROR * np.abs(parts.high).sum(axis=1)).all():
        return False
    pairs = zip(packing.loads.ravel().tolist(), u.ravel().tolist(), strict=True)
    return sum(Fraction(p) * Fraction(x) for p, x in pairs) > 0
