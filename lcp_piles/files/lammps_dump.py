"""A solution as LAMMPS would dump it: discs as atoms, contacts as local entries.

Discs are numbered from 1 in the scene's order, supports -1, -2, ... in theirs. Lengths are in
radii, forces in w, displacements and gaps in w tau.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..numbers.vectors import FloatArray
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .solution_tables import as_solved, normal_array, positions

_ROOM = 2.0


def atoms_text(solution: Solution) -> str:
    """The discs as `dump custom` writes atoms: `id type x y z radius ux uy uz`.

    Discs of type 2 have a prescribed motion, those of type 1 have none.
    """
    solved = as_solved(solution)
    scene = solved.scene
    types = [2 if any(h is not None for h in disc.held) else 1 for disc in scene.discs]
    rows = [
        [k + 1, types[k], *place, float(scene.discs[k].radius), *moved]
        for k, (place, moved) in enumerate(
            zip(_three(positions(scene)), _three(solved.displacement_array), strict=True)
        )
    ]
    return _snapshot(scene, "ATOMS", "id type x y z radius ux uy uz", rows)


def entries_text(solution: Solution) -> str:
    """The contacts as `dump local` writes entries: `index id1 id2 force fx fy fz gap`.

    fx, fy, fz is the force of the second end on the first.
    """
    solved = as_solved(solution)
    scene = solved.scene
    ends = np.where(scene.ends[1] >= 0, scene.ends[1] + 1, -1 - scene.support_of)
    vectors = _three(normal_array(scene) * solved.force_array[:, None])
    rows = [
        [k + 1, first + 1, second, force, *vector, gap]
        for k, (first, second, force, vector, gap) in enumerate(
            zip(
                scene.ends[0].tolist(),
                ends.tolist(),
                solved.force_array.tolist(),
                vectors,
                solved.gap_array.tolist(),
                strict=True,
            )
        )
    ]
    return _snapshot(scene, "ENTRIES", "index id1 id2 force fx fy fz gap", rows)


def _snapshot(scene: Scene, what: str, columns: str, rows: Iterable[Sequence[float]]) -> str:
    """A snapshot with its header."""
    places = np.array(_three(positions(scene)))
    low, high = places.min(axis=0) - _ROOM, places.max(axis=0) + _ROOM
    lines = [" ".join(map(repr, row)) for row in rows]
    return "\n".join(
        [
            "ITEM: TIMESTEP",
            "0",
            f"ITEM: NUMBER OF {what}",
            str(len(lines)),
            "ITEM: BOX BOUNDS ff ff ff",
            *(f"{a!r} {b!r}" for a, b in zip(low.tolist(), high.tolist(), strict=True)),
            f"ITEM: {what} {columns}",
            *lines,
            "",
        ]
    )


def _three(vectors: FloatArray) -> list[list[float]]:
    """Vectors of any dimension with three components."""
    padded: list[list[float]] = np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1]))).tolist()
    return padded
