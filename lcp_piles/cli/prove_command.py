"""`lcp-piles prove`: the contact set proved without digits, and bounds of the forces."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from ..methods.bounds import prove_contacts
from ..scenes.names import contact_name
from .options import add_digits, add_scene
from .output import opening
from .report import aligned, describe
from .status import ERROR, SOLVED


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "prove",
        help="the contact set, proved without exact fractions",
        description="Prove which contacts carry a force, and bound every force rigorously in "
        "floating point: certainty at little more than the price of a floating-point solution. "
        "Exit status: 0 proved, 1 not proved.",
    )
    add_scene(parser)
    add_digits(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Prove, print what is proved and what is not."""
    scene, _ = opening(options)
    proof = prove_contacts(scene)
    contacts, forces = scene.contacts, proof.forces
    lines = [
        ("scene", describe(scene)),
        ("contact set", "proved" if proof.proved else "not proved"),
        ("contacts", f"{int(proof.loaded.sum())} carry a force, {int((~proof.loaded).sum())} none"),
    ]
    if proof.zero.any():
        count = int(proof.zero.sum())
        lines.append(("", f"of these {count} touch without force: they hold mechanisms"))
    for k in proof.unproved:
        c = contacts[k]
        near = f"force {abs(forces.middle[k]):.3g} w, gap {abs(proof.gaps.middle[k]):.3g} w tau"
        lines.append(("unproved", f"{contact_name((c.a, c.b))}: {near}, too close to zero to tell"))
    if len(contacts):
        k = int(np.argmax(forces.middle))
        name = contact_name((contacts[k].a, contacts[k].b))
        largest = f"{forces.middle[k]:.{min(options.digits, 17)}g} w"
        lines.append(("largest force", f"{name}: {largest}, within {forces.radius[k]:.1e}"))
    lines.append(
        (
            "bounds",
            f"every force within {forces.radius.max(initial=0.0):.1e} w, "
            f"every gap within {proof.gaps.radius.max(initial=0.0):.1e} w tau",
        )
    )
    lines.append(("time", f"{proof.seconds:.3g} s"))
    print(aligned(lines))
    return SOLVED if proof.proved else ERROR
