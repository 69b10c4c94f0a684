"""The Z algorithm as a method: from a contact system to an outcome, in any arithmetic."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from typing import Any

from ...mechanics.motions import CollapseError, free_motions
from ...mechanics.system import ContactSystem
from ...solution.fit import check_fit
from ..float_state import FloatState
from ..method import Arithmetic, Method, Outcome, Progress
from .z_iteration import Distances, Iteration, LinearStep, iterate
from .z_steps import closed_mask, exact_step, float_step, float_tolerance, physical

DEFAULT_LIMIT = 1000


def z_iteration(
    system: ContactSystem, arithmetic: Arithmetic, start: Iterable[int], limit: int
) -> Iteration[Any]:
    """Iterate on a contact system, from the set `start` of its contacts removed at first."""
    exact = arithmetic == "exact"
    step: LinearStep[Any] = exact_step(system) if exact else float_step(system, arithmetic)
    o = physical(system, system.gap)
    distances: Distances = o if exact else o.array()
    return iterate(step, start, distances, limit)


def z_outcome(system: ContactSystem, arithmetic: Arithmetic, ended: Iteration[Any]) -> Outcome:
    """What the end of an iteration proves, or only says, of the contact system.

    Raises `ContradictionError` where the iteration is exact, found no solution, and no
    displacements fit the rigid contacts.
    """
    steps = len(ended.trace)
    if ended.status == "solved" and ended.last is not None:
        state = ended.last.state
        if isinstance(state, FloatState):
            return Outcome(steps, "none: floating point", replace(state, steps=steps))
        return Outcome(steps, "fixed point of the Z iteration, verified", state)
    why = {
        "cycle": f"{len(ended.cycle)} sets follow each other for ever",
        "limit": f"no end after {steps} systems",
        "unstable": "no forces found to balance the load",
    }
    if arithmetic == "exact":
        try:
            free_motions(system, closed_mask(system, frozenset())).check(system.load)
        except CollapseError as collapse:
            proof = "a free motion of the pile with all contacts closed is loaded"
            return Outcome(steps, proof, motion=collapse.motion)
        check_fit(system)
        why["unstable"] = "rigid contacts cannot all be closed, and no contact is left to put back"
    return Outcome(steps, "none: " + why[ended.status])


def run_z(
    arithmetic: Arithmetic, system: ContactSystem, progress: Progress | None = None
) -> Outcome:
    """The Z algorithm from the set of all contacts, as a method of `solve`."""
    return z_outcome(system, arithmetic, z_iteration(system, arithmetic, (), DEFAULT_LIMIT))


Z = Method("z", "the paper's Z iteration, which may cycle", "exact", partial(run_z, "exact"))


def _in_floats(arithmetic: Arithmetic) -> Method:
    return Method(
        f"z-{arithmetic}",
        f"the paper's Z iteration in {arithmetic}",
        arithmetic,
        partial(run_z, arithmetic),
        float_tolerance(arithmetic),
    )


Z_FLOAT64, Z_FLOAT32 = _in_floats("float64"), _in_floats("float32")
Z_METHODS = {method.arithmetic: method for method in (Z, Z_FLOAT64, Z_FLOAT32)}
