"""The vertices of a tiny polyhedron {y : c + D y >= 0}, exactly, and its volume.

The double description of Motzkin, Raiffa, Thompson and Thrall (1953), in the form of Fukuda and
Prodon (1996, "Double description method revisited"): the polyhedron is a slice of the cone
{(t, y) : c t + D y >= 0, t >= 0}, whose extreme rays are found inequality by inequality. A new ray
lies between two old ones on either side that are adjacent: no third one satisfies with equality all
that both do. Rays with t > 0 are vertices, those with t = 0 directions without end.

The numbers of vertices and of rays in between grow exponentially, so more than `MOST` is refused.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import factorial
from typing import NamedTuple

from ..errors import SolveError
from ..numbers.exact import ONE, ZERO, Surd

MOST = 400
"""Rays of the cone, and simplices of its slice, at which a polyhedron counts as tiny no more."""

Point = tuple[Surd, ...]


class TooManyError(SolveError):
    """The polyhedron has too many vertices to list."""

    def __init__(self, what: str) -> None:
        super().__init__(f"more than {MOST} {what}: vertices and volume are for tiny polyhedra")


@dataclass(frozen=True, eq=False)
class Vertices:
    """A polyhedron by its `points` and its `rays`.

    `touching[k]` numbers the inequalities that vertex k satisfies with equality.
    """

    points: tuple[Point, ...]
    rays: tuple[Point, ...]
    touching: tuple[frozenset[int], ...]


class _Ray(NamedTuple):
    """A ray of the cone, and the inequalities that it satisfies with equality (-1 is t >= 0)."""

    way: Point
    zero: frozenset[int]


def vertices(c: Sequence[Surd], D: Sequence[Sequence[Surd]]) -> Vertices:
    """The vertices and the extreme rays of {y : c + D y >= 0}, the first rows of which are y >= 0.

    Raises `TooManyError` above `MOST`. The square above the diagonal y_1 + y_2 >= 1:

    >>> from lcp_piles import surd
    >>> one, zero = surd(1), surd(0)
    >>> D = [[one, zero], [zero, one], [-one, zero], [zero, -one], [one, one]]
    >>> found = vertices([zero, zero, one, one, -one], D)
    >>> sorted([str(x) for x in point] for point in found.points), found.rays
    ([['0', '1'], ['1', '0'], ['1', '1']], ())
    """
    size = len(D[0]) if D else 0
    rows = [(-1, (ONE, *[ZERO] * size))]
    rows += [(k, (constant, *row)) for k, (constant, row) in enumerate(zip(c, D, strict=True))]
    names = [number for number, _ in rows[: size + 1]]
    rays = [
        _Ray(tuple(ONE if i == k else ZERO for i in range(size + 1)), frozenset(names) - {names[k]})
        for k in range(size + 1)
    ]
    for number, row in rows[size + 1 :]:
        rays = _cut(rays, number, row)
        if len(rays) > MOST:
            raise TooManyError("rays")
    ends = [ray for ray in rays if ray.way[0]]
    return Vertices(
        tuple(tuple(x / ray.way[0] for x in ray.way[1:]) for ray in ends),
        tuple(ray.way[1:] for ray in rays if not ray.way[0]),
        tuple(ray.zero for ray in ends),
    )


def _cut(rays: list[_Ray], number: int, row: Point) -> list[_Ray]:
    """The extreme rays of the cone with one more inequality."""
    values = [_dot(row, ray.way) for ray in rays]
    kept = [
        _Ray(ray.way, ray.zero | {number}) if not value else ray
        for ray, value in zip(rays, values, strict=True)
        if value >= 0
    ]
    above = [(ray, value) for ray, value in zip(rays, values, strict=True) if value > 0]
    below = [(ray, value) for ray, value in zip(rays, values, strict=True) if value < 0]
    for one, up in above:
        for other, down in below:
            common = one.zero & other.zero
            if not any(common <= r.zero for r in rays if r is not one and r is not other):
                way = [up * y - down * x for x, y in zip(one.way, other.way, strict=True)]
                scale = next(x for x in way if x)
                kept.append(_Ray(tuple(x / abs(scale) for x in way), common | {number}))
    return kept


def volume(found: Vertices) -> Surd:
    """The volume of a bounded polyhedron of full dimension, as a sum over simplices.

    Each face is cut into the simplices that its first vertex makes with the faces of it that do not
    hold that vertex (Cohen and Hickey 1979). Raises `TooManyError` above `MOST` simplices.

    >>> from lcp_piles import surd
    >>> one, zero = surd(1), surd(0)
    >>> D = [[one, zero], [zero, one], [-one, zero], [zero, -one], [one, one]]
    >>> str(volume(vertices([zero, zero, one, one, -one], D)))
    '1/2'
    """
    size = len(found.points[0])
    numbers = frozenset().union(*found.touching)
    faces = {frozenset(k for k, t in enumerate(found.touching) if n in t) for n in numbers}
    total = ZERO
    for count, simplex in enumerate(_simplices(frozenset(range(len(found.points))), faces)):
        if count >= MOST:
            raise TooManyError("simplices")
        first, *others = (found.points[k] for k in simplex)
        edges = [[x - y for x, y in zip(p, first, strict=True)] for p in others]
        total += abs(_determinant(edges))
    return total / factorial(size)


def _simplices(face: frozenset[int], faces: set[frozenset[int]]) -> Iterator[tuple[int, ...]]:
    if len(face) == 1:
        yield tuple(face)
        return
    apex = min(face)
    cuts = {face & other for other in faces} - {face}
    for cut in cuts:
        if apex not in cut and cut and not any(cut < other for other in cuts):
            for simplex in _simplices(cut, faces):
                yield (apex, *simplex)


def _determinant(matrix: list[list[Surd]]) -> Surd:
    """By elimination, up to its sign."""
    rows, product = [list(row) for row in matrix], ONE
    for k in range(len(rows)):
        pivot = next((row for row in rows if row[k]), None)
        if pivot is None:
            return ZERO
        rows.remove(pivot)
        product *= pivot[k]
        for row in rows:
            if row[k]:
                share = row[k] / pivot[k]
                row[:] = [x - share * y for x, y in zip(row, pivot, strict=True)]
    return product


def _dot(a: Sequence[Surd], b: Sequence[Surd]) -> Surd:
    return sum((x * y for x, y in zip(a, b, strict=True) if x and y), ZERO)
