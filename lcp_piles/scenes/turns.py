"""Turns about the vertical axis that leave a pile of spheres alone.

Piles of spheres have more symmetries than one mirror: with its turns by a third, the mirror of a
tetrahedral pile makes the six symmetries of a triangle, and that of a square pyramid with its
quarter turns the eight of a square.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..numbers.exact import ONE, ZERO, Surd, sqrt_of, surd
from ..numbers.vectors import IntArray
from .scene import Disc, Numbers, Scene
from .symmetry import codes, contact_images, mirror

Matrix = tuple[Numbers, Numbers, Numbers]


@dataclass(frozen=True, eq=False)
class Turn:
    """An orthogonal map of space that leaves a scene alone: where every disc and contact goes."""

    matrix: Matrix
    discs: IntArray
    contacts: IntArray


def _about_z(cosine: Surd, sine: Surd) -> Matrix:
    return ((cosine, -sine, ZERO), (sine, cosine, ZERO), (ZERO, ZERO, ONE))


_MIRROR: Matrix = ((-ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE))
_THIRD = _about_z(surd("-1/2"), sqrt_of(3) * surd("1/2"))
_QUARTER = _about_z(ZERO, ONE)
_HALF = _about_z(-ONE, ZERO)


def turns(scene: Scene) -> tuple[Turn, ...]:
    """Maps that generate the symmetries of a scene of spheres, its mirror among them.

    Empty where it has no turn about the line x = y = 0.

    >>> from lcp_piles import pyramid
    >>> [turn.discs.tolist() for turn in turns(pyramid(1))]
    [[0, 3, 1, 4, 2], [0, 3, 4, 1, 2]]
    """
    if scene.dimension != 3:
        return ()
    found: list[Turn] = []
    for matrix in (_THIRD, _QUARTER, _HALF):
        if matrix is _HALF and any(turn.matrix is _QUARTER for turn in found):
            continue  # two quarters
        turn = _turn(scene, matrix)
        if turn is not None:
            found.append(turn)
    if found:
        flip = mirror(scene)
        if flip is not None:
            found.append(Turn(_MIRROR, flip.discs, flip.contacts))
    return tuple(found)


def turned(matrix: Matrix, vector: Sequence[Surd]) -> Numbers:
    """The image of a vector."""
    return tuple(
        sum((m * x for m, x in zip(row, vector, strict=True) if m and x), ZERO) for row in matrix
    )


def _turn(scene: Scene, matrix: Matrix) -> Turn | None:
    """The map of discs and contacts that a matrix makes, None where the scene changes."""
    code = codes()
    places = {tuple(code(x) for x in disc.position): k for k, disc in enumerate(scene.discs)}
    across: dict[tuple[int, int], Numbers] = {}  # many discs share x and y
    compared: set[tuple[int, int, int, int]] = set()  # and most share their load and freedom
    image = []
    for disc in scene.discs:
        x, y, z = disc.position
        if (id(x), id(y)) not in across:
            across[id(x), id(y)] = turned(matrix, (x, y, ZERO))
        x, y, _ = across[id(x), id(y)]
        k = places.get((code(x), code(y), code(z)))
        if k is None:
            return None
        other = scene.discs[k]
        pair = (id(disc.load), id(other.load), id(disc.held), id(other.held))
        if pair not in compared:
            compared.add(pair)
            if not _alike(matrix, disc, other):
                return None
        image.append(k)
    if len(set(image)) < len(image):
        return None
    discs = np.array(image, dtype=np.int64)
    contacts = contact_images(scene, discs, lambda normal: turned(matrix, normal))
    return None if contacts is None else Turn(matrix, discs, contacts)


def _alike(matrix: Matrix, disc: Disc, image: Disc) -> bool:
    """Whether load and prescribed displacements of a disc go to those of another.

    Across the axis a disc has to be held along x and y, or along neither.
    """
    if turned(matrix, disc.load) != image.load:
        return False
    one, other = ([h is None for h in each.held] for each in (disc, image))
    if one != other or one[0] != one[1]:
        return False
    moved, there = ([h or ZERO for h in each.held] for each in (disc, image))
    return turned(matrix, moved) == tuple(there)
