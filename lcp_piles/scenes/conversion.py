"""What a person hands in, as the exact values that scenes are made of.

Builders make thousands of discs and contacts out of values that need no conversion: `is_plain` and
`all_of` tell these at once.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..errors import InputError
from ..numbers.exact import Surd, surd

_SMALL = 2**30


def is_plain(id: Any) -> bool:
    """Whether an id is a pair of small numbers as builders make it, in no need of `disc_id`."""
    if type(id) is not tuple or len(id) != 2:
        return False
    i, j = id
    return type(i) is int is type(j) and 0 <= i < _SMALL and 0 <= j < _SMALL


def all_of(kinds: set[type], vector: object) -> bool:
    """Whether this is a tuple of values of just these types."""
    return type(vector) is tuple and kinds.issuperset(map(type, vector))


def numbers_of(values: Any, what: str, none: bool = False) -> tuple[Any, ...]:
    """A vector of exact numbers, None allowed on request."""
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise InputError(what, values, "a tuple of exact numbers")
    return tuple(None if none and x is None else number_of(x, what) for x in values)


def number_of(value: Any, what: str) -> Surd:
    """The exact number that a value stands for; an error calls it by `what`."""
    try:
        return surd(value)
    except InputError as error:
        raise InputError(what, value, error.expected, error.remedy) from error


def rational_of(value: Any, what: str) -> Fraction:
    """As `number_of`, without roots."""
    number = number_of(value, what)
    if not number.is_rational:
        raise InputError(what, str(number), "a rational number")
    return number.rational()


def tuple_of(kind: type, values: Any, name: str) -> tuple[Any, ...]:
    """A sequence of values of one type, as a tuple."""
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise InputError(name, values, f"a sequence of {kind.__name__}")
    found = tuple(values)
    for value in found:
        if not isinstance(value, kind):
            raise InputError(f"an entry of {name}", value, f"a {kind.__name__}")
    return found
