"""Reading the compact form of result files: displacements and forces as vectors.

Gaps and states follow from them and the scene, and are not in the file.
"""

from __future__ import annotations

import numpy as np

from ..errors import FileFormatError
from ..solution.identities import gaps_of
from ..solution.solution import Solution, Solved, Unstable, states_of
from .hex_vectors import length_of, read_vector
from .json_fields import Entry, field, only
from .read_claims import read_record, read_stability, read_uniqueness
from .scene_json import read_scene_within

_HEAD = ("format", "scene", "method", "exact", "status", "solver", "vectors")
_MORE = {"solved": ("stability", "forces_unique"), "unstable": (), "unresolved": ()}
_VECTORS = {"solved": ("displacements", "forces"), "unstable": ("collapse",)}
_SEVERAL = "gaps_not_unique"
_MOST_CONTACTS = 12  # that a disc may have in the kinds of scenes


def read_vectors(content: Entry, status: str) -> Solution:
    """The solution of a file in the compact form, where gaps and states follow from the rest."""
    only(content, (*_HEAD, *_MORE[status]))
    if status not in _VECTORS or not field(content, "exact", bool):
        raise FileFormatError("vectors", f"of {status}", "those of an exact answer")
    vectors = field(content, "vectors", dict)
    only(vectors, (*_VECTORS[status], *([_SEVERAL] if status == "solved" else [])), "vectors")
    entries = [field(vectors, name, dict, "vectors") for name in _VECTORS[status]]
    where = [f"vectors.{name}" for name in _VECTORS[status]]
    places, *rest = map(length_of, entries, where)
    # A scene is not built where it is larger than its vectors; a collapse has none of contacts.
    contacts = rest[0] if rest else _MOST_CONTACTS * places
    scene = read_scene_within(field(content, "scene", dict), places, contacts)
    sizes = (len(scene.discs) * scene.dimension, len(scene.contacts))
    found = list(map(read_vector, entries, sizes, where))
    record = read_record(content, scene, exact=True)
    if status == "unstable":
        return Unstable(scene, record, found[0])
    u, f = found
    gaps = gaps_of(scene, u, f)
    unique = np.ones(len(scene.contacts), dtype=bool)
    for k in field(vectors, _SEVERAL, list, "vectors"):
        if type(k) is not int or not 0 <= k < len(unique):
            raise FileFormatError(f"vectors.{_SEVERAL}", k, "the number of a contact")
        unique[k] = False
    return Solved(
        scene,
        record,
        f,
        gaps,
        u,
        states_of(f, gaps),
        tuple(unique.tolist()),
        read_uniqueness(content),
        read_stability(content, version=2),
    )
