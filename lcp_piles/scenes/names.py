"""How discs, supports and contacts are written for people."""

from __future__ import annotations

from collections.abc import Iterable

from .scene import DiscId


def end_name(end: DiscId | str) -> str:
    """A disc as the paper writes it, (i,j), or the name of a support.

    >>> end_name((6, 2)), end_name("floor")
    ('(6,2)', 'floor')
    """
    return "(" + ",".join(map(str, end)) + ")" if isinstance(end, tuple) else str(end)


def contact_name(ends: Iterable[DiscId | str]) -> str:
    """The two ends of a contact.

    >>> contact_name([(6, 2), "floor"])
    '(6,2)-floor'
    """
    return "-".join(map(end_name, ends))
