"""The proof on the true geometry: contact set and bounds of forces for exactly a given packing.

Floating point proposes the contact set, whose closed contacts are taken as springs of both signs,
and `refine` improves their displacements until rounding to 100 bits is all that is left. With a
proved lower bound mu of the least eigenvalue of D K D, K = B^T E B (`linear.springs`, a shifted
Cholesky factorisation), the true gaps are within |B_k D| |D r| / mu of those found (`bounds`), and
where all signs are proved so is the set. A contact whose sign is proved wrong changes sides, and
the proof starts again, a few times.

Translations that closed contacts leave free have no load, or nothing balances; one freedom of each
stays where floating point has it (`translations`).
"""

from __future__ import annotations

from time import perf_counter

import numpy as np
from scipy.sparse import csr_array

from ...errors import SolveError
from ...linear.springs import springs
from ...linear.stiffness import factor, stiffness
from ...linear.threads import one_thread
from ...numbers.floats import LOST, UP, Bounded
from ...numbers.vectors import FloatArray, IntArray, Mask
from ...packings.packing import Packing
from ...scenes.names import DiscId, end_name
from ..contact_proof import ContactProof, forces_of
from ..newton import newton_on
from .collapse import collapse
from .refine import Held, refined
from .translations import driven, free_translations, pinned, room

_ROUNDS = 8
_SOFT, _STEPS = 1e-10, 4  # of the inverse iteration that finds what a message names
_NONE = (0.0, 1e-11, 1e-8)
"""Forces, relative to the largest, up to which contacts are proposed to be open, one try each.

Last of all, all contacts: a packing without loads may come apart.
"""


@one_thread()
def prove_packing(packing: Packing) -> ContactProof:
    """Prove the contact set of a packing, and bound its forces and gaps, as it was given.

    Parameters
    ----------
    packing : Packing
        The packing.

    Returns
    -------
    ContactProof
        Forces and gaps are in the packing's units. Contacts that cannot be told are in `unproved`;
        a packing whose loads no forces balance has a `collapse` that proves it.

    Raises
    ------
    SolveError
        Where neither is found: the contacts hold the packing too weakly, or in a way that only
        exact numbers can tell (`solve_packing`).

    Examples
    --------
    >>> from lcp_piles import packing
    >>> groove = {"left": ((0, 0), (1, 1)), "right": ((0, 0), (-1, 1))}
    >>> proof = prove_packing(packing([(0, 1.4142)], 1, supports=groove, stiffness=1e4))
    >>> proof.proved, proof.forces.middle.round(12).tolist()
    (True, [0.707106781187, 0.707106781187])
    """
    clock = perf_counter()
    B = normals_matrix(packing)
    free = ~packing.held
    p, c = packing.loads[free], 1 / packing.stiffness
    nothing = np.zeros(len(c), dtype=bool)
    guess = newton_on(B, c, packing.gaps.high, p, nothing)
    pushed = np.maximum(-packing.gaps.high, 0) / c
    largest = max(float(np.abs(x).max(initial=0.0)) for x in (guess.forces, p, pushed))
    U = np.where(np.isfinite(guess.U), guess.U, 0.0)
    proposals = [guess.closed & (guess.forces > share * largest) for share in _NONE]
    for proposal in (*proposals, nothing):
        state = _settled(packing, B, proposal, U)
        if state is not None:
            closed, gaps, signs = state
            return ContactProof(
                packing,
                closed,
                nothing,
                forces_of(gaps, c, closed),
                Bounded(*(np.where(closed, 0.0, x) for x in (gaps.middle, gaps.radius))),
                tuple(np.flatnonzero(signs <= 0).tolist()),
                int(free.sum()),
                perf_counter() - clock,
            )
    motion = collapse(packing, B, U)
    if motion is None:
        disc = f"disc {end_name(_loosest(packing, B, proposals[0]))}"
        raise SolveError(
            f"the contacts hold {disc} too weakly for bounds, if they do: solve_packing is exact"
        )
    unknown = Bounded(np.full(len(c), np.nan), np.full(len(c), np.inf))
    seconds = perf_counter() - clock
    return ContactProof(
        packing, nothing, nothing, unknown, unknown, (), int(free.sum()), seconds, motion
    )


def _settled(
    packing: Packing, B: csr_array, closed: Mask, U: FloatArray
) -> tuple[Mask, Bounded, IntArray] | None:
    """From a proposed set: the closed contacts, all gaps, and the signs that should be positive.

    These are of forces where closed, else of gaps. None where no set is proved to hold the packing.
    """
    placed = False
    for _ in range(_ROUNDS):
        translations = free_translations(packing, closed)
        if driven(translations, packing.loads[~packing.held]):
            return None
        found = _gaps(packing, B, closed, pinned(translations), U)
        if found is None:
            return None
        gaps, signs = found, found.signs() * np.where(closed, -1, 1)
        rates = csr_array(B @ translations)
        loose = ~closed & (np.diff(rates.indptr) > 0)
        if not placed and (signs[loose] <= 0).any():
            shift = room(csr_array(rates[loose]), gaps.middle[loose])
            U, placed = (U if shift is None else U + translations @ shift), True
        elif (signs < 0).any():
            closed = closed ^ (signs < 0)
        else:
            break
    return closed, gaps, signs


def normals_matrix(packing: Packing) -> csr_array:
    """B in floats, of shape (contacts, freedoms): the gaps change by B U."""
    dimension, contacts = packing.dimension, len(packing.a)
    a = packing.free[packing.a]
    b = np.where(packing.b[:, None] >= 0, packing.free[packing.b], -1)
    row = np.repeat(np.arange(contacts), dimension)
    n = packing.normals.high.ravel()
    column = np.append(a.ravel(), b.ravel())
    rows, values = np.append(row, row), np.append(n, -n)
    there = (column >= 0) & (values != 0)
    shape = (contacts, int((~packing.held).sum()))
    return csr_array((values[there], (rows[there], column[there])), shape=shape)


def _gaps(
    packing: Packing, B: csr_array, closed: Mask, still: IntArray, U: FloatArray
) -> Bounded | None:
    """Gaps of every contact with the closed ones and some freedoms held; their overlaps negative.

    None where these are not proved to hold the packing.
    """
    active = np.delete(np.arange(B.shape[1]), still)
    over = csr_array(B[:, active])
    bound = springs(csr_array(over[closed]), 1 / packing.stiffness[closed])
    if not bound.least > 0:
        return None
    reach = np.sqrt((over * bound.D).power(2).sum(axis=1)) * UP
    found = refined(Held(packing, B, closed, active), bound, U)
    with np.errstate(all="ignore"):
        radius = (found.gaps.radius + reach * (found.rest / bound.least)) * UP + LOST
    if not np.isfinite(radius).all():
        raise SolveError("the packing has numbers beyond the range of floating point")
    return Bounded(found.gaps.middle, radius)


def _loosest(packing: Packing, B: csr_array, closed: Mask) -> DiscId:
    """The disc that moves most in the weakest motion of some springs, as floats see it."""
    soft = float(packing.stiffness.max(initial=0.0)) * _SOFT or 1.0
    solve = factor(stiffness(B), np.where(closed, packing.stiffness, 0.0), soft)
    motion = np.random.default_rng(0).standard_normal(B.shape[1])
    for _ in range(_STEPS):
        motion = solve(motion / np.linalg.norm(motion))
    whole = np.zeros(packing.held.shape)
    whole[~packing.held] = motion
    return packing.ids[int(np.argmax((whole * whole).sum(axis=1)))]
