"""The distribution P(x) of contact forces, x = f / <f>, and what is fitted to its two ends.

<f> is the mean over the contacts of a sample that carry a force, P the density over all of them.

* Small forces, x below `SMALL`: P ~ x^alpha. The likelihood of x_1..x_n, all in (0, s), is largest
  at 1 + alpha = n / sum log(s / x).
* The tail, x above `TAIL`: P ~ exp(-beta x), largest at beta = n / sum (x - t), and P ~
  exp(-gamma x^2), the tail of a normal distribution, whose gamma solves
  <x^2> = (1 + 2 t sqrt(gamma) h) / (2 gamma), with h = exp(-gamma t^2) / (sqrt(pi) erfc(t
  sqrt(gamma))).

How good a fit is, is its largest distance from the cumulated histogram (Kolmogorov and Smirnov).
Forces of one sample depend on each other, so the usual tables say nothing: the p-value is the
share of the replicates of the bootstrap over samples whose distance, less what is common to all,
is larger.
"""

from __future__ import annotations

import numpy as np

from ..numbers.vectors import FloatArray, Mask

LOWEST, HIGHEST, PER_DECADE = -6, 2, 20
SMALL = 1e-1
TAIL = 10**0.3
"""The ends: below a tenth of the mean force, and above about twice it (an edge of a bin)."""
EDGES: FloatArray = 10.0 ** (np.arange(LOWEST * PER_DECADE, HIGHEST * PER_DECADE + 1) / PER_DECADE)
"""The edges of the bins of the histogram: what is below the first counts to the first bin."""
_SMALL_BIN = (-1 - LOWEST) * PER_DECADE
_TAIL_BIN = 6 - LOWEST * PER_DECADE


def force_columns(forces: FloatArray) -> dict[str, FloatArray]:
    """The columns that the fits and the histogram need, for forces (samples, contacts) in w."""
    loaded = forces > 0
    count = np.maximum(loaded.sum(axis=1), 1)
    mean = np.where(loaded, forces, 0.0).sum(axis=1) / count
    rows, places = np.nonzero(loaded)
    x = forces[rows, places] / mean[rows]
    bins = np.clip(np.searchsorted(EDGES, x, side="right") - 1, 0, len(EDGES) - 2)
    size = len(EDGES) - 1
    histogram = np.bincount(rows * size + bins, minlength=len(forces) * size)
    small, tail = x < SMALL, x >= TAIL

    def summed(where: Mask, values: FloatArray) -> FloatArray:
        return np.bincount(rows[where], values[where], len(forces)).astype(np.float64)

    ends = np.stack(
        [
            summed(small, np.ones_like(x)),
            summed(small, np.log(SMALL / x)),
            summed(tail, np.ones_like(x)),
            summed(tail, x - TAIL),
            summed(tail, x * x),
        ],
        axis=1,
    )
    return {
        "histogram": histogram.reshape(len(forces), size).astype(np.float64),
        "ends": ends,
    }


def density(histogram: FloatArray) -> FloatArray:
    """P(x) in every bin, from numbers of forces in them."""
    found: FloatArray = histogram / (histogram.sum() * np.diff(EDGES))
    return found


def cumulated_small(histogram: FloatArray) -> FloatArray:
    """The share of the small forces that is below every edge up to `SMALL`."""
    return _cumulated(histogram[:_SMALL_BIN])


def cumulated_tail(histogram: FloatArray) -> FloatArray:
    """The share of the tail that is below every edge from `TAIL` on."""
    return _cumulated(histogram[_TAIL_BIN:])


def small_exponent(ends: FloatArray) -> float:
    """The alpha of the largest likelihood; NaN without small forces."""
    number, logs = ends[:2]
    return float(number / logs - 1) if logs > 0 else np.nan


def tail_rate(ends: FloatArray) -> float:
    """The beta of the largest likelihood; NaN without a tail."""
    number, excess = ends[2:4]
    return float(number / excess) if excess > 0 else np.nan


def tail_square(ends: FloatArray) -> float:
    """The gamma of the largest likelihood; NaN without a tail, or where none is largest.

    <x^2> falls from infinity to t^2 as gamma grows from 0 to infinity.
    """
    from scipy.optimize import brentq
    from scipy.special import erfcx

    number, squares = ends[2], ends[4]
    if not (number > 0 and squares > 0):
        return np.nan
    wanted = squares / number

    def off(log: float) -> float:
        gamma = np.exp(log)
        h = 1 / (np.sqrt(np.pi) * erfcx(TAIL * np.sqrt(gamma)))
        return float((1 + 2 * TAIL * np.sqrt(gamma) * h) / (2 * gamma) - wanted)

    low, high = -20.0, 10.0
    return float(np.exp(brentq(off, low, high))) if off(low) > 0 > off(high) else np.nan


def small_share(alpha: float) -> FloatArray:
    """The share of small forces below every edge up to `SMALL`, by the fit."""
    found: FloatArray = (EDGES[: _SMALL_BIN + 1] / SMALL) ** (alpha + 1)
    found[0] = 0.0  # all that is smaller counts to the first bin
    return found


def exponential_share(beta: float) -> FloatArray:
    """The share of the tail below every edge, by the fit of exp(-beta x)."""
    return -np.expm1(-beta * (EDGES[_TAIL_BIN:] - TAIL))


def normal_share(gamma: float) -> FloatArray:
    """The share of the tail below every edge, by the fit of exp(-gamma x^2)."""
    from scipy.special import erfcx

    x, root = EDGES[_TAIL_BIN:], np.sqrt(gamma)
    above = erfcx(root * x) / erfcx(root * TAIL) * np.exp(-gamma * (x * x - TAIL * TAIL))
    found: FloatArray = 1 - above
    return found


def _cumulated(histogram: FloatArray) -> FloatArray:
    total = histogram.sum()
    found: FloatArray = np.append(0.0, np.cumsum(histogram)) / (total if total > 0 else np.nan)
    return found
