"""The first correction to the rigid limit, exactly: f(tau) = f0 + tau f1 + O(tau^2).

The displacements of a pile of compliance tau are tau u(tau), u = u0 + tau u1 + ... . Where the
rigid limit determines u0, f1 and u1 are the solution of one more problem with its matrix
(`problem`). Where free motions leave u0 undetermined, balance along them selects the u0 of the
deformable pile, if it has one with this network (`selection`); one order later the same decides u1.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import InputError, NotSolvedError, SolveError, VerificationError
from ..linear.integer_product import times
from ..numbers.exact import ONE
from ..numbers.vectors import ExactVector, combination
from ..solution.solution import Solved
from .base import Base, base_of
from .check import faults
from .columns import at, product, scaled
from .correction import FirstOrder, NoFirstOrder
from .expansion import across, along, relative, sliding
from .problem import Start, Term, start_of, term_of
from .selection import balancing_mix, moved, moving


def first_order(solution: Solved) -> FirstOrder | NoFirstOrder:
    """The exact first-order term in tau of the forces, displacements and gaps of a solved scene.

    Parameters
    ----------
    solution : Solved
        An exact solution whose forces are unique.

    Returns
    -------
    FirstOrder or NoFirstOrder
        The term, or the proof that there is none; told apart by `status`.

    Raises
    ------
    NotSolvedError
        Where the scene is not solved.
    InputError
        For a floating-point solution.
    SolveError
        Where the first order does not decide.
    VerificationError
        Rather than return a term that fails its own check.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> soft = first_order(solve(nt60(2)))
    >>> soft.force((2, 1), (1, 1)), soft.range
    (1/18, (None, ()))
    """
    if not isinstance(solution, Solved):
        raise NotSolvedError("the status of the solution", solution.status, '"solved"')
    if not solution.exact:
        raise InputError("the method", solution.record.method, 'an exact one, such as "proved"')
    if solution.forces_unique is False:
        raise SolveError(
            "rigid contacts share the load in several ways, and the first order does not decide "
            "which forces a slightly deformable pile takes: give those contacts a compliance"
        )
    base = base_of(solution)
    u0, g0 = _start(base)
    contacts, signs = solution.scene.contacts, g0.signs()
    crossing = tuple(c for c, sign in zip(contacts, signs, strict=True) if sign < 0)
    if crossing:
        return NoFirstOrder(solution, u0, g0, crossing)
    for contact, sign, state in zip(contacts, signs, solution.states, strict=True):
        if not sign and state == "open":
            raise SolveError(
                f"balance along the free motions closes the gap of {contact.name} without a force: "
                "whether it is loaded is not a matter of the first order"
            )
    start = start_of(base, u0, g0)
    term, loose = _balanced(base, start, term_of(base, start))
    wrong = faults(base, start, term)
    if wrong:
        raise VerificationError("the first order fails its own check: " + "; ".join(wrong))
    terms = (term.forces, term.displacements, term.gaps)
    return FirstOrder(solution, u0, g0, *terms, loose, base.partition, term.partition)


def _start(base: Base) -> tuple[ExactVector, ExactVector]:
    """u0 and g0: those of the rigid solution, moved to balance along its free motions."""
    u, g = base.displacements, base.gaps
    if not len(base.free):
        return u, g
    where = moving(base, base.free)
    forces = [product(where.pressing, x) for x in sliding(where.joints, u)]
    return moved(where, balancing_mix(where, forces), u, g)


def _balanced(base: Base, start: Start, term: Term) -> tuple[Term, tuple[int, ...]]:
    """The term with u1 such that order tau^2 balances, and the contacts whose g1 stays open.

    Along motions that change no touching contact, balance at order tau^2 is that of the forces
    f1 s0 / L + f0 (s1 - s0 (n . D0) / L) / L. Where it would close a contact that opens at order
    tau, or where neutral motions leave a choice, u1 stays undetermined.
    """
    motions = term.motions
    if not len(motions):
        return term, ()
    where = moving(base, motions)
    joints, scene = where.joints, base.rigid.scene
    apart = relative(scene, joints.contacts, start.displacements)
    stretch = along(joints.normals, apart)
    s0 = across(joints.normals, apart, stretch)
    s1 = sliding(joints, term.displacements)
    shorter = product(where.pressing, scaled(stretch, joints.inverse_lengths))
    sides = combination([(ONE, at(term.forces, joints.contacts)), (-ONE, shorter)])
    forces = [
        combination([(ONE, product(sides, x)), (ONE, product(where.pressing, y))])
        for x, y in zip(s0, s1, strict=True)
    ]
    mix = balancing_mix(where, forces)
    u1, g1 = moved(where, mix, term.displacements, term.gaps)
    system = base.system
    touching = np.append(base.touching, False)[system.reduction.contact]
    barred = bool((touching & (np.array(g1.signs()) < 0)).any())
    if not barred:
        term = replace(term, displacements=u1, gaps=g1)
    if mix.regular and not barred:
        return term, ()
    open_ = np.zeros(system.contacts + 1, dtype=bool)
    for motion in motions.basis:
        open_[:-1] |= np.array([bool(x) for x in times(system.B, motion)], dtype=bool)
    return term, tuple(np.flatnonzero(open_[system.reduction.contact]).tolist())
