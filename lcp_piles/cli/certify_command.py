"""`lcp-piles certify`: make a certificate of a result file, or check one."""

from __future__ import annotations

import argparse
from typing import Any

from ..certificates.certify import is_certificate, proposed, proved, text_of
from ..errors import InputError, VerificationError
from ..files.json_fields import json_object
from ..files.read_result import loads
from ..files.safe_read import read_text
from ..solution.verify import verify
from .options import add_file
from .output import Narrator, keep
from .status import ERROR, SOLVED

EXAMPLE = "certify nt30.json --out nt30.certificate.json"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "certify",
        help="make a certificate of a result file, or check one",
        description="Of a certificate, check it and print what it proves. Of a result file, verify "
        "it and write its certificate. Exit status: 0 proved, 1 not proved or an error.",
    )
    parser.add_argument("file", metavar="FILE", help="a certificate or a result file")
    add_file(parser, "--out", "where the certificate of a result file goes", ".json")
    return parser


def run(options: argparse.Namespace) -> int:
    """Check the certificate, or make that of the result."""
    text = read_text(options.file)
    if is_certificate(json_object(text)):
        if options.out:
            options.parser.error(f"--out: {options.file} is a certificate itself")
        try:
            print("proved:", *proved(text), sep="\n  ")
        except VerificationError as error:
            print(f"not proved: {error}")
            return ERROR
        return SOLVED
    if not options.out:
        options.parser.error(f"--out: where the certificate of {options.file} should go")
    solution = loads(text)
    checked = verify(solution.scene, solution)
    if not checked.ok:
        why = "; ".join(checked.faults) or "it is of floating point"
        raise InputError("the result", options.file, f"one that is true ({why})")
    text = text_of(proposed(solution))
    words = proved(text)
    keep(Narrator(options.quiet), text, options.out)
    print("proved:", *words, sep="\n  ")
    return SOLVED
