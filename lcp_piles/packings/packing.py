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

    `packing` and `from_contacts` build one; `dataclasses.replace` makes variants.

    Attributes
    ----------
    ids : tuple of int, str or tuple, shape (discs,)
        The ids of the discs.
    loads : array of float, shape (discs, axes)
        The loads, in the packing's unit of force.
    held : array of bool, shape (discs, axes)
        Marks motions that are fixed.
    a : array of int, shape (contacts,)
        The number of disc a.
    b : array of int, shape (contacts,)
        The number of disc b, -1 where there is a support.
    support : array of int, shape (contacts,)
        Then the number of the support in `supports`, else -1.
    normals : DoubleDouble, shape (contacts, axes)
        Unit vectors from b to a, each component within `NORMAL_ERROR` of itself.
    gaps : DoubleDouble, shape (contacts,)
        Distances minus radii (the packing's unit of length), negative where discs overlap.
    gap_error : array of float, shape (contacts,)
        What the gaps are within.
    stiffness : array of float, shape (contacts,)
        A contact pushes with this times the overlap.
    supports : tuple of str
        The names of the supports.
    geometry : Geometry or None
        Centres and radii, where there are any.

    Examples
    --------
    >>> from lcp_piles import packing
    >>> heap = packing([(0, 1), (2, 1)], 1, supports={"floor": 0})
    >>> heap.a.tolist(), heap.b.tolist(), heap.support.tolist()
    ([0, 0, 1], [1, -1, -1], [-1, 0, 0])
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
        """The ids of the two ends of a contact, or the id and the name of the support.

        Parameters
        ----------
        k : int
            The number of the contact.

        Returns
        -------
        tuple of int, str or tuple, shape (2,)
            The ends a and b.
        """
        b = int(self.b[k])
        other = self.ids[b] if b >= 0 else self.supports[int(self.support[k])]
        return self.ids[int(self.a[k])], other

    def contact_name(self, k: int) -> str:
        """What messages call a contact, by its ends.

        Parameters
        ----------
        k : int
            The number of the contact.

        Returns
        -------
        str
            Its name, such as "0-floor".
        """
        return contact_name(self.contact_ends(k))

    @cached_property
    def free(self) -> IntArray:
        """The number of every motion of a disc along an axis, -1 where it is held."""
        numbers = np.cumsum(~self.held.ravel()) - 1
        return np.where(self.held.ravel(), -1, numbers).reshape(self.held.shape)
