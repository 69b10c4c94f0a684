"""`lcp-piles bounds`: what friction leaves open, contact by contact."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from typing import Any

from ..certificates.certify import checked, text_of
from ..certificates.friction import bounds_certificate
from ..errors import SolveError
from ..fields.field import Cell, Column, Table
from ..files.tables import csv_text
from ..friction.equations import friction_problem
from ..friction.extremes import extremes
from ..friction.first_loading import UnresolvedError, first_loading
from ..friction.force_bounds import ContactBounds, InadmissibleError
from ..friction.indeterminacy import indeterminacy, is_admissible
from ..numbers.exact import Surd
from ..numbers.vectors import exact_vector
from ..scenes.names import contact_name
from ..scenes.scene import Scene
from ..solve import solve
from .friction_bounds import bounds_with_bar
from .options import (
    CERTIFICATE,
    add_digits,
    add_file,
    add_friction,
    add_scene,
    rough_of,
    whole_number,
)
from .output import Narrator, draw, keep, opening, write
from .report import aligned, describe, table_text
from .status import SOLVED, UNSTABLE

EXAMPLE = "bounds nt60 --layers 4 --friction 3/10 --inside --plot bounds.png"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "bounds",
        help="with friction: the least and largest force of every contact",
        description="Over all force networks that Coulomb's law admits, find the exact least and "
        "largest normal force of every contact, each bound proved. Exit status: 0 solved, 1 error, "
        "2 usage, 3 no network balances the loads.",
    )
    add_scene(parser)
    add_friction(parser)
    parser.add_argument(
        "--inside",
        action="store_true",
        help="show beside the bounds, in the picture too, the forces without friction and those of "
        "first loading; and the dimension of the set of networks, of a tiny pile its corners",
    )
    parser.add_argument(
        "--jobs",
        type=whole_number(1, 256, "number of processes"),
        default=1,
        metavar="N",
        help="processes to share the work (default 1)",
    )
    add_file(parser, "--csv", "write the table (- is standard output)", ".csv")
    add_file(parser, "--certificate", CERTIFICATE, ".json")
    add_file(parser, "--plot", "draw the intervals (png, pdf, svg)")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Bound every contact, print the table, write the files that were asked for."""
    scene, narrate = opening(options)
    rough = rough_of(options, scene)
    try:
        bounds = bounds_with_bar(narrate, scene, options.friction, rough, options.jobs)
    except InadmissibleError as error:
        print(f"no network: {error}")
        _certify(options, scene, rough, narrate)
        return UNSTABLE
    facts, forces = _inside(bounds) if options.inside else ([], {})
    if options.inside:
        facts.append(("corners", _corners(bounds)))
    table = _table(bounds, forces)
    summary = _summary(bounds, facts)
    text = f"{summary}\n\n{table_text(table, options.digits)}"
    write(narrate, text, csv_text(table.header(), table.lines()), options.csv)
    _certify(options, scene, rough, narrate)
    narrate.time()
    if options.plot:
        from ..pictures import draw_bounds

        draw(narrate, draw_bounds(bounds, inside=forces), options.plot)
    return SOLVED


def _certify(
    options: argparse.Namespace, scene: Scene, rough: Sequence[str], narrate: Narrator
) -> None:
    if options.certificate:
        entry = bounds_certificate(scene, options.friction, rough)
        keep(narrate, text_of(checked(entry)), options.certificate)


def _inside(bounds: ContactBounds) -> tuple[list[tuple[str, str]], dict[str, Sequence[Surd]]]:
    """What is known of the set of networks, and the forces of two that elasticity chooses."""
    scene, mu, rough = bounds.scene, bounds.mu, bounds.rough
    found = indeterminacy(scene, mu, rough)
    known = f"{found.unknowns} force components, rank {found.rank}"
    facts = [
        ("networks", f"a set of dimension {found.dimension}"),
        ("hyperstaticity", f"{found.hyperstaticity}: {known}"),
    ]
    forces: dict[str, Sequence[Surd]] = {}
    problem = friction_problem(scene, mu, rough)
    frictionless = solve(scene)
    if frictionless.status == "solved":
        normal = exact_vector(list(frictionless.forces))
        nothing = exact_vector([0] * len(normal))
        forces["frictionless"] = list(normal)
        facts.append(("frictionless", _admitted(is_admissible(problem, normal, nothing))))
    try:
        network = first_loading(scene, mu, rough).network
        forces["first loading"] = list(network.normal)
        inside = is_admissible(problem, network.normal, network.tangential)
        facts.append(("first loading", _admitted(inside)))
    except UnresolvedError as error:
        facts.append(("first loading", f"unresolved: {error}"))
    return facts, forces


def _corners(bounds: ContactBounds) -> str:
    """How many corners the set of networks has, and its volume, where that can be listed."""
    try:
        found = extremes(bounds.scene, bounds.mu, bounds.rough)
    except SolveError as error:
        return f"not listed: {error}"
    size = "no volume" if found.volume is None else f"volume {found.volume}"
    if found.rays:
        size = f"{len(found.rays)} directions without end"
    return f"{len(found.networks)}, {size}"


def _admitted(inside: bool) -> str:
    return "within the bounds" if inside else "not admissible"


def _summary(bounds: ContactBounds, facts: list[tuple[str, str]]) -> str:
    pairs = list(zip(bounds.least, bounds.largest, strict=True))
    floor = f"; {', '.join(bounds.rough)} as rough" if bounds.rough else ""
    return aligned(
        [
            ("scene", describe(bounds.scene)),
            ("friction", f"mu = {bounds.mu}{floor}"),
            ("contacts", str(len(pairs))),
            ("determined", str(sum(low == high for low, high in pairs))),
            ("always loaded", str(sum(low > 0 for low, _ in pairs))),
            ("no largest", str(sum(high is None for _, high in pairs))),
            *facts,
            ("proof", f"every bound by duality, {bounds.exact_pivots} exact pivots"),
        ]
    )


def _table(bounds: ContactBounds, forces: Mapping[str, Sequence[Surd]]) -> Table:
    names = ("least", "largest", *forces)
    columns = (Column("contact"), *(Column(name, exact=True) for name in names))
    values = zip(bounds.least, bounds.largest, *forces.values(), strict=True)
    rows: list[list[Cell]] = [
        [contact_name((contact.a, contact.b)), *numbers]
        for contact, numbers in zip(bounds.scene.contacts, values, strict=True)
    ]
    return Table(columns, rows)
