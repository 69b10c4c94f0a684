"""Which contact of a scene every given force is of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ..errors import InputError
from ..numbers.vectors import FloatArray, Mask
from ..scenes.names import end_name
from .given import GivenForce, Place
from .reference import Reference

NEAR_CENTRE, NEAR_POINT = 0.5, 0.3
"""Parts of the least radius within which a place is that of a disc, or of a contact: less than half
of what parts two of them, and more than stiff discs move."""

_UNITS = "places count from the origin of the scene, and the radius is one in their unit"


@dataclass(frozen=True, eq=False, repr=False)
class Matched:
    """Given forces in the scene's order: zero, and not `present`, where none was given.

    `forces` (contacts,) are along the normals; `vectors` (contacts, axes) are on disc a, None
    unless all entries had vectors and ends; `tangential` is the largest part of a vector across its
    normal. `others` are the ends (as numbers) and forces of what is no contact of the scene.
    """

    forces: FloatArray
    present: Mask
    vectors: FloatArray | None
    tangential: float | None
    others: tuple[tuple[tuple[int, int], float], ...]


def matched(
    reference: Reference, entries: Sequence[GivenForce], radius: float, weight: float
) -> Matched:
    """The entries by contacts, lengths in units of `radius` and forces of `weight` from now on.

    Raises `InputError` for an entry whose ends or place are none of the scene's, and where one
    contact is given two forces.
    """
    count, axes = reference.normals.shape
    forces, vectors = np.zeros(count), np.zeros((count, axes))
    entry_of: dict[int, GivenForce] = {}
    others = []
    across = []
    oriented = True
    for entry, (ends, k, way) in zip(entries, _contacts(reference, entries, radius), strict=True):
        vector = np.zeros(3)
        vector[: len(entry.vector or ())] = entry.vector or ()
        vector /= weight
        if k < 0:
            force = np.linalg.norm(vector) if entry.force is None else entry.force / weight
            others.append((ends, float(force)))
            continue
        along = float(vector[:axes] @ reference.normals[k])
        force = (
            (along * way if way else abs(along)) if entry.force is None else entry.force / weight
        )
        if k in entry_of and not np.isclose(force, forces[k], rtol=1e-9, atol=0):
            raise InputError(
                entry.where,
                f"{force:g} on {reference.name(k)}",
                f"the same force as in {entry_of[k].where}",
            )
        entry_of[k] = entry
        forces[k], vectors[k] = force, vector[:axes] * way
        oriented &= way != 0 and entry.vector is not None
        if entry.vector is not None:
            vector[:axes] -= along * reference.normals[k]
            across.append(float(np.linalg.norm(vector)))
    present = np.zeros(count, dtype=bool)
    present[list(entry_of)] = True
    return Matched(
        forces,
        present,
        vectors if oriented and entry_of else None,
        max(across, default=None),
        tuple(others),
    )


def _contacts(
    reference: Reference, entries: Sequence[GivenForce], radius: float
) -> list[tuple[tuple[int, int], int, int]]:
    """For every entry its ends, its contact and 1, or -1 where its ends are turned round.

    Ends are (-1, -1) and the last number is 0 where the place of the contact says which it is; the
    contact is -1 where the scene has none between the ends.
    """
    names = _numbers(reference)
    pairs: dict[tuple[int, int], tuple[int, int]] = {}
    for k, (a, b) in enumerate(zip(reference.a.tolist(), reference.b.tolist(), strict=True)):
        pairs[a, b], pairs[b, a] = (k, 1), (k, -1)  # every pair stands once
    centres, points = reference.centres, reference.points
    units = radius, reference.size
    at_a = _at(centres, [(e.at_a, e.where) for e in entries], units, NEAR_CENTRE, "disc")
    at_b = _at(centres, [(e.at_b, e.where) for e in entries], units, NEAR_CENTRE, "disc")
    at = _at(points, [(e.point, e.where) for e in entries], units, NEAR_POINT, "contact")
    found = []
    for n, entry in enumerate(entries):
        ends = (_end(entry.a, at_a[n], names, entry), _end(entry.b, at_b[n], names, entry))
        if min(ends) >= 0:
            if ends[0] == ends[1]:
                where = f"{end_name(reference.end(ends[0]))} and itself"
                raise InputError(entry.where, where, "two different ends", _UNITS)
            found.append((ends, *pairs.get(ends, (-1, 0))))
        else:
            found.append(((-1, -1), at[n], 0))
    return found


def _numbers(reference: Reference) -> dict[str, int | None]:
    """Discs and supports by the names that people and files know them by, None for two of a name.

    Supports are also -1, -2, ... in their order, as in `export`, where no disc is called so.
    """
    found: dict[str, int | None] = {}
    for number, end in enumerate([*reference.ids, *reference.supports]):
        name = end_name(end)
        found[name] = None if name in found else number
    for s in range(len(reference.supports)):
        found.setdefault(str(-1 - s), len(reference.ids) + s)
    return found


def _end(name: Any, at: int, names: dict[str, int | None], entry: GivenForce) -> int:
    """The number of one end of an entry, -1 where it is not given."""
    if name is None:
        return at
    text = end_name(name)
    number = names.get(text, -1)
    if number is None:
        raise InputError(entry.where, text, "a name that only one disc has")
    if number < 0:
        some = ", ".join(list(names)[:4])
        raise InputError(entry.where, text, f"a disc or support of the scene ({some}, ...)")
    return number


def _at(
    known: FloatArray | None,
    places: Sequence[tuple[Place | None, str]],
    units: tuple[float, float],
    near: float,
    what: str,
) -> list[int]:
    """The disc or contact at each of the places, -1 where none is given.

    `units` are that of the places in the scene, and the least radius there.
    """
    radius, size = units
    found = [-1] * len(places)
    given = [n for n, (place, _) in enumerate(places) if place is not None]
    if not given:
        return found
    if known is None or not len(known):
        raise InputError(places[given[0]][1], "places", "names: the scene has no places")
    axes = known.shape[1]
    short = [n for n in given if len(places[n][0] or ()) < axes]
    if short:
        raise InputError(places[short[0]][1], places[short[0]][0], f"{axes} coordinates")
    wanted = np.array([(places[n][0] or ())[:axes] for n in given]) / radius
    distances, nearest = cKDTree(known / size).query(wanted / size)
    for n, distance, index in zip(given, distances.tolist(), nearest.tolist(), strict=True):
        if distance > near:
            raise InputError(
                places[n][1],
                f"{distance:.3g} radii from the nearest {what}",
                f"at most {near} radii",
                _UNITS,
            )
        found[n] = index
    return found
