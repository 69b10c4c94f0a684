"""Scenes in JSON: a kind with its parameters, or discs and contacts written out."""

from __future__ import annotations

from typing import Any

from ..errors import FileFormatError, InputError
from ..numbers.exact import Surd, surd
from ..scenes.kinds import KINDS
from ..scenes.scene import Contact, Disc, Scene
from .json_fields import (
    Entry,
    choice,
    exact_number,
    field,
    id_entry,
    identity,
    only,
    rows,
)

_DISC = ("id", "position", "load", "held")
_CONTACT = ("a", "b", "normal", "compliance", "gap", "bilateral")


def scene_entry(scene: Scene) -> Entry:
    """Kind and parameters where these make the scene; else the scene is written out."""
    if scene.origin is not None:
        kind, values = scene.origin.kind, scene.origin.parameters
        named: Entry = {"kind": kind.name}
        return named | {name: kind.parameter(name).write(value) for name, value in values}
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


def read_scene(entry: Entry, discs: int, contacts: int, version: int) -> Scene:
    """The scene of an entry, which must have so many discs and contacts.

    A kind tells the size of a scene beforehand, and nothing is built that has another one: a scene
    may not be larger than the file that asks for it. Version 1 knew no `supports`, these are the
    ends of contacts that are text; and it did not check normals against the centres, so where these
    disagree the scene has no geometry.
    """
    if "discs" not in entry:
        return _of_a_kind(entry, discs, contacts)
    for name, length in (("discs", discs), ("contacts", contacts)):
        if len(field(entry, name, list, "scene")) != length:
            found = len(entry[name])
            raise FileFormatError(f"scene.{name}", found, f"a list of {length} entries, as above")
    parts = (_discs(entry), _contacts(entry))
    if version > 1:
        only(entry, ("supports", "geometric", "discs", "contacts"), "scene")
        supports = field(entry, "supports", list, "scene")
        return _scene(*parts, supports, field(entry, "geometric", bool, "scene"))
    only(entry, ("kind", "discs", "contacts"), "scene")
    supports = list(dict.fromkeys(c.b for c in parts[1] if isinstance(c.b, str)))
    try:
        return _scene(*parts, supports, geometric=True)
    except FileFormatError:
        return _scene(*parts, supports, geometric=False)


def _of_a_kind(entry: Entry, discs: int, contacts: int) -> Scene:
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
    for name, found, size in zip(
        ("discs", "contacts"), (discs, contacts), kind.size(**values), strict=True
    ):
        if found != size:
            raise FileFormatError(name, found, f"a list of {size} entries for this scene")
    return kind.scene(**values)


def _discs(entry: Entry) -> list[Disc]:
    found = []
    for k, row in enumerate(rows(entry, "discs", _DISC, "scene")):
        where = f"scene.discs[{k}]"
        only(row, _DISC, where)
        held = [
            None if x is None else exact_number(x, f"{where}.held")
            for x in field(row, "held", list, where)
        ]
        found.append(
            Disc(
                identity(row["id"], f"{where}.id"),
                _vector(row, "position", where),
                _vector(row, "load", where),
                tuple(held),
            )
        )
    return found


def _contacts(entry: Entry) -> list[Contact]:
    found = []
    for k, row in enumerate(rows(entry, "contacts", _CONTACT, "scene")):
        where = f"scene.contacts[{k}]"
        only(row, _CONTACT, where)
        compliance = exact_number(row["compliance"], f"{where}.compliance")
        if not compliance.is_rational:
            raise FileFormatError(f"{where}.compliance", str(compliance), "a rational number")
        found.append(
            Contact(
                identity(row["a"], f"{where}.a"),
                identity(row["b"], f"{where}.b"),
                _vector(row, "normal", where),
                compliance.rational(),
                exact_number(row["gap"], f"{where}.gap"),
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


def _vector(entry: Entry, name: str, where: str) -> tuple[Surd, ...]:
    return tuple(exact_number(x, f"{where}.{name}") for x in field(entry, name, list, where))
