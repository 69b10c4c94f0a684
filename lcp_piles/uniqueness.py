"""Whether the forces of a solution are the only ones.

Elastic contacts (C > 0) make the energy strictly convex in their forces, so those are unique. The
forces of rigid contacts (C = 0) are unique unless some self-stress acts on them alone: weights on
touching rigid contacts, non-negative where the force is zero, that balance at every freedom.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from .kernel import kernel
from .partition import Partition, openable
from .system import ContactSystem, contact_system


def forces_unique(system: ContactSystem, solved: Partition) -> bool | None:
    """Whether no other forces solve the scene; None where nothing is promised (C < 0).

    The whole pile is asked: a self-stress of rigid contacts may be antisymmetric.
    """
    if not system.scene.definite:
        return None
    parts = [system]
    if system.reduction.part == "even":
        parts.append(contact_system(system.scene, "odd"))
    for part in parts:
        states = system.reduction.contact[part.reduction.representative]
        rigid = np.array([c == 0 for c in part.compliance], dtype=bool)
        candidates = np.flatnonzero(rigid & solved.touching[states])
        if not len(candidates):
            continue
        stresses, _ = kernel(csr_array(part.B[candidates].T))
        if not stresses:
            continue
        unloaded = np.flatnonzero(~solved.closed[states][candidates])
        rows = [[stress[i] for stress in stresses] for i in unloaded.tolist()]
        moving, _ = openable(rows) if rows else ([], [])
        if moving:
            return False
        loaded = candidates[solved.closed[states][candidates]]
        if kernel(csr_array(part.B[loaded].T))[0]:
            return False
    return True
