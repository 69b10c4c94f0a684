"""Scenes in JSON: a kind with its parameters, or discs and contacts written out."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..errors import FileFormatError, InputError
from ..numbers.exact import Surd, surd
from ..scenes.kind import Kind
from ..scenes.kinds import KINDS
from ..scenes.scene import Contact, Disc, Scene
from .json_fields import (
    Entry,
    choice,
    field,
    id_entry,
    identity,
    only,
    rows,
    whole_or_exact,
)

_DISC = ("id", "position", "load", "held")
_RADIUS = "radius"
"""Of a disc: left out where it is 1."""
_CONTACT = ("a", "b", "normal", "compliance", "gap", "bilateral")
_DEFAULTS: Entry = {"compliance": 1, "gap": 0, "bilateral": False}
_LISTS = ("discs", "contacts")
MOST_DISCS = 100_000
"""Discs that a scene file may ask for by a kind and its parameters."""


def scene_entry(scene: Scene) -> Entry:
    """Kind and parameters where these make the scene; else the scene is written out."""
    if scene.origin is not None:
        kind, values = scene.origin.kind, scene.origin.parameters
        named: Entry = {"kind": kind.name}
        return named | {name: kind.parameter(name).write(value) for name, value in values}
    return full_entry(scene)


def full_entry(scene: Scene) -> Entry:
    """A scene written out, wherever it comes from."""
    return {
        "supports": list(scene.supports),
        "geometric": scene.geometric,
        "discs": [
            {
                "id": id_entry(disc.id),
                "position": [str(x) for x in disc.position],
                "load": [str(x) for x in disc.load],
                "held": [None if x is None else str(x) for x in disc.held],
            }
            | ({} if disc.radius == 1 else {_RADIUS: str(surd(disc.radius))})
            for disc in scene.discs
        ],
        "contacts": [
            {
                "a": id_entry(contact.a),
                "b": id_entry(contact.b),
                "normal": [str(x) for x in contact.normal],
                "compliance": str(surd(contact.compliance)),
                "gap": str(contact.gap),
                "bilateral": contact.bilateral,
            }
            for contact in scene.contacts
        ],
    }


def read_scene(entry: Entry, size: tuple[int, int], version: int) -> Scene:
    """The scene of a result file, which must have so many discs and contacts.

    A kind tells the size of a scene beforehand, and nothing is built that has another one: a scene
    may not be larger than the file that asks for it. Version 1 knew no `supports`, these are the
    ends of contacts that are text; and it did not check normals against the centres, so where these
    disagree the scene has no geometry.
    """
    if "discs" not in entry:
        kind, values = _kind_and_values(entry)
        for name, found, needed in zip(_LISTS, size, kind.size(**values), strict=True):
            if found != needed:
                raise FileFormatError(name, found, f"a list of {needed} entries for this scene")
        return kind.scene(**values)
    for name, length in zip(_LISTS, size, strict=True):
        if len(field(entry, name, list, "scene")) != length:
            found = len(entry[name])
            raise FileFormatError(f"scene.{name}", found, f"a list of {length} entries, as above")
    if version > 1:
        return _written_out(entry)
    parts = (_discs(entry), _contacts(entry))
    only(entry, ("kind", "discs", "contacts"), "scene")
    supports = list(dict.fromkeys(c.b for c in parts[1] if isinstance(c.b, str)))
    try:
        return _scene(*parts, supports, geometric=True)
    except FileFormatError:
        return _scene(*parts, supports, geometric=False)


def read_scene_within(entry: Entry, discs: int, contacts: int) -> Scene:
    """The scene of a file with vectors, of at most so many discs and contacts.

    More than that cannot fit what the file says of them, and is not built.
    """
    if "discs" not in entry:
        kind, values = _kind_and_values(entry)
        for name, most, needed in zip(_LISTS, (discs, contacts), kind.size(**values), strict=True):
            if needed > most:
                raise FileFormatError(f"scene.{name}", needed, f"at most {most}, by the vectors")
        return kind.scene(**values)
    return _written_out(entry)


def read_lone_scene(entry: Entry) -> Scene:
    """The scene of a file that holds nothing else, where what has a default may be left out.

    Nothing there tells how large a scene of a kind should be, so there is a limit.
    """
    if "discs" not in entry:
        kind, values = _kind_and_values(entry)
        discs, _ = kind.size(**values)
        if discs > MOST_DISCS:
            raise FileFormatError(
                f"the number of discs of {kind.name}",
                discs,
                f"at most {MOST_DISCS} in a scene file of a few words",
                "build a larger one from its kind, in Python or on the command line",
            )
        return kind.scene(**values)
    contacts = [_DEFAULTS | row for row in rows(entry, "contacts", (), "scene")]
    return _written_out({"supports": ["floor"], "geometric": True} | entry | {"contacts": contacts})


def _kind_and_values(entry: Entry) -> tuple[Kind, dict[str, Any]]:
    kind = KINDS[choice(entry, "kind", KINDS, "scene")]
    only(entry, ("kind", *(parameter.name for parameter in kind.parameters)), "scene")
    values = {}
    for parameter in kind.parameters:
        given = entry.get(parameter.name, parameter.default)
        try:
            values[parameter.name] = parameter.check(given)
        except InputError as error:
            where = f"scene.{parameter.name}"
            raise FileFormatError(where, given, error.expected, error.remedy) from error
    return kind, values


def _written_out(entry: Entry) -> Scene:
    """A scene of version 2 with all its discs and contacts."""
    parts = (_discs(entry), _contacts(entry))
    only(entry, ("supports", "geometric", *_LISTS), "scene")
    supports = field(entry, "supports", list, "scene")
    return _scene(*parts, supports, field(entry, "geometric", bool, "scene"))


def _discs(entry: Entry) -> list[Disc]:
    found = []
    for k, row in enumerate(rows(entry, "discs", _DISC, "scene")):
        where = f"scene.discs[{k}]"
        only(row, (*_DISC, _RADIUS), where)
        held = [
            None if x is None else whole_or_exact(x, f"{where}.held")
            for x in field(row, "held", list, where)
        ]
        radius = _rational(row.get(_RADIUS, 1), f"{where}.{_RADIUS}")
        if radius <= 0:
            raise FileFormatError(f"{where}.{_RADIUS}", radius, "a positive number")
        found.append(
            Disc(
                identity(row["id"], f"{where}.id"),
                _vector(row, "position", where),
                _vector(row, "load", where),
                tuple(held),
                radius,
            )
        )
    return found


def _contacts(entry: Entry) -> list[Contact]:
    found = []
    for k, row in enumerate(rows(entry, "contacts", _CONTACT, "scene")):
        where = f"scene.contacts[{k}]"
        only(row, _CONTACT, where)
        found.append(
            Contact(
                identity(row["a"], f"{where}.a"),
                identity(row["b"], f"{where}.b"),
                _vector(row, "normal", where),
                _rational(row["compliance"], f"{where}.compliance"),
                whole_or_exact(row["gap"], f"{where}.gap"),
                field(row, "bilateral", bool, where),
            )
        )
    return found


def _scene(
    discs: list[Disc], contacts: list[Contact], supports: list[Any], geometric: bool
) -> Scene:
    try:
        return Scene(tuple(discs), tuple(contacts), tuple(supports), geometric)
    except InputError as error:
        raise FileFormatError("scene", "written out", f"a consistent scene ({error})") from error


def _rational(value: Any, where: str) -> Fraction:
    number = whole_or_exact(value, where)
    if not number.is_rational:
        raise FileFormatError(where, str(number), "a rational number")
    return number.rational()


def _vector(entry: Entry, name: str, where: str) -> tuple[Surd, ...]:
    return tuple(whole_or_exact(x, f"{where}.{name}") for x in field(entry, name, list, where))
