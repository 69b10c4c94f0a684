"""A proof that no forces balance the loads of a packing: a motion along which it falls.

If B u >= 0 at every contact and p . u > 0, forces f >= 0 in balance would give
0 <= f . B u = -p . u < 0 (Farkas). A linear programme in floats proposes u, a second one moves it
away from all contacts that it may leave, and what decides is rigorous: a contact's rate B_k u
counts as not negative where its terms are exactly zero or where it is above its rounding, and
p . u is computed in fractions.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from scipy.sparse import csr_array, hstack, vstack

from ...numbers.double_double import ERROR, DoubleDouble
from ...numbers.vectors import FloatArray, Mask
from ...packings.packing import Packing

_STILL = 1e-7  # a disc's motion, relative to the largest, that is taken for none
_LEAST = 2.0**-100  # parts of a motion below this are left out, and nothing underflows


def collapse(packing: Packing, B: csr_array) -> FloatArray | None:
    """A motion (discs, axes) proved to be a collapse, or None where none is found.

    >>> from lcp_piles import packing
    >>> from lcp_piles.methods.packings.prove import prove_packing
    >>> float(prove_packing(packing([(0, 1.0)], 1, weights=2)).collapse[0, 1])
    -1.0
    """
    p = packing.loads[~packing.held]
    scaled = p / (np.abs(p).max(initial=0.0) or 1.0)
    u = _furthest(B, scaled)
    if u is None:
        return None
    whole = np.zeros(packing.held.shape)
    whole[~packing.held] = u
    moving = (np.abs(whole) > _STILL * np.abs(u).max(initial=0.0)).any(axis=1)
    free = np.broadcast_to(moving[:, None], whole.shape)[~packing.held]
    for motion in (_apart(B, scaled, free), u):
        if motion is not None:
            whole[~packing.held] = np.where(free & (np.abs(motion) > _LEAST), motion, 0.0)
            if _falls(packing, whole):
                return whole
    return None


def _furthest(B: csr_array, p: FloatArray) -> FloatArray | None:
    """The motion of at most one along each freedom that lets the loads fall farthest."""
    from scipy.optimize import linprog  # slow to import, seldom needed

    found = linprog(-p, A_ub=-B, b_ub=np.zeros(B.shape[0]), bounds=(-1, 1), method="highs")
    return found.x if found.status == 0 and found.x @ p > 0 else None


def _apart(B: csr_array, p: FloatArray, free: Mask) -> FloatArray | None:
    """A motion of the free freedoms that parts all their contacts, and lowers the loads."""
    from scipy.optimize import linprog

    touched = np.asarray(abs(B) @ free) > 0
    m, n = int(touched.sum()), len(p)
    rates = hstack([-B[touched], np.ones((m, 1))], format="csr")
    falls = csr_array(np.append(-p, 1.0)[None, :])
    limits = [(-float(f), float(f)) for f in free] + [(None, 1.0)]
    found = linprog(
        np.append(np.zeros(n), -1.0),
        A_ub=vstack([rates, falls], format="csr"),
        b_ub=np.zeros(m + 1),
        bounds=limits,
        method="highs",
    )
    return found.x[:-1] if found.status == 0 and found.x[-1] > 0 else None


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
