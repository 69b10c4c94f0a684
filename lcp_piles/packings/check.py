"""What is handed in for a packing, as arrays; messages name the disc that is wrong."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..numbers.floats import FloatArray
from ..scenes.names import DiscId, disc_id, end_name

Marks = np.ndarray[Any, np.dtype[np.bool_]]
_LARGEST = 2.0**150
"""Numbers of a packing are zero or between 1/_LARGEST and it: no product of six leaves floats."""
_RANGE = "a number; zero, or of a size from 1e-45 to 1e45"


def float_array(values: ArrayLike, what: str, expected: str) -> FloatArray:
    """The values as an array of floats of its own; `InputError` where they are no numbers."""
    try:
        return np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(what, values, expected) from None


def in_range(values: FloatArray) -> Marks:
    """Whether the entries are numbers of a size that all computations have room for."""
    size = np.abs(values)
    fits: Marks = (size == 0) | ((size >= 1 / _LARGEST) & (size <= _LARGEST))
    return fits


def checked_rows(values: FloatArray, what: str, names: Sequence[str]) -> FloatArray:
    """Rows whose numbers are all in range, read-only; else the first wrong one is named."""
    bad = np.flatnonzero(~in_range(values.reshape(len(names), -1)).all(axis=1))
    for k in bad.tolist():
        raise InputError(f"{what} of {names[k]}", values[k].tolist(), _RANGE)
    values.flags.writeable = False
    return values


def one_or_each(
    values: ArrayLike, what: str, names: Sequence[str], positive: bool = False
) -> FloatArray:
    """One number for all of the named things, or one for each."""
    found = float_array(values, what, "one number, or one each")
    if found.shape not in ((), (len(names),)):
        expected = f"one number, or an array of {len(names)}"
        raise InputError(f"the shape of {what}", found.shape, expected)
    found = checked_rows(np.broadcast_to(found, len(names)).copy(), what, names)
    for k in np.flatnonzero(found <= 0).tolist() if positive else ():
        raise InputError(f"{what} of {names[k]}", float(found[k]), "a positive number")
    return found


def number(value: Any, what: str, least: float | None = None) -> float:
    """One number: positive, or not below the least."""
    found = float_array(value, what, "a number")
    if found.shape or not in_range(found).all() or (found <= 0 if least is None else found < least):
        expected = "a positive number" if least is None else f"a number from {least:g} on"
        raise InputError(what, value, expected)
    return float(found)


def checked_ids(ids: Iterable[Any], count: int | None, supports: Iterable[str]) -> list[DiscId]:
    """The ids of so many discs: all different, and no names of supports."""
    found = [disc_id(each) for each in ids]
    if count is not None and len(found) != count:
        raise InputError("the number of ids", len(found), f"{count}, one a disc")
    if len(set(found)) < len(found):
        raise InputError("the ids", "a list with repeats", "every id once")
    for name in supports:
        if name in found:
            raise InputError("the name of a wall", name, "a name that no disc has for its id")
    return found


def disc_names(ids: Iterable[DiscId]) -> list[str]:
    """What messages call the discs."""
    return [f"disc {end_name(each)}" for each in ids]


def held_motions(held: ArrayLike | None, shape: tuple[int, int]) -> Marks:
    """Which motions are held, from marks of discs or of their motions."""
    if held is None:
        marks: Marks = np.zeros(shape, dtype=bool)
    else:
        marks = np.array(held)
        if marks.dtype != bool or marks.shape not in (shape, shape[:1]):
            expected = f"booleans of shape ({shape[0]},) or {shape}"
            raise InputError("held", held, expected)
        marks = marks if marks.ndim > 1 else np.repeat(marks[:, None], shape[1], axis=1)
    marks.flags.writeable = False
    return marks
