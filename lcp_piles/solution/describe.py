"""Scenes in a few words, for what is shown of a solution."""

from __future__ import annotations

from ..scenes.scene import Scene


def brief(scene: Scene) -> str:
    """Kind and parameters that are not its defaults, or the size of a scene without a kind.

    >>> from lcp_piles import nt60
    >>> brief(nt60(4, push="sqrt(3)"))
    'NT60, layers 4, push sqrt(3)'
    """
    if scene.origin is None:
        return f"own scene, {len(scene.discs)} discs, {len(scene.contacts)} contacts"
    return str(scene.origin)
