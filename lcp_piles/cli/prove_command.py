"""`lcp-piles prove`: the contact set proved without digits, and bounds of the forces."""

from __future__ import annotations

import argparse
from typing import Any

from ..methods.bounds import prove_contacts
from ..methods.packings.prove import prove_packing
from .options import add_digits, add_scene
from .output import Narrator, opening
from .packing_options import add_packing, packing_of
from .proof_text import describe_packing, proof_lines
from .report import aligned, describe
from .status import ERROR, SOLVED, UNSTABLE

EXAMPLE = "prove tbs --layers 100"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "prove",
        help="the contact set, proved without exact fractions",
        description="Prove which contacts carry a force, and bound every force rigorously in "
        "floating point: certainty at little more than the price of a floating-point solution. "
        "Exit status: 0 proved, 1 not proved, 2 usage, 3 a packing that cannot stand.",
    )
    add_scene(parser)
    add_packing(parser)
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Prove, print what is proved and what is not."""
    packing = packing_of(options)
    if packing is not None:
        narrate = Narrator(options.quiet)
        what, proof = describe_packing(packing), prove_packing(packing)
    else:
        scene, narrate = opening(options)
        what, proof = describe(scene), prove_contacts(scene)
    narrate.time()
    print(aligned([("scene", what), *proof_lines(proof, options.digits)]))
    if proof.collapse is not None:
        return UNSTABLE
    return SOLVED if proof.proved else ERROR
