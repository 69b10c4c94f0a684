"""Writing the path of a push, format lcp-piles-push/1: JSON with exact numbers as text."""

from __future__ import annotations

from math import isfinite
from typing import Any

from ..numbers.exact import Surd
from ..push.push_path import PushPath, promise
from ..scenes.scene import Contact
from .json_fields import id_entry
from .scene_json import scene_entry


def to_json(path: PushPath) -> dict[str, Any]:
    """The path for a JSON file: breakpoints in order of |push - start|, both images in changes."""

    def change(contact: Contact, what: str) -> dict[str, Any]:
        return {"a": id_entry(contact.a), "b": id_entry(contact.b), "change": what}

    return {
        "format": "lcp-piles-push/1",
        "scene": scene_entry(path.scene),
        "direction": "push" if path.unit > 0 else "pull",
        "end": path.end,
        "promise": promise(path.scene),
        "breakpoints": [
            {
                "push": str(r.push),
                "decimal": _decimal(r.push),
                "changes": [change(c, "opens") for c in r.opens]
                + [change(c, "closes") for c in r.closes],
            }
            for r in path.rearrangements
        ],
    }


def _decimal(push: Surd) -> float | None:
    """The nearest float; JSON has none beyond their range."""
    nearest = float(push)
    return nearest if isfinite(nearest) else None
