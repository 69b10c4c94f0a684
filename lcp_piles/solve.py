"""From a scene to its verified solution."""

from __future__ import annotations

from time import perf_counter

import numpy as np

from .errors import InputError, SolveError
from .linear.threads import one_thread
from .mechanics.system import contact_system
from .methods.method import Progress, answer
from .methods.registry import METHODS
from .scenes.scene import Scene
from .solution.solution import Solution


@one_thread()
def solve(
    scene: Scene,
    method: str = "proved",
    *,
    whole: bool = False,
    progress: Progress | None = None,
) -> Solution:
    """The forces, gaps and displacements of a scene, verified.

    Parameters: `method`, a name of `methods.registry.METHODS`: "proved" (exact: floating point
    proposes, exact arithmetic decides), "lemke" (exact, cold start, no floating point), "z" (exact,
    the paper's iteration, which may cycle), or one in floating point, of which "newton" is the best
    and "fire", "gauss-seidel", "lemke-float64", "z-float64" and so on are for comparison; `whole`,
    to solve the whole pile where its symmetric half would do; `progress`, called with a line of
    text now and then.

    The status is a property of the scene, the same by every exact method: "solved" where forces
    balance the load and displacements fit the rigid contacts; "unstable" where displacements fit
    and no forces balance, which a collapse proves. Where no displacements fit, whatever the load,
    `ContradictionError` is raised, with a stress that proves it. "unresolved" claims nothing: an
    iteration gave up, or compliances are negative.

    Raises `VerificationError` rather than return an exact result that fails its own check, and
    `SolveError` where a method in floating point is asked for a scene with numbers beyond the range
    of floats.

    >>> from lcp_piles import nt30
    >>> pile = solve(nt30(2))
    >>> pile.status, pile.count("open"), pile.force((2, 2), "floor")
    ('solved', 1, 3/2)
    """
    if method not in METHODS:
        raise InputError("the method", method, "one of " + ", ".join(METHODS))
    start = perf_counter()
    system = contact_system(scene, "whole" if whole else None)
    if progress:
        progress(f"{system.dof} degrees of freedom, {system.contacts} contacts to decide")
    chosen = METHODS[method]
    if chosen.arithmetic != "exact" and not system.in_range(chosen.arithmetic):
        raise SolveError(
            f"the scene has numbers beyond the range of {chosen.arithmetic}: use an exact method"
        )
    with np.errstate(over="ignore", invalid="ignore"):  # floats that overflow claim nothing
        outcome = chosen.run(system, progress)
    return answer(system, chosen, outcome, start)
