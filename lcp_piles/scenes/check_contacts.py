"""What the contacts of a scene have to fulfil, and the message where one does not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Surd
from ..numbers.vectors import IntArray, distinct

if TYPE_CHECKING:
    from .scene import Scene

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
    """The normals against x_a - x_b, each pair of a normal and a line of centres once."""
    normals, which = scene.normals
    between = np.flatnonzero(scene.ends[1] >= 0)
    a, b = (ends[between] for ends in scene.ends)
    codes, lines = [which[between]], []
    for axis in range(scene.dimension):
        numbers, at = distinct([disc.position[axis] for disc in scene.discs])
        ends, pair_of = np.unique(at[a] * len(numbers) + at[b], return_inverse=True)
        pairs = (divmod(int(code), len(numbers)) for code in ends)
        differences, which_one = distinct([numbers[i] - numbers[j] for i, j in pairs])
        lines.append(differences)
        codes.append(which_one[pair_of])
    for k in _firsts(codes):
        line = tuple(lines[axis][codes[axis + 1][k]] for axis in range(scene.dimension))
        if not _along(normals[int(codes[0][k])], line):
            contact = scene.contacts[int(between[k])]
            raise InputError(
                f"the normal of {contact.name}",
                tuple(map(str, contact.normal)),
                f"the direction of the centre of a from that of b, ({', '.join(map(str, line))})",
                "or say geometric=False, where positions mean nothing",
            )


def _firsts(codes: list[IntArray]) -> list[int]:
    """The first place of every combination of codes, in their order."""
    merged = codes[0]
    for code in codes[1:]:
        merged = np.unique(merged * (code.max(initial=0) + 1) + code, return_inverse=True)[1]
    return sorted(np.unique(merged, return_index=True)[1].tolist())


def _along(normal: tuple[Surd, ...], line: tuple[Surd, ...]) -> bool:
    """Whether the angle between a unit normal and a line is at most a hundredth, about."""
    cosine = sum((n * x for n, x in zip(normal, line, strict=True)), ZERO)
    square = sum((x * x for x in line), ZERO)
    return cosine.sign() > 0 and (_MOST * cosine * cosine - (_MOST - 1) * square).sign() >= 0
