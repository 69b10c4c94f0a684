"""What a solution claims beyond its identities, made anew on the whole pile.

The solver finds mechanisms, stability and uniqueness on the symmetric half and on the antisymmetric
one (`partition`, `stability`, `uniqueness`). Here the same is asked of the contact system of the
whole pile, of the signs of the solution's forces and gaps, and of nothing else. Given that the
identities hold, these are the definitions:

* a contact is osculatory where no other solution opens it, by a motion that leaves the closed
  contacts at rest, and none loads it, by a self-stress of rigid contacts;
* mechanisms leave the closed contacts at rest, free ones all that touch; the gap of a contact is
  unique where no free one moves it;
* a free mechanism that slides two discs pressed against each other lowers the energy;
* the forces of elastic contacts are unique, those of rigid ones where no self-stress acts on them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from flint import fmpz

from ..linear.integer_matrix import IntegerMatrix
from ..linear.integer_product import times
from ..linear.kernel import kernel
from ..linear.rearrangement import rows_of, transposed
from ..mechanics.system import ContactSystem, contact_system
from ..numbers.vectors import ExactVector, IntArray, Mask
from ..scenes.kind import has_unique_forces
from ..scenes.scene import Scene
from ..scenes.symmetry import mirror, reduction
from .partition import openable
from .record import Record
from .solution import Solved
from .stability import Verdict

Motions = list[list[fmpz]]


def claim_faults(
    scene: Scene, solution: Solved, forces: ExactVector, gaps: ExactVector
) -> Iterator[str]:
    """Every claim of an exact solution that does not hold, in words, given that its identities do.

    `forces` and `gaps` are those of the solution.
    """
    yield from record_faults(scene, solution.record, exact=True)
    system = contact_system(scene, "whole")
    force, gap = np.array(forces.signs(), dtype=int), np.array(gaps.signs(), dtype=int)
    held = (force != 0) | system.bilateral
    mechanisms = kernel(rows_of(system.B, held))[0]
    yield from _state_faults(system, force, gap, mechanisms)
    free = kernel(rows_of(system.B, gap == 0))[0] if mechanisms else []
    yield from _gap_faults(system, solution, free)
    yield from _stability_faults(system, solution, force, len(mechanisms), free)
    unique = _forces_unique(system, held)
    if solution.forces_unique is not unique:
        yield f"forces_unique is {solution.forces_unique}, but it is {unique}"


def float_claim_faults(scene: Scene, solution: Solved) -> Iterator[str]:
    """What a floating-point solution claims although floating point cannot prove it."""
    yield from record_faults(scene, solution.record, exact=False)
    if solution.stability is not None:
        yield "a verdict of stability, which floating point cannot prove"
    if solution.forces_unique is not None or solution.gap_unique:
        yield "unique forces or gaps, which floating point cannot prove"


def record_faults(scene: Scene, record: Record, *, exact: bool) -> Iterator[str]:
    """What the record says wrongly of the arithmetic, and of what was solved for this scene."""
    if record.exact != exact:
        numbers = "exact" if exact else "floating-point numbers"
        yield f"the arithmetic is called {record.arithmetic}, but the numbers are {numbers}"
    free = sum(h is None for disc in scene.discs for h in disc.held)
    sizes = {"whole_dof": free, "whole_contacts": len(scene.contacts)}
    symmetry = mirror(scene) if record.part == "even" else None
    if record.part == "whole":
        sizes |= {"dof": free, "contacts": len(scene.contacts)}
    elif record.part == "even" and symmetry is not None:
        half = reduction(scene, "even", symmetry)
        sizes |= {"dof": half.size, "contacts": len(half.representative)}
    else:
        yield f"the part is called {record.part}, which this scene is not solved on"
    for name, size in sizes.items():
        if getattr(record, name) != size:
            yield f"{name} is {getattr(record, name)}, but it is {size}"


def _state_faults(
    system: ContactSystem, force: IntArray, gap: IntArray, mechanisms: Motions
) -> Iterator[str]:
    """Contacts without force and gap here that some other solution opens or loads."""
    idle = ~system.bilateral & (force == 0) & (gap == 0)
    for k in _openable(rows_of(system.B, idle), mechanisms, np.flatnonzero(idle)):
        yield f"{_name(system, k)}: called osculatory, but it is open in another solution"
    touching = np.flatnonzero(system.rigid & (gap == 0))
    stresses = kernel(transposed(rows_of(system.B, touching)))[0] if idle[touching].any() else []
    rows = [[stress[i] for stress in stresses] for i in np.flatnonzero(idle[touching])]
    loaded = openable(rows)[0] if stresses else []
    # What is held closed takes a force of either sign, if the idle ones can do without.
    rest = touching[~idle[touching]]
    tied = np.flatnonzero(force[rest] == 0)
    clamps = kernel(transposed(rows_of(system.B, rest)))[0] if len(tied) else []
    pulled = [k for k in tied.tolist() if any(stress[k] != 0 for stress in clamps)]
    for k in [*touching[idle[touching]][loaded].tolist(), *rest[pulled].tolist()]:
        yield f"{_name(system, k)}: called osculatory, but it is closed in another solution"


def _openable(B: IntegerMatrix, motions: Motions, numbers: IntArray) -> list[int]:
    """Which of the contacts with these rows of B open in a mix of motions that closes none."""
    if not motions or not len(numbers):
        return []
    rates = [times(B, motion) for motion in motions]
    rows = [list(row) for row in zip(*rates, strict=True)]
    return [int(numbers[k]) for k in openable(rows)[0]]


def _gap_faults(system: ContactSystem, solution: Solved, free: Motions) -> Iterator[str]:
    unique = np.ones(system.contacts, dtype=bool)
    for motion in free:
        unique[[k for k, rate in enumerate(times(system.B, motion)) if rate != 0]] = False
    if len(solution.gap_unique) != len(unique):
        yield f"gap_unique has {len(solution.gap_unique)} entries, but {len(unique)} contacts"
        return
    for k in np.flatnonzero(np.array(solution.gap_unique, dtype=bool) != unique).tolist():
        yield f"{_name(system, k)}: gap_unique is {solution.gap_unique[k]}, but it is {unique[k]}"


def _stability_faults(
    system: ContactSystem, solution: Solved, force: IntArray, mechanisms: int, free: Motions
) -> Iterator[str]:
    claimed = solution.stability
    if claimed is None:
        yield "nothing is said of stability"
        return
    counts = {"mechanisms": mechanisms, "free": len(free)}
    for name, count in counts.items():
        if getattr(claimed, name) != count:
            yield f"stability: {name} is {getattr(claimed, name)}, but it is {count}"
    slides = _sliding(system, free)
    verdict: Verdict = "neutral" if free else "stable"
    if (slides & (force > 0)).any():
        verdict = "saddle"
    if (slides & (force < 0)).any() or not system.scene.definite:
        verdict = "undecided"
    if claimed.verdict != verdict:
        yield f"stability: the verdict is {claimed.verdict}, but it is {verdict}"


def _sliding(system: ContactSystem, free: Motions) -> Mask:
    """The contacts between discs that some free motion moves against each other."""
    scene = system.scene
    a, b = scene.ends
    alive = np.flatnonzero(system.reduction.sign)
    sliding = np.zeros(len(a), dtype=bool)
    for motion in free:
        flat = np.zeros(len(scene.discs) * scene.dimension, dtype=object)
        flat[alive] = motion
        moves = flat.reshape(-1, scene.dimension)
        sliding |= (b >= 0) & (moves[a] != moves[b]).any(axis=1)
    return sliding


def _forces_unique(system: ContactSystem, held: Mask) -> bool | None:
    if not system.scene.definite:
        return True if has_unique_forces(system.scene) else None
    return not kernel(transposed(rows_of(system.B, system.rigid & held)))[0]


def _name(system: ContactSystem, k: int) -> str:
    contact = system.scene.contacts[k]
    return f"contact {contact.a}-{contact.b}"
