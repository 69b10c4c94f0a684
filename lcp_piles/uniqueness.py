"""Whether the forces of a solution are the only ones.

Elastic contacts (C > 0) make the energy strictly convex in their forces, so those are unique. The
forces of rigid contacts (C = 0) are unique unless some self-stress acts on them alone: weights on
touching rigid contacts, non-negative where the force is zero, that balance at every freedom.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from .bilateral import Mask
from .kernel import kernel
from .partition import Partition, openable
from .system import ContactSystem
from .vectors import IntArray


def forces_unique(system: ContactSystem, solved: Partition) -> bool | None:
    """Whether no other forces solve the scene; None where nothing is promised (C < 0).

    The whole pile is asked: a self-stress of rigid contacts may be antisymmetric.
    """
    if not system.scene.definite:
        return None
    if all(c != 0 for c in system.compliance):
        return True
    for part in (system, system.odd):
        if part is None:
            continue
        states = system.reduction.contact[part.reduction.representative]
        rigid = np.array([c == 0 for c in part.compliance], dtype=bool)
        closed = solved.closed[states]
        if kernel(csr_array(part.B[rigid & closed].T))[0]:
            return False
        # An antisymmetric self-stress pulls on one of every pair that it presses on, so it may
        # load no contact without force: those are asked about in the symmetric part only.
        if part is system and _loadable(part, np.flatnonzero(rigid & solved.touching), closed):
            return False
    return True


def _loadable(system: ContactSystem, candidates: IntArray, closed: Mask) -> bool:
    """Whether a self-stress of the candidates loads some without force and pulls on none."""
    unloaded = np.flatnonzero(~closed[candidates]).tolist()
    stresses = kernel(csr_array(system.B[candidates].T))[0] if unloaded else []
    rows = [[stress[i] for stress in stresses] for i in unloaded]
    return bool(stresses) and bool(openable(rows)[0])
