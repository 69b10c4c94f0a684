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
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import IntArray, distinct
from .check_contacts import check_contacts
from .conversion import all_of, is_plain, number_of, numbers_of, rational_of, tuple_of
from .names import DiscId, contact_name, count, disc_id, end_name

if TYPE_CHECKING:
    from .kind import Origin

Numbers = tuple[Surd, ...]
_SURDS: set[type] = {Surd}
_HELD: set[type] = {Surd, type(None)}
_MAX_DIMENSION = 3
_UNIT_RADIUS = Fraction(1)


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc (or sphere): its lattice point, the load on it, and which motions are prescribed.

    `held[axis]` is the prescribed displacement along that axis (0 for a disc that is simply fixed,
    the push for a corner stone), or None where the disc is free. All three have one entry an axis.
    `radius` is 1 in the four piles, whose unit of length it is; forces do not depend on it.

    >>> Disc(1, position=(0, "sqrt(3)"), load=(0, -1), held=(None, 0))
    Disc(1, position=('0', 'sqrt(3)'), load=('0', '-1'), held=(None, '0'))
    """

    id: DiscId
    position: Numbers
    load: Numbers
    held: tuple[Surd | None, ...]
    radius: Fraction = _UNIT_RADIUS

    def __post_init__(self) -> None:
        # Builders make thousands, out of what needs no conversion.
        if not is_plain(self.id):
            object.__setattr__(self, "id", disc_id(self.id))
        if not all_of(_SURDS, self.position):
            self._convert("position")
        if not all_of(_SURDS, self.load):
            self._convert("load")
        if not all_of(_HELD, self.held):
            self._convert("held")
        if self.radius is not _UNIT_RADIUS:
            what = f"radius of disc {end_name(self.id)}"
            object.__setattr__(self, "radius", rational_of(self.radius, what))
            if self.radius <= 0:
                raise InputError(f"the {what}", self.radius, "a positive number")

    def _convert(self, name: str) -> None:
        what = f"{name} of disc {end_name(self.id)}"
        numbers = numbers_of(getattr(self, name), what, none=name == "held")
        object.__setattr__(self, name, numbers)

    @property
    def fixed(self) -> bool:
        """Whether no motion is left to the disc."""
        return None not in self.held

    def __repr__(self) -> str:
        position, load = ([str(x) for x in vector] for vector in (self.position, self.load))
        held = [None if x is None else str(x) for x in self.held]
        parts = f"{self.id!r}, position={tuple(position)}, load={tuple(load)}, held={tuple(held)}"
        return f"Disc({parts})" if self.radius == 1 else f"Disc({parts}, radius={self.radius})"


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact that may open: unit normal from b to a, compliance c and initial gap o.

    `b` is another disc or the name of a support ("floor"). Its gap is
    g = normal . (u_a - u_b) + gap + compliance * force; a support does not move. A `bilateral`
    contact is held closed whatever the sign of its force.

    >>> Contact(1, "floor", (0, 1), compliance="1/2")
    Contact(1, 'floor', ('0', '1'), compliance=1/2)
    """

    a: DiscId
    b: DiscId
    normal: Numbers
    compliance: Fraction = Fraction(1)
    gap: Surd = ZERO
    bilateral: bool = False

    def __post_init__(self) -> None:
        if not is_plain(self.a):
            object.__setattr__(self, "a", disc_id(self.a))
        if not is_plain(self.b):
            object.__setattr__(self, "b", disc_id(self.b, "the other end of a contact"))
        if not all_of(_SURDS, self.normal):
            object.__setattr__(self, "normal", numbers_of(self.normal, f"normal of {self.name}"))
        if type(self.compliance) is not Fraction:
            compliance = rational_of(self.compliance, f"compliance of {self.name}")
            object.__setattr__(self, "compliance", compliance)
        if type(self.gap) is not Surd:
            object.__setattr__(self, "gap", number_of(self.gap, f"gap of {self.name}"))
        if type(self.bilateral) is not bool:
            raise InputError(f"bilateral of {self.name}", self.bilateral, "True or False")

    @property
    def name(self) -> str:
        """What messages call it, by its ends."""
        return "contact " + contact_name((self.a, self.b))

    def __repr__(self) -> str:
        parts = [repr(self.a), repr(self.b), str(tuple(str(x) for x in self.normal))]
        if self.compliance != 1:
            parts.append(f"compliance={self.compliance}")
        if self.gap:
            parts.append(f"gap='{self.gap}'")
        if self.bilateral:
            parts.append("bilateral=True")
        return f"Contact({', '.join(parts)})"


@dataclass(frozen=True, repr=False)
class Scene:
    """Discs and contacts, and the names of the supports that contacts may lean on.

    In a `geometric` scene every normal points along the line of the two centres, and one that does
    not is an error; False says that the positions mean nothing, as in an abstract network. `origin`
    tells which kind of pile this is, with which parameters: only the builder of a kind sets it, and
    `dataclasses.replace`, the way to variants, drops it.

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
        """The disc with this id."""
        return self.discs[self.disc_index(id)]

    def disc_index(self, id: DiscId) -> int:
        """Where the disc with this id stands in `discs`."""
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
        """The scene with some discs, and the contacts that touch them, taken away."""
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
