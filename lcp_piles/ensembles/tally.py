"""Sums over samples, and the bootstrap: every mean with its error bars, in one pass.

The bootstrap over samples draws samples with replacement; as their number grows, how often each is
drawn becomes Poisson's distribution of mean one, independently of the others (Hanley and MacGibbon
2006, "Creating non-parametric bootstrap samples using Poisson frequencies"). So sample k has its
own weights in all replicates, from its own random numbers: nothing depends on the order of samples
or on where they were made, and nothing but sums is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from ..numbers.vectors import FloatArray
from .observables import Columns

REPLICATES = 200
_BAND = (2.5, 97.5)


@dataclass(frozen=True, eq=False)
class Estimate:
    """A number, or an array of them, with a 95 per cent confidence band of the bootstrap."""

    value: FloatArray
    low: FloatArray
    high: FloatArray

    @property
    def error(self) -> FloatArray:
        """Half the width of the band."""
        half: FloatArray = (self.high - self.low) / 2
        return half

    def __str__(self) -> str:
        return f"{float(self.value):.6g}  [{float(self.low):.6g}, {float(self.high):.6g}]"


@dataclass(frozen=True, eq=False)
class Tally:
    """Sums of columns over so many samples, and the weighted sums of the replicates.

    `names` gives the columns of every name. `replicates` has a row of sums for each replicate,
    `weights` the sum of its weights.
    """

    names: dict[str, slice]
    samples: int
    sums: FloatArray
    replicates: FloatArray
    weights: FloatArray

    def estimate(self, quantity: Callable[[Columns], FloatArray | float]) -> Estimate:
        """A quantity that is a function of the means of columns, with its band."""
        value = np.asarray(quantity(self._means(self.sums / self.samples)), dtype=np.float64)
        drawn = self.drawn(quantity)
        if not drawn.size:
            return Estimate(value, value, value)
        known = np.isfinite(drawn).any(axis=0)  # what has no value in any replicate has no band
        low, high = np.nanpercentile(np.where(known, drawn, 0.0), _BAND, axis=0)
        return Estimate(value, np.where(known, low, np.nan), np.where(known, high, np.nan))

    def drawn(self, quantity: Callable[[Columns], FloatArray | float]) -> FloatArray:
        """The quantity in every replicate; that of the samples where one has drawn none."""
        rows = [
            quantity(self._means(row / weight if weight else self.sums / self.samples))
            for row, weight in zip(self.replicates, self.weights.tolist(), strict=True)
        ]
        return np.array(rows, dtype=np.float64)

    def means(self) -> Columns:
        """The means of all columns."""
        return self._means(self.sums / self.samples)

    def mean(self, name: str) -> Estimate:
        """The means of the columns of a name."""
        return self.estimate(lambda means: means[name])

    def spread(self, name: str) -> Estimate:
        """The standard deviation over samples of columns that come with their squares."""
        return self.estimate(
            lambda means: np.sqrt(np.maximum(means[f"{name} squared"] - means[name] ** 2, 0.0))
        )

    def _means(self, row: FloatArray) -> Columns:
        return {name: row[where] for name, where in self.names.items()}


def tally(chunks: Iterable[tuple[list[int], Columns]], seed: int) -> Tally | None:
    """The tally of samples in chunks, each with the numbers of its samples; None without any."""
    names: dict[str, slice] = {}
    samples, sums, replicates = 0, np.zeros(0), np.zeros((REPLICATES, 0))
    weights = np.zeros(REPLICATES)
    for ks, columns in chunks:
        table = np.concatenate(list(columns.values()), axis=1)
        if not names:
            ends = np.cumsum([0, *(part.shape[1] for part in columns.values())]).tolist()
            names = {name: slice(*ends[i : i + 2]) for i, name in enumerate(columns)}
            sums, replicates = np.zeros(table.shape[1]), np.zeros((REPLICATES, table.shape[1]))
        drawn = np.stack([_times_drawn(seed, k) for k in ks])
        samples += len(ks)
        sums = sums + table.sum(axis=0)
        replicates += drawn.T @ table
        weights += drawn.sum(axis=0)
    return Tally(names, samples, sums, replicates, weights) if samples else None


def _times_drawn(seed: int, k: int) -> FloatArray:
    """How often every replicate draws sample k."""
    source = np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(k, 1)))
    drawn: FloatArray = np.random.Generator(source).poisson(1.0, REPLICATES).astype(np.float64)
    return drawn
