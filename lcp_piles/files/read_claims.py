"""What a result file says of a solution beside its numbers: how it was made, stability, uniqueness.

Sizes have to be those of the scene, and claims have to agree with each other; whether they are true
is for `verify`.
"""

from __future__ import annotations

from ..errors import FileFormatError
from ..scenes.scene import Scene
from ..scenes.symmetry import mirror, reduction
from ..solution.record import Record
from ..solution.stability import Stability
from .json_fields import Entry, choice, count, field, number, only

_PARTS = ("whole", "even")
_STABLE = {"stable": True, "saddle": False, "neutral": False, "undecided": None}
_SIZES = ("dof", "contacts", "whole_dof", "whole_contacts")
_SOLVER = ("arithmetic", "pivots", "seconds", "proof", "part", "guess_errors", *_SIZES)


def read_record(content: Entry, scene: Scene, exact: bool) -> Record:
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


def read_stability(content: Entry, version: int) -> Stability:
    """The stability that a file claims, which has to agree with itself."""
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


def read_uniqueness(content: Entry) -> bool | None:
    """Whether the forces are said to be unique; None where nothing is said."""
    if content.get("forces_unique") is None:
        return None
    return bool(field(content, "forces_unique", bool))
