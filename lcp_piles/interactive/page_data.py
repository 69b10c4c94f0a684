"""What the interactive page knows, as plain values that JSON can hold.

Numbers are there twice: as floats of 32 bits, to be drawn, and as exact text, to be read. The text
of the solution is always whole. Along a path it is kept from the start as far as `ROOM` goes: the
numbers of a large pile have hundreds of digits, and there are a million of them. The pieces that
have all their text, the first `whole` ones, have displacements too.

Forces are continuous along the path, so they have a column a corner: the first t of every piece,
and the end of the last. Gaps and displacements need not be (a mechanism may be held by another
contact in the next piece): they have two columns a piece, its two ends.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from ..errors import InputError
from ..fields.base_pressure import base_parts, base_pressure
from ..friction.force_bounds import ContactBounds
from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import ExactVector, FloatArray, exact_vector
from ..push.path import END_IN_WORDS, Path
from ..push.push_path import PushPath
from ..scenes.names import contact_name, end_name
from ..scenes.scene import Scene
from ..solution.describe import brief
from ..solution.solution import Solution, Vector, as_floats

ROOM = 600_000
"""Characters of exact numbers that are kept of a path."""


class Texts:
    """A table of the different texts, to be named by their numbers in it."""

    def __init__(self) -> None:
        self.table: dict[str, int] = {}
        self.size = 0

    def numbers(self, values: Sequence[Any] | Vector) -> list[int]:
        """The numbers of the texts of all entries; new ones are put into the table."""
        found = []
        for text in map(str, values):
            if text not in self.table:
                self.table[text] = len(self.table)
                self.size += len(text)
            found.append(self.table[text])
        return found

    def grown(self, vectors: Sequence[Vector]) -> int:
        """The size that the table would have with the entries of these vectors too."""
        new = {text for vector in vectors for text in map(str, vector)} - self.table.keys()
        return self.size + sum(map(len, new))


def page_data(
    solution: Solution,
    push: PushPath | None = None,
    bounds: ContactBounds | None = None,
    progress: Callable[[str], None] | None = None,
) -> dict[str, Any]:
    """Everything that the page shows; scenes that are not plane or do not agree: `InputError`."""
    scene = solution.scene
    if scene.dimension != 2:
        raise InputError("the number of axes", scene.dimension, "2: only plane scenes are shown")
    for what, other in (("push", push), ("bounds", bounds)):
        if other is not None and other.scene != scene:
            raise InputError(f"the scene of `{what}`", other.scene, "that of the solution")
    texts = Texts()
    base = [(scene.disc_index(disc), parts) for disc, parts in base_parts(scene)]
    names = ["force", "gap", "shift", "base"]
    start = [solution.forces, solution.gaps, solution.displacements, _on_base(solution)]
    verdict = solution.stability.verdict if solution.stability else ""
    return {
        "title": brief(scene),
        "verdict": verdict,
        "exact": solution.exact,
        "discs": _discs(scene),
        "contacts": _contacts(scene),
        "base": [[disc, [[k, float(w)] for k, w in parts]] for disc, parts in base],
        "start": {
            name: {"text": [texts.numbers(vector)], **_floats([vector])}
            for name, vector in zip(names, start, strict=True)
        },
        "path": None if push is None else _path(push, base, texts, progress),
        "bounds": None if bounds is None else _bounds(bounds, texts),
        "texts": list(texts.table),
    }


def _discs(scene: Scene) -> list[list[Any]]:
    """Name, place, radius and whether a motion is prescribed."""
    return [
        [
            end_name(d.id),
            *(float(x) for x in d.position),
            float(d.radius),
            int(d.held != (None, None)),
        ]
        for d in scene.discs
    ]


def _contacts(scene: Scene) -> list[list[Any]]:
    """Name, number of disc a and of disc b (-1 and below: of a support), normal from b to a."""
    a, b = scene.ends
    others = np.where(b < 0, -1 - scene.support_of, b).tolist()
    ends = zip(scene.contacts, a.tolist(), others, strict=True)
    return [[contact_name((c.a, c.b)), i, j, *(float(n) for n in c.normal)] for c, i, j in ends]


Base = list[tuple[int, list[tuple[int, Surd]]]]
"""Discs by number, each with the contacts below it and their normals' part downwards."""


def _on_base(solution: Solution) -> Vector:
    normal = [place.normal for place in base_pressure(solution)]
    if not solution.exact:
        return np.array(normal, dtype=np.float64)
    return exact_vector([n for n in normal if isinstance(n, Surd)])


def _path(
    push: PushPath, base: Base, texts: Texts, progress: Callable[[str], None] | None
) -> dict[str, Any]:
    corners, forces, gaps, shifts = _columns(push.path, progress)
    pushes = [push.start + t * push.unit for t in corners]
    pressed = [
        exact_vector([sum((w * f[k] for k, w in parts), ZERO) for _, parts in base]) for f in forces
    ]
    changes = {b.t: b for b in push.path.breakpoints}
    text: dict[str, list[list[int]]] = {
        "force": [texts.numbers(forces[0])],
        "base": [texts.numbers(pressed[0])],
        "gap": [],
        "shift": [],
    }
    whole, most = 0, texts.size + ROOM
    for ends in ((2 * k, 2 * k + 1) for k in range(len(push.path.segments))):
        added = [
            ("force", forces[whole + 1]),
            ("base", pressed[whole + 1]),
            *(("gap", gaps[k]) for k in ends),
            *(("shift", shifts[k]) for k in ends),
        ]
        if texts.grown([vector for _, vector in added]) > most:
            break
        for name, vector in added:
            text[name].append(texts.numbers(vector))
        whole += 1
    series = {"force": forces, "base": pressed, "gap": gaps, "shift": shifts[: 2 * whole]}
    return {
        "push": {"text": [texts.numbers(pushes)], **_floats([exact_vector(pushes)])},
        "changes": [
            [list(changes[t].opens), list(changes[t].closes)] if t in changes else [[], []]
            for t in corners
        ],
        "whole": whole,
        "end": END_IN_WORDS[push.end],
        **{name: {"text": text[name], **_floats(series[name])} for name in series},
    }


def _columns(
    path: Path, progress: Callable[[str], None] | None
) -> tuple[list[Surd], list[ExactVector], list[ExactVector], list[ExactVector]]:
    """The corners of the path in t; the forces there; gaps and displacements at ends of pieces.

    An endless last piece is shown for a tenth of the way, and one more unit.
    """
    corners = [piece.first for piece in path.segments]
    last = path.segments[-1].last
    corners.append(last if last is not None else corners[-1] * Fraction(11, 10) + 1)
    forces: list[ExactVector] = []
    gaps: list[ExactVector] = []
    shifts: list[ExactVector] = []
    for k, piece in enumerate(path.segments):
        if progress is not None:
            progress(f"piece {k + 1} of {len(path.segments)} for the page")
        for t in corners[k : k + 2]:
            state, system = piece.state(t), piece.system
            if len(forces) <= k or k == len(path.segments) - 1:
                forces.append(system.whole_forces(state.forces))
            gaps.append(system.whole_gaps(state.gaps))
            shifts.append(system.whole_displacements(state.displacements))
    return corners, forces, gaps, shifts


def _bounds(bounds: ContactBounds, texts: Texts) -> dict[str, Any]:
    return {
        "mu": str(bounds.mu),
        "rough": list(bounds.rough),
        "least": texts.numbers(bounds.least),
        "largest": texts.numbers(["no largest" if x is None else f"{x} w" for x in bounds.largest]),
    }


def _floats(columns: Sequence[Vector]) -> dict[str, Any]:
    """Vectors as floats of 32 bits: the different rows in base 64, and which row an entry has."""
    if not columns:
        return {"columns": 0, "rows": "", "of": []}
    exact: FloatArray = np.stack([as_floats(vector) for vector in columns], axis=1)
    with np.errstate(over="ignore"):
        short = exact.astype("<f4")
    if not np.isfinite(short).all() or ((short == 0) != (exact == 0)).any():
        raise InputError("a number", "beyond the range of short floats", "numbers to be drawn")
    rows, of = np.unique(short, axis=0, return_inverse=True)
    return {
        "columns": len(columns),
        "rows": b64encode(rows.astype("<f4").tobytes()).decode("ascii"),
        "of": of.ravel().tolist(),
    }
