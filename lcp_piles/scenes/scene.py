"""A scene: discs, the contacts they may make, what is held and what pulls.

Plain values. Everything after this module (system, LCP, solution, picture, file) works on any
scene, so a new kind of pile is a new builder and nothing else (see `kinds`).

Units: lengths in disc radii, forces in disc weights w, compliances in tau, and displacements and
gaps in w tau. Wherever an exact number is wanted, whatever `surd` takes will do: an int, a
Fraction, text such as "1/3" or "1/2*sqrt(3)", sympy's and flint's numbers.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from ..numbers.vectors import IntArray, distinct
from .check_contacts import check_contacts
from .conversion import tuple_of
from .names import DiscId, count, end_name
from .parts import Contact as Contact
from .parts import Disc as Disc
from .parts import Numbers as Numbers

if TYPE_CHECKING:
    from .kind import Origin

_MAX_DIMENSION = 3


@dataclass(frozen=True, repr=False)
class Scene:
    """Discs and contacts, and the names of the supports that contacts may lean on.

    `dataclasses.replace` is the way to variants, and drops `origin`.

    Attributes
    ----------
    discs : tuple of Disc
        All discs, the held ones too.
    contacts : tuple of Contact
        The contacts that may carry a force, every pair of ends once.
    supports : tuple of str, default ("floor",)
        The names of what does not move: floors, walls.
    geometric : bool, default True
        Whether every normal points along the line of the two centres, and one that does not is an
        error; False says that the positions mean nothing, as in an abstract network.
    origin : Origin or None
        Which kind of pile this is, with which parameters: only the builder of a kind sets it.

    Raises
    ------
    InputError
        Where ids or pairs stand twice, a contact has an end that is not there, a normal is no exact
        unit vector or not along its line of centres, or dimensions differ.

    Examples
    --------
    >>> apex = Disc("apex", (0, 1), (0, -1), (None, None))
    >>> Scene([apex], [Contact("apex", "floor", (0, 1))])
    <Scene: 1 disc, 1 contact>
    """

    discs: tuple[Disc, ...]
    contacts: tuple[Contact, ...]
    supports: tuple[str, ...] = ("floor",)
    geometric: bool = True
    origin: Origin | None = field(default=None, init=False, compare=False)
    _index: dict[DiscId, int] = field(init=False, compare=False)

    def __post_init__(self) -> None:
        for name, kind in (("discs", Disc), ("contacts", Contact), ("supports", str)):
            object.__setattr__(self, name, tuple_of(kind, getattr(self, name), name))
        if type(self.geometric) is not bool:
            raise InputError("geometric", self.geometric, "True or False")
        index = {disc.id: k for k, disc in enumerate(self.discs)}
        object.__setattr__(self, "_index", index)
        self._check_discs()
        self._check_supports()
        check_contacts(self)

    def _check_discs(self) -> None:
        if not self.discs:
            raise InputError("the number of discs", 0, "at least one disc")
        if len(self._index) < len(self.discs):
            raise InputError("the disc ids", "a list with repeats", "every id once")
        dimension = self.dimension
        if not 1 <= dimension <= _MAX_DIMENSION:
            raise InputError("the dimension", dimension, f"1 to {_MAX_DIMENSION} axes")
        for disc in self.discs:
            if not len(disc.position) == len(disc.load) == len(disc.held) == dimension:
                raise InputError(
                    f"disc {end_name(disc.id)}", disc, f"{dimension} components throughout"
                )

    def _check_supports(self) -> None:
        if len(set(self.supports)) < len(self.supports) or "" in self.supports:
            raise InputError("the supports", self.supports, "different names, none empty")
        for name in self.supports:
            if name in self._index:
                raise InputError("the support", name, "a name that no disc has for its id")

    @property
    def dimension(self) -> int:
        """Number of axes: 2 for discs."""
        return len(self.discs[0].position)

    @property
    def definite(self) -> bool:
        """Whether the forces minimise a convex energy: no compliance is negative."""
        return all(contact.compliance.numerator >= 0 for contact in self.contacts)

    def disc(self, id: DiscId) -> Disc:
        """The disc with this id.

        Parameters
        ----------
        id : int, str or tuple
            The id.

        Returns
        -------
        Disc
            The disc; `InputError` where the scene has none of this id.
        """
        return self.discs[self.disc_index(id)]

    def disc_index(self, id: DiscId) -> int:
        """Where the disc with this id stands in `discs`.

        Parameters
        ----------
        id : int, str or tuple
            The id.

        Returns
        -------
        int
            Its place, from 0 on; `InputError` where the scene has none of this id.
        """
        try:
            return self._index[id]
        except (KeyError, TypeError):
            raise InputError("the disc", id, f"one of the {len(self.discs)} discs") from None

    @cached_property
    def ends(self) -> tuple[IntArray, IntArray]:
        """Index of disc a and of disc b of every contact, -1 for a support."""
        a, b = self._numbered_ends
        return a, np.where(b < len(self.discs), b, -1)

    @cached_property
    def support_of(self) -> IntArray:
        """For every contact the index of its support in `supports`, -1 for one between discs."""
        _, b = self._numbered_ends
        return np.maximum(b - len(self.discs), -1)

    @cached_property
    def _numbered_ends(self) -> tuple[IntArray, IntArray]:
        """Ends by number: discs in their order, then supports in theirs."""
        first = len(self.discs)
        number = self._index | {name: first + k for k, name in enumerate(self.supports)}
        count = len(self.contacts)
        try:
            a = np.fromiter((self._index[c.a] for c in self.contacts), np.int64, count)
            b = np.fromiter((number[c.b] for c in self.contacts), np.int64, count)
        except KeyError:
            pair = next(c for c in self.contacts if c.a not in self._index or c.b not in number)
            names = ", ".join(self.supports) or "none"
            raise InputError(
                "a contact",
                (pair.a, pair.b),
                f"discs of the scene, or a disc and one of its supports ({names})",
                "declare further supports with Scene(..., supports=(...))",
            ) from None
        return a, b

    @cached_property
    def normals(self) -> tuple[tuple[Numbers, ...], IntArray]:
        """The different normals, and for every contact which of them it has."""
        values, which = distinct([contact.normal for contact in self.contacts])
        return tuple(values), which

    def without(self, ids: Iterable[DiscId]) -> Scene:
        """The scene with some discs, and the contacts that touch them, taken away.

        Parameters
        ----------
        ids : iterable of int, str or tuple
            The ids of the discs; `InputError` where the scene has none of one.

        Returns
        -------
        Scene
            The variant, which has no origin.

        Examples
        --------
        >>> from lcp_piles import nt60
        >>> nt60(3).without([(1, 1)])
        <Scene: 5 discs, 8 contacts>
        """
        gone = set(ids)
        for id in gone:
            self.disc_index(id)
        return replace(
            self,
            discs=tuple(d for d in self.discs if d.id not in gone),
            contacts=tuple(c for c in self.contacts if c.a not in gone and c.b not in gone),
        )

    def __repr__(self) -> str:
        name = f"Scene {self.origin}" if self.origin else "Scene"
        return f"<{name}: {count(self.discs, 'disc')}, {count(self.contacts, 'contact')}>"
