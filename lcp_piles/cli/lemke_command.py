"""`lcp-piles lemke`: a linear complementarity problem from a file, exactly."""

from __future__ import annotations

import argparse
import json
from typing import Any

from ..certificates.certify import checked, text_of
from ..certificates.lcp import lcp_certificate
from ..fields.field import Cell, Column, Table
from ..files.lcp_file import load_lcp
from ..numbers.exact import surd
from ..pivoting.lemke import LemkeResult, lemke
from .options import CERTIFICATE, add_digits, add_file
from .output import Narrator, keep, write
from .report import aligned, table_text
from .status import SOLVED, UNRESOLVED, UNSTABLE

EXAMPLE = "lemke problem.json --certificate problem.certificate.json"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "lemke",
        help="any linear complementarity problem, by exact pivots",
        description="Find z >= 0 with w = M z + q >= 0 and z . w = 0 by Lemke's method in exact "
        'arithmetic. FILE is JSON: {"M": [[2, 1], [1, "2/3"]], "q": [-5, "-0.1"]}. Exit status: '
        "0 solved, 1 error, 2 usage, 3 proved to have no solution, 5 unresolved.",
    )
    parser.add_argument("file", metavar="FILE", help="the problem")
    add_file(parser, "--json", "write z and w as exact text (- is standard output)", ".json")
    add_file(parser, "--certificate", CERTIFICATE, ".json")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Solve, print z and w, write the files that were asked for."""
    problem, narrate = load_lcp(options.file), Narrator(options.quiet)
    narrate(f"{len(problem)} variables")
    with narrate.bar("pivot") as bar:
        result = lemke(problem, progress=lambda done: bar.update(done - bar.n))
    solved, proved = result.status == "solved", result.certificate is not None
    if solved:
        what = "solved"
    elif proved:
        what = "no z >= 0 has M z + q >= 0: proved by a certificate"
    else:
        what = "Lemke's method ended on a ray, which proves nothing"
    text = aligned([("status", what), ("pivots", str(result.pivots))])
    if solved:
        text += "\n\n" + table_text(_table(result), options.digits)
    content: dict[str, Any] = {"status": "solved" if solved else "infeasible" if proved else "ray"}
    if solved:
        content |= {"z": [str(x) for x in result.z], "w": [str(x) for x in result.w]}
    write(narrate, text, json.dumps(content) + "\n", options.json)
    if options.certificate and not (solved or proved):
        narrate("no certificate: nothing is proved")
    elif options.certificate:
        keep(narrate, text_of(checked(lcp_certificate(problem, result))), options.certificate)
    return SOLVED if solved else UNSTABLE if proved else UNRESOLVED


def _table(result: LemkeResult) -> Table:
    columns = (Column("variable"), Column("z", exact=True), Column("w", exact=True))
    pairs = enumerate(zip(result.z, result.w, strict=True))
    rows: list[list[Cell]] = [[str(i), surd(z), surd(w)] for i, (z, w) in pairs]
    return Table(columns, rows)
