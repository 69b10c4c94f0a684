"""Scenes as files of their own: a result file without the result (notes/result-format.md)."""

from __future__ import annotations

import os

from ..scenes.scene import Scene
from .json_fields import choice, field, json_object, layout
from .read_result import loads
from .safe_read import read_text
from .safe_write import check_ending, write_text
from .scene_json import read_lone_scene, scene_entry
from .write_result import FORMATS

_ALONE = {"format", "scene"}


def save_scene(scene: Scene, path: str | os.PathLike[str]) -> None:
    """Write a scene to a file (JSON); `load_scene` reads it back the same.

    Raises `InputError` where the path cannot be written, and for one that ends like another format.
    """
    check_ending(path, ".json")
    content = {"format": FORMATS[-1], "scene": scene_entry(scene)}
    write_text(path, layout(content) + "\n")


def load_scene(path: str | os.PathLike[str]) -> Scene:
    """Read the scene of a scene file, or of a result file, whose result is passed over.

    Raises `FileFormatError`, naming the field that is wrong.

    >>> from lcp_piles.files.scene_file import scene_of_text
    >>> scene_of_text('{"format": "lcp-piles/2", "scene": {"kind": "nt60", "layers": 3}}')
    <Scene NT60, layers 3: 6 discs, 10 contacts>
    """
    return scene_of_text(read_text(path))


def scene_of_text(text: str) -> Scene:
    """`load_scene` for the text of a file."""
    content = json_object(text)
    if content.keys() - _ALONE:
        return loads(text).scene
    choice(content, "format", FORMATS[-1:])
    return read_lone_scene(field(content, "scene", dict))
