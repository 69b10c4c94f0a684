"""Dips in a pressure profile: where they are, how deep and how wide, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .base_pressure import BaseForce
from .disc_contacts import Number
from .exact import Surd


@dataclass(frozen=True, slots=True)
class Depression:
    """A local minimum of the normal force between two rims.

    The bottom spans the lattice points `left`..`right`, which have the same force `bottom`; the
    force is higher on both sides of it. Each rim is the highest force met on the way outwards
    before the force falls below `bottom` or the profile ends, at the point nearest to the bottom.
    `depth` is the lower rim less `bottom` (the prominence of the minimum), `width` the distance
    from rim to rim.
    """

    left: Surd
    right: Surd
    bottom: Number
    left_rim: tuple[Surd, Number]
    right_rim: tuple[Surd, Number]

    @property
    def depth(self) -> Number:
        """How far the bottom lies below the lower rim (w), > 0."""
        return min(self.left_rim[1], self.right_rim[1]) - self.bottom

    @property
    def width(self) -> Surd:
        """Distance from rim to rim (disc radii)."""
        return self.right_rim[0] - self.left_rim[0]

    @property
    def under_apex(self) -> bool:
        """Whether the bottom spans the axis x = 0."""
        return self.left <= 0 <= self.right


def depressions(profile: Sequence[BaseForce]) -> tuple[Depression, ...]:
    """All depressions of the normal force along a profile, from left to right.

    A fall towards an end of the profile is none. The profile is one row of discs in order of x;
    values are compared exactly.

    >>> from lcp_piles import nt30, solve
    >>> from lcp_piles.base_pressure import base_pressure
    >>> pile = base_pressure(solve(nt30(6, push=100)))
    >>> [(str(d.left), str(d.right), round(float(d.depth), 3)) for d in depressions(pile)]
    []
    """
    found = []
    start = 0
    for end in range(1, len(profile) + 1):
        if end < len(profile) and profile[end].normal == profile[start].normal:
            continue
        left, right = profile[:start][::-1], profile[end:]
        bottom = profile[start].normal
        if left and right and left[0].normal > bottom and right[0].normal > bottom:
            bounds = profile[start].x, profile[end - 1].x
            found.append(Depression(*bounds, bottom, _rim(left, bottom), _rim(right, bottom)))
        start = end
    return tuple(found)


def dip(profile: Sequence[BaseForce]) -> Depression | None:
    """The depression under the apex, or None where the profile has none there.

    That is a local minimum whose bottom spans x = 0: with a disc on the axis that disc (and equal
    neighbours), without one the two discs next to the axis.
    """
    return next((found for found in depressions(profile) if found.under_apex), None)


def _rim(outwards: Sequence[BaseForce], bottom: Number) -> tuple[Surd, Number]:
    """The highest point on the way outwards, as far as the force does not fall below the bottom."""
    rim = outwards[0]
    for point in outwards[1:]:
        if point.normal < bottom:
            break
        if point.normal > rim.normal:
            rim = point
    return rim.x, rim.normal
