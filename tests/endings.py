"""How a method ends with a scene, and what every ending has to prove.

Certificates are checked here in plain Surds, disc by disc, with nothing of the package's own.
"""

import warnings
from contextlib import contextmanager
from functools import partial

import pytest
from helpers import along, equilibrium_faults

from lcp_piles import ContradictionError, contact_system, solve, surd
from lcp_piles.methods import fire, gauss_seidel
from lcp_piles.methods.registry import METHODS

ZERO = surd(0)
EXACT = [name for name, method in METHODS.items() if method.arithmetic == "exact"]
FLOAT = [name for name in METHODS if name not in EXACT]
FORCE_ERROR = {"float64": 1e-5, "float32": 1e-2}
GIVES_UP = ("sets follow each other", "rigid contacts cannot all be closed")
"""Why the paper's iteration may leave a scene unresolved that has an answer."""


def contradiction_faults(scene, stress):
    """What is wrong with a stress that is to prove that nothing fits, disc by disc."""
    rest = {disc.id: [ZERO] * scene.dimension for disc in scene.discs}
    held = {disc.id: [h or ZERO for h in disc.held] for disc in scene.discs}
    faults, work = [], ZERO
    for contact, s in zip(scene.contacts, stress, strict=True):
        if s and contact.compliance:
            faults.append(f"{contact.name} is elastic")
        if s < 0 and not contact.bilateral:
            faults.append(f"{contact.name} pulls")
        work += s * (contact.gap + along(contact.normal, held[contact.a]))
        for axis, n in enumerate(contact.normal):
            rest[contact.a][axis] += s * n
            if contact.b in rest:
                rest[contact.b][axis] -= s * n
        if contact.b in held:
            work -= s * along(contact.normal, held[contact.b])
    for disc in scene.discs:
        for axis in range(scene.dimension):
            if disc.held[axis] is None and rest[disc.id][axis] != 0:
                faults.append(f"disc {disc.id} is not balanced")
    return faults if work < 0 else [*faults, "no negative work"]


def collapse_faults(scene, collapse):
    """What is wrong with a motion along which a scene is to give way."""
    d = scene.dimension
    moves = {disc.id: collapse[d * k : d * k + d] for k, disc in enumerate(scene.discs)}
    faults = []
    for contact in scene.contacts:
        other = moves.get(contact.b, [ZERO] * d)
        relative = [x - y for x, y in zip(moves[contact.a], other, strict=True)]
        rate = along(contact.normal, relative)
        if rate < 0 or (rate and contact.bilateral):
            faults.append(f"{contact.name} resists")
    work = sum((along(disc.load, moves[disc.id]) for disc in scene.discs), ZERO)
    for disc in scene.discs:
        if any(h is not None and x for h, x in zip(disc.held, moves[disc.id], strict=True)):
            faults.append(f"disc {disc.id} is held")
    return faults if work > 0 else [*faults, "no work"]


def ending(scene, method="proved", whole=False):
    """(status, solution or error) of an exact method, its certificate checked."""
    try:
        found = solve(scene, method, whole=whole)
    except ContradictionError as error:
        found = error
    if isinstance(found, ContradictionError):
        assert contradiction_faults(scene, list(found.stress)) == []
        return "contradictory", found
    if found.status == "solved":
        assert equilibrium_faults(scene, found) == []
    elif found.status == "unstable":
        assert collapse_faults(scene, list(found.collapse)) == []
    return found.status, found


def parts(scene):
    """What `whole` may be, where that makes a difference."""
    return (False, True) if contact_system(scene).reduction.part == "even" else (True,)


def assert_all_alike(scene, expected, methods=EXACT):
    """Every exact method ends in this status, with the same claims and the same unique forces.

    The paper's iteration may give up, for a reason of its own. Returns the solution or the error,
    and whether it gave up.
    """
    found = [ending(scene, method, whole) for method in methods for whole in parts(scene)]
    gave_up = [end for status, end in found if status == "unresolved"]
    for end in gave_up:
        assert end.record.method == "z"
        assert any(why in end.record.proof for why in GIVES_UP)
    ends = [end for status, end in found if status != "unresolved"]
    assert {status for status, _ in found} - {"unresolved"} == {expected}
    one = ends[0]
    for other in ends[1:] if expected == "solved" else ():
        assert other.states == one.states
        assert other.forces_unique == one.forces_unique
        assert other.stability == one.stability
        for contact, f, g in zip(scene.contacts, one.forces, other.forces, strict=True):
            assert f == g or not (one.forces_unique or contact.compliance)
    return one, bool(gave_up)


@contextmanager
def few_steps():
    """The two slow methods get few steps: they may give up, not go wrong."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fire, "fire", partial(fire.fire, max_iterations=200))
        shorter = partial(gauss_seidel.gauss_seidel, max_sweeps=200)
        patch.setattr(gauss_seidel, "gauss_seidel", shorter)
        yield


def float_endings(scene):
    """The solution of every floating-point method, on the half and on the whole, by no warning."""
    with few_steps(), warnings.catch_warnings():
        warnings.simplefilter("error")
        return [solve(scene, method, whole=whole) for method in FLOAT for whole in parts(scene)]


def assert_floats_claim_nothing_else(scene, expected, exact):
    """Every floating-point method solves what is solved, or gives up and says why.

    `exact` is an exact solution, where there is one. Returns the methods that solved the scene.
    """
    solved = set()
    for found in float_endings(scene):
        if found.status == "unresolved":
            assert found.record.proof.startswith("none: ")
            continue
        assert (found.status, expected) == ("solved", "solved")
        solved.add(found.record.method)
        largest = max(exact.force_array.max(initial=0.0), 1.0)
        for k, contact in enumerate(scene.contacts):
            if exact.forces_unique or contact.compliance:
                error = abs(found.force_array[k] - exact.force_array[k])
                assert error < FORCE_ERROR[found.record.arithmetic] * largest
    return solved
