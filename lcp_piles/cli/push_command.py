"""`lcp-piles push`: every rearrangement as the corner stones are pushed together."""

from __future__ import annotations

import argparse
import json
from typing import Any

from ..certificates.certify import certificate, text_of
from ..files.write_path import to_json
from ..numbers.exact import decimal
from ..push.path import END_IN_WORDS
from ..push.push_path import promise, push_path
from ..scenes.kinds import KINDS
from ..scenes.names import contact_name
from .options import (
    CERTIFICATE,
    add_contacts,
    add_digits,
    add_file,
    add_kind,
    add_parameters,
    contacts_of,
    exact,
    parameters,
    scene_of,
)
from .output import Narrator, draw, keep, steps, write
from .report import describe, number
from .status import ERROR, SOLVED, UNSTABLE

EXAMPLE = "push nt30 --layers 6 --plot push.png"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "push",
        help="every rearrangement as the corner stones are pushed",
        description="Push both corner stones towards the axis, from no push on, and print every "
        "push at which the contact network changes, exactly.",
    )
    kinds = [kind for kind in KINDS.values() if kind.push]
    pushed = {kind.push.parameter for kind in kinds if kind.push}
    add_kind(parser, kinds)
    add_parameters(parser, kinds, leave_out=sorted(pushed))
    parser.add_argument(
        "--until", type=exact, metavar="X", help="stop at this push; a negative one pulls"
    )
    add_file(parser, "--json", "write the path (- is standard output)", ".json")
    add_file(parser, "--certificate", CERTIFICATE, ".json")
    add_file(parser, "--plot", "draw the pressure under the apex against the push")
    add_contacts(parser, "print, at every rearrangement, the force of")
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Follow the path, print its rearrangements, write the files that were asked for."""
    # What is wrong with the words is said before the work begins.
    shown = contacts_of(options, scene_of(options))
    narrate = Narrator(options.quiet)
    with narrate.bar("piece") as bar:
        path = push_path(
            options.kind, **parameters(options), until=options.until, progress=steps(bar)
        )
    narrate(f"{len(path.rearrangements)} rearrangements")
    text = [describe(path.scene)]
    width = len(str(len(path.rearrangements)))
    for k, r in enumerate(path.rearrangements, 1):
        text.append(f"{k:>{width}}  push {number(r.push, options.digits)}")
        for what, contacts in (("opens", r.opens), ("closes", r.closes)):
            if contacts:
                names = ", ".join(contact_name((c.a, c.b)) for c in contacts)
                text.append(f"{'':>{width}}  {what} {names}")
        for c in shown:
            force = number(path.force(c.a, c.b, r.push), options.digits)
            text.append(f"{'':>{width}}  force {contact_name((c.a, c.b))}: {force} w")
    text.append(f"end: {END_IN_WORDS[path.end]}")
    last = path.path.segments[-1].first * path.unit + path.start
    text.append(f"the last piece starts at push {decimal(last, options.digits)}")
    text.append(f"promise: {promise(path.scene)}")
    content = json.dumps(to_json(path), indent=1) + "\n" if options.json else ""
    write(narrate, "\n".join(text), content, options.json)
    if options.certificate:
        keep(narrate, text_of(certificate(path)), options.certificate)
    if options.plot:
        from ..pictures import draw_apex_pressure

        draw(narrate, draw_apex_pressure(path), options.plot)
    return {"reached": SOLVED, "asymptotic": SOLVED, "unstable": UNSTABLE}.get(path.end, ERROR)
