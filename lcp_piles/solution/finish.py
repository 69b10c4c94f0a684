"""From an exact state of a contact system to the verified solution of the whole scene."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from time import perf_counter

from flint import fmpz

from ..errors import VerificationError
from ..mechanics.motions import Motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector
from .fit import check_fit
from .identities import collapse_faults, identity_faults
from .partition import partition
from .record import Record
from .solution import Solution, Solved, Unstable, states_of
from .stability import stability
from .uniqueness import forces_unique, with_all_loads

_SHOWN = 10


def finished(
    system: ContactSystem, state: State, record: Record, free: Motions | None = None
) -> Solved:
    """The solution of the whole scene from an exact state of the system.

    Its identities are checked, whatever it came from. Mechanisms, verdict and uniqueness follow
    from it by exact arithmetic on both halves; `verify` asks for them anew on the whole pile.
    `free` are motions of some contact set that are known already.
    """
    scene = system.scene
    solved = partition(system, with_all_loads(system, state), free)
    verdict, unique = stability(system, solved)
    displacements = system.whole_displacements(solved.state.displacements)
    forces = system.whole_forces(solved.state.forces)
    gaps = system.whole_gaps(solved.state.gaps)
    states = states_of(forces, gaps)
    _raise_if(identity_faults(scene, displacements, forces, gaps, states))
    return Solved(
        scene,
        record,
        forces,
        gaps,
        displacements,
        states,
        tuple(unique.tolist()),
        forces_unique(system, solved),
        verdict,
    )


def collapsed(system: ContactSystem, motion: list[fmpz], record: Record) -> Unstable:
    """The verified answer that a scene cannot stand.

    Raises `ContradictionError` where nothing fits its rigid contacts in the first place.
    """
    check_fit(system)
    freedoms = ExactVector({1: motion}, fmpz(1))
    collapse = system.whole_displacements(freedoms, prescribed=False)
    _raise_if(collapse_faults(system.scene, collapse))
    return Unstable(system.scene, record, collapse)


def timed(solution: Solution, start: float) -> Solution:
    """The solution, with the wall time since `start` (`perf_counter`) in its record."""
    return replace(solution, record=replace(solution.record, seconds=perf_counter() - start))


def _raise_if(faults: Iterator[str]) -> None:
    """Raise `VerificationError` where a result fails its own check."""
    found = tuple(islice(faults, _SHOWN))
    if found:
        raise VerificationError("the result fails its own check: " + "; ".join(found))
