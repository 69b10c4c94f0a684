"""What a check may conclude, and what it may not, in sentences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..deformation.correction import FirstOrder, NoFirstOrder
from ..methods.contact_proof import ContactProof
from ..numbers.exact import decimal, surd
from ..numbers.vectors import FloatArray
from ..scenes.names import end_name
from ..solution.solution import Solved, Unresolved, Unstable
from .check import Check

_SCALES = 0.05


def conclusions(check: Check) -> tuple[str, ...]:
    """Sentences about a check, the verdict first.

    >>> from lcp_piles import check, nt60
    >>> apex = {((1, 1), (2, 1)): 0.5774, ((1, 1), (2, 2)): 0.5773}
    >>> print(conclusions(check(nt60(2), apex))[0])
    the forces agree: every one is within 0.001 of the largest
    """
    solution = check.solution
    if isinstance(solution, ContactProof) and solution.collapse is not None:
        return (_without_balance(check, solution.collapse),)
    if isinstance(solution, Unstable):
        return (_without_balance(check, solution.collapse.array()),)
    if isinstance(solution, Unresolved):
        return ("nothing is proved about this scene, so there is nothing to compare with",)
    ours = _about_proof if isinstance(solution, ContactProof) else _about_solution
    return (_verdict(check), *_about_theirs(check), *ours(check))


def _verdict(check: Check) -> str:
    tolerance = f"{check.tolerance:g} of the largest"
    if check.verdict == "agree":
        return f"the forces agree: every one is within {tolerance}"
    if check.verdict == "another solution":
        return (
            "the forces are another solution: rigid contacts share the load in several ways, and "
            f"these balance, vanish where contacts are open and agree elsewhere, within {tolerance}"
        )
    return f"the forces differ: not all are within {tolerance}"


def _about_theirs(check: Check) -> Iterator[str]:
    """What the given forces themselves show."""
    silent = [check.reference.end(b) for b in np.unique(check.reference.b[~check.judged]).tolist()]
    if silent:
        names = ", ".join(map(end_name, silent))
        yield (
            f"they have no forces at {names}: the {int((~check.judged).sum())} contacts there are "
            "left out, and the balance of the discs there as well"
        )
    if abs(check.scale) > 0 and abs(check.scale - 1) > max(_SCALES, check.tolerance):
        left = np.linalg.norm((check.given - check.scale * check.expected)[check.judged])
        if left < _SCALES * np.linalg.norm(check.given):
            yield (
                f"they are all {check.scale:.4g} times ours, about: was the weight that they are "
                "divided by that of a disc?"
            )
    if check.largest_residual > check.allowed:
        k = int(np.linalg.norm(check.residual, axis=1).argmax())
        text = (
            f"they do not balance the loads: {check.largest_residual:.3g}{check.unit} is left on "
            f"{end_name(check.reference.ids[k])}, along the normals of the undeformed scene"
        )
        if check.own_residual is not None:
            own = float(np.linalg.norm(check.own_residual, axis=1).max(initial=0.0))
            text += f", and {own:.3g}{check.unit} along their own directions"
        yield text
    if check.largest_other > check.allowed:
        yield "they have forces where the scene has no contacts, so they are of another scene"


def _about_proof(check: Check) -> Iterator[str]:
    """What the proof of a packing leaves open."""
    proof = check.solution
    assert isinstance(proof, ContactProof)
    if proof.unproved:
        names = ", ".join(map(check.reference.name, proof.unproved[:5]))
        more = ", ..." if len(proof.unproved) > 5 else ""
        yield f"whether {names}{more} carry a force is not proved, and so no bound is"


def _about_solution(check: Check) -> Iterator[str]:
    """What the exact solution leaves open."""
    solution = check.solution
    assert isinstance(solution, Solved)
    if not solution.exact:
        yield "ours are a solution in floating point, which proves nothing"
    verdict = solution.stability.verdict if solution.stability else None
    if verdict == "saddle":
        yield (
            "this equilibrium is a saddle: a real pile slides off it, so a simulation that came to "
            "rest elsewhere is not wrong, and one that stays here is not settled"
        )
    elif verdict == "neutral":
        yield "this equilibrium is neutral: a simulation may come to rest beside it, changed"
    elif verdict == "undecided":
        yield "negative compliances leave the stability of this equilibrium undecided"
    if solution.forces_unique is False and check.verdict != "another solution":
        yield (
            "ours are one of several solutions: rigid contacts share the load as they like, and "
            "only what balances and stays closed can be judged"
        )
    elif solution.forces_unique is None and solution.exact:
        yield "negative compliances leave open whether other forces are a solution as well"
    several = solution.gap_unique.count(False)
    if several:
        yield (
            f"{several} gaps are not unique: whether those contacts touch is not decided, and none "
            "of them counts as named wrongly for touching"
        )
    yield from _about_stiffness(check)


def _about_stiffness(check: Check) -> Iterator[str]:
    softened = check.softened
    if check.tau is None or softened is None:
        return
    if isinstance(softened, NoFirstOrder):
        yield (
            "no equilibrium of slightly deformable discs keeps this network, so a simulation "
            "cannot find these forces, however stiff its discs are"
        )
        return
    assert isinstance(softened, FirstOrder)
    limit, _ = softened.range
    if limit is not None and surd(check.tau) >= limit:
        yield (
            f"to first order the network changes at tau = {decimal(limit, 4)}: beyond that the "
            "change that was taken out is only a guide"
        )


def _without_balance(check: Check, collapse: FloatArray) -> str:
    """By the collapse v: for forces f >= 0 the residual r has r . v >= p . v > 0."""
    motion = collapse.reshape(check.reference.loads.shape)
    work = float((check.reference.loads * motion).sum())
    reach = float(np.linalg.norm(motion, axis=1).sum())
    return (
        "no forces balance the loads of this scene, which is proved: whatever pushes at its "
        f"contacts, {work / reach:.3g}{check.unit} or more is left on some disc (here "
        f"{check.largest_residual:.3g}{check.unit})"
    )
