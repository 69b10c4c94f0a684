"""From a scene to its verified solution."""

from __future__ import annotations

from time import perf_counter

import numpy as np

from .errors import InputError
from .linear.threads import one_thread
from .mechanics.system import contact_system
from .methods.method import Outcome, Progress, answer
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

    The status is a property of the scene, the same by every exact method: "solved" where forces
    balance the load and displacements fit the rigid contacts; "unstable" where displacements fit
    and no forces balance, which a collapse proves. Where no displacements fit, whatever the load,
    every exact method raises `ContradictionError`, with a stress that proves it. "unresolved"
    claims nothing, and `record.proof` says why: the paper's iteration cannot go on, compliances are
    negative, or floating point cannot tell. In floating point a scene ends in "solved" or
    "unresolved", whatever it is: there is no proof of a collapse or of a contradiction.

    Parameters
    ----------
    scene : Scene
        Any scene.
    method : str, default "proved"
        A name of `METHODS`: "proved" (exact: floating point proposes, exact arithmetic decides),
        "lemke" (exact, cold start, no floating point), "z" (exact, the paper's iteration, which may
        cycle), or one in floating point, of which "newton" is the best and "fire", "gauss-seidel",
        "lemke-float64", "z-float64" and so on are for comparison.
    whole : bool, default False
        Whether to solve the whole pile where its symmetric half would do.
    progress : callable, optional
        Called with a line of text now and then.

    Returns
    -------
    Solved, Unstable or Unresolved
        Told apart by `status`.

    Raises
    ------
    InputError
        For an unknown method.
    ContradictionError
        Where rigid contacts contradict each other.
    SolveError
        Where no scaling of the axes by square roots makes all normals rational.
    VerificationError
        Rather than return an exact result that fails its own check.

    Examples
    --------
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
        outcome = Outcome(0, f"none: the scene has numbers beyond the range of {chosen.arithmetic}")
    else:
        with np.errstate(over="ignore", invalid="ignore"):  # floats that overflow claim nothing
            outcome = chosen.run(system, progress)
    return answer(system, chosen, outcome, start)
