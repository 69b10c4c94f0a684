"""What commands say while they work, and where their results go."""

from __future__ import annotations

import argparse
import os
import sys
from time import perf_counter
from typing import TYPE_CHECKING

from ..files.safe_write import write_text
from ..scenes.scene import Scene
from .options import scene_of
from .report import describe

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STANDARD_OUTPUT = "-"
"""The name of a file that means standard output."""


def opening(options: argparse.Namespace) -> tuple[Scene, Narrator]:
    """The scene of a command, and a narrator that has said which it is."""
    scene = scene_of(options)
    narrate = Narrator()
    narrate(describe(scene))
    return scene, narrate


class Narrator:
    """Lines on standard error, with the time since the start on work that takes a while."""

    def __init__(self) -> None:
        self._start = self._last = perf_counter()

    def __call__(self, text: str) -> None:
        """Say one line."""
        passed = perf_counter() - self._start
        stamp = f"[{passed:6.1f} s] " if passed > 2 else ""
        print(stamp + text, file=sys.stderr, flush=True)

    def rarely(self, text: str) -> None:
        """Say one line, if the last one was two seconds ago."""
        if perf_counter() - self._last > 2:
            self._last = perf_counter()
            self(text)


def write(narrate: Narrator, text: str, content: str, file: str | None) -> None:
    """Print a text, and write what else was asked for to a file; "-" is standard output.

    Standard output holds one of the two alone: with "-" the text goes to standard error.
    """
    if file == STANDARD_OUTPUT:
        print(content, end="")
    elif file:
        keep(narrate, content, file)
    print(text, file=sys.stderr if file == STANDARD_OUTPUT else sys.stdout)


def keep(narrate: Narrator, content: str, file: str) -> None:
    """Write a file of text."""
    write_text(file, content)
    narrate(f"wrote {file}")


def draw(narrate: Narrator, picture: Axes | Figure, file: str) -> None:
    """Write a picture."""
    from ..pictures import save

    save(picture, file)
    narrate(f"drew {file}")


def leave_standard_output() -> None:
    """Turn standard output to nowhere: what it still holds could not be written."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
