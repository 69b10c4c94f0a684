"""From a scene to its verified solution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import numpy as np

from .errors import InputError, SolveError
from .mechanics.bilateral import CollapseError, work_sign
from .mechanics.contact_lcp import ContactLCP, contact_lcp
from .mechanics.system import ContactSystem, contact_system
from .methods.newton import newton_solution
from .methods.proved import float_guess, prove_or_repair
from .pivoting.lemke import LemkeResult, lemke
from .scenes.scene import Scene
from .solution.finish import collapsed, finished
from .solution.record import make_record
from .solution.solution import Solution, Unresolved

Progress = Callable[[str], None]
METHODS = ("proved", "lemke", "newton")


def solve(
    scene: Scene,
    method: str = "proved",
    *,
    whole: bool = False,
    progress: Progress | None = None,
) -> Solution:
    """The forces, gaps and displacements of a scene, verified.

    Parameters: `method`, "proved" (exact: floating point proposes, exact arithmetic decides),
    "lemke" (exact, cold start, no floating point) or "newton" (floating point, not exact);
    `whole`, to solve the whole pile where its symmetric half would do; `progress`, called with a
    line of text now and then. Raises `VerificationError` rather than return an exact result that
    fails its own check, and `SolveError` where rigid contacts contradict each other.

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
    if method == "newton":
        return newton_solution(system, start)
    return (_by_lemke if method == "lemke" else _by_proof)(system, start, progress)


def _by_lemke(system: ContactSystem, start: float, progress: Progress | None) -> Solution:
    try:
        reduced = contact_lcp(system)
    except CollapseError as error:
        return _free_fall(system, error, "lemke", start)
    last = [perf_counter()]

    def tick(pivots: int) -> None:
        if progress and perf_counter() - last[0] > 1:
            last[0] = perf_counter()
            progress(f"{pivots} pivots")

    result = lemke(reduced.problem, progress=tick)
    if result.z_vector is None:
        return _ended_on_ray(reduced, result, "lemke", start)
    state = reduced.state(result.z_vector)
    return finished(system, state, "lemke", result.pivots, "exact Lemke pivots, verified", start)


def _by_proof(system: ContactSystem, start: float, progress: Progress | None) -> Solution:
    guess = float_guess(system)
    try:
        proved = prove_or_repair(system, guess, progress)
    except CollapseError as error:
        return _free_fall(system, error, "proved", start)
    if proved.state is None:
        assert proved.result is not None
        return _ended_on_ray(proved.lcp, proved.result, "proved", start)
    if progress:
        progress("states, stability and verification")
    pivots = proved.result.pivots if proved.result else 0
    proof = "floating point proposed the contact set, exact signs proved it"
    if proved.result:
        proof = (
            f"floating point proposed a contact set, {pivots} exact pivots repaired it, verified"
        )
    solution = finished(system, proved.state, "proved", pivots, proof, start)
    loaded = np.array(proved.state.forces.signs()) > 0
    wrong = int((loaded != guess.closed)[~system.bilateral].sum())
    return replace(solution, record=replace(solution.record, guess_errors=wrong))


def _free_fall(system: ContactSystem, error: CollapseError, method: str, start: float) -> Solution:
    """The answer where a load moves the pile although every contact is held closed."""
    record = make_record(system, method, "exact", 0, "a free motion is loaded", start)
    return collapsed(system, error.motion, record)


def _ended_on_ray(reduced: ContactLCP, result: LemkeResult, method: str, start: float) -> Solution:
    """The answer where Lemke's method found no solution: a collapse, if that is proved."""
    system = reduced.base.system
    if result.certificate is None:
        proof = "none: an indefinite problem, and Lemke's method ended on a ray"
        record = make_record(system, method, "exact", result.pivots, proof, start)
        return Unresolved(system.scene, record)
    motion = reduced.motion(result.certificate)
    if work_sign(system.load, motion) <= 0:
        raise SolveError(
            "no displacements fit the scene: rigid contacts would have to overlap (their initial "
            "gaps contradict each other)"
        )
    record = make_record(system, method, "exact", result.pivots, "Farkas certificate", start)
    return collapsed(system, motion, record)
