"""The statistics of an ensemble: what is found over all samples, with confidence bands.

Lines are read in the order of their samples, some at a time, so memory does not grow with their
number, and the same samples give the same statistics to the last bit, however they were made.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np

from ..errors import FileFormatError
from ..numbers.vectors import FloatArray
from ..scenes.scene import Scene
from . import force_distribution as ends
from .observables import Columns, Observables, Observed, central_dip, columns, observables
from .tally import Estimate, Tally, tally

_TOGETHER = 64


@dataclass(frozen=True, eq=False)
class Fit:
    """A parameter fitted to an end of P(x), its distance from the histogram, and its p-value."""

    parameter: Estimate
    distance: float
    p_value: float


@dataclass(frozen=True, eq=False, repr=False)
class Statistics:
    """Statistics of samples that did not fail; every estimate with its 95 per cent band.

    `observables` says of which discs and contacts, `tally` holds the means. `largest_error` (w) is
    the largest of all proved bounds of forces.
    """

    observables: Observables
    tally: Tally
    largest_error: float

    def __repr__(self) -> str:
        return f"<Statistics of {self.samples} samples of {self.observables.scene}>"

    @property
    def samples(self) -> int:
        """The number of samples."""
        return self.tally.samples

    @cached_property
    def numbers(self) -> dict[str, Estimate]:
        """The numbers that an ensemble is told by, under their names."""
        contacts = len(self.observables.scene.contacts)
        freedoms = self.observables.freedoms

        def one(name: str) -> Estimate:
            return self.tally.estimate(lambda means: means[name][0])

        estimate = self.tally.estimate
        found = {
            "contacts with force": one("closed"),
            "fraction of contacts": estimate(lambda m: m["closed"][0] / contacts),
            "contacts less freedoms": estimate(lambda m: m["closed"][0] - freedoms),
            "mechanisms": one("mechanisms"),
            "self-stresses": estimate(lambda m: m["closed"][0] - freedoms + m["mechanisms"][0]),
            "share of saddles": one("saddle"),
            "share of stable piles": one("stable"),
        }
        base = self.observables.base
        if np.isfinite(central_dip(base, np.zeros((1, len(base))))).all():
            found |= {
                "share with a dip": one("dip"),
                "depth of the dip (w)": one("dip depth"),
                "dip of the mean (w)": estimate(lambda m: central_dip(base, m["normal"][None])[0]),
            }
        return found

    @cached_property
    def base_pressure(self) -> Estimate:
        """The mean normal force (w) of every disc of the base row."""
        return self.tally.mean("normal")

    @cached_property
    def base_spread(self) -> Estimate:
        """The standard deviation (w) of the normal force of every disc of the base row."""
        return self.tally.spread("normal")

    @cached_property
    def closing(self) -> Estimate:
        """The probability that each contact carries a force."""
        return self.tally.mean("loaded")

    @cached_property
    def forces(self) -> Estimate:
        """The mean force (w) of every contact."""
        return self.tally.mean("force")

    @cached_property
    def force_spread(self) -> Estimate:
        """The standard deviation (w) of the force of every contact."""
        return self.tally.spread("force")

    @cached_property
    def stress(self) -> Estimate:
        """The mean of pi sigma (w/R), xx, xy and yy of one disc after the other."""
        return self.tally.mean("stress")

    @cached_property
    def stress_spread(self) -> Estimate:
        """The standard deviation of pi sigma (w/R), as `stress`."""
        return self.tally.spread("stress")

    @cached_property
    def density(self) -> Estimate:
        """P(x), x = f / <f>, in the bins between `force_distribution.EDGES`."""
        return self.tally.estimate(lambda means: ends.density(means["histogram"]))

    @cached_property
    def correlation(self) -> Estimate:
        """Correlation of the forces of two contacts, by the step of their distance.

        The mean covariance of the pairs of a step over the mean variance of all contacts; `pairs`
        of the observables has the distances.
        """
        pairs = self.observables.pairs

        def found(means: Columns) -> FloatArray:
            f = means["force"]
            apart = pairs.products(f[None])[0]
            variance = float(np.mean(means["force squared"] - f * f))
            if not variance > 0:
                return np.full(len(apart), np.nan)
            with np.errstate(invalid="ignore"):
                correlation: FloatArray = (means["pairs"] - apart) / pairs.counts / variance
            return correlation

        return self.tally.estimate(found)

    @cached_property
    def small_forces(self) -> Fit:
        """The exponent alpha of P ~ x^alpha below `SMALL`."""
        return self._fit(ends.small_exponent, ends.small_share, ends.cumulated_small)

    @cached_property
    def exponential_tail(self) -> Fit:
        """The beta of P ~ exp(-beta x) above `TAIL`."""
        return self._fit(ends.tail_rate, ends.exponential_share, ends.cumulated_tail)

    @cached_property
    def normal_tail(self) -> Fit:
        """The gamma of P ~ exp(-gamma x^2) above `TAIL`."""
        return self._fit(ends.tail_square, ends.normal_share, ends.cumulated_tail)

    def _fit(self, parameter: Any, share: Any, cumulated: Any) -> Fit:
        def off(means: Columns) -> FloatArray:
            apart: FloatArray = cumulated(means["histogram"]) - share(parameter(means["ends"]))
            return apart

        found = self.tally.estimate(lambda means: parameter(means["ends"]))
        here = off(self.tally.means())
        distance = float(np.abs(here).max())
        with np.errstate(invalid="ignore"):
            apart = np.abs(self.tally.drawn(off) - here).max(axis=1)
        apart = apart[np.isfinite(apart)]
        known = np.isfinite(distance) and len(apart)
        return Fit(found, distance, float(np.mean(apart >= distance)) if known else np.nan)


def statistics_of(scene: Scene, seed: int, lines: Iterable[str]) -> Statistics | None:
    """The statistics of the lines of samples that did not fail, in order; None without any.

    Raises `FileFormatError` for a line that is not one of this scene.
    """
    of = observables(scene)
    largest = 0.0

    def chunks() -> Iterator[tuple[list[int], Columns]]:
        nonlocal largest
        rest = iter(lines)
        while some_lines := list(islice(rest, _TOGETHER)):
            try:
                some = [json.loads(line) for line in some_lines]
                seen = Observed(
                    np.array([content["forces"] for content in some], dtype=np.float64),
                    np.array([content["mechanisms"] for content in some], dtype=np.int64),
                    [content["verdict"] for content in some],
                    [content["road"] for content in some],
                )
                if seen.forces.shape != (len(some), len(scene.contacts)):
                    raise ValueError("another number of contacts")
                largest = max(largest, *(float(content["error"]) for content in some))
                ks = [int(content["k"]) for content in some]
            except (KeyError, TypeError, ValueError) as error:
                what = f"one of {len(some_lines)} samples from {some_lines[0][:20]} on"
                expected = "forces of this scene, mechanisms, verdict, road and error"
                raise FileFormatError(what, str(error), expected) from error
            yield ks, columns(of, seen)

    found = tally(chunks(), seed)
    return None if found is None else Statistics(of, found, largest)
