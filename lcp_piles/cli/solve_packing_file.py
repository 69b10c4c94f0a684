"""`lcp-piles solve` of a table of discs: proved as they are, or exactly next to it."""

from __future__ import annotations

import argparse
import os

from ..files.export import FORMATS, format_of
from ..files.proof_table import proof_csv
from ..files.write_result import dumps
from ..methods.contact_proof import ContactProof
from ..methods.packings.prove import prove_packing
from ..packings.packing import Packing
from ..solve_packing import NearSolution, solve_packing
from .output import Narrator, draw, keep, write
from .proof_text import describe_packing, proof_lines
from .report import aligned, summary
from .status import ERROR, SOLVED, UNSTABLE


def run_packing(options: argparse.Namespace, packing: Packing) -> int:
    """Prove the forces, print what is proved, write the files that were asked for."""
    _check_words(options)
    narrate = Narrator(options.quiet)
    narrate(describe_packing(packing))
    proof: ContactProof | None
    if options.exact is None:
        proof = prove_packing(packing)
        lines = [("scene", describe_packing(packing)), *proof_lines(proof, options.digits)]
        write(narrate, aligned(lines), "", None)
        for file in options.out:
            keep(narrate, proof_csv(packing, proof), file)
    else:
        near = solve_packing(packing, options.exact)
        proof = near.proof
        text = _near_text(near, options.digits)
        write(narrate, text, dumps(near.solution) if options.json else "", options.json)
        for file in options.out:
            keep(narrate, format_of(file).text(near.solution), file)
    narrate.time()
    if options.plot and proof is not None:
        from ..pictures import draw_packing

        draw(narrate, draw_packing(proof), options.plot)
    return _status(proof)


def _check_words(options: argparse.Namespace) -> None:
    """What only scenes have, or only exact solutions."""
    if options.stiffness is not None or options.whole or options.contact:
        words = "--stiffness, --whole, --contact"
        options.parser.error(f"{words}: not of a packing; --contact-stiffness is, and --out")
    if options.exact is None:
        if options.json:
            options.parser.error("--json: a result file is exact; --exact ANGLE makes one")
        for file in options.out:
            if format_of(file) is not FORMATS[".csv"]:
                name = os.path.basename(file)
                options.parser.error(f"--out {name}: only .csv without --exact ANGLE")


def _near_text(near: NearSolution, digits: int) -> str:
    lines = [("angle", f"normals are rational, within {near.angle:.1e} of those of the packing")]
    if near.proof is not None:
        lines += [("", "of the packing itself:"), *proof_lines(near.proof, digits)]
    if near.force_change < float("inf"):
        lines.append(("change", f"no force differs by more than {near.force_change:.1e}"))
    if near.warning:
        lines.append(("WARNING", near.warning))
    return f"{summary(near.solution, digits=digits)}\n{aligned(lines)}"


def _status(proof: ContactProof | None) -> int:
    if proof is None or (proof.collapse is None and not proof.proved):
        return ERROR
    return SOLVED if proof.collapse is None else UNSTABLE
