"""A scene: discs, the contacts they may make, what is held and what pulls.

Plain values. Everything after this module (system, LCP, solution, picture, file) works on any
scene, so a new kind of pile is a new builder and nothing else; `piles` has the four of the paper.

Units: lengths in disc radii, forces in disc weights w, compliances in tau, and displacements and
gaps in w tau.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

import numpy as np

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Surd
from ..numbers.vectors import IntArray, distinct

DiscId = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc (or sphere): its lattice point, the load on it, and which motions are prescribed.

    `held[axis]` is the prescribed displacement along that axis (0 for a disc that is simply fixed,
    the push for a corner stone), or None where the disc is free.
    """

    id: DiscId
    position: tuple[Surd, ...]
    load: tuple[Surd, ...]
    held: tuple[Surd | None, ...]

    @property
    def fixed(self) -> bool:
        """Whether no motion is left to the disc."""
        return None not in self.held


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact that may open: unit normal from b to a, compliance c and initial gap o.

    `b` is the name of a support ("floor") or another disc. Its gap is
    g = normal . (u_a - u_b) + gap + compliance * force; a support does not move. A `bilateral`
    contact is held closed whatever the sign of its force.
    """

    a: DiscId
    b: DiscId | str
    normal: tuple[Surd, ...]
    compliance: Fraction = Fraction(1)
    gap: Surd = ZERO
    bilateral: bool = False


@dataclass(frozen=True)
class Scene:
    """Discs and contacts, with the kind and the parameters that they were built from.

    `parameters` are (name, value) pairs in the builder's order; a scene of kind "custom" has none
    and stands for itself. `Scene.without` and `dataclasses.replace` make variants.
    """

    kind: str
    parameters: tuple[tuple[str, object], ...]
    discs: tuple[Disc, ...]
    contacts: tuple[Contact, ...]
    _index: dict[DiscId, int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        index = {disc.id: k for k, disc in enumerate(self.discs)}
        object.__setattr__(self, "_index", index)
        if not self.discs:
            raise InputError("the number of discs", 0, "at least one disc")
        if len(index) < len(self.discs):
            raise InputError("the disc ids", "a list with repeats", "every id once")
        dimension = len(self.discs[0].position)
        for disc in self.discs:
            if not len(disc.position) == len(disc.load) == len(disc.held) == dimension:
                raise InputError(f"disc {disc.id}", disc, f"{dimension} components throughout")
        checked: set[int] = set()
        for contact in self.contacts:
            if contact.a not in index or (
                not isinstance(contact.b, str) and contact.b not in index
            ):
                raise InputError("a contact", (contact.a, contact.b), "discs of the scene")
            if type(contact.compliance) is not Fraction:
                raise InputError("a compliance", contact.compliance, "a Fraction")
            if id(contact.normal) not in checked:
                checked.add(id(contact.normal))
                square = sum((n * n for n in contact.normal), ZERO)
                if len(contact.normal) != dimension or square != ONE:
                    raise InputError(
                        f"the normal of contact {contact.a}-{contact.b}",
                        tuple(map(str, contact.normal)),
                        f"an exact unit vector of {dimension} components",
                    )

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
        index = self._index
        count = len(self.contacts)
        a = np.fromiter((index[c.a] for c in self.contacts), dtype=np.int64, count=count)
        b = np.fromiter(
            (-1 if isinstance(c.b, str) else index[c.b] for c in self.contacts),
            dtype=np.int64,
            count=count,
        )
        return a, b

    @cached_property
    def normals(self) -> tuple[tuple[tuple[Surd, ...], ...], IntArray]:
        """The different normals, and for every contact which of them it has."""
        values, which = distinct([contact.normal for contact in self.contacts])
        return tuple(values), which

    def without(self, ids: Iterable[DiscId]) -> Scene:
        """The scene with some discs, and the contacts that touch them, taken away."""
        gone = set(ids)
        for id in gone:
            self.disc_index(id)
        return Scene(
            "custom",
            (),
            tuple(d for d in self.discs if d.id not in gone),
            tuple(c for c in self.contacts if c.a not in gone and c.b not in gone),
        )
