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
from scipy.sparse import csr_array

from ..linear.kernel import kernel
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import IntArray, Mask
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
        if kernel(csr_array(part.B[rigid & closed].T))[0]:
            return False
    return True


def with_all_loads(system: ContactSystem, state: State) -> State:
    """A solution in which every rigid contact that some solution loads carries a force.

    The states of contacts are those of the set of all solutions, so a rigid contact that happens
    to be without force in one of them has to be asked about.
    """
    rigid = system.rigid
    touching = np.array(state.gaps.signs()) == 0
    candidates = np.flatnonzero(rigid & touching)
    settled = (np.array(state.forces.signs()) > 0) | system.bilateral  # these may change either way
    opening, mix, stresses = _loadable(system, candidates, settled)
    if not opening:
        return state
    change = [fmpz(0)] * system.contacts
    for i, k in enumerate(candidates.tolist()):
        change[k] = sum((c * s[i] for c, s in zip(mix, stresses, strict=True)), fmpz(0))
    falling = [fmpz(0) if both else x for both, x in zip(system.bilateral, change, strict=True)]
    h = safe_halvings(state.forces, falling)
    return replace(state, forces=shifted(state.forces, change, fmpz(1) << h))


def _loadable(
    system: ContactSystem, candidates: IntArray, settled: Mask
) -> tuple[list[int], list[fmpz], list[list[fmpz]]]:
    """The unloaded candidates that a self-stress loads, the mix of stresses, and the stresses."""
    unloaded = np.flatnonzero(~settled[candidates]).tolist()
    stresses = kernel(csr_array(system.B[candidates].T))[0] if unloaded else []
    if not stresses:
        return [], [], []
    rows = [[stress[i] for stress in stresses] for i in unloaded]
    return *openable(rows), stresses
