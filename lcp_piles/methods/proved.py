"""The default method: floating point proposes a contact set, exact arithmetic proves or repairs it.

Newton's method on the sparse system names the closed contacts. One exact sparse solve with those
bilateral gives all forces and gaps, and their exact signs prove the set, because any state that
satisfies all conditions is the solution. Where a sign is wrong, Lemke's method goes on from that
set (an advanced start: its closed contacts enter with their gap as z, the open ones with their
force), so floating point can change how long the answer takes, never the answer.

A set that leaves mechanisms is completed (`regular_set`): by contacts that touch, which then carry
exactly nothing, and by the displacements that floating point gives the mechanisms.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..mechanics.contact_lcp import lcp_from
from ..mechanics.held_set import HeldSet
from ..mechanics.motions import CollapseError
from ..mechanics.orbits import symmetric_part
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..pivoting.lemke import lemke
from .full_steps import full_steps
from .lemke_road import ended_on_ray, free_fall
from .method import Method, Outcome, Progress
from .newton import newton
from .regular_set import Guess, regular_set

_NEAR = 1e-6  # unbalanced force, relative to the largest one, of a guess that is worth keeping


def float_guess(system: ContactSystem) -> Guess:
    """The closed set that Newton's method ends with; all contacts where it ends in nonsense.

    Full steps are tried before the others, which are safe.

    A set that is short of convergence is a good one to start from, unless forces are far from
    balance: then the pile runs away, and its contacts mean nothing.
    """
    result = full_steps(system) or newton(system)
    if not (result.residual <= _NEAR and np.isfinite(result.forces).all()):
        return Guess(np.ones(system.contacts, dtype=bool), np.zeros(system.contacts))
    return Guess(result.closed & (result.forces > 0), result.gaps, result.U)


def run_proved(system: ContactSystem, progress: Progress | None = None) -> Outcome:
    """The default method of `solve`: the guess of floating point, proved or repaired.

    Where a scene has more symmetries than its mirror, the part that keeps all of them is solved.
    """
    symmetric = symmetric_part(system)
    if symmetric is None:
        return prove_or_repair(system, float_guess(system), progress)
    part = symmetric.part
    if progress:
        progress(f"{part.dof} degrees of freedom, {part.contacts} contacts by symmetry")
    found = prove_or_repair(part, float_guess(part), progress)
    return replace(
        found,
        state=symmetric.state(found.state) if isinstance(found.state, State) else None,
        motion=None if found.motion is None else symmetric.motion(found.motion),
        free=None,
    )


def prove_or_repair(
    system: ContactSystem, guess: Guess, progress: Progress | None = None
) -> Outcome:
    """The exact outcome for a system from a guess of its contact set, right or wrong."""
    if progress:
        progress("exact solve of the proposed contact set")
    regular = regular_set(system, guess, progress)
    try:
        state = regular.state()
        wrong = _wrong_signs(regular.held, state)
        if wrong:
            if progress:
                progress(f"{wrong} wrong signs: exact pivots repair the contact set")
            reduced = lcp_from(regular.complete())
    except CollapseError as error:
        return free_fall(error)
    proof, pivots = "floating point proposed the contact set, exact signs proved it", 0
    if wrong:
        # Covering the wrong rows only keeps the path short. For a positive semidefinite problem a
        # ray is a proof all the same; an indefinite one gets a second chance with the full cover.
        signs = reduced.problem.q.signs()
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


def _wrong_signs(held: HeldSet, state: State) -> int:
    """How many contacts pull though closed, or overlap though open."""
    signs = np.where(held.closed, state.forces.signs(), state.gaps.signs())
    return int(((signs < 0) & ~held.system.bilateral).sum())


PROVED = Method("proved", "floating point proposes, exact arithmetic decides", "exact", run_proved)
