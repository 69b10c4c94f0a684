"""Writing the path of a push, format lcp-piles-push/1: JSON with exact numbers as text."""

from __future__ import annotations

from typing import Any

from ..push.push_path import PushPath, promise
from ..scenes.scene import Contact
from .write_result import id_entry, scene_entry


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
                "decimal": float(r.push),
                "changes": [change(c, "opens") for c in r.opens]
                + [change(c, "closes") for c in r.closes],
            }
            for r in path.rearrangements
        ],
    }
