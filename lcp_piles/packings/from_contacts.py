"""`from_contacts`: a packing of bare contacts, without positions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..numbers.double_double import DoubleDouble
from ..scenes.names import DiscId, contact_name, disc_id
from .check import (
    checked_ids,
    checked_rows,
    disc_names,
    float_array,
    held_motions,
    one_or_each,
)
from .geometry import unit_normals
from .packing import Packing

_SHAPE = "an array of numbers, one row of 2 or 3 components a contact"


def from_contacts(
    i: Iterable[Any],
    j: Iterable[Any],
    normal: ArrayLike,
    gap: ArrayLike = 0.0,
    *,
    weights: ArrayLike = 1.0,
    loads: ArrayLike | None = None,
    supports: Iterable[str] = ("floor",),
    stiffness: ArrayLike = 1.0,
    held: ArrayLike | None = None,
    ids: Iterable[DiscId] | None = None,
) -> Packing:
    """The packing of these contacts, whose discs have no positions.

    Parameters
    ----------
    i : iterable of int, str or tuple
        The id of the one disc of every contact.
    j : iterable of int, str or tuple
        The id of the other, or the name of one of the `supports`.
    normal : array of float, shape (contacts, 2) or (contacts, 3)
        The directions from j to i, of any length (the unit vector along each is meant, exactly).
    gap : float or array of float, shape (contacts,), default 0
        The gaps (a length), negative for an overlap.
    weights : float or array of float, shape (discs,), default 1
        The weights, pulling down the last axis.
    loads : array of float, shape (discs, axes), optional
        The loads in place of weights.
    supports : iterable of str, default ("floor",)
        The names of supports.
    stiffness : float or array of float, shape (contacts,), default 1
        The force of a unit of overlap.
    held : array of bool, shape (discs,) or (discs, axes), optional
        Marks of discs that do not move, or of their motions.
    ids : iterable of int, str or tuple, optional
        The discs in the order of weights and loads: where it is not given, that in which they come
        up in i, then in j.

    Returns
    -------
    Packing
        The discs and their contacts, without geometry.

    Raises
    ------
    InputError
        For numbers, shapes and names that are none of these, and a contact that stands twice.

    Examples
    --------
    >>> sides = ["left", "right"]
    >>> wedge = from_contacts([0, 0], sides, [(3, 4), (-3, 4)], supports=sides)
    >>> wedge, wedge.normals.high.tolist()
    (<Packing: 1 disc, 2 contacts>, [[0.6, 0.8], [-0.6, 0.8]])
    """
    walls = tuple(supports)
    if len(set(walls)) < len(walls) or not all(isinstance(s, str) and s for s in walls):
        raise InputError("the supports", walls, "different names, none empty")
    ends = [[disc_id(end, "an end of a contact") for end in side] for side in (i, j)]
    if len(ends[0]) != len(ends[1]):
        raise InputError("the length of j", len(ends[1]), f"that of i, {len(ends[0])}")
    seen = dict.fromkeys(end for side in ends for end in side if end not in walls)
    found_ids = checked_ids(seen if ids is None else ids, None, walls)
    if not found_ids:
        raise InputError("the number of discs", 0, "at least one disc")
    place = {each: k for k, each in enumerate(found_ids)}
    contacts = [f"contact {contact_name(pair)}" for pair in zip(*ends, strict=True)]
    for x, y in zip(*ends, strict=True):
        if x not in place or (y not in place and y not in walls) or x == y:
            raise InputError("a contact", (x, y), "two discs, or a disc and one of the supports")
    if len({frozenset(pair) for pair in zip(*ends, strict=True)}) < len(contacts):
        raise InputError("the contacts", "a list with repeats", "every pair of ends once")
    lines = float_array(normal, "the normals", _SHAPE)
    if lines.ndim != 2 or lines.shape[1] not in (2, 3) or len(lines) != len(contacts):
        raise InputError("the shape of the normals", lines.shape, _SHAPE)
    lines = checked_rows(lines, "the normal", contacts)
    for k in np.flatnonzero(~lines.any(axis=1)).tolist():
        raise InputError(f"the normal of {contacts[k]}", lines[k].tolist(), "a direction")
    names = disc_names(found_ids)
    if loads is None:
        pull = np.zeros((len(names), lines.shape[1]))
        pull[:, -1] = -one_or_each(weights, "the weight", names)
    else:
        pull = float_array(loads, "the loads", "an array of numbers (discs, axes)")
        if pull.shape != (len(names), lines.shape[1]):
            expected = f"({len(names)}, {lines.shape[1]})"
            raise InputError("the shape of the loads", pull.shape, expected)
        pull = checked_rows(pull, "the load", names)
    support: dict[DiscId, int] = {name: s for s, name in enumerate(walls)}
    gaps = one_or_each(gap, "the gap", contacts)
    return Packing(
        tuple(found_ids),
        pull,
        held_motions(held, pull.shape),
        np.array([place[x] for x in ends[0]], dtype=np.int64),
        np.array([place.get(y, -1) for y in ends[1]], dtype=np.int64),
        np.array([support.get(y, -1) for y in ends[1]], dtype=np.int64),
        unit_normals(DoubleDouble.of(lines))[0],
        DoubleDouble.of(gaps),
        np.zeros(len(gaps)),
        one_or_each(stiffness, "the stiffness", contacts, positive=True),
        walls,
        None,
    )
