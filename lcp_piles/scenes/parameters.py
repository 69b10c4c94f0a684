"""The parameters that the piles of the paper share."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from operator import index
from typing import Any

from ..errors import InputError
from ..numbers.exact import Surd
from .conversion import number_of, rational_of
from .kind import Parameter

MAX_LAYERS = 2000
"""More layers than any machine holds: a guard against a slip of the finger."""

HELD, RESTING = "held", "resting"


@dataclass(frozen=True, slots=True)
class WholeNumber:
    """What turns a value, or by `read` a word of text, into a whole number within bounds."""

    what: str
    least: int
    most: int

    def __call__(self, value: Any) -> int:
        """The value as an int; `InputError` where it is none, or not within the bounds."""
        try:
            number = index(value)
        except TypeError:
            number = None
        if number is None or isinstance(value, bool):
            raise InputError(self.what, value, "a whole number")
        if not self.least <= number <= self.most:
            raise InputError(self.what, number, f"a number from {self.least} to {self.most}")
        return number

    def read(self, text: str) -> int:
        """The number that a word of text is."""
        if not (text.isascii() and text.isdecimal()) or len(text) > len(str(self.most)):
            raise InputError(self.what, text, f"a number from {self.least} to {self.most}")
        return self(int(text))


@dataclass(frozen=True, slots=True)
class ExactNumber:
    """What turns a value or text into an exact number, and names it where it is none."""

    what: str

    def __call__(self, value: Any) -> Surd:
        """The value as a Surd; `InputError` where `surd` does not take it."""
        return number_of(value, self.what)


@dataclass(frozen=True, slots=True)
class RationalNumber:
    """As `ExactNumber`, without roots, and not below `least` if there is one."""

    what: str
    least: Fraction | None = None

    def __call__(self, value: Any) -> Fraction:
        """The value as a Fraction; `InputError` where it is no rational number."""
        number = rational_of(value, self.what)
        if self.least is not None and number < self.least:
            raise InputError(self.what, number, f"a number from {self.least} up")
        return number


@dataclass(frozen=True, slots=True)
class Choice:
    """What lets a value pass that is one of a few words."""

    what: str
    choices: tuple[str, ...]

    def __call__(self, value: Any) -> str:
        """The value as text; `InputError` where it is none of the words."""
        if value not in self.choices:
            raise InputError(self.what, value, " or ".join(f'"{word}"' for word in self.choices))
        return str(value)


def choice_of(name: str, choices: tuple[str, ...], help: str, title: str) -> Parameter:
    """A parameter that is one of a few words, the first by default."""
    check = Choice(name, choices)
    return Parameter(
        name=name,
        check=check,
        read=check,
        default=choices[0],
        help=help,
        title=title,
        choices=choices,
    )


def extent_of(kind: str, name: str, least: int, help: str, title: str) -> Parameter:
    """How many discs, rows or columns of a kind of scene there are, `least` or more."""
    number = WholeNumber(f"{name} of {kind}", least, MAX_LAYERS)
    return Parameter(
        name=name,
        check=number,
        read=number.read,
        default=None,
        help=help,
        title=title,
        metavar="N",
        write=int,
    )


def compliance_of(name: str, help: str) -> Parameter:
    """A compliance (tau) of 0 or more, that of the discs by default."""
    check = RationalNumber(name.replace("_", " "), Fraction(0))
    return Parameter(
        name=name,
        check=check,
        read=check,
        default=1,
        help=f"{help}, in tau; 0 is rigid, default 1",
        title=name.replace("_", " ") + r" ${}\,\tau$",
        metavar="C",
    )


def layers_of(kind: str, least: int) -> Parameter:
    """The number of layers of a kind of pile, `least` or more."""
    return extent_of(kind, "layers", least, "rows of discs", "$N = {}$")


PUSH = Parameter(
    name="push",
    check=ExactNumber("push"),
    read=ExactNumber("push"),
    default=0,
    help='both corner stones towards the axis, in w tau: exact, such as 20 or "7/3*sqrt(3)"; '
    "negative pulls",
    title=r"push ${}\,w\tau$",
    metavar="X",
)
FLOOR_COMPLIANCE = Parameter(
    name="floor_compliance",
    check=RationalNumber("floor compliance"),
    read=RationalNumber("floor compliance"),
    default=1,
    help="in tau; 0 is rigid, default 1; -1/2 is the paper's published floor",
    title=r"floor compliance ${}\,\tau$",
    metavar="C",
)
CORNER_STONES = choice_of(
    "corner_stones",
    (HELD, RESTING),
    "held at their lattice points (default), or resting on the floor, held sideways only",
    "corner stones {}",
)
SOFT_FLOOR = compliance_of("floor_compliance", "of contacts with the floor")
