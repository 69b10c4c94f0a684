"""The mirror x -> -x of a scene, and its symmetric and antisymmetric halves.

The forces of a definite scene are unique, hence as symmetric as the scene: one half with x odd and
y even carries them all. Mechanisms may be antisymmetric too (x even, y odd), and a motion of the
whole pile is the sum of one of each kind, so both halves together are the whole pile.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.sparse import csr_array

from ..numbers.exact import Surd
from ..numbers.vectors import IntArray, distinct
from .scene import Disc, Numbers, Scene

Part = Literal["whole", "even", "odd", "symmetric"]


@dataclass(frozen=True, eq=False)
class Mirror:
    """For each disc and each contact of a scene, the one it is the image of."""

    discs: IntArray
    contacts: IntArray


def mirror(scene: Scene) -> Mirror | None:
    """The mirror map of the scene, or None where the scene is not its own image.

    >>> from lcp_piles import nt60
    >>> mirror(nt60(2)).discs.tolist()
    [0, 2, 1]
    """
    code = codes()
    places = {tuple(code(x) for x in disc.position): k for k, disc in enumerate(scene.discs)}
    image: list[int] = []
    compared: set[tuple[int, int, int, int]] = set()
    for disc in scene.discs:
        x, *rest = disc.position
        k = places.get((code(x, True), *(code(y) for y in rest)))
        if k is None:
            return None
        image.append(k)
        other = scene.discs[k]
        pair = (id(disc.load), id(other.load), id(disc.held), id(other.held))
        if pair not in compared:  # most discs share their load and their freedom
            compared.add(pair)
            if other.load != _reflect(disc.load) or not _held_alike(disc, other):
                return None
    discs = np.array(image, dtype=np.int64)
    contacts = contact_images(scene, discs, _reflect)
    if contacts is None or not np.array_equal(contacts[contacts], np.arange(len(contacts))):
        return None
    return Mirror(discs, contacts)


def codes() -> Callable[..., int]:
    """A function from a number, or its negative, to an integer: equal for equal numbers.

    Exact numbers are slow to hash, and discs share the objects of their coordinates. Objects are
    known by their identity: they have to outlive the function.
    """
    by_value: dict[Surd, int] = {}
    by_object: dict[int, tuple[int, int]] = {}

    def code(x: Surd, negative: bool = False) -> int:
        found = by_object.get(id(x))
        if found is None:
            found = (
                by_value.setdefault(x, len(by_value)),
                by_value.setdefault(-x, len(by_value)),
            )
            by_object[id(x)] = found
        return found[negative]

    return code


def _reflect(vector: tuple[Surd, ...]) -> tuple[Surd, ...]:
    return (-vector[0], *vector[1:])


def _held_alike(one: Disc, other: Disc) -> bool:
    """Whether prescribed displacements are mirror images."""
    if one.held[1:] != other.held[1:]:
        return False
    x, x_image = one.held[0], other.held[0]
    return x_image is None if x is None else x_image is not None and x == -x_image


def contact_images(
    scene: Scene, discs: IntArray, turned: Callable[[Numbers], Numbers]
) -> IntArray | None:
    """For each contact the one it goes to, with its discs, under an orthogonal map of vectors.

    None where one goes to none, or two to the same one, as at two discs in one place.
    """
    normals, direction = scene.normals
    number = {normal: k for k, normal in enumerate(normals)}
    same = np.array([number.get(turned(n), -1) for n in normals], dtype=np.int64)
    swapped = np.array(
        [number.get(tuple(-x for x in turned(n)), -1) for n in normals], dtype=np.int64
    )
    traits = [
        distinct([c.compliance for c in scene.contacts])[1],
        distinct([c.gap for c in scene.contacts])[1],
        np.array([c.bilateral for c in scene.contacts], dtype=np.int64),
    ]
    supports = _support_images(scene, discs, same[direction], traits)
    if supports is None:
        return None
    a, b = scene.ends
    # Supports are numbered after the discs: so all ends have images.
    b = np.where(b < 0, len(discs) + scene.support_of, b)
    image = np.concatenate([discs, len(discs) + supports])

    def key(one: IntArray, two: IntArray, normal: IntArray) -> IntArray:
        code = (one * len(image) + two) * len(normals) + normal
        return np.where(normal < 0, -1, code)

    keys = key(a, b, direction)
    order = np.argsort(keys, kind="stable")
    if not len(order):
        return order
    found = np.full(len(keys), -1, dtype=np.int64)
    for wanted in (
        key(image[b], image[a], swapped[direction]),
        key(image[a], image[b], same[direction]),
    ):
        at = order[np.searchsorted(keys[order], wanted, side="right") - 1]
        found = np.where(keys[at] == wanted, at, found)
    if (found < 0).any() or any(not np.array_equal(t, t[found]) for t in traits):
        return None
    return found if len(np.unique(found)) == len(found) else None


def _support_images(
    scene: Scene, discs: IntArray, reflected: IntArray, traits: list[IntArray]
) -> IntArray | None:
    """The image of every support, None where one has no image.

    A support is its own image where the mirror leaves the whole set of its contacts alone, and
    otherwise has another one for its image, all of whose contacts are images of its own.
    """
    a, _ = scene.ends
    _, direction = scene.normals
    touching: list[list[tuple[int, ...]]] = [[] for _ in scene.supports]
    images: list[list[tuple[int, ...]]] = [[] for _ in scene.supports]
    for k in np.flatnonzero(scene.support_of >= 0).tolist():
        support, given = scene.support_of[k], tuple(int(t[k]) for t in traits)
        touching[support].append((int(a[k]), int(direction[k]), *given))
        images[support].append((int(discs[a[k]]), int(reflected[k]), *given))
    alike: dict[tuple[tuple[int, ...], ...], list[int]] = {}
    for support in range(len(scene.supports)):
        alike.setdefault(tuple(sorted(touching[support])), []).append(support)
    found = np.arange(len(scene.supports), dtype=np.int64)
    for contacts, group in alike.items():
        image = tuple(sorted(images[group[0]]))
        if image != contacts:
            others = alike.get(image, [])
            if len(others) != len(group):
                return None
            found[group] = others
    return found


@dataclass(frozen=True, eq=False)
class Reduction:
    """How the freedoms and contacts of one part of a scene stand for those of the whole.

    Freedom f = axis + dimension * disc of the whole moves by sign[f] times freedom[f] of the
    part (sign 0: it does not move). Contact k of the whole is `contact[k]` of the part (-1 where
    this part cannot load it), and contact r of the part is `representative[r]` of the whole and
    stands for `weight[r]` contacts. The part "symmetric" (`mechanics.orbits`) keeps more symmetries
    than a mirror, and one of its freedoms moves discs along several axes: what moves how far is
    said by `spread` for every part, a matrix (freedoms of the whole, of the part) of integers in
    the rational gauge, and `freedom` and `sign` are empty. `axis` has for every freedom of the part
    one along which it moves discs.
    """

    part: Part
    size: int
    freedom: IntArray
    sign: IntArray
    contact: IntArray
    representative: IntArray
    weight: IntArray
    spread: csr_array
    axis: IntArray


def reduction(scene: Scene, part: Part, symmetry: Mirror | None) -> Reduction:
    """The reduction of a scene to one part; "whole" needs no mirror."""
    dimension = scene.dimension
    held = np.array([h is not None for disc in scene.discs for h in disc.held])
    freedoms = np.arange(len(held))
    if part == "whole" or symmetry is None:
        image_sign = np.ones(len(held), dtype=np.int64)
        image, contact_image = freedoms, np.arange(len(scene.contacts))
    else:
        axis = freedoms % dimension
        image = symmetry.discs[freedoms // dimension] * dimension + axis
        image_sign = np.where((axis == 0) == (part == "even"), -1, 1)
        contact_image = symmetry.contacts
    alive = ~held & ~((image == freedoms) & (image_sign < 0))
    first = np.minimum(freedoms, image)
    leaders = np.flatnonzero(alive & (first == freedoms))
    freedom = np.zeros(len(held), dtype=np.int64)
    freedom[leaders] = np.arange(len(leaders))
    freedom = freedom[first]
    sign = np.where(alive, np.where(first == freedoms, 1, image_sign), 0)

    numbers = np.arange(len(scene.contacts))
    first_contact = np.minimum(numbers, contact_image)
    loadable = np.ones(len(numbers), dtype=bool)
    if part == "odd":  # a contact across the axis keeps its length in an antisymmetric motion
        loadable = contact_image != numbers
    representative = np.flatnonzero(loadable & (first_contact == numbers))
    contact = np.full(len(numbers), -1, dtype=np.int64)
    contact[representative] = np.arange(len(representative))
    contact = contact[first_contact]
    weight = np.where(contact_image[representative] == representative, 1, 2)
    keep = np.flatnonzero(sign)
    spread = csr_array((sign[keep], (keep, freedom[keep])), shape=(len(sign), len(leaders)))
    return Reduction(
        part,
        len(leaders),
        freedom,
        sign,
        contact,
        representative,
        weight,
        spread,
        leaders % dimension,
    )
