"""Scenes in a few words, for what is shown of a solution."""

from __future__ import annotations

from ..scenes.scene import Scene

_LONGEST = 24


def brief(scene: Scene) -> str:
    """Kind and parameters, or the size of a scene without, in at most about a hundred characters.

    >>> from lcp_piles import nt60
    >>> brief(nt60(4, push="sqrt(3)"))
    'nt60 layers 4, push sqrt(3), floor_compliance 1, corner_stones held'
    """
    if scene.origin is None:
        return f"own scene, {len(scene.discs)} discs, {len(scene.contacts)} contacts"
    named = (f"{name} {_cut(x)}" for name, x in scene.origin.parameters)
    return f"{scene.origin.kind.name} " + ", ".join(named)


def _cut(value: object) -> str:
    text = str(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
