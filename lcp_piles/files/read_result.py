"""Reading result files back, format lcp-piles/1.

Files are untrusted. Nothing in them is evaluated: numbers go through the grammar of
`exact.surd`, sizes are compared before anything is built, and every complaint names the field.
"""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import FileFormatError, InputError
from ..numbers.exact import Surd, surd
from ..numbers.vectors import exact_vector
from ..scenes.kinds import KINDS
from ..scenes.names import DiscId, disc_id
from ..scenes.scene import Contact, Disc, Scene
from ..solution.record import Record
from ..solution.solution import Solution, Solved, Unresolved, Unstable, Vector
from ..solution.stability import Stability
from .write_result import AXES, FORMAT, id_entry

MAX_BYTES = 4 * 2**30
_STATES = ("closed", "open", "osculatory")
_STATUSES = ("solved", "unstable", "unresolved")


def load(path: str | os.PathLike[str]) -> Solution:
    """Read a result file back. Raises `FileFormatError`, naming the field that is wrong.

    The solution is what the file says; `verify(solution.scene, solution)` tells whether it is one.
    """
    try:
        if Path(path).stat().st_size > MAX_BYTES:
            raise FileFormatError("the file", str(path), f"at most {MAX_BYTES} bytes")
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError("the file", str(path), f"a readable text file ({error})") from error
    return loads(text)


def loads(text: str) -> Solution:
    """`load` for the text of a result file."""
    try:
        content = json.loads(text, parse_int=_whole)
    except (ValueError, RecursionError) as error:
        raise FileFormatError("the file", text[:40], f"JSON, whole and valid ({error})") from error
    if not isinstance(content, dict):
        raise FileFormatError("the file", type(content).__name__, "a JSON object")
    if content.get("format") != FORMAT:
        raise FileFormatError(
            "format", content.get("format"), repr(FORMAT), "this version reads no other"
        )
    exact = _field(content, "exact", bool)
    status = _choice(content, "status", _STATUSES)
    discs = _field(content, "discs", list)
    contacts = _field(content, "contacts", list)
    scene = _read_scene(_field(content, "scene", dict), len(discs), len(contacts))
    if len(discs) != len(scene.discs):
        raise FileFormatError("discs", len(discs), f"a list of {len(scene.discs)} entries")
    if len(contacts) != len(scene.contacts):
        raise FileFormatError("contacts", len(contacts), f"a list of {len(scene.contacts)} entries")
    record = _read_record(content, exact)
    if status == "unresolved":
        return Unresolved(scene, record)
    if status == "unstable":
        if not exact:
            raise FileFormatError("exact", exact, "true: a collapse is proved exactly")
        rows = _field(content, "collapse", list)
        return Unstable(scene, record, exact_vector(_motion(scene, rows, "collapse", exact)))

    for k, disc in enumerate(scene.discs):
        where = f"discs[{k}]"
        for a, x in enumerate(disc.position):
            if _number(_entry(discs, k, "discs"), AXES[a], where, True) != x:
                raise FileFormatError(f"{where}.{AXES[a]}", discs[k][AXES[a]], str(x))
    displacements = _vector(_motion(scene, discs, "discs", exact), exact)
    forces, gaps, states, unique = [], [], [], []
    for k, contact in enumerate(scene.contacts):
        entry, where = _entry(contacts, k, "contacts"), f"contacts[{k}]"
        ends = (entry.get("a"), entry.get("b"))
        expected = (id_entry(contact.a), id_entry(contact.b))
        if ends != expected:
            raise FileFormatError(f"{where}.a and b", ends, f"{expected}, as in the scene")
        forces.append(_number(entry, "force", where, exact))
        gaps.append(_number(entry, "gap", where, exact))
        states.append(_choice(entry, "state", _STATES, where))
        unique.append(entry.get("gap_unique", True) is not False)
    return Solved(
        scene,
        record,
        _vector(forces, exact),
        _vector(gaps, exact),
        displacements,
        tuple(states),  # type: ignore[arg-type]
        tuple(unique) if exact else (),
        content.get("forces_unique") if isinstance(content.get("forces_unique"), bool) else None,
        _read_stability(content),
    )


def _read_scene(entry: dict[str, Any], discs: int, contacts: int) -> Scene:
    if "discs" in entry:
        return _read_custom(entry)
    kind = _field(entry, "kind", str, "scene")
    if kind not in KINDS:
        raise FileFormatError("scene.kind", kind, "one of " + ", ".join(KINDS))
    parameters = {name: value for name, value in entry.items() if name != "kind"}
    layers = parameters.get("layers")
    if not isinstance(layers, int) or isinstance(layers, bool) or layers > discs:
        raise FileFormatError("scene.layers", layers, f"a whole number, for {discs} discs")
    rows = layers * (layers + 1) // 2
    if discs < rows:  # the scene may not be larger than the file that asks for it
        raise FileFormatError("discs", discs, f"at least {rows} entries for {layers} layers")
    try:
        return KINDS[kind].scene(**parameters)
    except (InputError, TypeError) as error:
        raise FileFormatError("scene", parameters, f"parameters of {kind} ({error})") from error


def _read_custom(entry: dict[str, Any]) -> Scene:
    discs = []
    for k, _ in enumerate(_field(entry, "discs", list, "scene")):
        where = f"scene.discs[{k}]"
        row = _entry(entry["discs"], k, "scene.discs")
        discs.append(
            Disc(
                _id(row.get("id"), where + ".id"),
                _surds(row, "position", where),
                _surds(row, "load", where),
                tuple(
                    None if x is None else _surd(x, where + ".held")
                    for x in _field(row, "held", list, where)
                ),
            )
        )
    contacts = []
    for k, _ in enumerate(_field(entry, "contacts", list, "scene")):
        where = f"scene.contacts[{k}]"
        row = _entry(entry["contacts"], k, "scene.contacts")
        compliance = _surd(row.get("compliance"), where + ".compliance")
        if not compliance.is_rational:
            raise FileFormatError(where + ".compliance", str(compliance), "a rational number")
        contacts.append(
            Contact(
                _id(row.get("a"), where + ".a"),
                _id(row.get("b"), where + ".b"),
                _surds(row, "normal", where),
                compliance.rational(),
                _surd(row.get("gap"), where + ".gap"),
                _field(row, "bilateral", bool, where),
            )
        )
    try:
        return Scene(
            tuple(discs),
            tuple(contacts),
            tuple(entry.get("supports", ())),
            entry.get("geometric", False),
        )
    except InputError as error:
        raise FileFormatError("scene", "custom", f"a consistent scene ({error})") from error


def _read_record(content: dict[str, Any], exact: bool) -> Record:
    solver = _field(content, "solver", dict)
    numbers = {}
    for name in ("pivots", "dof", "contacts", "whole_dof", "whole_contacts"):
        value = solver.get(name, 0)
        if not isinstance(value, int) or isinstance(value, bool):
            raise FileFormatError("solver." + name, value, "a whole number")
        numbers[name] = value
    seconds = solver.get("seconds", 0.0)
    if not isinstance(seconds, int | float) or not math.isfinite(seconds):
        raise FileFormatError("solver.seconds", seconds, "a number")
    return Record(
        _field(content, "method", str),
        str(solver.get("arithmetic", "exact" if exact else "float64")),
        numbers["pivots"],
        str(solver.get("proof", "")),
        str(solver.get("part", "whole")),
        numbers["dof"],
        numbers["contacts"],
        numbers["whole_dof"],
        numbers["whole_contacts"],
        float(seconds),
    )


def _read_stability(content: dict[str, Any]) -> Stability | None:
    if "stability" not in content:
        return None
    entry = _field(content, "stability", dict)
    mechanisms = _field(entry, "mechanisms", int, "stability")
    stable = entry.get("stable")
    default = {True: "stable", False: "saddle"}.get(stable, "undecided")
    verdict = entry.get("verdict", default)
    if verdict not in ("stable", "saddle", "neutral", "undecided"):
        raise FileFormatError("stability.verdict", verdict, "stable, saddle, neutral or undecided")
    free = entry.get("free", mechanisms)
    if not isinstance(free, int):
        raise FileFormatError("stability.free", free, "a whole number")
    return Stability(mechanisms, free, verdict)


def _motion(scene: Scene, rows: list[Any], name: str, exact: bool) -> list[Any]:
    """dx, dy of every disc of the scene, in its order."""
    if len(rows) != len(scene.discs):
        raise FileFormatError(name, len(rows), f"a list of {len(scene.discs)} entries")
    values = []
    for k, disc in enumerate(scene.discs):
        row, where = _entry(rows, k, name), f"{name}[{k}]"
        if _id(row.get("id"), where + ".id") != disc.id:
            raise FileFormatError(
                where + ".id", row.get("id"), f"{id_entry(disc.id)}, as in the scene"
            )
        for a in range(scene.dimension):
            values.append(_number(row, "d" + AXES[a], where, exact))
    return values


def _vector(values: list[Any], exact: bool) -> Vector:
    return exact_vector(values) if exact else np.array(values, dtype=np.float64)


def _field(entry: dict[str, Any], name: str, kind: type, where: str = "") -> Any:
    value = entry.get(name)
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        place = f"{where}.{name}" if where else name
        raise FileFormatError(place, value, f"a value of type {kind.__name__}")
    return value


def _choice(entry: dict[str, Any], name: str, allowed: tuple[str, ...], where: str = "") -> str:
    value = entry.get(name)
    if value not in allowed:
        place = f"{where}.{name}" if where else name
        raise FileFormatError(place, value, "one of " + ", ".join(allowed))
    return str(value)


def _entry(rows: list[Any], k: int, name: str) -> dict[str, Any]:
    row = rows[k]
    if not isinstance(row, dict):
        raise FileFormatError(f"{name}[{k}]", row, "a JSON object")
    return row


def _number(entry: dict[str, Any], name: str, where: str, exact: bool) -> Surd | float:
    value = entry.get(name)
    if exact:
        return _surd(value, f"{where}.{name}")
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise FileFormatError(f"{where}.{name}", value, "a finite number")
    return float(value)


def _surd(value: Any, where: str) -> Surd:
    if not isinstance(value, str):
        raise FileFormatError(where, value, 'an exact number as text, such as "-7/3"')
    try:
        return surd(value)
    except InputError as error:
        raise FileFormatError(
            where, value, 'an exact number such as "-7/3" or "2 - 1/2*sqrt(3)"'
        ) from error


def _surds(entry: dict[str, Any], name: str, where: str) -> tuple[Surd, ...]:
    return tuple(_surd(x, f"{where}.{name}") for x in _field(entry, name, list, where))


def _id(value: Any, where: str) -> DiscId:
    try:
        return disc_id(tuple(value) if isinstance(value, list) else value)
    except InputError as error:
        raise FileFormatError(where, value, error.expected) from error


def _whole(text: str) -> int:
    if len(text) > 18:
        raise ValueError(f"a whole number of {len(text)} digits")
    return int(text)
