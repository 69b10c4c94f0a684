"""The ids of discs and the names of supports: what they may be, and how people read them.

An id is a whole number of 64 bits, a text that is not empty, or a tuple of such; the name of a
support is such a text. Scenes, files and messages keep to this one rule.
"""

from __future__ import annotations

from collections.abc import Iterable, Sized
from operator import index
from typing import Any

from ..errors import InputError

DiscId = int | str | tuple[int | str, ...]

_EXPECTED = "a whole number of 64 bits, a text that is not empty, or a tuple of such"


def disc_id(value: Any, what: str = "the id of a disc") -> DiscId:
    """The value as an id, in plain Python types; `InputError` where it is none.

    >>> disc_id((1, 2)), disc_id("A"), disc_id(7)
    ((1, 2), 'A', 7)
    >>> disc_id(0.5)
    Traceback (most recent call last):
    lcp_piles.errors.InputError: the id of a disc is 0.5, expected a whole number of 64 bits, \
a text that is not empty, or a tuple of such
    """
    if isinstance(value, tuple) and value:
        return tuple(_single(part, value, what) for part in value)
    return _single(value, value, what)


def _single(part: Any, whole: object, what: str) -> int | str:
    if isinstance(part, str) and part:
        return str.__str__(part)
    try:
        number = index(part)
    except TypeError:
        number = None
    if number is None or isinstance(part, bool) or not -(2**63) <= number < 2**63:
        raise InputError(what, whole, _EXPECTED)
    return number


def end_name(end: DiscId) -> str:
    """A disc as the paper writes it, (i,j), or the name of a support.

    >>> end_name((6, 2)), end_name("floor"), end_name(3)
    ('(6,2)', 'floor', '3')
    """
    return "(" + ",".join(map(str, end)) + ")" if isinstance(end, tuple) else str(end)


def contact_name(ends: Iterable[DiscId]) -> str:
    """The two ends of a contact.

    >>> contact_name([(6, 2), "floor"])
    '(6,2)-floor'
    """
    return "-".join(map(end_name, ends))


def count(things: Sized, name: str) -> str:
    """How many of them there are, in words.

    >>> count([1, 2], "disc")
    '2 discs'
    """
    return f"{len(things)} {name}{'' if len(things) == 1 else 's'}"
