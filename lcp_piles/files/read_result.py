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
from ..solution.record import Record
from ..solution.solution import Solution, Solved, Unresolved, Unstable, Vector
from .json_fields import (
    Entry,
    choice,
    field,
    id_entry,
    json_object,
    number,
    only,
    rows,
)
from .read_claims import read_record, read_stability, read_uniqueness
from .read_vectors import read_vectors
from .safe_read import read_text
from .scene_json import read_scene
from .write_result import AXES, FORMATS

_STATES = ("closed", "open", "osculatory")
_HEAD = ("format", "scene", "method", "exact", "status", "solver", "discs", "contacts")
_MORE = {"solved": ("stability", "forces_unique"), "unstable": ("collapse",), "unresolved": ()}


def load(path: str | os.PathLike[str]) -> Solution:
    """Read a result file back.

    The solution is what the file says; `verify(solution.scene, solution)` tells whether it is one.

    Parameters
    ----------
    path : str or path
        The file, as `save` writes it.

    Returns
    -------
    Solved, Unstable or Unresolved
        The solution, with its scene.

    Raises
    ------
    FileFormatError
        For a file that cannot be read; it names the field that is wrong.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from lcp_piles import nt60, save, solve
    >>> with TemporaryDirectory() as folder:
    ...     save(solve(nt60(2)), f"{folder}/pile.json")
    ...     load(f"{folder}/pile.json").force((1, 1), (2, 2))
    sqrt(3)/3
    """
    return loads(read_text(path))


def loads(text: str) -> Solution:
    """`load` for the text of a result file."""
    content = json_object(text)
    version = FORMATS.index(choice(content, "format", FORMATS)) + 1
    status = choice(content, "status", _MORE)
    if version > 1 and "vectors" in content:
        return read_vectors(content, status)
    only(content, (*_HEAD, *_MORE[status]))
    exact = field(content, "exact", bool)
    discs = rows(content, "discs", ("id", AXES[0]))
    contacts = rows(content, "contacts", ("a", "b"))
    scene = read_scene(field(content, "scene", dict), (len(discs), len(contacts)), version)
    record = read_record(content, scene, exact)
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
    forces_unique = read_uniqueness(content)
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
        read_stability(content, version) if exact else None,
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


def _vector(values: list[Any], exact: bool) -> Vector:
    return exact_vector(values) if exact else np.array(values, dtype=np.float64)
