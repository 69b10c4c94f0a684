"""Writing result files, format lcp-piles/1: JSON with exact numbers as text.

Exact numbers are written as "-7/3" or "2 - 1/2*sqrt(3)", floating-point ones as JSON numbers.
"""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..numbers.exact import surd
from ..numbers.vectors import ExactVector
from ..scenes.names import DiscId
from ..scenes.scene import Scene
from ..solution.solution import Solution, Vector

FORMAT = "lcp-piles/1"
AXES = "xyz"


def to_json(solution: Solution) -> dict[str, Any]:
    """The content of a result file, as plain lists, dictionaries, text and numbers."""
    scene, record = solution.scene, solution.record
    dimension = scene.dimension
    solved = solution if solution.status == "solved" else None
    discs = []
    for k, disc in enumerate(scene.discs):
        entry: dict[str, Any] = {"id": id_entry(disc.id)}
        entry |= {AXES[a]: str(x) for a, x in enumerate(disc.position)}
        entry["fixed"] = disc.fixed
        if solved:
            for a in range(dimension):
                entry["d" + AXES[a]] = _written(solved.displacements, k * dimension + a)
        discs.append(entry)
    contacts = []
    for k, contact in enumerate(scene.contacts):
        entry = {"a": id_entry(contact.a), "b": id_entry(contact.b)}
        if solved:
            entry["force"] = _written(solved.forces, k)
            entry["gap"] = _written(solved.gaps, k)
            entry["state"] = solved.states[k]
            if solved.gap_unique and not solved.gap_unique[k]:
                entry["gap_unique"] = False
        contacts.append(entry)
    content: dict[str, Any] = {
        "format": FORMAT,
        "scene": scene_entry(scene),
        "method": record.method,
        "exact": solution.exact,
        "status": solution.status,
    }
    if solved and solved.stability is not None:
        content["stability"] = {
            "mechanisms": solved.stability.mechanisms,
            "free": solved.stability.free,
            "stable": solved.stability.stable,
            "verdict": solved.stability.verdict,
        }
    if solved and solved.forces_unique is not None:
        content["forces_unique"] = solved.forces_unique
    content["solver"] = {
        "arithmetic": record.arithmetic,
        "pivots": record.pivots,
        "seconds": round(record.seconds, 6),
        "proof": record.proof,
        "part": record.part,
        "dof": record.dof,
        "contacts": record.contacts,
        "whole_dof": record.whole_dof,
        "whole_contacts": record.whole_contacts,
    }
    content["discs"] = discs
    content["contacts"] = contacts
    if solution.status == "unstable":
        content["collapse"] = [
            {"id": id_entry(disc.id)}
            | {
                "d" + AXES[a]: _written(solution.collapse, k * dimension + a)
                for a in range(dimension)
            }
            for k, disc in enumerate(scene.discs)
        ]
    return content


def save(solution: Solution, path: str | os.PathLike[str]) -> None:
    """Write the result file of a solution (JSON); `load` reads it back.

    A file that stood there is replaced only once the new one is whole. Raises `InputError` where
    the path cannot be written.
    """
    write_text(path, dumps(solution))


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a text file, whole or not at all."""
    target = Path(path)
    try:
        if target.exists() and not target.is_file():  # a device such as /dev/null
            target.write_text(text, encoding="utf-8")
            return
        handle, name = tempfile.mkstemp(dir=target.parent, prefix="." + target.name)
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text)
            os.chmod(name, 0o644)
            os.replace(name, target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise InputError("the file to write", str(path), f"a writable path ({error})") from error


def dumps(solution: Solution) -> str:
    """The text of the result file: one line a disc and a contact."""
    content = to_json(solution)
    lines = []
    for key, value in content.items():
        if isinstance(value, list):
            rows = ",\n".join("    " + json.dumps(row) for row in value)
            lines.append(f"  {json.dumps(key)}: [\n{rows}\n  ]")
        else:
            lines.append(f"  {json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def scene_entry(scene: Scene) -> dict[str, Any]:
    """Kind and parameters; an own scene is written out, since nothing else could rebuild it."""
    if scene.origin is not None:
        kind, values = scene.origin.kind, scene.origin.parameters
        named: dict[str, Any] = {"kind": kind.name}
        return named | {name: kind.parameter(name).write(value) for name, value in values}
    entry: dict[str, Any] = {"supports": list(scene.supports), "geometric": scene.geometric}
    entry["discs"] = [
        {
            "id": id_entry(disc.id),
            "position": [str(x) for x in disc.position],
            "load": [str(x) for x in disc.load],
            "held": [None if x is None else str(x) for x in disc.held],
        }
        for disc in scene.discs
    ]
    entry["contacts"] = [
        {
            "a": id_entry(contact.a),
            "b": id_entry(contact.b),
            "normal": [str(x) for x in contact.normal],
            "compliance": str(surd(contact.compliance)),
            "gap": str(contact.gap),
            "bilateral": contact.bilateral,
        }
        for contact in scene.contacts
    ]
    return entry


def _written(vector: Vector, k: int) -> str | float:
    return str(vector[k]) if isinstance(vector, ExactVector) else float(vector[k])


def id_entry(id: DiscId) -> list[int | str] | int | str:
    """The id of a disc, or the name of a support, as JSON has it: a list for a tuple."""
    return list(id) if isinstance(id, tuple) else id
