"""What is measured: functions of plain arguments that say what came out."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcp_piles import (
    Packing,
    contact_system,
    packing,
    pile,
    prove_contacts,
    prove_packing,
    push_path,
    solve,
    solve_packing,
)
from lcp_piles.methods.newton import newton


def warm_up() -> None:
    """Import and compile what every task needs."""
    for method in ("proved", "lemke", "newton"):
        solve(pile("nt30", 3), method)


def whole_solution(
    kind: str, layers: int, method: str = "proved", **parameters: Any
) -> dict[str, Any]:
    """From nothing to the verified solution of the whole pile."""
    solution = solve(pile(kind, layers, **parameters), method)
    record = solution.record
    return {
        "status": solution.status,
        "pivots": record.pivots,
        "dof": record.dof,
        "mechanisms": solution.stability.mechanisms if solution.stability else None,
        "guess_errors": record.guess_errors,
    }


def newton_solve(kind: str, layers: int) -> dict[str, Any]:
    """Newton's method in floating point, from nothing to its displacements."""
    result = newton(contact_system(pile(kind, layers)))
    return {"converged": result.converged, "iterations": result.steps}


def contact_proof(kind: str, layers: int) -> dict[str, Any]:
    """The contact set proved without digits, from nothing."""
    proof = prove_contacts(pile(kind, layers))
    return {"proved": proof.proved, "unproved": len(proof.unproved)}


def all_breakpoints(kind: str, layers: int) -> dict[str, Any]:
    """Every rearrangement under a push, exactly."""
    path = push_path(kind, layers)
    return {"breakpoints": len(path.rearrangements), "end": path.end, "pivots": path.path.pivots}


def packing_proof(columns: int, rows: int) -> dict[str, Any]:
    """Contacts, contact set and bounds of the forces of a packing, from centres and radii."""
    found = _packed(columns, rows)
    proof = prove_packing(found)
    return {
        "discs": len(found.ids),
        "contacts": len(found.a),
        "loaded": int(proof.loaded.sum()),
        "radius": float(proof.forces.radius.max() / proof.forces.middle.max()),
        "unproved": len(proof.unproved),
    }


def near_packing(columns: int, rows: int, angle: float) -> dict[str, Any]:
    """The exact solution of a packing whose normals are rational, and the proof beside it."""
    near = solve_packing(_packed(columns, rows), angle)
    assert near.proof is not None
    force = max(near.solution.forces)
    return {
        "discs": len(near.packing.ids),
        "bits": force.rational().denominator.bit_length(),
        "change": near.force_change / float(near.proof.forces.middle.max()),
        "differing": len(near.differing),
    }


def _packed(columns: int, rows: int) -> Packing:
    """Discs of unlike radii near a triangular lattice, in a box."""
    rng = np.random.default_rng(columns * rows)
    places = [(1 + 2 * i + j % 2, 1 + j * 3**0.5) for j in range(rows) for i in range(columns)]
    centres = np.array(places) + 0.005 * rng.standard_normal((len(places), 2))
    radii = rng.uniform(0.99, 1.01, len(places))
    box = {"floor": 0.0, "left": 0.0, "right": 2.0 * columns + 1}
    return packing(centres, radii, supports=box, tolerance=0.05, stiffness=1e3)
