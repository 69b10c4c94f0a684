"""A case as plain data: the setup in decimals and exactly, the forces, what to expect of a code."""

from __future__ import annotations

from typing import Any

from benchmarks.reference.cases import Case
from lcp_piles import Solution, Surd, first_order, solve
from lcp_piles.scenes.names import end_name

FORMAT = "lcp-piles-reference/1"
_EXPECT = {
    "stable": "A correct code comes to rest here from nearby, with these forces up to tau times "
    "`per_tau` and terms of order tau squared.",
    "saddle": "Forces balance here, and a code that starts here without noise may stay; but a free "
    "motion lowers the energy, so a correct code may also slide off and come to rest elsewhere.",
    "neutral": "A correct code finds these forces; some discs are free to move without any change.",
    "undecided": "A correct code finds these forces; whether it stays is not decided.",
}


def record(case: Case) -> tuple[dict[str, Any], Solution]:
    """The data of a case, and the solution that they are read off."""
    scene = case.scene()
    solution = solve(scene)
    data: dict[str, Any] = {
        "format": FORMAT,
        "name": case.name,
        "tests": case.tests,
        "units": "lengths in disc radii R, forces in disc weights w, compliance tau in R/w",
        "scene": repr(scene).strip("<>"),
        "status": solution.status,
        "discs": [
            {
                "id": end_name(disc.id),
                "position": [_both(x) for x in disc.position],
                "radius": float(disc.radius),
                "load": [float(x) for x in disc.load],
                "held": [None if h is None else _both(h) for h in disc.held],
            }
            for disc in scene.discs
        ],
    }
    if solution.status == "solved":
        data |= _solved(solution)
    elif solution.status == "unstable":
        data["expect"] = "No forces balance the load: a correct code sees the discs move."
        data["collapse"] = [str(x) for x in solution.collapse]
    return data, solution


def _both(x: Surd) -> list[Any]:
    """A number as a decimal of 17 digits and exactly."""
    return [float(x), str(x)]


def _solved(solution: Any) -> dict[str, Any]:
    rates, until = _first_order(solution)
    contacts = []
    for k, contact in enumerate(solution.scene.contacts):
        contacts.append(
            {
                "a": end_name(contact.a),
                "b": end_name(contact.b),
                "normal": [float(n) for n in contact.normal],
                "compliance": float(contact.compliance),
                "force": _both(solution.forces[k]),
                "state": solution.states[k],
                "per_tau": None if rates is None else float(rates[k]),
            }
        )
    verdict = solution.stability.verdict
    expect = _EXPECT[verdict]
    if rates is None:
        expect += " No deformable pile keeps this network to first order, however stiff it is."
    return {
        "stability": verdict,
        "mechanisms": solution.stability.mechanisms,
        "expect": expect,
        "first_order_until": until,
        "contacts": contacts,
    }


def _first_order(solution: Solution) -> tuple[Any, float | None]:
    """f1 of every contact, and up to which tau f0 + tau f1 keeps all contacts as they are."""
    found = first_order(solution)
    if found.status == "none":
        return None, None
    tau, _ = found.range
    return found.forces, None if tau is None else float(tau)
