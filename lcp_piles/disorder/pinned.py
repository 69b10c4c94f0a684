"""The springs of a closed set, factored and proved definite, with a pin for every free motion.

A closed set may leave motions free. Loads that do work on one cannot be borne by this set; the
other motions are places of freedom, and a freedom of each is pinned where it is: with the rest in
balance the pinned ones are too, because N^T (B^T f + p) = 0 whatever f, for the motions N. That
B N = 0 on the closed set and N^T p = 0 is checked in integers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..linear.banded import Cholesky, cholesky, vanishing_pivots
from ..linear.definite import band_bound
from ..linear.kernel import SHOWN, common_denominators
from ..numbers.vectors import FloatArray, IntArray, Mask
from .family import Springs

_ALPHAS = (1e-5, 1e-6, 1e-8)
_REFINEMENTS = 2


@dataclass(frozen=True, eq=False)
class PinnedSprings:
    """D K D of a closed set with pinned freedoms: factors, and `least`, below its least eigenvalue.

    `motions` are integers, a column for each pinned freedom: a basis of all that are free.
    """

    least: float
    factors: Cholesky
    pins: IntArray
    motions: IntArray


def pinned_springs(springs: Springs, closed: Mask) -> PinnedSprings | None:
    """The springs of a closed set; None where nothing is proved, or a load drives a free motion."""
    order = springs.order
    band = (springs.entries @ (closed / springs.C)).reshape(len(order), -1).T
    largest = float(band[0].max(initial=0.0))
    if not 0 < largest < np.inf:
        return None
    pins = np.empty(0, dtype=np.int64)
    least = band_bound(band, order, _ALPHAS) if (band[0] > 0).all() else 0.0
    if not least > 0:
        places = vanishing_pivots(band)
        if places is None:
            return None
        _pin(band, places, largest)
        pins = order[places]
        least = band_bound(band, order, _ALPHAS)
    least -= springs.rounding
    factors = cholesky(band, order)
    if factors is None or not least > 0:
        return None
    motions = _free_motions(springs, closed, factors, pins)
    return None if motions is None else PinnedSprings(least, factors, pins, motions)


def _pin(band: FloatArray, places: IntArray, diagonal: float) -> None:
    """Take rows and columns out of a band; a number on their diagonal keeps it definite."""
    width = len(band)
    band[:, places] = 0.0
    for d in range(1, min(width, band.shape[1])):
        band[d, places[places >= d] - d] = 0.0
    band[0, places] = diagonal


def _free_motions(
    springs: Springs, closed: Mask, factors: Cholesky, pins: IntArray
) -> IntArray | None:
    """The motion of every pin with the other pins at rest, in integers; None if one is not free.

    Floats say what it is, as in `linear.kernel`; exact products decide.
    """
    if not len(pins):
        return np.empty((len(springs.D), 0), dtype=np.int64)
    integers, weights = springs.integers, (closed / springs.C)[:, None]
    X = np.zeros((len(springs.D), len(pins)))
    X[pins, np.arange(len(pins))] = 1.0
    for _ in range(_REFINEMENTS):
        left = springs.transposed @ (weights * (springs.B @ X))
        left[pins] = 0.0
        X -= factors.solve(left)
    scale = springs.D / integers.freedom
    X *= scale[:, None] / scale[pins]
    common = common_denominators(X)
    if not ((common > 0) & (np.abs(X).max(axis=0, initial=0.0) * common < SHOWN)).all():
        return None
    motions = np.rint(X * common).astype(np.int64)
    held = not (integers.B @ motions)[closed].any()
    return motions if held and not (integers.loads @ motions).any() else None
