"""The certificate of a path: solutions at its corners, between which all is linear."""

from __future__ import annotations

from itertools import pairwise

from ..files.hex_vectors import vector_entry
from ..files.json_fields import Entry
from ..numbers.exact import ONE, ZERO, Surd
from ..numbers.vectors import ExactVector, combination, exact_vector
from ..push.path import Path, Segment
from .entries import FORMAT, certified_scene


def path_certificate(path: Path) -> Entry:
    """That the pieces of a path are solutions from one end to the other, and where they change."""
    first = path.segments[0]
    found: Entry = {"format": FORMAT, "claim": "path"}
    found["scene"] = certified_scene(first.system.scene)
    found["towards"] = certified_scene(first.other.scene)
    corners = [_corner(segment, t) for segment in path.segments for t in _ends(segment)]
    # Most pieces begin with the solution that the one before ends with.
    found["points"] = corners[:1] + [b for a, b in pairwise(corners) if a != b]
    last = path.segments[-1]
    if path.end == "asymptotic":
        near, far = (_vectors(last, last.first + t) for t in (ZERO, ONE))
        found["direction"] = {
            name: vector_entry(combination([(ONE, far[name]), (-ONE, near[name])])) for name in near
        }
    return found


def _ends(segment: Segment) -> list[Surd]:
    if segment.last is None or segment.last == segment.first:
        return [segment.first]
    return [segment.first, segment.last]


def _corner(segment: Segment, t: Surd) -> Entry:
    vectors = _vectors(segment, t)
    return {"t": str(t)} | {name: vector_entry(vector) for name, vector in vectors.items()}


def _vectors(segment: Segment, t: Surd) -> dict[str, ExactVector]:
    """Displacements and forces of the whole scene at a t of the piece."""
    state = segment.state(t)
    free = segment.system.whole_displacements(state.displacements, prescribed=False).plain()
    pairs = zip(segment.system.scene.discs, segment.other.scene.discs, strict=True)
    held = [
        ZERO if a is None or b is None else a + (b - a) * t
        for one, two in pairs
        for a, b in zip(one.held, two.held, strict=True)
    ]
    u = combination([(ONE, free), (ONE, exact_vector(held))])
    return {"u": u, "f": segment.system.whole_forces(state.forces).plain()}
