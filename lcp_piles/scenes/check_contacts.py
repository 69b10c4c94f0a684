"""What the contacts of a scene have to fulfil, and the message where one does not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Surd
from ..numbers.floats import UNIT

if TYPE_CHECKING:
    from .scene import Scene

Mask = np.ndarray[Any, np.dtype[np.bool_]]

_MOST = 10**4
"""1/_MOST is the largest squared sine of the angle between a normal and the line of centres."""


def check_contacts(scene: Scene) -> None:
    """`InputError` naming the first contact that is wrong.

    Both ends are there and differ, no pair stands twice, normals are exact unit vectors, and in a
    geometric scene they lie along the line of centres. An exact unit vector may have to be rounded
    from an irrational one, so an angle of a hundredth between the two is let pass: mistakes are
    larger.
    """
    _check_pairs(scene)
    _check_unit_normals(scene)
    if scene.geometric:
        _check_lines_of_centres(scene)


def _check_pairs(scene: Scene) -> None:
    a, b = scene.ends
    for k in np.flatnonzero(a == b).tolist():
        contact = scene.contacts[k]
        raise InputError("a contact", (contact.a, contact.b), "one between two different discs")
    other = np.where(b < 0, len(scene.discs) + scene.support_of, b)
    low, high = np.minimum(a, other), np.maximum(a, other)
    pairs = low * (len(scene.discs) + len(scene.supports)) + high
    order = np.argsort(pairs, kind="stable")
    for k in order[1:][np.diff(pairs[order]) == 0].tolist():
        raise InputError(
            f"the number of entries for {scene.contacts[k].name}",
            2,
            "1: every pair of discs, and every disc with a support, stands once",
            "two walls that one disc leans on are two supports, each with its own name",
        )


def _check_unit_normals(scene: Scene) -> None:
    normals, which = scene.normals
    for number, normal in enumerate(normals):
        square = sum((n * n for n in normal), ZERO)
        if len(normal) != scene.dimension or square != ONE:
            contact = scene.contacts[int(np.flatnonzero(which == number)[0])]
            raise InputError(
                f"the normal of {contact.name}",
                tuple(map(str, normal)),
                f"an exact unit vector of {scene.dimension} components",
            )


def _check_lines_of_centres(scene: Scene) -> None:
    """The normals against x_a - x_b: exactly wherever floats do not settle it."""
    a, b = scene.ends
    for k in np.flatnonzero((b >= 0) & ~_clearly_along(scene)).tolist():
        contact = scene.contacts[k]
        ends = scene.discs[a[k]].position, scene.discs[b[k]].position
        line = tuple(x - y for x, y in zip(*ends, strict=True))
        if not _along(contact.normal, line):
            raise InputError(
                f"the normal of {contact.name}",
                tuple(map(str, contact.normal)),
                f"the direction of the centre of a from that of b, ({', '.join(map(str, line))})",
                "or say geometric=False, where positions mean nothing",
            )


def _along(normal: tuple[Surd, ...], line: tuple[Surd, ...]) -> bool:
    """Whether a line has the direction of a unit normal, but for an angle of a hundredth."""
    cosine = sum((n * x for n, x in zip(normal, line, strict=True)), ZERO)
    square = sum((x * x for x in line), ZERO)
    return cosine.sign() > 0 and (_MOST * cosine * cosine - (_MOST - 1) * square).sign() >= 0


def _clearly_along(scene: Scene) -> Mask:
    """The contacts between discs for which floats prove `_along`.

    Every entry of a line is off by a few units in the last place of the positions at most; where
    that is less than a millionth of its length, the direction is off by less than 4e-6, and an
    angle of 0.009 leaves room for that. NaN and infinity leave a contact in doubt.
    """
    a, b = scene.ends
    normals, which = scene.normals
    shared = {id(part): part for disc in scene.discs for part in disc.position}
    nearest = {key: float(part) for key, part in shared.items()}  # many discs share an object
    x = np.array([[nearest[id(part)] for part in disc.position] for disc in scene.discs])
    n = np.array([[float(part) for part in normal] for normal in normals])
    n = n.reshape(-1, scene.dimension)[which]
    with np.errstate(all="ignore"):
        line = x[a] - x[b]
        length = np.sqrt((line * line).sum(axis=1))
        error = 8 * UNIT * (np.abs(x[a]) + np.abs(x[b])).sum(axis=1)
        cosine = (line * n).sum(axis=1) / length
        clear: Mask = (error < 1e-6 * length) & (cosine > 1 - 0.009**2 / 2)
    return clear
