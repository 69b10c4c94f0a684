"""From an exact state of a contact system to the verified solution of the whole scene."""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

from flint import fmpz

from ..errors import VerificationError
from ..mechanics.motions import Motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector
from .partition import partition
from .record import Record
from .solution import Solution, Solved, Unstable, states_of
from .stability import stability
from .uniqueness import forces_unique, with_all_loads
from .verify import verify


def finished(
    system: ContactSystem, state: State, record: Record, free: Motions | None = None
) -> Solved:
    """The verified solution of the whole scene from an exact state of the system.

    `free` are motions of some contact set that are known already.
    """
    scene = system.scene
    solved = partition(system, with_all_loads(system, state), free)
    verdict, unique = stability(system, solved)
    forces = system.whole_forces(solved.state.forces)
    gaps = system.whole_gaps(solved.state.gaps)
    solution = Solved(
        scene,
        record,
        forces,
        gaps,
        system.whole_displacements(solved.state.displacements),
        states_of(forces, gaps),
        tuple(unique.tolist()),
        forces_unique(system, solved),
        verdict,
    )
    _check(solution)
    return solution


def collapsed(system: ContactSystem, motion: list[fmpz], record: Record) -> Unstable:
    """The verified answer that a scene cannot stand."""
    freedoms = ExactVector({1: motion}, fmpz(1))
    collapse = system.whole_displacements(freedoms, prescribed=False)
    solution = Unstable(system.scene, record, collapse)
    _check(solution)
    return solution


def timed(solution: Solution, start: float) -> Solution:
    """The solution, with the wall time since `start` (`perf_counter`) in its record."""
    return replace(solution, record=replace(solution.record, seconds=perf_counter() - start))


def _check(solution: Solution) -> None:
    """Raise `VerificationError` where a solution fails its own check."""
    check = verify(solution.scene, solution)
    if not check.ok:
        raise VerificationError("the result fails its own check: " + "; ".join(check.faults))
