"""Writing result files, format lcp-piles/2 (notes/result-format.md), JSON with exact text.

Exact numbers are written as "-7/3" or "2 - 1/2*sqrt(3)", floating-point ones as JSON numbers.
"""

from __future__ import annotations

import os
from math import isfinite

from ..errors import InputError
from ..numbers.vectors import ExactVector
from ..solution.solution import Solution, Solved, Unstable, Vector
from .hex_vectors import vector_entry
from .json_fields import Entry, id_entry, layout
from .safe_write import check_ending, write_text
from .scene_json import scene_entry

FORMATS = ("lcp-piles/1", "lcp-piles/2")
"""What can be read; the last one is written."""
AXES = "xyz"
_LARGE = 2000  # contacts; from here on text in rows takes much longer than the vectors behind it


def save(solution: Solution, path: str | os.PathLike[str], *, compact: bool | None = None) -> None:
    """Write the result file of a solution (JSON); `load` reads it back.

    A file that stood there is replaced only once the new one is whole.

    Parameters
    ----------
    solution : Solved, Unstable or Unresolved
        What to write.
    path : str or path
        The file, which may end in .json or in nothing known.
    compact : bool, optional
        Whether an exact solution is written as vectors, and not in rows, a line for a disc and a
        contact with its numbers as people write them; by default where there are thousands of
        contacts.

    Raises
    ------
    InputError
        Where the path cannot be written, and for one that ends like another format.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from lcp_piles import load, nt60, solve
    >>> with TemporaryDirectory() as folder:
    ...     save(solve(nt60(2)), f"{folder}/pile.json", compact=True)
    ...     load(f"{folder}/pile.json").force((1, 1), (2, 2))
    sqrt(3)/3
    """
    check_ending(path, ".json")
    write_text(path, dumps(solution, compact=compact))


def dumps(solution: Solution, *, compact: bool | None = None) -> str:
    """The text of the result file, as for `save`."""
    return layout(to_json(solution, compact=compact)) + "\n"


def to_json(solution: Solution, *, compact: bool | None = None) -> Entry:
    """The content of a result file, as plain lists, dictionaries, text and numbers."""
    if compact is None:
        compact = len(solution.scene.contacts) > _LARGE
    scene, record = solution.scene, solution.record
    content: Entry = {
        "format": FORMATS[-1],
        "scene": scene_entry(scene),
        "method": record.method,
        "exact": solution.exact,
        "status": solution.status,
    }
    if solution.status == "solved" and solution.stability is not None:
        content["stability"] = {
            "mechanisms": solution.stability.mechanisms,
            "free": solution.stability.free,
            "stable": solution.stability.stable,
            "verdict": solution.stability.verdict,
        }
    if solution.status == "solved" and solution.forces_unique is not None:
        content["forces_unique"] = solution.forces_unique
    content["solver"] = {
        "arithmetic": record.arithmetic,
        "pivots": record.pivots,
        "proof": record.proof,
        "part": record.part,
        "dof": record.dof,
        "contacts": record.contacts,
        "whole_dof": record.whole_dof,
        "whole_contacts": record.whole_contacts,
    }
    if record.guess_errors is not None:
        content["solver"]["guess_errors"] = record.guess_errors
    if compact and solution.exact and solution.status != "unresolved":
        return content | {"vectors": _vectors(solution)}
    content["discs"] = _discs(solution)
    content["contacts"] = _contacts(solution)
    if solution.status == "unstable":
        content["collapse"] = [
            {"id": id_entry(disc.id), **_moved(solution.collapse, k, scene.dimension)}
            for k, disc in enumerate(scene.discs)
        ]
    return content


def _vectors(solution: Solved | Unstable) -> Entry:
    """What rows say, without what follows from scene, displacements and forces."""
    if isinstance(solution, Unstable):
        return {"collapse": vector_entry(solution.collapse)}
    u, f = solution.displacements, solution.forces
    assert isinstance(u, ExactVector)
    assert isinstance(f, ExactVector)  # the solution is exact
    several = [k for k, unique in enumerate(solution.gap_unique) if not unique]
    return {
        "displacements": vector_entry(u),
        "forces": vector_entry(f),
        "gaps_not_unique": several,
    }


def _discs(solution: Solution) -> list[Entry]:
    found = []
    for k, disc in enumerate(solution.scene.discs):
        entry: Entry = {"id": id_entry(disc.id)}
        entry |= {axis: str(x) for axis, x in zip(AXES, disc.position, strict=False)}
        entry["fixed"] = disc.fixed
        if solution.status == "solved":
            entry |= _moved(solution.displacements, k, solution.scene.dimension)
        found.append(entry)
    return found


def _contacts(solution: Solution) -> list[Entry]:
    found = []
    for k, contact in enumerate(solution.scene.contacts):
        entry: Entry = {"a": id_entry(contact.a), "b": id_entry(contact.b)}
        if solution.status == "solved":
            entry["force"] = _written(solution.forces, k)
            entry["gap"] = _written(solution.gaps, k)
            entry["state"] = solution.states[k]
            if solution.gap_unique and not solution.gap_unique[k]:
                entry["gap_unique"] = False
        found.append(entry)
    return found


def _moved(motion: Vector, disc: int, dimension: int) -> Entry:
    """dx, dy, ... of a disc."""
    return {"d" + AXES[a]: _written(motion, disc * dimension + a) for a in range(dimension)}


def _written(vector: Vector, k: int) -> str | float:
    if isinstance(vector, ExactVector):
        return str(vector[k])
    value = float(vector[k])
    if not isfinite(value):  # JSON has no such numbers
        raise InputError("a number of the solution", value, "a finite number, to write it")
    return value
