"""`--print-completion SHELL`: what makes a shell complete the words of the command line."""

from __future__ import annotations

import argparse
from typing import Any

from ..files.optional import needed
from .status import SOLVED

SHELLS = ("bash", "zsh", "tcsh")
"""The shells that shtab knows."""


class PrintCompletion(argparse.Action):
    """The option: print and end, as `--help` does."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Print the script of a shell; `MissingExtraError` without shtab."""
        print(needed("shtab", "completion").complete(parser, shell=values))
        parser.exit(SOLVED)
