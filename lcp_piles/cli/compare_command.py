"""`lcp-piles compare`: Lemke's method against the Z algorithm of the paper, size by size."""

from __future__ import annotations

import argparse
from typing import Any

from ..paper.compare import compare
from ..scenes.kinds import KINDS
from ..scenes.names import contact_name
from .options import SIZE, add_kind, add_parameters, parameters, sizes
from .output import Narrator
from .status import ERROR, SOLVED

EXAMPLE = "compare tss --layers 2..12"
"""What `--help` shows."""


def add(commands: Any) -> argparse.ArgumentParser:
    """The words of this command."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "compare",
        help="Lemke's method and the paper's Z algorithm, size by size",
        description="Solve piles of one kind exactly by Lemke's method and by the Z algorithm of "
        "the paper, and print where their contact sets differ and what each of them took.",
    )
    kinds = [kind for kind in KINDS.values() if any(p.name == SIZE for p in kind.parameters)]
    add_kind(parser, kinds)
    parser.add_argument(
        f"--{SIZE}", dest="sizes", required=True, metavar="A..B", help="sizes, or one size"
    )
    add_parameters(parser, kinds, leave_out=[SIZE])
    return parser


def run(options: argparse.Namespace) -> int:
    """One line a size, the contacts that differ below it."""
    given, wanted = parameters(options), sizes(options)
    header = ("N", "contacts", "sets", "pivots", "iterations", "put back", "singular")
    print("  ".join([*(f"{name:>10}" for name in header), "   Lemke s", "       Z s"]))
    failed = False
    bar = Narrator(options.quiet).bar("size", len(wanted))
    for size in wanted:
        (c,) = compare(options.kind, [size], **given)
        failed |= c.equal is None
        verdict = {True: "equal", False: "differ", None: c.z_status}[c.equal]
        row = (c.layers, c.contacts, verdict, c.pivots, c.iterations, c.reintroductions, c.singular)
        times = f"{c.lemke_seconds:>10.3g}  {c.z_seconds:>10.3g}"
        bar.write("  ".join([*(f"{value!s:>10}" for value in row), times]))
        for d in c.differences:
            bar.write(f"{'':>12}{contact_name((d.a, d.b))} ({d.state}): {d.reason}")
        if c.forces_equal is False:
            bar.write(f"{'':>12}the forces differ")
        bar.update()
    bar.close()
    return ERROR if failed else SOLVED
