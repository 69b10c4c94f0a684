"""A disc and a contact: the parts of a scene, as plain values."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..errors import InputError
from ..numbers.exact import ZERO, Surd
from .conversion import all_of, is_plain, number_of, numbers_of, rational_of
from .names import DiscId, contact_name, disc_id, end_name

Numbers = tuple[Surd, ...]
_SURDS: set[type] = {Surd}
_HELD: set[type] = {Surd, type(None)}
_UNIT_RADIUS = Fraction(1)


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc (or sphere): its lattice point, the load on it, and which motions are prescribed.

    All three vectors have one entry an axis. Whatever `surd` takes may be given for exact numbers.

    Attributes
    ----------
    id : int, str or tuple
        The name of the disc in its scene, (row, number in the row) in the four piles.
    position : tuple of Surd
        The centre, in disc radii.
    load : tuple of Surd
        The force on it from outside (w), (0, -1) for its weight.
    held : tuple of Surd or None
        The prescribed displacement along each axis (w tau): 0 for a disc that is simply fixed, the
        push for a corner stone. None where the disc is free.
    radius : Fraction, default 1
        1 in the four piles, whose unit of length it is; forces do not depend on it.

    Raises
    ------
    InputError
        Where an entry is no exact number, the id is none, or the radius is not positive.

    Examples
    --------
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

    Its gap is g = normal . (u_a - u_b) + gap + compliance * force; a support does not move.

    Attributes
    ----------
    a : int, str or tuple
        The id of a disc.
    b : int, str or tuple
        The id of another disc, or the name of a support ("floor").
    normal : tuple of Surd
        The unit vector from b to a, exact, one entry an axis.
    compliance : Fraction, default 1
        The overlap of a unit force (tau); 0 is rigid.
    gap : Surd, default 0
        The gap where nothing is displaced and no force acts (w tau).
    bilateral : bool, default False
        Whether the contact is held closed whatever the sign of its force.

    Raises
    ------
    InputError
        Where a number is not exact, the compliance not rational, or an end no id.

    Examples
    --------
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
