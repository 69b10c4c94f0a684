"""A packing: discs or spheres in floats, and the contacts between them, as they are.

Normals of a disordered packing are irrational in as many ways as it has contacts, so it is no
`Scene`, whose numbers are exact. But floats are exact numbers too: centres, radii, loads and
stiffnesses in floats are one real packing, whose normals and gaps are known here to 100 bits.
`prove_packing` proves the forces of just this packing, `solve_packing` solves a rational one near.

Units are the user's: lengths in one unit, forces in another, stiffnesses force per length.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..numbers.double_double import ERROR, DoubleDouble
from ..numbers.floats import FloatArray
from ..numbers.vectors import IntArray
from ..scenes.names import DiscId, contact_name, count
from .check import Marks
from .walls import Wall

NORMAL_ERROR = 4 * ERROR
"""Relative error of every component of a normal: 2^-100 (`geometry`)."""


@dataclass(frozen=True, eq=False, repr=False)
class Geometry:
    """Where discs and walls are: what a packing of bare contacts lacks.

    Shapes: `centres` (discs, axes), `radii` (discs,). With a `period` (along x) the contact k
    is one with the image of disc b that is `image[k]` periods to the right of it.
    """

    centres: FloatArray
    radii: FloatArray
    walls: Mapping[str, Wall]
    period: float | None
    image: IntArray


@dataclass(frozen=True, eq=False, repr=False)
class Packing:
    """Discs with loads, and contacts with normals, gaps and stiffnesses, in floats taken as exact.

    Shapes: `loads` and `held` (discs, axes), `held` marks motions that are fixed; `a`, `b` and
    `support` (contacts,): the disc a, and the disc b or -1, and then the number of the support in
    `supports`. `normals` (contacts, axes) are unit vectors from b to a, each component within
    `NORMAL_ERROR` of itself; `gaps` (contacts,), distances minus radii, are within `gap_error`, and
    negative where discs overlap. A contact pushes with `stiffness` times the overlap.

    `packing` and `from_contacts` build one; `dataclasses.replace` makes variants.
    """

    ids: tuple[DiscId, ...]
    loads: FloatArray
    held: Marks
    a: IntArray
    b: IntArray
    support: IntArray
    normals: DoubleDouble
    gaps: DoubleDouble
    gap_error: FloatArray
    stiffness: FloatArray
    supports: tuple[str, ...]
    geometry: Geometry | None

    def __repr__(self) -> str:
        return f"<Packing: {count(self.ids, 'disc')}, {count(self.a, 'contact')}>"

    @property
    def dimension(self) -> int:
        """Number of axes: 2 for discs, 3 for spheres."""
        return int(self.loads.shape[1])

    def contact_ends(self, k: int) -> tuple[DiscId, DiscId]:
        """The ids of the two ends of contact k, or the id and the name of the support."""
        b = int(self.b[k])
        other = self.ids[b] if b >= 0 else self.supports[int(self.support[k])]
        return self.ids[int(self.a[k])], other

    def contact_name(self, k: int) -> str:
        """What messages call contact k, by its ends."""
        return contact_name(self.contact_ends(k))

    @cached_property
    def free(self) -> IntArray:
        """The number of every motion of a disc along an axis, -1 where it is held."""
        numbers = np.cumsum(~self.held.ravel()) - 1
        return np.where(self.held.ravel(), -1, numbers).reshape(self.held.shape)
