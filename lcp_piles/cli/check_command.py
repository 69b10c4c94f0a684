"""`lcp-piles check`: the forces of a simulation or a solver held against ours."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from ..checking.check import TOLERANCE, Check, check
from ..checking.conclusions import conclusions
from ..fields.field import Cell, Column, Table
from ..files.json_fields import layout
from ..files.read_forces import FORCE_COLUMNS, read_forces
from ..files.tables import csv_text
from ..files.write_check import check_entry
from ..packings.packing import Packing
from ..scenes.scene import Scene
from ..solution.solution import Unresolved
from .options import add_digits, add_file, add_scene, exact, positive, scene_of
from .output import Narrator, draw, keep, write
from .packing_options import add_packing, columns, known, packing_of
from .proof_text import describe_packing
from .report import aligned, describe, table_text
from .status import DIFFER, ERROR, SOLVED, UNSTABLE

_WORST = 8

EXAMPLE = "check forces.csv --scene nt30 --layers 6 --plot check.png"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "check",
        help="forces of a simulation or a solver against ours",
        description="Hold contact forces from a table (CSV or blanks) or a LAMMPS dump against the "
        "exact ones of a scene: worst contacts, contacts named wrongly, what the given forces "
        "leave unbalanced, and what that allows to conclude. Pairs may stand in any order, "
        "compression may have either sign. Exit status: 0 they agree within the tolerance, "
        "1 error, 2 usage, 3 the scene cannot stand, 4 they differ.",
    )
    parser.add_argument("forces", metavar="FORCES", help="a table or dump with a row a contact")
    add_scene(parser, "--scene")
    add_packing(parser)
    parser.add_argument(
        "--columns",
        type=columns,
        default={},
        metavar="WHAT=NAME,...",
        help="which columns are what, where their names do not say so: a, b the ends, or ax, ay, "
        "bx, by their centres, or x, y the point of contact; force along the normal, or fx, fy on "
        f"a ({known(FORCE_COLUMNS)} are understood)",
    )
    parser.add_argument(
        "--discs", metavar="FILE", help="table or dump of discs, by whose ids ends are called"
    )
    parser.add_argument(
        "--disc-radius",
        type=positive,
        default=1,
        metavar="R",
        help="radius of a disc, in their unit",
    )
    parser.add_argument(
        "--disc-weight",
        type=positive,
        default=1,
        metavar="W",
        help="weight of a disc in their unit",
    )
    parser.add_argument(
        "--tolerance",
        type=_tolerance,
        default=TOLERANCE,
        metavar="T",
        help="difference that still agrees, relative to the largest force (default: %(default)g)",
    )
    parser.add_argument(
        "--stiffness",
        type=positive,
        metavar="TAU",
        help="compliance of their discs (radii a disc weight): the change of forces that it makes "
        "to first order is taken out",
    )
    add_file(parser, "--json", "write the check (- is standard output)", ".json")
    add_file(parser, "--csv", "write both forces of every contact", ".csv")
    add_file(parser, "--plot", "draw the differences (png, pdf, svg)")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Compare, print what comes out, write the files that were asked for."""
    packing = packing_of(options, allowed=["disc_columns"] if options.discs else [])
    scene = scene_of(options) if packing is None else packing
    narrate = Narrator(options.quiet)
    forces = read_forces(
        options.forces,
        options.columns,
        discs=options.discs,
        disc_columns=options.disc_columns if packing is None else None,
    )
    narrate(f"{len(forces)} forces; {_described(scene)}")
    found = check(
        scene,
        forces,
        radius=float(options.disc_radius),
        weight=float(options.disc_weight),
        tolerance=options.tolerance,
        tau=options.stiffness,
        progress=narrate,
    )
    digits = options.digits
    text = _facts(found, digits)
    if found.verdict != "nothing to compare":
        text += "\n\n" + table_text(_table(found, _WORST), digits)
    write(narrate, text, layout(check_entry(found)) + "\n" if options.json else "", options.json)
    if options.csv:
        table = _table(found, len(found.given))
        keep(narrate, csv_text(table.header(), table.lines()), options.csv)
    if options.plot and found.verdict != "nothing to compare":
        from ..pictures import draw_check

        draw(narrate, draw_check(found), options.plot)
    if found.verdict == "nothing to compare":
        return ERROR if isinstance(found.solution, Unresolved) else UNSTABLE
    return SOLVED if found.agrees else DIFFER


def _facts(found: Check, digits: int) -> str:
    verdict, *others = conclusions(found)
    given = f"{int(found.present.sum())} of {len(found.given)} contacts"
    lines = [
        ("scene", _described(found.scene)),
        ("given", given + (", compression negative" if found.flipped else "")),
        ("verdict", verdict),
    ]
    if found.verdict != "nothing to compare":
        lines += _differences(found, digits)
    lines.append(
        ("unbalanced", f"at most {found.largest_residual:.3g}{found.unit} on a disc, as given")
    )
    if found.tangential is not None:
        lines.append(("tangential", f"at most {found.tangential:.3g}{found.unit}, left out"))
    for k, text in enumerate(others):
        lines.append(("but" if k == 0 else "", text))
    return aligned(lines)


def _described(scene: Scene | Packing) -> str:
    return describe_packing(scene) if isinstance(scene, Packing) else describe(scene)


def _differences(found: Check, digits: int) -> list[tuple[str, str]]:
    lines = [
        ("difference", f"at most {found.largest:.3g}{found.unit}, {found.relative:.3g} in the norm")
    ]
    if found.tau is not None:
        text = f"of tau = {found.tau}, to first order: without it {found.off_rigid:.3g}{found.unit}"
        taken = found.expected is not found.reference.forces
        lines.append(("stiffness", text if taken else "no change that could be taken out"))
    wrong = found.wrong.tolist()
    if wrong:
        some = ", ".join(map(found.reference.name, wrong[:5]))
        more = ", ..." if len(wrong) > 5 else ""
        lines.append(("named wrongly", f"{len(wrong)} contacts: {some}{more}"))
    if found.others:
        some = ", ".join(
            f"{name}: {force:.{digits}g}{found.unit}" for name, force in found.others[:5]
        )
        more = ", ..." if len(found.others) > 5 else ""
        lines.append(("no contacts", f"{len(found.others)} of theirs: {some}{more}"))
    return lines


def _table(found: Check, count: int) -> Table:
    """The contacts with the largest differences, those first."""
    names = ("contact", "given", "ours", "difference", "state")
    states = getattr(found.solution, "states", None)
    wrong = set(found.wrong.tolist())
    rows: list[list[Cell]] = []
    for k in found.worst[:count].tolist():
        state = (states[k] if states else "") + (", named wrongly" if k in wrong else "")
        numbers = [float(v[k]) for v in (found.given, found.expected, found.difference)]
        rows.append([found.reference.name(k), *map(_cell, numbers), state])
    return Table(tuple(map(Column, names)), rows)


def _cell(number: float) -> float | None:
    return number if np.isfinite(number) else None


def _tolerance(text: str) -> float:
    value = float(exact(text))
    if not 0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of at least 0")
    return value
