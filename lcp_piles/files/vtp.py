"""A solution as a file of ParaView: VTK's XML PolyData, in text.

Points are the centres of all discs, then for every contact its two ends, centre and centre, or
centre and foot on the support. So every contact has points of its own, and a tube filter that
varies its radius by the scalar `force` of the points draws each as wide as its force; a sphere
glyph scaled by `radius` draws the discs, since ends of contacts have none.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.sax.saxutils import quoteattr

import numpy as np

from ..errors import InputError
from ..numbers.vectors import FloatArray, IntArray
from ..solution.solution import Solution
from .solution_tables import as_solved, contact_points, positions

STATES = ("open", "closed", "osculatory")
"""A state in the file is its number here."""


def vtp_text(solution: Solution) -> str:
    """The file of a solved scene: points with `force`, `radius` and `displacement`, and cells.

    Cells are a vertex a disc and a line a contact, with `force` (w), `gap` (w tau), `state` (0
    open, 1 closed, 2 osculatory; -1 for a disc), and `index`, the place in the scene's discs or
    contacts. Raises `InputError` for numbers beyond the range of floats.
    """
    solved = as_solved(solution)
    scene = solved.scene
    discs, contacts = len(scene.discs), len(scene.contacts)
    centres, motion = _in_space(positions(scene)), _in_space(solved.displacement_array)
    i, j = scene.ends
    far = np.where(j[:, None] >= 0, centres[j], _in_space(contact_points(scene)))
    ends = np.stack([centres[i], far], axis=1).reshape(-1, 3)
    moved = np.stack([motion[i], np.where(j[:, None] >= 0, motion[j], 0.0)], axis=1).reshape(-1, 3)
    forces, gaps = solved.force_array, solved.gap_array
    none = np.zeros(discs)
    radii = np.array([float(disc.radius) for disc in scene.discs])
    states = np.array([STATES.index(state) for state in solved.states], dtype=np.int64)
    points = [
        _array("force", np.concatenate([none, np.repeat(forces, 2)])),
        _array("radius", np.concatenate([radii, np.zeros(2 * contacts)])),
        _array("displacement", np.concatenate([motion, moved])),
    ]
    cells = [
        _array("force", np.concatenate([none, forces])),
        _array("gap", np.concatenate([none, gaps])),
        _array("state", np.concatenate([np.full(discs, -1), states])),
        _array("index", np.concatenate([np.arange(discs), np.arange(contacts)])),
    ]
    piece = (
        f'<Piece NumberOfPoints="{discs + 2 * contacts}" NumberOfVerts="{discs}" '
        f'NumberOfLines="{contacts}" NumberOfStrips="0" NumberOfPolys="0">'
    )
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
        "<PolyData>",
        piece,
        *_within('PointData Scalars="force"', points),
        *_within('CellData Scalars="force"', cells),
        *_within("Points", [_array("points", np.concatenate([centres, ends]))]),
        *_within("Verts", _connected(np.arange(discs), 1)),
        *_within("Lines", _connected(np.arange(discs, discs + 2 * contacts), 2)),
        "</Piece>",
        "</PolyData>",
        "</VTKFile>",
    ]
    return "\n".join(lines) + "\n"


def _in_space(vectors: FloatArray) -> FloatArray:
    """Vectors of any dimension with three components."""
    return np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))


def _within(tag: str, parts: Iterable[str]) -> Sequence[str]:
    return [f"<{tag}>", *parts, f"</{tag.split()[0]}>"]


def _connected(points: IntArray, size: int) -> list[str]:
    """Cells of so many points each, one after the other."""
    ends = np.arange(size, len(points) + 1, size)
    return [_array("connectivity", points), _array("offsets", ends)]


def _array(name: str, values: FloatArray | IntArray) -> str:
    if not np.isfinite(values).all():
        what = f"{name} of the solution"
        raise InputError(what, "beyond the range of floats", "finite numbers, to write them")
    kind = "Int64" if values.dtype.kind == "i" else "Float64"
    rows = values.reshape(len(values), -1)
    text = "\n".join(" ".join(map(repr, row)) for row in rows.tolist())
    head = f'<DataArray type="{kind}" Name={quoteattr(name)} NumberOfComponents="{rows.shape[1]}"'
    return f'{head} format="ascii">\n{text}\n</DataArray>'
