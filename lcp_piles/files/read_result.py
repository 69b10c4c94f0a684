"""Reading result files back, formats lcp-piles/1 and lcp-piles/2 (notes/result-format.md).

Files are untrusted. Sizes are compared before anything is built, and every complaint names the
field. What a file says more than once has to agree with itself: what follows from the scene
(positions, ends, sizes) is compared with the scene, and what no file of the format has is refused.
The rest is a claim, and `verify` tells whether it is true.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ..errors import FileFormatError
from ..numbers.vectors import exact_vector
from ..scenes.scene import Scene
from ..scenes.symmetry import mirror, reduction
from ..solution.record import Record
from ..solution.solution import Solution, Solved, Unresolved, Unstable, Vector
from ..solution.stability import Stability
from .json_fields import (
    Entry,
    choice,
    count,
    field,
    id_entry,
    json_object,
    number,
    only,
    rows,
)
from .safe_read import read_text
from .scene_json import read_scene
from .write_result import AXES, FORMATS

_STATES = ("closed", "open", "osculatory")
_PARTS = ("whole", "even")
_STABLE = {"stable": True, "saddle": False, "neutral": False, "undecided": None}
_HEAD = ("format", "scene", "method", "exact", "status", "solver", "discs", "contacts")
_MORE = {"solved": ("stability", "forces_unique"), "unstable": ("collapse",), "unresolved": ()}
_SIZES = ("dof", "contacts", "whole_dof", "whole_contacts")
_SOLVER = ("arithmetic", "pivots", "seconds", "proof", "part", "guess_errors", *_SIZES)


def load(path: str | os.PathLike[str]) -> Solution:
    """Read a result file back. Raises `FileFormatError`, naming the field that is wrong.

    The solution is what the file says; `verify(solution.scene, solution)` tells whether it is one.
    """
    return loads(read_text(path))


def loads(text: str) -> Solution:
    """`load` for the text of a result file."""
    content = json_object(text)
    version = FORMATS.index(choice(content, "format", FORMATS)) + 1
    status = choice(content, "status", _MORE)
    only(content, (*_HEAD, *_MORE[status]))
    exact = field(content, "exact", bool)
    discs = rows(content, "discs", ("id", AXES[0]))
    contacts = rows(content, "contacts", ("a", "b"))
    scene = read_scene(field(content, "scene", dict), (len(discs), len(contacts)), version)
    record = _read_record(content, scene, exact)
    moved = [f"d{axis}" for axis in AXES[: scene.dimension]] if status == "solved" else []
    _check_discs(discs, scene, moved)
    _check_contacts(contacts, scene, status == "solved")
    if status == "unresolved":
        return Unresolved(scene, record)
    if status == "unstable":
        if not exact:
            raise FileFormatError("exact", exact, "true: a collapse is proved exactly")
        return Unstable(scene, record, exact_vector(_collapse(content, scene)))
    return _read_solved(content, scene, record, version)


def _check_discs(discs: list[Entry], scene: Scene, moved: list[str]) -> None:
    """That the rows are the discs of the scene."""
    axes = AXES[: scene.dimension]
    known = {"id", *axes, "fixed", *moved}
    for k, (row, disc) in enumerate(zip(discs, scene.discs, strict=True)):
        where = f"discs[{k}]"
        only(row, known, where)
        _same(row, "id", id_entry(disc.id), where)
        if field(row, "fixed", bool, where) != disc.fixed:
            raise FileFormatError(f"{where}.fixed", row["fixed"], f"{disc.fixed}, as in the scene")
        for axis, x in zip(axes, disc.position, strict=True):
            if number(row, axis, where, exact=True) != x:
                raise FileFormatError(f"{where}.{axis}", row[axis], f"{x}, as in the scene")


def _check_contacts(contacts: list[Entry], scene: Scene, solved: bool) -> None:
    """That the rows are the contacts of the scene."""
    known = {"a", "b", *(("force", "gap", "state", "gap_unique") if solved else ())}
    for k, (row, contact) in enumerate(zip(contacts, scene.contacts, strict=True)):
        only(row, known, f"contacts[{k}]")
        _same(row, "a", id_entry(contact.a), f"contacts[{k}]")
        _same(row, "b", id_entry(contact.b), f"contacts[{k}]")


def _same(row: Entry, name: str, expected: object, where: str) -> None:
    """That a field is the id expected: 1 is not true, nor 1.0."""
    if row.get(name) != expected or repr(row[name]) != repr(expected):
        raise FileFormatError(f"{where}.{name}", row.get(name), f"{expected!r}, as in the scene")


def _read_solved(content: Entry, scene: Scene, record: Record, version: int) -> Solved:
    exact = record.exact
    forces, gaps, states, unique = [], [], [], []
    for k, row in enumerate(content["contacts"]):
        where = f"contacts[{k}]"
        forces.append(number(row, "force", where, exact))
        gaps.append(number(row, "gap", where, exact))
        states.append(choice(row, "state", _STATES, where))
        unique.append("gap_unique" not in row or field(row, "gap_unique", bool, where))
    forces_unique = content.get("forces_unique")
    if forces_unique is not None:
        forces_unique = field(content, "forces_unique", bool)
    if not exact and (forces_unique is not None or "stability" in content or not all(unique)):
        raise FileFormatError("exact", False, "true, where stability or uniqueness is claimed")
    return Solved(
        scene,
        record,
        _vector(forces, exact),
        _vector(gaps, exact),
        _vector(_motion(content["discs"], "discs", scene, exact), exact),
        tuple(states),
        tuple(unique) if exact else (),
        forces_unique,
        _read_stability(content, version) if exact else None,
    )


def _collapse(content: Entry, scene: Scene) -> list[Any]:
    moved = [f"d{axis}" for axis in AXES[: scene.dimension]]
    found = rows(content, "collapse", ("id", *moved))
    if len(found) != len(scene.discs):
        raise FileFormatError("collapse", len(found), f"a list of {len(scene.discs)} entries")
    for k, (row, disc) in enumerate(zip(found, scene.discs, strict=True)):
        only(row, ("id", *moved), f"collapse[{k}]")
        _same(row, "id", id_entry(disc.id), f"collapse[{k}]")
    return _motion(found, "collapse", scene, exact=True)


def _motion(found: list[Entry], name: str, scene: Scene, exact: bool) -> list[Any]:
    """The displacement of every disc along every axis."""
    return [
        number(row, "d" + axis, f"{name}[{k}]", exact)
        for k, row in enumerate(found)
        for axis in AXES[: scene.dimension]
    ]


def _read_record(content: Entry, scene: Scene, exact: bool) -> Record:
    """How the result was made; sizes have to be those of the scene and the part solved."""
    solver = field(content, "solver", dict)
    only(solver, _SOLVER, "solver")
    solver = {"arithmetic": "exact" if exact else "float64", "part": "whole"} | solver
    arithmetic = field(solver, "arithmetic", str, "solver")
    if (arithmetic == "exact") != exact:
        expected = '"exact" exactly where the file says "exact": true'
        raise FileFormatError("solver.arithmetic", arithmetic, expected)
    part = choice(solver, "part", _PARTS, "solver")
    symmetry = None if part == "whole" else mirror(scene)
    if part != "whole" and symmetry is None:
        raise FileFormatError("solver.part", part, '"whole" for a scene without mirror symmetry')
    reduced = reduction(scene, part, symmetry)
    free = sum(h is None for disc in scene.discs for h in disc.held)
    sizes = (reduced.size, len(reduced.representative), free, len(scene.contacts))
    for name, size in zip(_SIZES, sizes, strict=True):
        if name in solver and count(solver, name, "solver") != size:
            raise FileFormatError(f"solver.{name}", solver[name], f"{size}, by the scene")
    seconds = number({"seconds": 0} | solver, "seconds", "solver", exact=False)
    if seconds < 0:
        raise FileFormatError("solver.seconds", seconds, "a time")
    return Record(
        field(content, "method", str),
        arithmetic,
        count({"pivots": 0} | solver, "pivots", "solver"),
        field({"proof": ""} | solver, "proof", str, "solver"),
        part,
        *sizes,
        float(seconds),
        count(solver, "guess_errors", "solver") if "guess_errors" in solver else None,
    )


def _read_stability(content: Entry, version: int) -> Stability:
    entry = field(content, "stability", dict)
    only(entry, ("mechanisms", "free", "stable", "verdict"), "stability")
    mechanisms = count(entry, "mechanisms", "stability")
    if version == 1:  # where both could be left out
        known = {True: "stable", False: "saddle"}.get(entry.get("stable") is True, "undecided")
        entry = {"verdict": known, "free": 0 if known == "stable" else mechanisms} | entry
    verdict = choice(entry, "verdict", _STABLE, "stability")
    if "stable" not in entry or entry["stable"] is not _STABLE[verdict]:
        expected = f"{_STABLE[verdict]}, by the verdict"
        raise FileFormatError("stability.stable", entry.get("stable"), expected)
    free = count(entry, "free", "stability")
    if free > mechanisms:
        raise FileFormatError("stability.free", free, f"at most {mechanisms}, the mechanisms")
    if verdict != "undecided" and (free == 0) != (verdict == "stable"):
        raise FileFormatError("stability.verdict", verdict, f"one that fits {free} free motions")
    return Stability(mechanisms, free, verdict)


def _vector(values: list[Any], exact: bool) -> Vector:
    return exact_vector(values) if exact else np.array(values, dtype=np.float64)
