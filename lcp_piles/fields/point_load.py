"""A load on one disc, from none to as much as one likes: what arrives at the base, and where.

The response is what the base bears beyond what it bears without the load. Between two breakpoints
of the continuation in the load F it is linear in F, so that the loads at which another place of the
base becomes the one that bears most of it are exact numbers too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, Surd, surd
from ..push.continuation import continuation
from ..push.path import Path, Segment
from ..scenes.names import DiscId
from ..scenes.scene import Scene
from ..scenes.variants import loaded
from .base_load import BasePlace, base_places

Line = tuple[Surd, Surd]
"""(a, b) for the number a + b F."""


@dataclass(frozen=True, slots=True)
class Split:
    """A load at which the largest response moves from some positions on the base to others.

    `before` and `after` are exact x in disc radii, from left to right.
    """

    load: Surd
    before: tuple[Surd, ...]
    after: tuple[Surd, ...]


@dataclass(frozen=True, eq=False, repr=False)
class PointLoad:
    """The solutions of a scene under a load F (w, downwards) on one disc, for all F on the path.

    `base` has the places on the base from left to right.
    """

    scene: Scene
    disc: DiscId
    path: Path
    base: tuple[BasePlace, ...]

    def __repr__(self) -> str:
        return f"<PointLoad on {self.disc}: {self.path.summary}>"

    @cached_property
    def positions(self) -> tuple[Surd, ...]:
        """The x of all places on the base, in disc radii."""
        return tuple(self.scene.disc(place.disc).position[0] for place in self.base)

    def response(self, load: Exact) -> tuple[Surd, ...]:
        """What every place bears beyond its load at F = 0, as a share of F > 0."""
        force = surd(load)
        if force <= ZERO:
            raise InputError("the load", str(force), "a positive number of w")
        lines = self._lines(self.path.segment(force))
        return tuple((a + b * force) / force for a, b in lines)

    def peaks(self, load: Exact) -> tuple[Surd, ...]:
        """Where on the base the response to a load F > 0 is largest, from left to right."""
        shares = self.response(load)
        most = max(shares)
        return tuple(x for x, share in zip(self.positions, shares, strict=True) if share == most)

    @cached_property
    def splits(self) -> tuple[Split, ...]:
        """Every load at which the largest response moves, in the order of the path."""
        pieces = [found for piece in self.path.segments for found in self._leading(piece)]
        return tuple(
            Split(load, before, after)
            for (_, before), (load, after) in pairwise(pieces)
            if before != after
        )

    def _leading(self, piece: Segment) -> list[tuple[Surd, tuple[Surd, ...]]]:
        """From which loads on which places bear most, within a piece: (load, positions)."""
        lines = self._lines(piece)
        here, found = piece.first, []
        while True:
            values = [a + b * here for a, b in lines]
            best = max(zip(values, (b for _, b in lines), strict=True))
            at_lead = [(v, b) == best for v, (_, b) in zip(values, lines, strict=True)]
            leaders = tuple(x for x, leads in zip(self.positions, at_lead, strict=True) if leads)
            found.append((here, leaders))
            later = [
                here + (best[0] - v) / (b - best[1])
                for v, (_, b) in zip(values, lines, strict=True)
                if b > best[1]
            ]
            here = min(later, default=here)
            if not later or (piece.last is not None and here >= piece.last):
                return found

    def _lines(self, piece: Segment) -> list[Line]:
        """What every place bears on a piece beyond what it bears at F = 0."""
        found = []
        for place, rest in zip(self.base, self._unloaded, strict=True):
            lines = [(n, piece.linear_force(k)) for k, n in place.contacts]
            a = sum((n * start for n, (start, _) in lines), ZERO)
            found.append((a - rest, sum((n * slope for n, (_, slope) in lines), ZERO)))
        return found

    @cached_property
    def _unloaded(self) -> list[Surd]:
        forces = self.path.segments[0].forces(0)
        return [sum((n * forces[k] for k, n in p.contacts), ZERO) for p in self.base]


def point_load(
    scene: Scene,
    disc: DiscId,
    *,
    until: Exact | None = None,
    progress: Callable[[str], None] | None = None,
) -> PointLoad:
    """Load one disc of a plane scene from 0 on, through every rearrangement.

    Without gravity the network is the same for every load: then solve the scene with one
    (`loaded`).

    Parameters
    ----------
    scene : Scene
        A scene of discs.
    disc : int, str or tuple
        The id of the disc that is loaded, downwards.
    until : exact number, optional
        The last load wanted (w); without it the path goes on to the last change.
    progress : callable, optional
        Called with a line of text now and then.

    Returns
    -------
    PointLoad
        The response of the base to every load on the path.

    Raises
    ------
    InputError
        For a scene that is not plane, an unknown disc, and a negative `until`.
    SolveError
        Where the scene has no solution without the load.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> load = point_load(nt60(3, floor_compliance=0), (1, 1), until=10)
    >>> [str(x) for x in load.peaks(10)], str(load.response(10)[0])
    (['-2', '2'], '1/2')
    """
    if scene.dimension != 2:
        raise InputError("the dimension", scene.dimension, "2, for a scene of discs")
    towards = loaded(scene, disc, (ZERO, -ONE))
    path = continuation(scene, towards, until=until, progress=progress)
    return PointLoad(scene, disc, path, base_places(scene))
