"""What all certificates begin with, and scenes as they have them."""

from __future__ import annotations

from typing import Any

from ..files.json_fields import Entry
from ..files.scene_json import full_entry, scene_entry
from ..scenes.scene import Scene

FORMAT = "lcp-piles-certificate/1"
REBUILT = ("nt30", "nt60", "tss", "tbs")
"""The kinds whose scenes the checker builds by itself; all others are written out."""


def certified_scene(scene: Scene) -> Entry:
    """A scene as the checker reads it: without positions, which enter no law."""
    entry = scene_entry(scene)
    if entry.get("kind") in REBUILT:
        return entry
    entry = full_entry(scene)
    discs: list[dict[str, Any]] = entry["discs"]
    return {
        "supports": entry["supports"],
        "discs": [{name: disc[name] for name in ("id", "load", "held")} for disc in discs],
        "contacts": entry["contacts"],
    }
