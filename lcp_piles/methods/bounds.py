"""Proof without digits: the contact set, proved, and forces and gaps within rigorous bounds.

For who wants certainty and no fractions of thousands of digits. Floating point proposes the contact
set, whose closed contacts are taken as bilateral springs of matrix K = B^T C^-1 B (in the physical
units of `mechanics.physical`). Displacements U are improved in floats against a residual that is
exact: the overlaps B U + o are, in integers, and the forces of the springs are rounded to a fixed
point far behind that of floats, so what is left unbalanced, r, is known to within that rounding.
With a proved lower bound mu of the least eigenvalue of K (`linear.springs`) the true gaps are

    |g - g(U)|_k = |B_k K^-1 r| <= |B_k| |r| / mu,

in the norms of a scaling D of the freedoms that makes the diagonal of D K D about one. Where every
force of a closed contact and every gap of an open one is away from zero by more than its bound, the
signs are proved and with them the set: any state that satisfies all conditions is the solution. A
contact that is exactly zero cannot be told from a tiny one this way and is named, unless it is one
of those that hold a mechanism without load: those carry exactly nothing (`regular_set`).

Rounding of the bounds themselves: float(x) is within 1.01 u |x| of an exact x, u = 2^-53, and sums,
products and roots of a few such non-negative numbers, of at most 2^28 terms each, are within a
factor 1 + 2^-24 of the exact ones; `UP` covers four of these. What underflows is covered by `LOST`
for each product (`numbers.floats`).
"""

from __future__ import annotations

from time import perf_counter

import numpy as np
from scipy.sparse import csr_array

from ..errors import SolveError
from ..linear.springs import springs
from ..linear.threads import one_thread
from ..mechanics.held_set import HeldSet
from ..mechanics.motions import CollapseError
from ..mechanics.system import contact_system
from ..numbers.floats import LOST, UP, Bounded
from ..numbers.vectors import ExactVector
from ..scenes.scene import Scene
from .contact_proof import ContactProof, forces_of
from .proved import float_guess
from .refinement import refined
from .regular_set import regular_set


@one_thread()
def prove_contacts(scene: Scene, *, whole: bool = False) -> ContactProof:
    """Prove the contact set of a scene with elastic contacts, and bound its forces and gaps.

    Parameters
    ----------
    scene : Scene
        A scene whose compliances are positive.
    whole : bool, default False
        Whether to take the whole pile where its symmetric half would do.

    Returns
    -------
    ContactProof
        The contacts that carry a force, and all forces (w) and gaps (w tau) within bounds.

    Raises
    ------
    SolveError
        For rigid or negative compliances, and where no bound is found: the exact `solve` is for
        those.

    Examples
    --------
    >>> from lcp_piles import nt30
    >>> proof = prove_contacts(nt30(6))
    >>> proof.proved, int(proof.loaded.sum()), bool(proof.forces.radius.max() < 1e-13)
    (True, 113, True)
    """
    clock = perf_counter()
    system = contact_system(scene, "whole" if whole else None)
    if any(c <= 0 for c in system.compliances[0]):
        raise SolveError("bounds without digits need elastic contacts: use solve")
    C = system.floats()[1]
    if not (system.in_range() and C.min(initial=1.0) > LOST):
        raise SolveError("the scene has numbers beyond the range of floating point: use solve")
    regular = regular_set(system, float_guess(system))
    try:
        regular.held.free.check(system.load)
    except CollapseError as error:
        raise SolveError("a load moves the scene freely, without bounds: use solve") from error
    closed, zero = regular.held.closed, regular.idle
    gaps = _gaps(regular.held, regular.gap)
    c = C * system.reduction.weight
    pushing = closed & ~zero
    forces = forces_of(gaps, c, pushing)
    right = np.where(closed, zero | system.bilateral | (forces.signs() > 0), gaps.signs() > 0)
    contact = system.reduction.contact
    return ContactProof(
        scene,
        pushing[contact],
        zero[contact],
        Bounded(forces.middle[contact], forces.radius[contact]),
        Bounded(*(np.where(closed, 0.0, x)[contact] for x in (gaps.middle, gaps.radius))),
        tuple(np.flatnonzero(~right[contact]).tolist()),
        system.dof,
        perf_counter() - clock,
    )


def _gaps(held: HeldSet, gap: ExactVector) -> Bounded:
    """B u + o (w tau) of every contact with the closed ones bilateral; their overlaps negative."""
    system = held.system
    B, C, _, _ = system.floats()
    B = csr_array(B[:, held.equations.free])
    bound = springs(csr_array(B[held.closed]), C[held.closed])
    if not bound.least > 0:
        raise SolveError("the contacts hold the pile too weakly for bounds: use solve")
    # Components of normals below the range of floats are off by less than LOST.
    lost = LOST * float(bound.D.max(initial=0.0))
    reach = (np.sqrt((B * bound.D).power(2).sum(axis=1)) + lost) * UP
    total = Bounded(np.zeros(system.contacts), np.zeros(system.contacts))
    for r in sorted({*gap.numerators, *system.load.numerators}):
        part = refined(held, gap, bound, r)
        near = part.gaps.bounded()
        with np.errstate(all="ignore"):
            radius = (near.radius + reach * (part.rest / bound.least)) * UP + LOST
        total = total + Bounded(near.middle, radius)
    if not (np.isfinite(total.middle).all() and np.isfinite(total.radius).all()):
        raise SolveError("the scene has numbers beyond the range of floating point: use solve")
    return total
