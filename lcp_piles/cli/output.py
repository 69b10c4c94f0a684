"""What commands say while they work, and where their results go."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from time import perf_counter
from typing import TYPE_CHECKING, NoReturn

from tqdm import tqdm

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
    narrate = Narrator(options.quiet)
    narrate(describe(scene))
    return scene, narrate


class Narrator:
    """Lines on standard error, with the time since the start on work that takes a while.

    A `quiet` one says nothing at all, and shows no bars.
    """

    def __init__(self, quiet: bool) -> None:
        self.quiet = quiet
        self._start = perf_counter()

    def __call__(self, text: str) -> None:
        """Say one line."""
        passed = perf_counter() - self._start
        stamp = f"[{passed:6.1f} s] " if passed > 2 else ""
        if not self.quiet:
            print(stamp + text, file=sys.stderr, flush=True)

    def time(self) -> None:
        """Say how long it took: here and not in the results, which are always the same."""
        self(f"done in {perf_counter() - self._start:.3g} s")

    def bar(self, unit: str, total: int | None = None) -> tqdm[NoReturn]:
        """A bar for work that takes more than two seconds; it goes away with its end."""
        if sys.stdout is not None:
            sys.stdout.flush()  # tqdm does it too, and leaves half a bar where it fails
        return tqdm(
            total=total, unit=unit, file=sys.stderr, leave=False, delay=2, disable=self.quiet
        )


def steps(bar: tqdm[NoReturn]) -> Callable[[str], None]:
    """What is called with a line of text for every step of the work that the bar is for."""

    def step(text: str) -> None:
        bar.set_postfix_str(text, refresh=False)
        bar.update()

    return step


def write(narrate: Narrator, text: str, content: str, file: str | None) -> None:
    """Print a text, and write what else was asked for to a file; "-" is standard output.

    Standard output holds one of the two alone: with "-" the text goes to standard error, unless
    nothing is to be said there.
    """
    if file == STANDARD_OUTPUT:
        print(content, end="")
        if not narrate.quiet:
            print(text, file=sys.stderr)
        return
    if file:
        keep(narrate, content, file)
    print(text)


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
