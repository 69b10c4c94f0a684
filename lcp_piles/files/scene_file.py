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

    Parameters
    ----------
    scene : Scene
        The scene.
    path : str or path
        The file, which may end in .json or in nothing known.

    Raises
    ------
    InputError
        Where the path cannot be written, and for one that ends like another format.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from lcp_piles import nt60
    >>> with TemporaryDirectory() as folder:
    ...     save_scene(nt60(3), f"{folder}/scene.json")
    ...     load_scene(f"{folder}/scene.json") == nt60(3)
    True
    """
    check_ending(path, ".json")
    content = {"format": FORMATS[-1], "scene": scene_entry(scene)}
    write_text(path, layout(content) + "\n")


def load_scene(path: str | os.PathLike[str]) -> Scene:
    """Read the scene of a scene file, or of a result file, whose result is passed over.

    Parameters
    ----------
    path : str or path
        The file (JSON).

    Returns
    -------
    Scene
        The scene.

    Raises
    ------
    FileFormatError
        For a file that cannot be read; it names the field that is wrong.

    Examples
    --------
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
