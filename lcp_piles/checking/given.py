"""Forces that somebody computed, as plain values: one entry a contact, in his units and order."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from ..errors import InputError
from ..scenes.names import contact_name

Place = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class GivenForce:
    """The force of one contact: its size along the normal, or a vector on the first end, or both.

    The ends are `a` and `b`, each an id or name, or its centre (`at_a`, `at_b`); or the contact is
    known by its own place, `point`. `where` tells people where the entry stands.
    """

    force: float | None = None
    vector: Place | None = None
    a: Any = None
    b: Any = None
    at_a: Place | None = None
    at_b: Place | None = None
    point: Place | None = None
    where: str = "an entry of the forces"

    def __post_init__(self) -> None:
        numbers = [self.force] if self.force is not None else []
        for place in (self.vector, self.at_a, self.at_b, self.point):
            numbers += place or ()
        for number in numbers:
            if not isfinite(number):
                raise InputError(f"a number of {self.where}", number, "a finite number")
        if self.force is None and self.vector is None:
            raise InputError(self.where, "without a force", "a force or a vector of force")
        first = self.a is not None or self.at_a is not None
        second = self.b is not None or self.at_b is not None
        if not (first and second) and self.point is None:
            raise InputError(self.where, "without its ends", "two ends, or the point of contact")


def given_forces(forces: Any, pairs: Iterable[tuple[Any, Any]]) -> list[GivenForce]:
    """Forces in any of the forms that `check` takes; `pairs` are the ends of the scene's contacts.

    >>> given_forces({("a", "floor"): 1}, [])[0].force
    1.0
    """
    if isinstance(forces, Mapping):
        return [_entry(ends, value) for ends, value in forces.items()]
    found = list(forces)
    if all(isinstance(force, GivenForce) for force in found):
        return found
    ends = list(pairs)
    if len(found) != len(ends):
        expected = f"{len(ends)} numbers, one a contact, or a mapping from (a, b) to forces"
        raise InputError("the number of forces", len(found), expected)
    return [_entry(pair, value) for pair, value in zip(ends, found, strict=True)]


def _entry(ends: Any, value: Any) -> GivenForce:
    try:
        a, b = ends
    except (TypeError, ValueError):
        raise InputError("the key of a force", ends, "the two ends of a contact") from None
    where = f"the force of {contact_name((a, b))}"
    try:
        numbers = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(where, value, "a number or a vector of numbers") from None
    if numbers.ndim == 0:
        return GivenForce(float(numbers), None, a, b, where=where)
    return GivenForce(None, tuple(numbers.ravel().tolist()), a, b, where=where)
