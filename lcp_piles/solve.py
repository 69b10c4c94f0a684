"""From a scene to its verified solution."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

from flint import fmpz

from .bilateral import CollapseError, State
from .contact_lcp import contact_lcp
from .errors import InputError, VerificationError
from .lemke import lemke
from .partition import partition
from .scene import Scene
from .solution import Record, Solution, states_of
from .stability import stability
from .system import ContactSystem, contact_system
from .uniqueness import forces_unique
from .vectors import ExactVector
from .verify import verify

Progress = Callable[[str], None]
METHODS = ("lemke", "newton")


def solve(
    scene: Scene,
    method: str = "lemke",
    *,
    whole: bool = False,
    progress: Progress | None = None,
) -> Solution:
    """The forces, gaps and displacements of a scene, verified.

    Parameters: `method`, "lemke" (exact, cold start) or "newton" (floating point); `whole`, to
    solve the whole pile where its symmetric half would do; `progress`, called with a line of text
    now and then. Raises `VerificationError` rather than return an exact result that fails its own
    check.

    >>> from lcp_piles import nt30
    >>> pile = solve(nt30(2))
    >>> pile.status, pile.count("open"), pile.force((2, 2), "floor")
    ('solved', 3, 3/2)
    """
    if method not in METHODS:
        raise InputError("the method", method, "one of " + ", ".join(METHODS))
    start = perf_counter()
    system = contact_system(scene, "whole" if whole else None)
    if progress:
        progress(f"{system.dof} degrees of freedom, {system.contacts} contacts to decide")
    if method == "newton":
        from .newton import newton_solution

        return newton_solution(system, start)
    return _by_lemke(system, start, progress)


def _by_lemke(system: ContactSystem, start: float, progress: Progress | None) -> Solution:
    def record(pivots: int, proof: str) -> Record:
        return make_record(system, "lemke", "exact", pivots, proof, start)

    try:
        reduced = contact_lcp(system)
    except CollapseError as collapse:
        return collapsed(system, collapse.motion, record(0, "a free motion is loaded"))
    last = [perf_counter()]

    def tick(pivots: int) -> None:
        if progress and perf_counter() - last[0] > 1:
            last[0] = perf_counter()
            progress(f"{pivots} pivots")

    result = lemke(reduced.problem, progress=tick)
    if result.status == "ray":
        if result.certificate is None:
            return Solution(
                system.scene,
                "unresolved",
                record(result.pivots, "none: an indefinite problem, and Lemke ended on a ray"),
            )
        motion = reduced.motion(result.certificate)
        return collapsed(system, motion, record(result.pivots, "Farkas certificate"))
    assert result.z_vector is not None
    state = reduced.state(result.z_vector)
    return finished(system, state, "lemke", result.pivots, "exact Lemke pivots, verified", start)


def make_record(
    system: ContactSystem, method: str, arithmetic: str, pivots: int, proof: str, start: float
) -> Record:
    """The record of a result that is ready now."""
    scene = system.scene
    free = sum(h is None for disc in scene.discs for h in disc.held)
    return Record(
        method,
        arithmetic,
        pivots,
        proof,
        system.reduction.part,
        system.dof,
        system.contacts,
        free,
        len(scene.contacts),
        perf_counter() - start,
    )


def finished(
    system: ContactSystem, state: State, method: str, pivots: int, proof: str, start: float
) -> Solution:
    """The verified solution of the whole scene from an exact state of the system."""
    scene = system.scene
    solved = partition(system, state)
    verdict, unique = stability(system, solved)
    forces = system.whole_forces(solved.state.forces)
    gaps = system.whole_gaps(solved.state.gaps)
    solution = Solution(
        scene,
        "solved",
        make_record(system, method, "exact", pivots, proof, start),
        forces,
        gaps,
        system.whole_displacements(solved.state.displacements),
        states_of(forces, gaps),
        tuple(unique.tolist()),
        forces_unique(system, solved),
        verdict,
    )
    return _checked(solution)


def collapsed(system: ContactSystem, motion: list[fmpz], record: Record) -> Solution:
    """The verified answer that a scene cannot stand."""
    freedoms = ExactVector({1: motion}, fmpz(1))
    collapse = system.whole_displacements(freedoms, prescribed=False)
    return _checked(Solution(system.scene, "unstable", record, collapse=collapse))


def _checked(solution: Solution) -> Solution:
    check = verify(solution.scene, solution)
    if not check.ok:
        raise VerificationError("the result fails its own check: " + "; ".join(check.faults))
    return solution
