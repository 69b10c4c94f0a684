"""Newton's method with full steps, on small piles that are well held: a guess in a few solves.

From all contacts closed, each step solves for the displacements of the present closed set and
takes the contacts that they press for the next (the iteration of the paper, in floating point). It
may cycle, and the displacements of a set with mechanisms mean nothing. So what it ends with serves
where the set repeats, leaves no mechanism, no contact only touches (it may hold a mechanism that
should end between its stops), and forces balance; for all else there is `newton`,
which takes five times as long on a pile of some dozens of contacts.
"""

from __future__ import annotations

import numpy as np

from ..mechanics.system import ContactSystem
from .float_state import FloatState

_MOST = 8  # steps: most piles take three to seven
_LARGEST = 16_000  # places of B, so few that it is best written out
_SOFT = 1e-11  # stiffness that holds every freedom, relative to the stiffest contact
_FIRM = 1e-4  # a pivot of the factors, relative to the largest, where no mechanism is near
_TOUCHING = 1e-8  # a force or a gap, relative to the largest force or displacement, like none
_BALANCED = 1e-9  # unbalanced force, relative to the largest, of what serves


@np.errstate(all="ignore")
def full_steps(system: ContactSystem) -> FloatState | None:
    """The state that full steps end with; None where they do not serve.

    >>> from lcp_piles import contact_system, nt60
    >>> full_steps(contact_system(nt60(4))).steps
    2
    """
    from scipy.linalg import lapack  # slow to import

    if not 0 < system.contacts * system.dof <= _LARGEST or not system.in_range():
        return None
    sparse, C, o, p = system.floats()
    if not (C > 0).all():
        return None
    B, E, always = sparse.toarray(), 1 / C, system.bilateral
    soft = np.diag(np.full(system.dof, _SOFT * float(E.max())))
    closed = np.ones(len(C), dtype=bool)
    steps = 0
    while steps < _MOST:
        steps += 1
        D = np.where(closed, E, 0.0)
        weighted = B.T * D
        factors, info = lapack.dpotrf(weighted @ B + soft, lower=1)
        if info != 0:
            return None
        U = lapack.dpotrs(factors, p - weighted @ o, lower=1)[0]
        gaps = B @ U + o
        pressed = always | (gaps <= 0)
        if (pressed == closed).all():
            break
        closed = pressed
    else:
        return None
    pivots = factors.diagonal()
    if not pivots.min() > _FIRM * pivots.max():
        return None
    forces = -D * gaps
    largest = max(np.abs(forces).max(), np.abs(p).max()) or 1.0
    residual = float(np.abs(B.T @ forces + p).max() / largest)
    decided = np.where(closed, forces > _TOUCHING * largest, gaps > _TOUCHING * np.abs(U).max())
    if not (residual <= _BALANCED and (decided | always).all()):
        return None
    return FloatState(U, forces, np.where(closed, 0.0, gaps), closed, steps, residual, True)
