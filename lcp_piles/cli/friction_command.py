"""`lcp-piles friction`: the forces with friction of a pile that is loaded once."""

from __future__ import annotations

import argparse
from typing import Any

from ..fields.field import Cell, Column, Table
from ..files.tables import csv_text
from ..friction.first_loading import FirstLoading, UnresolvedError, first_loading
from ..friction.loading_search import all_first_loadings
from ..scenes.names import contact_name
from .options import (
    add_digits,
    add_file,
    add_friction,
    add_scene,
    positive,
    rough_of,
)
from .output import draw, opening, write
from .report import aligned, describe, table_text
from .status import SOLVED, UNRESOLVED

EXAMPLE = "friction tss --layers 4 --friction 3/10 --plot friction.png"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "friction",
        help="with friction: the forces when the pile is loaded once, on elastic contacts",
        description="With friction and elastic springs along the tangents, without a past: find "
        "the exact forces, and which contacts stick or slip. Exit status: 0 solved, 1 error, "
        "2 usage, 5 unresolved.",
    )
    add_scene(parser)
    add_friction(parser)
    parser.add_argument(
        "--ratio",
        type=positive,
        default=1,
        metavar="K",
        help="tangential stiffness of a contact over its normal one, rational (default: 1)",
    )
    parser.add_argument(
        "--all",
        action="store_true",
        help="search all states of few contacts, and prove whether the forces are unique",
    )
    add_file(parser, "--csv", "write the table (- is standard output)", ".csv")
    add_file(parser, "--plot", "draw the forces (png, pdf, svg)")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Solve, print the table, write the files that were asked for."""
    scene, narrate = opening(options)
    rough = rough_of(options, scene)
    try:
        found = first_loading(scene, options.friction, rough, ratio=options.ratio)
    except UnresolvedError as error:
        print(f"unresolved: {error}")
        return UNRESOLVED
    lines = _facts(found)
    if options.all:
        with narrate.bar("programme") as bar:
            every = all_first_loadings(
                scene,
                options.friction,
                rough,
                ratio=options.ratio,
                progress=lambda done: bar.update(done - bar.n),
            )
        lines.append(("solutions", _how_many(len(every.solutions), every.continuum)))
    narrate.time()
    table = _table(found)
    text = f"{aligned(lines)}\n\n{table_text(table, options.digits)}"
    write(narrate, text, csv_text(table.header(), table.lines()), options.csv)
    if options.plot:
        from ..pictures import draw_friction

        picture = draw_friction(scene, found.network, found.mu, rough=bool(rough))
        draw(narrate, picture, options.plot)
    return SOLVED


def _facts(found: FirstLoading) -> list[tuple[str, str]]:
    floor = f"; {', '.join(found.rough)} as rough" if found.rough else ""
    counts = (
        (found.count("stick"), "stick"),
        (found.count("slip+", "slip-"), "slip"),
        (found.count("closed"), "smooth and closed"),
        (found.count("open"), "open"),
    )
    return [
        ("scene", describe(found.scene)),
        ("friction", f"mu = {found.mu}{floor}; tangential stiffness {found.ratio}"),
        ("contacts", ", ".join(f"{count} {name}" for count, name in counts if count)),
        ("proof", "one exact solution, the signs of all its forces, gaps and slips"),
    ]


def _how_many(count: int, continuum: bool) -> str:
    if continuum:
        return "forces vary within the same states"
    return "one: no other states have a solution" if count == 1 else f"{count} different ones"


def _table(found: FirstLoading) -> Table:
    columns = (
        Column("contact"),
        Column("state"),
        Column("normal", exact=True),
        Column("tangential", exact=True),
    )
    network = found.network
    rows: list[list[Cell]] = [
        [contact_name((contact.a, contact.b)), state, normal, tangential]
        for contact, state, normal, tangential in zip(
            found.scene.contacts, found.states, network.normal, network.tangential, strict=True
        )
    ]
    return Table(columns, rows)
