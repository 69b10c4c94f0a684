"""`lcp-piles reproduce`: the figures of the paper, a file each with its numbers."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from .output import Narrator
from .status import SOLVED

EXAMPLE = "reproduce --out paper --only table1"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "reproduce",
        help="every computed figure and table of the paper",
        description="Draw every computed figure of Oron and Herrmann, each with its numbers.",
    )
    parser.add_argument("--out", default="paper", metavar="DIR", help="default: %(default)s")
    parser.add_argument(
        "--only", action="append", metavar="NAME", help="one figure; may be repeated"
    )
    return parser


def run(options: argparse.Namespace) -> int:
    """Make the figures that were asked for, all of them if none was."""
    from ..paper.reproduce import NAMES, reproduce

    total = len(options.only or NAMES)
    with Narrator(options.quiet).bar("figure", total) as bar:
        begun = iter(range(total))

        def begin(name: str) -> None:
            bar.set_description_str(f"{name:<14}", refresh=False)
            bar.update(next(begun) - bar.n)

        files = reproduce(Path(options.out), options.only, progress=begin)
        bar.update(total - bar.n)
    print("\n".join(str(file) for file in files))
    return SOLVED
