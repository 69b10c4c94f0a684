"""All methods of the comparison under one roof: ours, the exact baselines, the peers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from benchmarks.comparison import molecular
from benchmarks.comparison.fraction_tableau import lemke_tableau
from benchmarks.comparison.peers import PEERS, Peer
from benchmarks.comparison.problem import Answer, FailedError, Problem, Raw, whole
from lcp_piles import Solution, contact_lcp, lemke, prove_contacts, push_path, solve
from lcp_piles.mechanics.state import State
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lcp, float_lemke
from lcp_piles.methods.float_state import FloatState
from lcp_piles.methods.gauss_seidel import gauss_seidel
from lcp_piles.methods.proved import float_guess, prove_or_repair
from lcp_piles.methods.registry import METHODS as METHODS_OF_SOLVE
from lcp_piles.methods.regular_set import regular_set
from lcp_piles.numbers.vectors import ExactVector, exact_vector
from lcp_piles.scenes.kind import origin_of


@dataclass(frozen=True)
class Method:
    """One way to the forces of a scene.

    `group` is exact, proof, float, peer or md. `run` takes a `Problem` and a setting; with
    `from_scene` it makes the contact system itself, from the scene. It is not run beyond `limit`
    contacts of the part that is solved, nor on scenes that `fits` refuses. `tolerance` turns a
    setting into the residual that the method's claim of success is held against; None where the
    claim is judged otherwise.
    """

    name: str
    group: str
    run: Callable[[Problem, Any], Answer]
    limit: int
    settings: tuple[float | None, ...] = (None,)
    from_scene: bool = False
    module: str = "lcp_piles"
    extra: str = ""
    fits: Callable[[str], bool] = lambda name: True
    tolerance: Callable[[Any], float] | None = None


def _solution(solution: Solution, **facts: Any) -> Answer:
    if solution.status != "solved":
        raise FailedError(f"{solution.status} {facts}")
    exact = solution.forces if isinstance(solution.forces, ExactVector) else None
    return Answer(solution.force_array, solution.gap_array, True, facts, exact)


def _exactly(given: Problem, state: State, **facts: Any) -> Answer:
    """The answer for the whole scene from an exact state of its part, unchecked."""
    forces = given.system.whole_forces(state.forces)
    gaps = given.system.whole_gaps(state.gaps)
    return Answer(forces.array(), gaps.array(), True, facts, forces)


def _solve(method: str) -> Callable[[Problem, Any], Answer]:
    def run(given: Problem, setting: Any) -> Answer:
        solution = solve(given.scene, method)
        return _solution(solution, pivots=solution.record.pivots)

    return run


def _from_float_start(given: Problem, setting: Any) -> Answer:
    """Lemke from the set that Newton's method names: forces and gaps, without states and checks."""
    outcome = prove_or_repair(given.system, float_guess(given.system))
    if not isinstance(outcome.state, State):
        raise FailedError("Lemke's method ended on a ray")
    return _exactly(given, outcome.state, pivots=outcome.steps)


def _lemke_alone(given: Problem, setting: Any) -> Answer:
    """Cold Lemke to forces and gaps, without states and checks: what a tableau gives too."""
    reduced = contact_lcp(given.system)
    result = lemke(reduced.problem)
    if result.z_vector is None:
        raise FailedError("Lemke's method ended on a ray")
    return _exactly(given, reduced.state(result.z_vector), pivots=result.pivots)


def _contacts(given: Problem, setting: Any) -> Answer:
    proof = prove_contacts(given.scene)
    radius = proof.forces.radius
    facts = {"unproved": len(proof.unproved), "loaded": int(proof.loaded.sum())}
    return Answer(proof.forces.middle, proof.gaps.middle, proof.proved, facts, radius=radius)


def _continuation(given: Problem, setting: Any) -> Answer:
    """Push from 0 to the push of the scene, through every rearrangement."""
    origin = origin_of(given.scene)
    parameters = dict(origin.parameters)
    push = parameters["push"]
    path = push_path(origin.kind.name, parameters["layers"], until=push)
    return _solution(path.solution(push), breakpoints=len(path.rearrangements))


def _floats(name: str) -> Callable[[Problem, Any], Answer]:
    """Forces and gaps of a floating-point method of the registry, without states read off them."""

    def run(given: Problem, setting: Any) -> Answer:
        outcome = METHODS_OF_SOLVE[name].run(given.system)
        state = outcome.state
        if not isinstance(state, FloatState):
            raise FailedError(f"{outcome.claim} after {outcome.steps} steps: {outcome.proof}")
        facts = {"steps": outcome.steps}
        return whole(given, Raw(state.forces, state.gaps, state.converged, facts))

    return run


def _float_lemke(kind: Any) -> Callable[[Problem, Any], Answer]:
    def run(given: Problem, setting: Any) -> Answer:
        result = float_lemke(*float_lcp(given.system), dtype=kind)
        if result.status != "solved":
            raise FailedError(f"{result.status} after {result.pivots} pivots")
        w, z = result.w.astype(np.float64), result.z.astype(np.float64)
        return whole(given, Raw(w, z, result.converged, {"pivots": result.pivots}))

    return run


def _gauss_seidel(given: Problem, setting: Any) -> Answer:
    result = gauss_seidel(given.system, tolerance=setting)
    return whole(given, Raw(result.forces, result.gaps, result.converged, {"sweeps": result.steps}))


def _fire(given: Problem, setting: Any) -> Answer:
    result = fire(given.system, tolerance=setting)
    return whole(
        given,
        Raw(result.forces, result.gaps, result.converged, {"iterations": result.steps}),
    )


def _flint(given: Problem, setting: Any) -> Answer:
    """The float set proved by FLINT's dense `solve` (Dixon) instead of sparse lifting."""
    regular = regular_set(given.system, float_guess(given.system))
    regular.held.equations.solver._lifting = None  # nothing to lift with: dense FLINT is left
    state = regular.state()
    if min(state.forces.signs()) < 0 or min(state.gaps.signs()) < 0:
        raise FailedError("the float set is wrong")
    return _exactly(given, state)


def _tableau(name: str) -> Callable[[Problem, Any], Answer]:
    def run(given: Problem, setting: Any) -> Answer:
        number: Any = Fraction
        if name == "gmpy2":
            from gmpy2 import mpq as number
        reduced = contact_lcp(given.system)
        problem = reduced.problem
        if len(problem.q.numerators) > 1:
            raise FailedError("a tableau of rationals cannot take a push that is not rational")
        result = lemke_tableau(problem.M, [x.rational() for x in problem.q], number)
        if result is None:
            raise FailedError("a secondary ray")
        z, pivots = result
        fractions = [Fraction(int(x.numerator), int(x.denominator)) for x in z]
        return _exactly(given, reduced.state(exact_vector(fractions)), pivots=pivots)

    return run


def _peer(peer: Peer) -> Method:
    def run(given: Problem, setting: Any) -> Answer:
        return whole(given, peer.solve(given.B, given.C, given.o, given.p, setting))

    return Method(
        peer.name,
        "peer",
        run,
        peer.limit,
        peer.settings,
        module=peer.module,
        extra=peer.extra,
        tolerance=_asked,
    )


def _asked(setting: Any) -> float:
    """The residual a method claims: its tolerance, 1e-6 where it has none."""
    return 1e-6 if setting is None else float(setting)


def _pushed(name: str) -> bool:
    return "push=" in name and "discs=" not in name


def _equal_discs(name: str) -> bool:
    return "discs=" not in name


GROUPS = ("exact", "proof", "float", "peer", "md")
FLOAT = (1e-3, 1e-6, 1e-9, 1e-11)
_LIMITS = {
    "proved": 10**6,
    "newton": 10**6,
    "fire": 3000,
    "gauss-seidel": 3000,
    "lemke-float64": 700,
    "lemke-float32": 700,
    "z": 400,
}
"""Contacts beyond which a method of the registry takes too long; `_LIMIT` for any other."""
_LIMIT = 1000
_CLAIMS = {"exact": None, "float64": lambda s: 1e-6, "float32": lambda s: 1e-3}
_OWN = {
    "newton": {"tolerance": lambda s: 1e-9},
    "lemke-float64": {"run": _float_lemke(np.float64)},
    "lemke-float32": {"run": _float_lemke(np.float32)},
    "gauss-seidel": {"run": _gauss_seidel, "settings": FLOAT, "tolerance": _asked},
    "fire": {"run": _fire, "settings": FLOAT, "tolerance": _asked},
}
"""What differs: tolerances that are swept, and Lemke's method without its displacements."""


def _of_registry(name: str, arithmetic: str) -> Method:
    exact = arithmetic == "exact"
    method = Method(
        name,
        "exact" if exact else "float",
        _solve(name) if exact else _floats(name),
        _LIMITS.get(name, _LIMIT),
        from_scene=exact,
        tolerance=_CLAIMS[arithmetic],
    )
    return replace(method, **_OWN.get(name, {}))


_ALL = (
    *(_of_registry(m.name, m.arithmetic) for m in METHODS_OF_SOLVE.values()),
    Method("float start", "exact", _from_float_start, 10**6),
    Method("lemke alone", "exact", _lemke_alone, 1000),
    Method("continuation", "exact", _continuation, 3000, from_scene=True, fits=_pushed),
    Method("FLINT dense", "exact", _flint, 1700),
    Method("Fractions", "exact", _tableau("fractions"), 130),
    Method("gmpy2", "exact", _tableau("gmpy2"), 130, module="gmpy2", extra="peers"),
    Method("contacts", "proof", _contacts, 10**6, from_scene=True),
    *map(_peer, PEERS),
    Method(
        "lammps",
        "md",
        lambda given, tau: molecular.relaxed(given.scene, tau),
        1300,
        molecular.TAUS,
        True,
        "lammps",
        "md",
        _equal_discs,
    ),
    Method(
        "lammps, tau to 0",
        "md",
        lambda given, tau: molecular.extrapolated(given.scene, tau),
        1300,
        molecular.TAUS,
        True,
        "lammps",
        "md",
        _equal_discs,
    ),
)


METHODS = tuple(sorted(_ALL, key=lambda m: GROUPS.index(m.group)))
"""All methods, one group after the other."""


def method(name: str) -> Method:
    """The method of this name."""
    return next(each for each in METHODS if each.name == name)
