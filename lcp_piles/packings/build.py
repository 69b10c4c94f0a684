"""`packing`: from centres and radii to a packing with its contacts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..numbers.double_double import DoubleDouble, difference
from ..numbers.floats import FloatArray
from ..numbers.vectors import IntArray
from ..scenes.names import DiscId, contact_name, end_name
from .check import (
    Marks,
    checked_ids,
    checked_rows,
    disc_names,
    float_array,
    held_motions,
    number,
    one_or_each,
)
from .geometry import gaps_between, gaps_to_wall, lines_between, unit_normals
from .packing import Geometry, Packing
from .touching import touching_pairs
from .walls import Wall, walls_of

_CENTRES = "an array of numbers of shape (discs, 2) or (discs, 3)"


def packing(
    centres: ArrayLike,
    radii: ArrayLike,
    *,
    weights: ArrayLike = 1.0,
    supports: Mapping[str, Wall | float | Sequence[Sequence[float]]] | None = None,
    tolerance: float = 0.01,
    stiffness: float = 1.0,
    wall_stiffness: float | None = None,
    held: ArrayLike | None = None,
    period: float | None = None,
    ids: Iterable[DiscId] | None = None,
) -> Packing:
    """The packing of discs (or spheres) where they stand, floats taken as exact.

    Gaps are distances minus radii: discs that overlap push already where they stand. Contacts
    between what is held on both sides carry nothing and are left out.

    Parameters
    ----------
    centres : array of float, shape (discs, 2) or (discs, 3)
        The centres, in any unit of length.
    radii : float or array of float, shape (discs,)
        The radii, one or one a disc, in the same unit.
    weights : float or array of float, shape (discs,), default 1
        The weights, pulling down the last axis, in any unit of force.
    supports : mapping of str to Wall, float or pair of points, optional
        Walls by name: a number for "floor", "ceiling", "left", "right" (and "front", "back" of
        spheres), or a `Wall` or pair of a point and an inward normal.
    tolerance : float, default 0.01
        The gap up to which discs count as neighbours that may push, as a share of the sum of their
        radii (of the radius, at a wall).
    stiffness : float, default 1
        The force of a unit of overlap.
    wall_stiffness : float, optional
        That at a wall, where it is another.
    held : array of bool, shape (discs,) or (discs, axes), optional
        Marks of discs that do not move, or of their motions.
    period : float, optional
        The length along x after which the packing repeats.
    ids : iterable of int, str or tuple, optional
        Names of the discs in place of 0, 1, ...

    Returns
    -------
    Packing
        The discs and their contacts.

    Raises
    ------
    InputError
        For numbers, shapes and names that are none of these, discs that are almost at one place,
        and discs beyond a wall.

    Examples
    --------
    >>> heap = packing([(0, 1), (2, 1), (1, 2.7)], 1, supports={"floor": 0}, stiffness=100)
    >>> heap, heap.contact_name(1), heap.gaps.high.round(3).tolist()
    (<Packing: 3 discs, 5 contacts>, '0-2', [0.0, -0.028, -0.028, 0.0, 0.0])
    """
    x = float_array(centres, "the centres", _CENTRES)
    if x.ndim != 2 or x.shape[1] not in (2, 3) or not len(x):
        raise InputError("the shape of the centres", x.shape, _CENTRES)
    walls = walls_of(supports, x.shape[1])
    found_ids = checked_ids(range(len(x)) if ids is None else ids, len(x), walls)
    names = disc_names(found_ids)
    x = checked_rows(x, "the centre", names)
    r = one_or_each(radii, "the radius", names, positive=True)
    loads = np.zeros_like(x)
    loads[:, -1] = -one_or_each(weights, "the weight", names)
    motions = held_motions(held, loads.shape)
    factor = 1 + number(tolerance, "the tolerance", least=0.0)
    k = number(stiffness, "the stiffness")
    k_wall = k if wall_stiffness is None else number(wall_stiffness, "the stiffness of a wall")
    if period is not None:
        period = number(period, "the period")
        if period <= 4 * factor * r.max():
            expected = f"more than two diameters, {4 * factor * r.max():g}"
            raise InputError("the period", period, expected)

    fixed: Marks = np.asarray(motions.all(axis=1))
    i, j, image = touching_pairs(x, r, factor, period)
    known = ~(fixed[i] & fixed[j])
    i, j, image = i[known], j[known], image[known]
    lines = lines_between(x, i, j, image, period)
    _check_apart(lines.high, r, i, j, found_ids)
    normals, lengths = unit_normals(lines)
    gaps, error = gaps_between(lengths, difference(r[i], -r[j]))
    parts = [(i, j, np.full(len(i), -1), normals, gaps, error, np.full(len(i), k))]
    for s, (name, wall) in enumerate(walls.items()):
        unit, gap, error = gaps_to_wall(x, r, wall)
        _check_inside(gap.high, r, name, found_ids)
        on = np.flatnonzero(~fixed & (gap.high <= (factor - 1) * r))
        rows = DoubleDouble(*(np.tile(part, (len(on), 1)) for part in (unit.high, unit.low)))
        ends = on, np.full(len(on), -1), np.full(len(on), s)
        parts.append((*ends, rows, gap[on], error[on], np.full(len(on), k_wall)))
    a, b, support, normal, gap, error, k_of = zip(*parts, strict=True)
    at_walls = sum(map(len, a[1:]))
    return Packing(
        tuple(found_ids),
        loads,
        motions,
        np.concatenate(a),
        np.concatenate(b),
        np.concatenate(support),
        _joined(normal),
        _joined(gap),
        np.concatenate(error),
        np.concatenate(k_of),
        tuple(walls),
        Geometry(x, r, walls, period, np.append(image, np.zeros(at_walls, np.int64))),
    )


def _joined(parts: Sequence[DoubleDouble]) -> DoubleDouble:
    high, low = ([getattr(part, name) for part in parts] for name in ("high", "low"))
    return DoubleDouble(np.concatenate(high), np.concatenate(low))


def _check_apart(
    lines: FloatArray, radii: FloatArray, i: IntArray, j: IntArray, ids: Sequence[DiscId]
) -> None:
    """No centre lies inside another disc: the line between such two says nothing of a normal."""
    distance = np.sqrt((lines * lines).sum(axis=1))
    for k in np.flatnonzero(distance < np.maximum(radii[i], radii[j])).tolist():
        raise InputError(
            f"the distance of discs {contact_name((ids[i[k]], ids[j[k]]))}",
            float(distance[k]),
            f"more than either radius, {radii[i[k]]:g} and {radii[j[k]]:g}",
            "are these diameters, or one disc twice?",
        )


def _check_inside(gaps: FloatArray, radii: FloatArray, wall: str, ids: Sequence[DiscId]) -> None:
    """No centre lies behind a wall."""
    for k in np.flatnonzero(gaps <= -radii).tolist():
        raise InputError(
            f"the distance of disc {end_name(ids[k])} from the wall {wall}",
            float(gaps[k] + radii[k]),
            "above zero",
            "the normal of a wall points to where the discs are",
        )
