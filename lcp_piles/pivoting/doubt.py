"""The ratio test in floats with error bounds: which variables could be the first to reach zero."""

from __future__ import annotations

import numpy as np

from ..numbers.floats import LOST, Bounded
from ..numbers.vectors import IntArray, Mask

_WIDER = 1 + 2.0**-40  # more than a few roundings


def in_doubt(value: Bounded, change: Bounded, basic: Mask) -> IntArray:
    """The basic variables that may fall and may be the first to reach zero, by their places.

    All values are >= 0. One that surely falls reaches zero no later than its greatest value over
    its slowest fall says; whoever needs longer than the least of these times, with its least value
    at its fastest, cannot be the first. Bounds that are NaN exclude nobody.

    >>> value = Bounded(np.array([1.0, 1.0, 1.0]), np.array([0.0, 1e-9, 0.0]))
    >>> change = Bounded(np.array([-2.0, -2.0, -1.0]), np.zeros(3))
    >>> in_doubt(value, change, np.array([True, True, True])).tolist()
    [0, 1]
    """
    with np.errstate(all="ignore"):
        slowest = change.middle + change.radius
        latest = (value.middle + value.radius) / -slowest
        least = np.fmin.reduce(latest[basic & (slowest < 0)], initial=np.inf)
        earliest = np.maximum(value.middle - value.radius, 0) / (
            np.abs(change.middle) + change.radius
        )
        rises = change.middle - change.radius >= 0
        later = earliest > least * _WIDER + LOST
    return np.flatnonzero(basic & ~(rises | later))
