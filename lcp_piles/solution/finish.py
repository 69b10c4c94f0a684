"""From an exact state of a contact system to the verified solution of the whole scene."""

from __future__ import annotations

from time import perf_counter

from flint import fmpz

from ..errors import VerificationError
from ..mechanics.bilateral import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector
from .partition import partition
from .solution import Record, Solution, states_of
from .stability import stability
from .uniqueness import forces_unique, with_all_loads
from .verify import verify


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
    solved = partition(system, with_all_loads(system, state))
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
    return checked(solution)


def collapsed(system: ContactSystem, motion: list[fmpz], record: Record) -> Solution:
    """The verified answer that a scene cannot stand."""
    freedoms = ExactVector({1: motion}, fmpz(1))
    collapse = system.whole_displacements(freedoms, prescribed=False)
    return checked(Solution(system.scene, "unstable", record, collapse=collapse))


def checked(solution: Solution) -> Solution:
    """The solution, or `VerificationError` where it fails its own check."""
    check = verify(solution.scene, solution)
    if not check.ok:
        raise VerificationError("the result fails its own check: " + "; ".join(check.faults))
    return solution
