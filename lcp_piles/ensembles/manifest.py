"""The manifest of an ensemble: what it is made of, and the hash that says so.

Samples of one folder are all of one scene, one disorder, one seed, one thing observed and one
version of this package, so whoever reads or continues it knows what they are.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..disorder.distributions import DISTRIBUTIONS, name_of
from ..disorder.draws import Disorder
from ..errors import FileFormatError, InputError
from ..files.json_fields import choice, field, json_object, only
from ..files.safe_read import read_text
from ..files.safe_write import write_text
from ..files.scene_file import scene_of_text
from ..files.scene_json import full_entry, scene_entry
from ..files.write_result import FORMATS
from ..scenes.scene import Scene
from .record import Observe

FILE = "ensemble.json"
_FORMAT = "lcp-piles ensemble/1"
_FIELDS = ("format", "hash", "scene", "distribution", "amplitude", "seed", "observed", "version")


@dataclass(frozen=True)
class Manifest:
    """What all samples of an ensemble have in common; `hash` is of all of it.

    `observed` names the function that says what is kept of a sample.
    """

    scene: Scene
    disorder: Disorder
    seed: int
    observed: str
    version: str

    @property
    def hash(self) -> str:
        """SHA-256 of the scene written out and of all else."""
        return _hash(full_entry(self.scene), self._rest())

    def _rest(self) -> dict[str, Any]:
        return {
            "distribution": name_of(self.disorder),
            "amplitude": str(self.disorder.amplitude),
            "seed": self.seed,
            "observed": self.observed,
            "version": self.version,
        }

    def text(self) -> str:
        """The manifest as a file."""
        content = {"format": _FORMAT, "hash": self.hash, "scene": scene_entry(self.scene)}
        return json.dumps(content | self._rest(), indent=1) + "\n"


def observed_by(observe: Observe) -> str:
    """The name of a function that a worker can import."""
    name = f"{getattr(observe, '__module__', '?')}.{getattr(observe, '__qualname__', '?')}"
    if "<" in name or "?" in name:
        what = "a function at the top level of a module, which workers can import"
        raise InputError("observe", name, what)
    return name


def scene_text(scene: Scene) -> str:
    """A scene as the text of a scene file."""
    return json.dumps({"format": FORMATS[-1], "scene": scene_entry(scene)})


def read_manifest(folder: Path) -> Manifest:
    """The manifest of a folder; `FileFormatError` where it is none, or was altered."""
    path = folder / FILE
    content = json_object(read_text(path))
    only(content, _FIELDS, str(path))
    choice(content, "format", [_FORMAT])
    entry = field(content, "scene", dict)
    name = choice(content, "distribution", DISTRIBUTIONS)
    disorder = DISTRIBUTIONS[name](field(content, "amplitude", str))
    found = Manifest(
        scene_of_text(json.dumps({"format": FORMATS[-1], "scene": entry})),
        disorder,
        field(content, "seed", int),
        field(content, "observed", str),
        field(content, "version", str),
    )
    if field(content, "hash", str) != found.hash:
        raise FileFormatError(f"{path}: hash", content["hash"], f"{found.hash}, of what it says")
    return found


def claim(folder: Path, manifest: Manifest) -> None:
    """Write the manifest into a new folder; in one that has a manifest, it must be the same."""
    path = folder / FILE
    if not path.exists():
        write_text(path, manifest.text())
        return
    there = read_manifest(folder)
    if there.hash != manifest.hash:
        differs = [
            f"{name} {theirs} (now {ours})"
            for name, theirs, ours in _told(there, manifest)
            if theirs != ours
        ]
        raise InputError(
            "the folder",
            str(folder),
            "a new one, or one of this ensemble",
            f"it holds another one: {', '.join(differs)}; take another folder",
        )


def _told(there: Manifest, here: Manifest) -> list[tuple[str, str, str]]:
    scenes = (_hash(full_entry(m.scene), {})[:12] for m in (there, here))
    rows = [("scene", *scenes)]
    mine = here._rest()
    rows += [(name, str(value), str(mine[name])) for name, value in there._rest().items()]
    return [(name, theirs, ours) for name, theirs, ours in rows]


def _hash(*parts: dict[str, Any]) -> str:
    return sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()
