"""Dips and sagging shoulders of a pressure profile: where they are, how deep, how wide, exactly.

Two readings, because the paper's "small depressions at the shoulders" of an unpushed pile need not
be minima: a `Depression` is a local minimum of the normal force, and a `Sag` is a stretch on which
the profile hangs below the chord between its ends, that is, below the concave hull of all of it.

A profile is one row of `BaseForce` in order of x. Values are compared as they are: exactly for
exact solutions, and to the last bit for floats, where rounding may show as a depression.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..numbers.exact import Surd
from ..solution.solution import Solution
from .base_pressure import BaseForce, base_pressure, base_profile
from .disc_contacts import Number
from .field import Cell, Column, Field, Profile, Table


@dataclass(frozen=True, slots=True)
class Depression:
    """A local minimum of the normal force between two rims.

    The bottom spans the lattice points `left`..`right`, which have the same force `bottom`; the
    force is higher on both sides of it. Each rim is the highest force met on the way outwards
    before the force is back at `bottom` or the profile ends, at the point nearest to the bottom. So
    twin minima of a symmetric profile stay apart, with the ridge between them as common rim.
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


@dataclass(frozen=True, slots=True)
class Sag:
    """A stretch `left`..`right` on which every point lies below the chord between its ends.

    `lowest` is the x of the point furthest below the chord (the first of equal ones), `depth` how
    far below it lies (w), > 0.
    """

    left: Surd
    right: Surd
    lowest: Surd
    depth: Number


def depressions(profile: Sequence[BaseForce]) -> tuple[Depression, ...]:
    """All local minima of the normal force along a profile.

    A fall towards an end of the profile is none.

    Parameters
    ----------
    profile : sequence of BaseForce
        The pressure on the base (`base_pressure`).

    Returns
    -------
    tuple of Depression
        Their places (disc radii), rims and `depth` (w), from left to right.

    Examples
    --------
    >>> from lcp_piles import nt30, solve
    >>> from lcp_piles.fields.base_pressure import base_pressure
    >>> pile = base_pressure(solve(nt30(6, push=28)))
    >>> [(str(d.left), round(float(d.depth), 3), str(d.width)) for d in depressions(pile)]
    [('-7', 0.139, '8'), ('7', 0.139, '8')]
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
    """The depression under the apex.

    That is a local minimum whose bottom spans x = 0: with a disc on the axis that disc (and equal
    neighbours), without one the two discs next to the axis.

    Parameters
    ----------
    profile : sequence of BaseForce
        The pressure on the base (`base_pressure`).

    Returns
    -------
    Depression or None
        The dip, None where the profile has none there.

    Examples
    --------
    >>> from lcp_piles import nt30, solve
    >>> from lcp_piles.fields.base_pressure import base_pressure
    >>> found = dip(base_pressure(solve(nt30(6))))
    >>> str(found.depth), str(found.left_rim[0]), str(found.right_rim[0])
    ('4663201153/39091958912', '-3', '3')
    """
    return next((found for found in depressions(profile) if found.under_apex), None)


def sags(profile: Sequence[BaseForce]) -> tuple[Sag, ...]:
    """Where a profile hangs below its concave hull.

    Parameters
    ----------
    profile : sequence of BaseForce
        The pressure on the base (`base_pressure`).

    Returns
    -------
    tuple of Sag
        The ends of each, its lowest point (disc radii) and `depth` (w), from left to right; none
        for a concave profile.

    Examples
    --------
    >>> from lcp_piles import nt30, solve
    >>> from lcp_piles.fields.base_pressure import base_pressure
    >>> shoulder = sags(base_pressure(solve(nt30(6))))[-1]
    >>> str(shoulder.left), str(shoulder.right), str(shoulder.lowest), float(shoulder.depth) < 0.3
    ('3', '13', '9', True)
    """
    hull: list[int] = []
    for k in range(len(profile)):
        while len(hull) > 1 and _below_chord(profile, hull[-2], hull[-1], k) > 0:
            hull.pop()
        hull.append(k)
    found = []
    for start, end in pairwise(hull):
        inner = range(start + 1, end)
        if inner:
            depths = [_below_chord(profile, start, k, end) for k in inner]
            deepest = max(depths)
            lowest = profile[inner[depths.index(deepest)]].x
            found.append(Sag(profile[start].x, profile[end].x, lowest, deepest))
    return tuple(found)


def _below_chord(profile: Sequence[BaseForce], start: int, k: int, end: int) -> Number:
    """How far point k lies below the chord from start to end (negative: above it)."""
    a, p, b = profile[start], profile[k], profile[end]
    part: Number = (p.x - a.x) / (b.x - a.x)
    if not isinstance(p.normal, Surd):
        part = float(part)
    return a.normal + part * (b.normal - a.normal) - p.normal


def _rim(outwards: Sequence[BaseForce], bottom: Number) -> tuple[Surd, Number]:
    """The highest point on the way outwards, as long as the force stays above the bottom."""
    rim = outwards[0]
    for point in outwards[1:]:
        if point.normal <= bottom:
            break
        if point.normal > rim.normal:
            rim = point
    return rim.x, rim.normal


@dataclass(frozen=True)
class Hollows:
    """A profile with all its depressions and sags."""

    profile: tuple[BaseForce, ...]
    depressions: tuple[Depression, ...]
    sags: tuple[Sag, ...]


def hollows(solution: Solution) -> Hollows:
    """The depressions and sags of the pressure on the base."""
    profile = base_pressure(solution)
    return Hollows(profile, depressions(profile), sags(profile))


def _table(found: Hollows) -> Table:
    columns = (
        Column("what"),
        *(Column(name, exact=True) for name in ("left", "right", "lowest", "depth", "width")),
        Column("under_apex"),
    )
    rows: list[list[Cell]] = [
        [
            "depression",
            d.left_rim[0],
            d.right_rim[0],
            (d.left + d.right) / 2,
            d.depth,
            d.width,
            "yes" if d.under_apex else "no",
        ]
        for d in found.depressions
    ]
    rows += [["sag", s.left, s.right, s.lowest, s.depth, s.right - s.left, ""] for s in found.sags]
    return Table(columns, rows)


def _shape(found: Hollows) -> Profile:
    bottoms = [
        (float(p.x), float(p.normal))
        for p in found.profile
        if any(d.left <= p.x <= d.right for d in found.depressions)
    ]
    lowest = {s.lowest for s in found.sags}
    sagging = [(float(p.x), float(p.normal)) for p in found.profile if p.x in lowest]
    return base_profile(found.profile, {"depression": bottoms, "lowest of a sag": sagging})


FIELD = Field(
    "depressions",
    "local minima (from rim to rim) and sags of the pressure on the base (R, w)",
    hollows,
    _table,
    _shape,
)
