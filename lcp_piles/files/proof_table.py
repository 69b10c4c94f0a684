"""Proved forces as a table: what the proof of a packing has in place of exact numbers."""

from __future__ import annotations

from ..methods.contact_proof import ContactProof
from ..packings.packing import Packing
from ..scenes.names import end_name
from .tables import csv_text

AXES = "xyz"


def proof_csv(packing: Packing, proof: ContactProof) -> str:
    """A row a contact as CSV: its ends, its place, and force and gap with their proved bounds.

    Numbers are in the units of the packing; `state` is closed, open, or unproved. Places are those
    where contacts touch disc a, left out where the packing has none.

    >>> from lcp_piles import packing, prove_packing
    >>> ball = packing([(0, 1)], 1, supports={"floor": 0})
    >>> print(proof_csv(ball, prove_packing(ball)).splitlines()[1][:22])
    0,floor,closed,1.0,1.0
    """
    geometry, axes = packing.geometry, AXES[: packing.dimension]
    header = ["a", "b", "state", "force", "stiffness"]
    header += ["force_error", "gap", "gap_error", *(f"normal_{axis}" for axis in axes)]
    rows = []
    for k in range(len(packing.a)):
        a, b = packing.contact_ends(k)
        state = "closed" if proof.loaded[k] else "open"
        row = [
            end_name(a),
            end_name(b),
            "unproved" if k in proof.unproved else state,
            float(proof.forces.middle[k]),
            float(packing.stiffness[k]),
            float(proof.forces.radius[k]),
            float(proof.gaps.middle[k]),
            float(proof.gaps.radius[k]),
            *packing.normals.high[k].tolist(),
        ]
        if geometry is not None:
            disc = packing.a[k]
            row += (
                geometry.centres[disc] - geometry.radii[disc] * packing.normals.high[k]
            ).tolist()
        rows.append(row)
    return csv_text([*header, *(axes if geometry is not None else ())], rows)
