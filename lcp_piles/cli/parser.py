"""The command line: what the words are, and what becomes of errors."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import suppress

from .. import __version__
from ..errors import LcpPilesError
from . import (
    bounds_command,
    certify_command,
    check_command,
    compare_command,
    ensemble_command,
    fields_command,
    friction_command,
    lemke_command,
    prove_command,
    push_command,
    reproduce_command,
    solve_command,
    view_command,
)
from .completion import SHELLS, PrintCompletion
from .options import joined
from .output import leave_standard_output
from .status import ERROR, INTERRUPTED, SOLVED

COMMANDS = (
    solve_command,
    fields_command,
    view_command,
    prove_command,
    push_command,
    bounds_command,
    friction_command,
    ensemble_command,
    check_command,
    certify_command,
    lemke_command,
    compare_command,
    reproduce_command,
)
"""A command is a file with `add`, its words, `run`, what it does, an `EXAMPLE`, and a line here."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status, one of `status`."""
    try:
        status = _run(sys.argv[1:] if arguments is None else arguments)
        if sys.stdout is not None:
            sys.stdout.flush()  # while a full disc can still be reported
        return status
    except BrokenPipeError:  # the reader has seen enough
        leave_standard_output()
        return ERROR
    except OSError as error:  # of a file that was named, the commands know more
        leave_standard_output()
        return _fail(f"standard output cannot be written: {error.strerror or error}")


def _run(arguments: Sequence[str]) -> int:
    try:
        options = build_parser().parse_args(joined(arguments))
        return int(options.run(options))
    except SystemExit as stop:  # argparse: usage, or help
        return stop.code if isinstance(stop.code, int) else SOLVED
    except LcpPilesError as error:
        return _fail(str(error))
    except KeyboardInterrupt:
        return _fail("interrupted", INTERRUPTED)
    except MemoryError:
        return _fail("out of memory: try fewer layers")


def _fail(text: str, status: int = ERROR) -> int:
    with suppress(OSError):  # nobody is left to tell
        print(f"lcp-piles: {text}", file=sys.stderr, flush=True)
    return status


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    parser = argparse.ArgumentParser(
        prog="lcp-piles",
        description="Exact static forces in granular piles of frictionless discs.",
    )
    parser.add_argument("--version", action="version", version=f"lcp-piles {__version__}")
    parser.add_argument(
        "--print-completion",
        action=PrintCompletion,
        choices=SHELLS,
        help="print what makes this shell complete the words of this program (extra completion)",
    )
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")
    for command in COMMANDS:
        words = command.add(commands)
        words.epilog = f"example: {parser.prog} {command.EXAMPLE}"
        words.add_argument(
            "--quiet", action="store_true", help="nothing on standard error but what is wrong"
        )
        words.set_defaults(run=command.run, parser=words)
    return parser
