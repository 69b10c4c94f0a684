"""The default method: floating point proposes a contact set, exact arithmetic proves or repairs it.

Newton's method on the sparse system names the closed contacts. One exact sparse solve with those
bilateral gives all forces and gaps, and their exact signs prove the set, because any state that
satisfies all conditions is the solution. Where a sign is wrong, Lemke's method goes on from that
set (an advanced start: its closed contacts enter with their gap as z, the open ones with their
force), so floating point can change how long the answer takes, never the answer.

A set that leaves mechanisms is completed by contacts without force that hold them, the nearest
ones first; those then carry exactly nothing, and exact pivots exchange them where gaps close.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mechanics.contact_lcp import lcp_from
from ..mechanics.held_set import HeldSet, completed, held_set, independent_rigid
from ..mechanics.motions import CollapseError, Motions, work_sign
from ..mechanics.system import ContactSystem
from ..numbers.vectors import FloatArray, Mask
from ..pivoting.lemke import lemke
from .lemke_road import ended_on_ray, free_fall
from .method import Method, Outcome, Progress
from .newton import newton

_NEAR = 1e-6  # unbalanced force, relative to the largest one, of a guess that is worth keeping


@dataclass(frozen=True, eq=False)
class Guess:
    """A contact set to start from; `distance` is small where an open contact nearly closes."""

    closed: Mask
    distance: FloatArray


def float_guess(system: ContactSystem) -> Guess:
    """The closed set that Newton's method ends with; all contacts where it ends in nonsense.

    A set that is short of convergence is a good one to start from, unless forces are far from
    balance: then the pile runs away, and its contacts mean nothing.
    """
    result = newton(system)
    if not (result.residual <= _NEAR and np.isfinite(result.forces).all()):
        return Guess(np.ones(system.contacts, dtype=bool), np.zeros(system.contacts))
    return Guess(result.closed & (result.forces > 0), result.gaps)


def run_proved(system: ContactSystem, progress: Progress | None = None) -> Outcome:
    """The default method of `solve`: the guess of floating point, proved or repaired."""
    return prove_or_repair(system, float_guess(system), progress)


def prove_or_repair(
    system: ContactSystem, guess: Guess, progress: Progress | None = None
) -> Outcome:
    """The exact outcome for a system from a guess of its contact set, right or wrong."""
    if progress:
        progress("exact solve of the proposed contact set")
    regular = regular_set(system, guess, progress)
    try:
        reduced = lcp_from(regular.held)
    except CollapseError as error:
        return free_fall(error)
    signs = reduced.problem.q.signs()
    if min(signs, default=0) >= 0:
        proof = "floating point proposed the contact set, exact signs proved it"
        state, pivots = reduced.start, 0
    else:
        wrong = sum(sign < 0 for sign in signs)
        if progress:
            progress(f"{wrong} wrong signs: exact pivots repair the contact set")
        # Covering the wrong rows only keeps the path short. For a positive semidefinite problem a
        # ray is a proof all the same; an indefinite one gets a second chance with the full cover.
        result = lemke(reduced.problem, d=[int(sign < 0) for sign in signs])
        if result.status == "ray" and result.certificate is None:
            result = lemke(reduced.problem)
        if result.z_vector is None:
            return ended_on_ray(reduced, result)
        state, pivots = reduced.state(result.z_vector), result.pivots
        proof = (
            f"floating point proposed a contact set, {pivots} exact pivots repaired it, verified"
        )
    if progress:
        progress("states, stability and verification")
    loaded = np.array(state.forces.signs()) > 0
    misnamed = int((loaded != guess.closed)[~system.bilateral].sum())
    return Outcome(pivots, proof, state, guess_errors=misnamed, free=regular.free)


PROVED = Method("proved", "floating point proposes, exact arithmetic decides", "exact", run_proved)


@dataclass(frozen=True, eq=False)
class RegularSet:
    """A held set, and which of its contacts surely carry nothing: those of `idle`.

    `free` are the motions that the guess left free before it was completed.
    """

    held: HeldSet
    idle: Mask
    free: Motions


def regular_set(
    system: ContactSystem, guess: Guess, progress: Progress | None = None
) -> RegularSet:
    """The guess, completed where it leaves motions free that other contacts would resist.

    With N a basis of the mechanisms, as many contacts X are added, B_X N being regular. Balance
    along N reads (B_X N)^T lambda_X = -N^T p, so where the load does no work on the mechanisms the
    added contacts are idle: they carry exactly nothing.
    """
    closed = independent_rigid(system, guess.closed | system.bilateral)
    proposed = held_set(system, closed, progress)
    nearest = np.flatnonzero(~closed)
    nearest = nearest[np.argsort(guess.distance[nearest], kind="stable")]
    regular = completed(proposed, nearest.tolist())
    idle = regular.closed & ~closed
    if any(work_sign(system.load, motion) for motion in proposed.free.basis):
        idle[:] = False
    return RegularSet(regular, idle, proposed.free)
