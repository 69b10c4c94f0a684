"""Certificates of bounds with friction, and of the least friction with which a pile stands."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..files.hex_vectors import vector_entry
from ..files.json_fields import Entry
from ..friction.critical_friction import CriticalFriction
from ..friction.equations import FrictionProblem, friction_problem
from ..friction.force_bounds import objective
from ..friction.functionals import Functional, weights
from ..numbers.exact import ONE, ZERO, Exact, Surd, surd
from ..numbers.vectors import ExactVector, combination
from ..programs.linear_program import LinearProgramResult, minimise
from ..programs.proposal import Proposer
from ..scenes.scene import Scene
from .entries import FORMAT, certified_scene

_MINUS = surd(-1)
_SENSES = {"least": ONE, "largest": _MINUS}
Weights = dict[int, tuple[Surd, Surd]]
"""The weights of normal and tangential force by the number of the contact."""


def bound_certificate(
    scene: Scene, mu: Exact, what: Functional, rough: Sequence[str] = ()
) -> Entry:
    """The least and the largest value of a functional of the forces, with what proves them.

    Where no network balances the loads, the certificate proves that.

    Parameters
    ----------
    scene : Scene
        A plane scene without contacts held closed.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    what : mapping of (a, b) to exact number or pair of exact numbers
        The functional, as for `force_bounds`.
    rough : sequence of str, optional
        The supports that are rough; others are smooth.

    Returns
    -------
    dict
        What `save_certificate` writes.

    Raises
    ------
    InputError
        For a scene, friction or contact that is none of these.

    Examples
    --------
    >>> from lcp_piles import bound_certificate, tbs
    >>> bound_certificate(tbs(1), 0, {((1, 1), (3, 2)): 1})["claim"]
    'bounds'
    """
    problem = friction_problem(scene, mu, rough)
    return _certificate(problem, [weights(scene, what)])


def bounds_certificate(
    scene: Scene,
    mu: Exact,
    rough: Sequence[str] = (),
    *,
    progress: Callable[[int, int], None] | None = None,
) -> Entry:
    """The least and the largest normal force of every contact, with what proves them.

    Parameters
    ----------
    scene : Scene
        A plane scene without contacts held closed.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    rough : sequence of str, optional
        The supports that are rough; others are smooth.
    progress : callable, optional
        Called with the number of contacts done and to do.

    Returns
    -------
    dict
        What `save_certificate` writes.

    Raises
    ------
    InputError
        For a scene or friction that is none of these.

    Examples
    --------
    >>> from lcp_piles import bounds_certificate, tbs
    >>> bounds_certificate(tbs(1), 0)["claim"]
    'bounds'
    """
    problem = friction_problem(scene, mu, rough)
    each = [{k: (ONE, ZERO)} for k in range(len(scene.contacts))]
    return _certificate(problem, each, progress)


def _certificate(
    problem: FrictionProblem,
    functionals: Sequence[Weights],
    progress: Callable[[int, int], None] | None = None,
) -> Entry:
    proposer = Proposer(problem.constraints.scaled)
    ends = list[Entry]()
    for done, of in enumerate(functionals, 1):
        for name, sense in _SENSES.items():
            cost = combination([(sense, objective(problem, of))])
            result = minimise(problem.constraints, cost, proposer=proposer)
            if result.status == "infeasible":
                return _head("collapse", problem) | {"motion": _motion(problem, result.y)}
            ends.append({"end": name, **_proof(problem, of, sense, result)})
        if progress is not None:
            progress(done, len(functionals))
    return _head("bounds", problem) | {"bounds": ends}


def _proof(
    problem: FrictionProblem, of: Weights, sense: Surd, result: LinearProgramResult
) -> Entry:
    """What attains an end of an interval, and what proves that it is one."""
    assert result.x is not None  # the result is feasible
    found: Entry = {"weights": {str(k): [str(x) for x in pair] for k, pair in of.items()}}
    found["network"] = vector_entry(result.x)
    if result.ray is not None:
        return found | {"ray": vector_entry(result.ray)}
    assert result.value is not None
    assert result.y is not None  # an optimum has both
    moved = combination([(_MINUS, problem.motion(result.y))])
    return found | {"value": str(result.value * sense), "motion": vector_entry(moved)}


def critical_certificate(found: CriticalFriction) -> Entry:
    """That a pile stands with the upper friction and not with the lower."""
    scene = found.scene
    entry: Entry = {"format": FORMAT, "claim": "critical friction"}
    entry |= {"scene": certified_scene(scene), "rough": list(scene.supports)}
    entry |= {"upper": str(found.upper), "network": vector_entry(_columns(found))}
    if found.motion is not None:
        entry |= {"lower": str(found.lower), "motion": vector_entry(found.motion)}
    return entry


def _head(claim: str, problem: FrictionProblem) -> Entry:
    return {
        "format": FORMAT,
        "claim": claim,
        "scene": certified_scene(problem.scene),
        "friction": str(problem.mu),
        "rough": sorted(problem.rough),
    }


def _motion(problem: FrictionProblem, y: ExactVector | None) -> Entry:
    assert y is not None  # the result that led here has one
    return vector_entry(problem.motion(y))


def _columns(found: CriticalFriction) -> ExactVector:
    """The x+ and x- of every contact in turn, of the network that stands."""
    network = found.network
    if not found.upper:
        return network.normal
    half, per = surd(1) / 2, surd(1) / (2 * found.upper)
    up, down = (
        combination([(half, network.normal), (sign * per, network.tangential)])
        for sign in (ONE, _MINUS)
    )
    columns = {
        r: [x for pair in zip(up.numerators[r], down.numerators[r], strict=True) for x in pair]
        for r in up.numerators
    }
    return ExactVector(columns, up.denominator)
