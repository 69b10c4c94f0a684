"""`lcp-piles solve`: the force network of one pile."""

from __future__ import annotations

import argparse
from typing import Any

from ..certificates.certify import certificate, text_of
from ..crosscheck import CrossCheck, cross_check
from ..errors import LcpPilesError
from ..files.export import FORMATS, format_of
from ..files.write_result import dumps
from ..methods.registry import METHODS
from ..solution.solution import Solution
from ..solve import solve
from .options import (
    CERTIFICATE,
    add_contacts,
    add_digits,
    add_file,
    add_scene,
    as_option,
    contacts_of,
    number,
    positive,
)
from .output import Narrator, draw, keep, opening, write
from .packing_options import add_packing, packing_of
from .report import aligned, contact_lines, summary
from .solve_packing_file import run_packing
from .status import ERROR, SOLVED, UNSTABLE
from .stiffness import stiffness_lines

EXAMPLE = "solve nt30 --layers 6 --push 20 --plot nt30.png --json nt30.json"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "solve",
        help="the force network of one scene",
        description="Solve one scene exactly, check the answer, print what matters. Of a table of "
        "discs the forces are proved as they stand, within rigorous bounds. "
        "Exit status: 0 solved, 1 error, 2 usage, 3 the scene cannot stand.",
    )
    add_scene(parser)
    add_packing(parser)
    parser.add_argument(
        "--exact",
        type=number,
        metavar="ANGLE",
        help="of a packing: solve exactly one with rational normals, within ANGLE (such as 1e-9)",
    )
    parser.add_argument("--whole", action="store_true", help="solve the whole pile, not its half")
    parser.add_argument(
        "--method",
        choices=list(METHODS),
        default=next(iter(METHODS)),
        metavar="METHOD",
        help="; ".join(f"{m.name}: {m.title}" for m in METHODS.values())
        + " (default: %(default)s)",
    )
    add_file(parser, "--json", "write the result file (- is standard output)", ".json")
    parser.add_argument(
        "--rows",
        action="store_true",
        help="write the result file in rows that people can read, even of thousands of contacts",
    )
    add_file(parser, "--certificate", CERTIFICATE, ".json")
    parser.add_argument(
        "--out",
        type=_export_name,
        action="append",
        default=[],
        metavar="FILE",
        help="write the solution in the format that the ending says, as often as wanted: "
        + "; ".join(f"{ending} {format.title}" for ending, format in FORMATS.items()),
    )
    add_file(parser, "--plot", "draw the force network (png, pdf, svg)")
    parser.add_argument(
        "--stiffness",
        type=positive,
        metavar="TAU",
        help="say also what a simulation of discs of compliance TAU (radii a disc weight, such as "
        "1/1000) should find",
    )
    add_contacts(parser, "say also state, force and gap of")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Solve, print the summary, write the files that were asked for."""
    packing = packing_of(options)
    if packing is not None:
        return run_packing(options, packing)
    if options.exact is not None:
        options.parser.error("--exact: scenes are solved exactly anyway")
    scene, narrate = opening(options)
    contacts = contacts_of(options, scene)
    solution = solve(scene, options.method, whole=options.whole, progress=narrate)
    narrate(f"{solution.status} in {solution.record.seconds:.3g} s")
    text = summary(solution, digits=options.digits, check=_check(solution, narrate))
    if options.stiffness is not None and solution.status == "solved":
        text += "\n" + aligned(stiffness_lines(solution, options.stiffness, options.digits))
    if contacts and solution.status == "solved":
        text += "\n" + aligned(contact_lines(solution, contacts, options.digits))
    rows = False if options.rows else None
    write(narrate, text, dumps(solution, compact=rows) if options.json else "", options.json)
    if options.certificate:
        keep(narrate, text_of(certificate(solution)), options.certificate)
    for file in options.out:
        keep(narrate, format_of(file).text(solution), file)
    if options.plot:
        from ..pictures import draw_network, draw_solid

        picture = draw_solid if scene.dimension == 3 else draw_network
        draw(narrate, picture(solution), options.plot)
    return {"solved": SOLVED, "unstable": UNSTABLE}.get(solution.status, ERROR)


def _export_name(text: str) -> str:
    as_option(lambda: format_of(text))
    return text


def _check(solution: Solution, narrate: Narrator) -> CrossCheck | None:
    """The exact solution held against floating point, where that has something to say."""
    if solution.status != "solved" or not solution.exact or not solution.scene.definite:
        return None
    try:
        return cross_check(solution)
    except LcpPilesError as error:
        narrate(f"no floating-point check: {error}")
        return None
