"""The parameters that the piles of the paper share."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from operator import index
from typing import Any

from ..errors import InputError
from ..numbers.exact import Surd, surd
from .kind import Parameter

MAX_LAYERS = 2000
"""More layers than any machine holds: a guard against a slip of the finger."""

HELD, RESTING = "held", "resting"


def layers_of(kind: str, least: int) -> Parameter:
    """The number of layers of a kind of pile, `least` or more."""
    return Parameter(
        name="layers",
        check=partial(_check_layers, kind, least),
        read=partial(_read_layers, kind, least),
        default=None,
        help="rows of discs",
        title="$N = {}$",
        metavar="N",
        write=int,
    )


def _check_layers(kind: str, least: int, value: Any) -> int:
    try:
        layers = index(value)
    except TypeError:
        raise InputError("layers", value, "a whole number") from None
    if isinstance(value, bool):
        raise InputError("layers", value, "a whole number")
    if not least <= layers <= MAX_LAYERS:
        raise InputError(f"layers of {kind}", layers, f"a number from {least} to {MAX_LAYERS}")
    return layers


def _read_layers(kind: str, least: int, text: str) -> int:
    if not (text.isascii() and text.isdecimal()) or len(text) > 9:
        raise InputError(f"layers of {kind}", text, f"a number from {least} to {MAX_LAYERS}")
    return _check_layers(kind, least, int(text))


def _exact(name: str, value: Any) -> Surd:
    try:
        return surd(value)
    except InputError as error:
        raise InputError(name, value, error.expected, error.remedy) from error


def _rational(name: str, value: Any) -> Fraction:
    number = _exact(name, value)
    if not number.is_rational:
        raise InputError(name, str(number), "a rational number")
    return number.rational()


def _check_corner_stones(value: Any) -> str:
    if value not in (HELD, RESTING):
        raise InputError("corner_stones", value, f'"{HELD}" or "{RESTING}"')
    return str(value)


PUSH = Parameter(
    name="push",
    check=partial(_exact, "push"),
    read=partial(_exact, "push"),
    default=0,
    help='both corner stones towards the axis, in w tau: exact, such as 20 or "7/3*sqrt(3)"; '
    "negative pulls",
    title=r"push ${}\,w\tau$",
    metavar="X",
)
FLOOR_COMPLIANCE = Parameter(
    name="floor_compliance",
    check=partial(_rational, "floor compliance"),
    read=partial(_rational, "floor compliance"),
    default=1,
    help="in tau; 0 is rigid, default 1; -1/2 is the paper's published floor",
    title=r"floor compliance ${}\,\tau$",
    metavar="C",
)
CORNER_STONES = Parameter(
    name="corner_stones",
    check=_check_corner_stones,
    read=_check_corner_stones,
    default=HELD,
    help="held at their lattice points (default), or resting on the floor, held sideways only",
    title="corner stones {}",
    choices=(HELD, RESTING),
)
