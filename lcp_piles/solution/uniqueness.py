"""Whether the forces of a solution are the only ones.

Elastic contacts (C > 0) make the energy strictly convex in their forces, so those are unique. The
forces of rigid contacts (C = 0) are unique unless some self-stress acts on them alone: weights on
touching rigid contacts, non-negative where the force is zero, that balance at every freedom.
(An antisymmetric one pulls on one of every pair that it presses on, so it can load no contact
without force: for those the symmetric half is enough.)
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from flint import fmpz

from ..linear.kernel import kernel
from ..linear.rearrangement import rows_of, transposed
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import IntArray
from ..scenes.kind import has_unique_forces
from .partition import Partition, openable, safe_halvings, shifted


def forces_unique(system: ContactSystem, solved: Partition) -> bool | None:
    """Whether no other forces solve the scene; None where nothing is promised.

    The whole pile is asked: a self-stress of rigid contacts may be antisymmetric. Contacts without
    force are not asked: `with_all_loads` has left none that another solution loads.
    """
    if not system.scene.definite:
        return True if has_unique_forces(system.scene) else None
    if not system.rigid.any():
        return True
    for part in (system, system.odd):
        if part is None:
            continue
        states = system.reduction.contact[part.reduction.representative]
        rigid = part.rigid
        closed = solved.closed[states]
        if kernel(transposed(rows_of(part.B, rigid & closed)))[0]:
            return False
    return True


def with_all_loads(system: ContactSystem, state: State) -> State:
    """A solution in which every rigid contact that some solution loads carries a force.

    The states of contacts are those of the set of all solutions, so a rigid contact that happens
    to be without force in one of them has to be asked about.
    """
    signs = np.array(state.forces.signs(), dtype=np.int64)
    candidates = np.flatnonzero(system.rigid & (np.array(state.gaps.signs()) == 0))
    idle = candidates[signs[candidates] == 0]
    stresses = _self_stresses(system, candidates) if len(idle) else []
    if not stresses:
        return state
    # A mix of self-stresses that loads every one-sided contact that can be, and pulls at none.
    pressed = idle[~system.bilateral[idle]].tolist()
    rows = [[stress[k] for stress in stresses] for k in pressed]
    found, mix = openable(rows) if rows else ([], [])
    loaded = [pressed[i] for i in found]
    change = [fmpz(0)] * system.contacts
    for c, stress in zip(mix, stresses, strict=False):
        change = [x + c * y for x, y in zip(change, stress, strict=True)]
    # Bilateral ones take a force of any sign, in a mix that leaves the others without one.
    tied = idle[system.bilateral[idle]].tolist()
    rest = np.setdiff1d(candidates, np.setdiff1d(pressed, loaded))
    for stress in _self_stresses(system, rest) if tied else []:
        if any(stress[k] != 0 and change[k] == 0 for k in tied):
            kept = [k for k in (*loaded, *tied) if change[k] * stress[k] < 0]
            factor = max((abs(stress[k]) // abs(change[k]) + 1 for k in kept), default=fmpz(1))
            change = [factor * x + y for x, y in zip(change, stress, strict=True)]
    if not any(change):
        return state
    # So short a step that no force vanishes, or turns round at a bilateral contact.
    facing = np.where(signs < 0, -1, 1).tolist()
    falling = [s * x if s * x < 0 else fmpz(0) for s, x in zip(facing, change, strict=True)]
    for k in tied:
        falling[k] = fmpz(0)
    h = safe_halvings(state.forces.take(np.arange(system.contacts), facing), falling)
    return replace(state, forces=shifted(state.forces, change, fmpz(1) << h))


def _self_stresses(system: ContactSystem, contacts: IntArray) -> list[list[fmpz]]:
    """A basis of the self-stresses of some contacts, each over all contacts of the system."""
    found = []
    for stress in kernel(transposed(rows_of(system.B, contacts)))[0]:
        spread = [fmpz(0)] * system.contacts
        for k, x in zip(contacts.tolist(), stress, strict=True):
            spread[k] = x
        found.append(spread)
    return found
