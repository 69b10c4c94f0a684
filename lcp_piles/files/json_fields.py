"""Reading what JSON may hold, with an error that names the field where it does not.

Everything comes from an untrusted file. Nothing is evaluated: exact numbers go through the grammar
of `surd`.
"""

from __future__ import annotations

import gc
import json
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from math import isfinite
from typing import Any

from ..errors import FileFormatError, InputError
from ..numbers.exact import Surd, surd
from ..scenes.names import DiscId, disc_id

Entry = dict[str, Any]
_FEW = 100_000  # objects are read in no time, however short
_TYPES = {
    bool: "true or false",
    int: "a whole number",
    str: "a text",
    list: "a list",
    dict: "an object",
}


def json_object(text: str) -> Entry:
    """The object that a JSON text is, NaN and infinity refused.

    Refused before it is read is a text with more objects and lists than one of its length may hold:
    these, not their bytes, take time and memory. The shortest row of any file here, with a comma
    {"a":[1,1],"b":[2,1]}, is 22 characters for an object and two lists.
    """
    objects, lists = text.count("{"), text.count("[")
    for what, found, shortest in (
        ("objects", objects, 14),
        ("objects and lists", objects + lists, 7),
    ):
        most = _FEW + len(text) // shortest
        if found > most:
            expected = f"at most {most} in {len(text)} characters"
            raise FileFormatError(f"the number of {what} in the file", found, expected)
    try:
        with _no_collection():
            content = json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise FileFormatError("the file", text[:40], f"JSON, whole and valid ({error})") from error
    if not isinstance(content, dict):
        raise FileFormatError("the file", type(content).__name__, "a JSON object")
    return content


@contextmanager
def _no_collection() -> Iterator[None]:
    """Without the garbage collector, which would look through a million new objects many times.

    What is read has no cycles, so there is nothing for it to find.
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


def layout(content: Entry, indent: str = "") -> str:
    """An object as JSON text, one line an entry; of a list of objects, one line an object."""
    inner, lines = indent + "  ", []
    for key, value in content.items():
        if _are_rows(value):
            rows = ",\n".join(f"{inner}  {json.dumps(row)}" for row in value)
            text = f"[\n{rows}\n{inner}]"
        elif isinstance(value, dict) and any(map(_are_rows, value.values())):
            text = layout(value, inner)
        else:
            text = json.dumps(value)
        lines.append(f"{inner}{json.dumps(key)}: {text}")
    return "{\n" + ",\n".join(lines) + f"\n{indent}}}"


def field(entry: Entry, name: str, kind: type, where: str = "") -> Any:
    """The value of a field, of this type (bool, int, str, list or dict)."""
    value = entry.get(name)
    if type(value) is not kind:
        raise FileFormatError(_place(where, name), value, _TYPES[kind])
    return value


def count(entry: Entry, name: str, where: str = "") -> int:
    """The value of a field, a number of things."""
    value: int = field(entry, name, int, where)
    if not 0 <= value < 2**63:
        raise FileFormatError(_place(where, name), value, "a number of at least 0, in 64 bits")
    return value


def choice(entry: Entry, name: str, allowed: Collection[str], where: str = "") -> Any:
    """The value of a field, one of the words allowed."""
    value = entry.get(name)
    if not isinstance(value, str) or value not in allowed:
        raise FileFormatError(_place(where, name), value, "one of " + ", ".join(allowed))
    return value


def only(entry: Entry, known: Collection[str], where: str = "") -> None:
    """Refuse a field that the format does not have: nobody would check it."""
    for name in entry:
        if name not in known:
            raise FileFormatError(_place(where, name), entry[name], "no field of this name here")


def rows(entry: Entry, name: str, needed: Collection[str], where: str = "") -> list[Entry]:
    """The value of a field, a list of objects that all have the fields needed."""
    found: list[Entry] = field(entry, name, list, where)
    place = _place(where, name)
    for k, row in enumerate(found):
        if not isinstance(row, dict):
            raise FileFormatError(f"{place}[{k}]", row, "an object")
        for key in needed:
            if key not in row:
                raise FileFormatError(f"{place}[{k}].{key}", "missing", "a value")
    return found


def number(entry: Entry, name: str, where: str, exact: bool) -> Surd | float:
    """The value of a field: exact numbers as text, floating-point ones as finite JSON numbers."""
    value = entry.get(name)
    if exact:
        return exact_number(value, _place(where, name))
    if isinstance(value, int | float) and not isinstance(value, bool):
        with suppress(OverflowError):
            nearest = float(value)
            if isfinite(nearest):
                return nearest
    raise FileFormatError(_place(where, name), value, "a finite number")


def whole_or_exact(value: Any, where: str) -> Surd:
    """An exact number that a person wrote: as text, or a whole one as a JSON number."""
    return surd(value) if type(value) is int else exact_number(value, where)


def exact_number(value: Any, where: str) -> Surd:
    """An exact number from its text."""
    if isinstance(value, str):
        try:
            return surd(value)
        except InputError as error:
            raise FileFormatError(where, value, error.expected, error.remedy) from error
    raise FileFormatError(where, value, 'an exact number as text, such as "-7/3"')


def identity(value: Any, where: str) -> DiscId:
    """The id of a disc or the name of a support."""
    try:
        return disc_id(tuple(value) if isinstance(value, list) else value)
    except InputError as error:
        raise FileFormatError(where, value, error.expected) from error


def id_entry(id: DiscId) -> list[int | str] | int | str:
    """The id of a disc, or the name of a support, as JSON has it: a list for a tuple."""
    return list(id) if isinstance(id, tuple) else id


def _place(where: str, name: str) -> str:
    return f"{where}.{name}" if where else name


def _are_rows(value: object) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], dict)


def _refuse(text: str) -> None:
    raise ValueError(f"{text}, which is no JSON")
