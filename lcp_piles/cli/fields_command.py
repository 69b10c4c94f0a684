"""`lcp-piles fields`: what is read off a solved pile, as tables and pictures."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ..fields.field import Field, Table
from ..fields.registry import FIELDS
from ..files.tables import csv_text
from ..solve import solve
from .options import add_digits, add_file, add_scene
from .output import STANDARD_OUTPUT, draw, keep, opening, write
from .report import summary, table_text
from .status import ERROR, SOLVED, UNSTABLE

_SEVERAL = "; with several fields each gets a file of its own, FILE with its name"

EXAMPLE = "fields nt30 --layers 6 --show stress --plot stress.png"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "fields",
        help="what is read off a solved pile: stress, pressure, fabric, ...",
        description="Solve one scene exactly and print fields of it as tables, numbers in "
        "decimals; the CSV has the exact numbers too. Exit status: 0 solved, 1 error, 2 usage, "
        "3 the scene cannot stand.",
    )
    add_scene(parser)
    parser.add_argument(
        "--show",
        type=_fields,
        required=True,
        metavar="FIELD[,FIELD...]",
        help="; ".join(f"{f.name}: {f.title}" for f in FIELDS.values()),
    )
    add_file(parser, "--csv", f"write the tables (- is standard output){_SEVERAL}", ".csv")
    add_file(parser, "--plot", f"draw the fields (png, pdf, svg){_SEVERAL}")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Solve, print the tables, write the files that were asked for."""
    fields: list[Field[Any]] = options.show
    if options.plot:
        for field in fields:
            if field.shape is None:
                options.parser.error(f"--plot: there is no picture of {field.name}, only a table")
    scene, narrate = opening(options)
    solution = solve(scene, progress=narrate)
    if solution.status != "solved":
        print(summary(solution))
        return UNSTABLE if solution.status == "unstable" else ERROR
    found = [(field, field.compute(solution)) for field in fields]
    tables = [(field, field.table(value)) for field, value in found]
    text = "\n\n".join(
        f"{field.name}: {field.title}\n{table_text(table, options.digits)}"
        for field, table in tables
    )
    if options.csv in (None, STANDARD_OUTPUT):
        write(narrate, text, "\n".join(_csv(table) for _, table in tables), options.csv)
    else:
        for field, table in tables:
            keep(narrate, _csv(table), _file(options.csv, field, fields))
        print(text)
    if options.plot:
        from ..pictures import draw_field

        for field, value in found:
            if field.shape is not None:
                picture = draw_field(field.shape(value))
                draw(narrate, picture, _file(options.plot, field, fields))
    return SOLVED


def _fields(text: str) -> list[Field[Any]]:
    """The fields of a list with commas, each once, in its order."""
    found: dict[str, Field[Any]] = {}
    for name in text.split(","):
        if name not in FIELDS:
            raise argparse.ArgumentTypeError(f"{name!r} is none of {', '.join(FIELDS)}")
        found[name] = FIELDS[name]
    return list(found.values())


def _csv(table: Table) -> str:
    return csv_text(table.header(), table.lines())


def _file(file: str, field: Field[Any], fields: list[Field[Any]]) -> str:
    """Where a field goes: pile-stress.csv for pile.csv if there are several."""
    path = Path(file)
    if len(fields) == 1:
        return file
    return str(path.with_name(f"{path.stem}-{field.name}{path.suffix}"))
