"""What is measured: functions of plain arguments that say what came out."""

from __future__ import annotations

from typing import Any

from lcp_piles import contact_system, pile, prove_contacts, push_path, solve
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
