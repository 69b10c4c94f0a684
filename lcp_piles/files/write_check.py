"""A check as JSON, format lcp-piles-check/1: floats as numbers, null where there is none."""

from __future__ import annotations

from math import isfinite

import numpy as np

from ..checking.check import Check
from ..checking.conclusions import conclusions
from ..numbers.vectors import FloatArray
from ..packings.packing import Packing
from .json_fields import Entry, id_entry
from .scene_json import scene_entry


def check_entry(check: Check) -> Entry:
    """Verdict, norms and conclusions, then every contact with both forces, in the scene's order."""
    reference = check.reference
    wrong = set(check.wrong.tolist())
    states = getattr(check.solution, "states", None)
    contacts = []
    for k in range(len(reference.a)):
        a, b = reference.ends(k)
        contacts.append(
            {
                "a": id_entry(a),
                "b": id_entry(b),
                "given": _number(check.given[k]),
                "expected": _number(check.expected[k]),
                "difference": _number(check.difference[k]),
                "present": bool(check.present[k]),
                "state": states[k] if states else None,
                "wrong": k in wrong,
            }
        )
    return {
        "format": "lcp-piles-check/1",
        "scene": None if isinstance(check.scene, Packing) else scene_entry(check.scene),
        "packing": repr(check.scene) if isinstance(check.scene, Packing) else None,
        "verdict": check.verdict,
        "conclusions": list(conclusions(check)),
        "tolerance": check.tolerance,
        "tau": None if check.tau is None else str(check.tau),
        "flipped": check.flipped,
        "largest_difference": _number(check.largest),
        "largest_difference_from_rigid": _number(check.off_rigid),
        "relative_norm": _number(check.relative),
        "scale": _number(check.scale),
        "named_wrongly": len(wrong),
        "largest_residual": _number(check.largest_residual),
        "largest_own_residual": _largest(check.own_residual),
        "largest_tangential": _number(check.tangential),
        "others": [{"contact": name, "given": force} for name, force in check.others],
        "contacts": contacts,
    }


def _largest(vectors: FloatArray | None) -> float | None:
    if vectors is None:
        return None
    return _number(float(np.linalg.norm(vectors, axis=1).max(initial=0.0)))


def _number(value: float | None) -> float | None:
    return float(value) if value is not None and isfinite(value) else None
