"""Exact bounds of forces over all networks that friction admits.

Each bound is a linear programme with a certificate (`linear_program`): the network that attains it
and multipliers that prove it, or a network and a ray along which the force grows without end.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial

from ..errors import SolveError
from ..numbers.exact import ONE, ZERO, Exact, Surd
from ..numbers.vectors import ExactVector, exact_vector
from ..programs.linear_program import LinearProgramResult, minimise
from ..programs.proposal import Proposer
from ..scenes.scene import Scene
from ..scenes.symmetry import mirror
from .equations import FrictionProblem, Network, friction_problem
from .functionals import Functional, weights

_CHUNK = 8  # contacts of one task


class InadmissibleError(SolveError):
    """No network balances the loads under Coulomb's law: `motion` proves it.

    `motion` are displacements (x, y) and the clockwise turn of every disc, flat, nothing for what
    is held. No admissible contact force resists it (all do work >= 0), and the load does work > 0.
    """

    def __init__(self, motion: ExactVector) -> None:
        super().__init__("no forces balance the loads with this friction: the pile slides")
        self.motion = motion


@dataclass(frozen=True, eq=False)
class Bound:
    """One end of an interval: the `value` and the network that attains it.

    Where there is no end, `value` is None, `network` is one that is admissible, and `ray` the
    change of forces along which the force goes on without end.
    """

    value: Surd | None
    network: Network
    ray: Network | None = None


@dataclass(frozen=True, eq=False)
class ForceBounds:
    """The least and the largest value of a functional of the forces, in w."""

    least: Bound
    largest: Bound

    def __repr__(self) -> str:
        low, high = ("unbounded" if b.value is None else str(b.value) for b in self._ends)
        return f"<ForceBounds from {low} to {high}>"

    @property
    def _ends(self) -> tuple[Bound, Bound]:
        return self.least, self.largest


@dataclass(frozen=True, eq=False)
class ContactBounds:
    """The least and largest normal force of every contact, in w; None where there is no largest.

    `exact_pivots` is how many exact pivots repaired the proposals of floating point.
    """

    scene: Scene
    mu: Surd
    rough: tuple[str, ...]
    least: tuple[Surd, ...]
    largest: tuple[Surd | None, ...]
    exact_pivots: int

    def __repr__(self) -> str:
        count = self.largest.count(None)
        return f"<ContactBounds of {len(self.least)} contacts, {count} of them without a largest>"


def force_bounds(
    scene: Scene, mu: Exact, what: Functional, rough: Sequence[str] = ()
) -> ForceBounds:
    """Exact bounds of a functional of the forces, over all that Coulomb's law admits.

    Certified by linear programming duality, each certificate checked.

    Parameters
    ----------
    scene : Scene
        A plane scene without contacts held closed.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    what : mapping of (a, b) to exact number or pair of exact numbers
        The weight of a contact's normal force, or those of its normal and tangential force (see
        `functionals`).
    rough : sequence of str, optional
        The supports that are rough; others are smooth.

    Returns
    -------
    ForceBounds
        The `least` and the `largest` value (w), and networks that attain them.

    Raises
    ------
    InadmissibleError
        Where nothing balances the loads.
    InputError
        For a scene, friction or contact that is none of these.

    Examples
    --------
    >>> from lcp_piles import nt30
    >>> force_bounds(nt30(4), 0, {((4, 6), "floor"): 1})
    <ForceBounds from 1 to 11/2>
    """
    problem = friction_problem(scene, mu, rough)
    cost = objective(problem, weights(scene, what))
    proposer = Proposer(problem.constraints.scaled)
    low = minimise(problem.constraints, cost, proposer=proposer)
    high = minimise(problem.constraints, _negative(cost), proposer=proposer)
    return ForceBounds(_bound(problem, low, 1), _bound(problem, high, -1))


def contact_bounds(
    scene: Scene,
    mu: Exact,
    rough: Sequence[str] = (),
    *,
    executor: Executor | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> ContactBounds:
    """Exact bounds of the normal force of every contact, over all that Coulomb's law admits.

    Contacts that are mirror images in a symmetric scene have the same bounds, and one of each pair
    is asked.

    Parameters
    ----------
    scene : Scene
        A plane scene without contacts held closed.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    rough : sequence of str, optional
        The supports that are rough; others are smooth.
    executor : Executor, optional
        One of processes, which share the work.
    progress : callable, optional
        Called with the number of contacts done and to do.

    Returns
    -------
    ContactBounds
        The `least` and the `largest` force (w), one entry a contact.

    Raises
    ------
    InadmissibleError
        Where nothing balances the loads.
    InputError
        For a scene or friction that is none of these.

    Examples
    --------
    >>> from lcp_piles import tbs
    >>> bounds = contact_bounds(tbs(1), "1/5*sqrt(3)")
    >>> [str(x) for x in bounds.least], [str(x) for x in bounds.largest]
    (['0', '0', '0'], ['5/2', '5/2', '1'])
    """
    problem = friction_problem(scene, mu, rough)
    first = _representatives(scene)
    asked = sorted(set(first))
    chunks = [asked[k : k + _CHUNK] for k in range(0, len(asked), _CHUNK)]
    found: dict[int, tuple[Surd, Surd | None]] = {}
    pivots = 0
    for chunk, (ends, exact) in zip(chunks, _run(problem, chunks, executor), strict=True):
        found.update(zip(chunk, ends, strict=True))
        pivots += exact
        if progress is not None:
            progress(len(found), len(asked))
    return ContactBounds(
        scene,
        problem.mu,
        tuple(rough),
        tuple(found[k][0] for k in first),
        tuple(found[k][1] for k in first),
        pivots,
    )


def _run(
    problem: FrictionProblem, chunks: list[list[int]], executor: Executor | None
) -> Iterator[tuple[list[tuple[Surd, Surd | None]], int]]:
    """The bounds of each chunk of contacts, in order."""
    if executor is not None:
        yield from executor.map(partial(_bounds_of, problem), chunks)
        return
    proposer = Proposer(problem.constraints.scaled)
    for chunk in chunks:
        yield _bounds_of(problem, chunk, proposer)


def _bounds_of(
    problem: FrictionProblem, contacts: list[int], proposer: Proposer | None = None
) -> tuple[list[tuple[Surd, Surd | None]], int]:
    """The bounds of the normal forces of some contacts, and how many exact pivots they took."""
    proposer = proposer or Proposer(problem.constraints.scaled)
    ends = []
    pivots = 0
    for k in contacts:
        cost = objective(problem, {k: (ONE, ZERO)})
        low = minimise(problem.constraints, cost, proposer=proposer)
        high = minimise(problem.constraints, _negative(cost), proposer=proposer)
        least, largest = _value(problem, low, 1), _value(problem, high, -1)
        assert least is not None  # no normal force is negative
        ends.append((least, largest))
        pivots += low.pivots + high.pivots
    return ends, pivots


def objective(problem: FrictionProblem, of: dict[int, tuple[Surd, Surd]]) -> ExactVector:
    """The functional as weights of the columns."""
    values: list[Surd] = [ZERO] * len(problem.constraints.columns)
    for k, (normal, tangential) in of.items():
        plus, minus = problem.plus[k], problem.minus[k]
        if plus == minus:
            values[plus] = normal
        else:
            shear = problem.mu * tangential
            values[plus], values[minus] = normal + shear, normal - shear
    return exact_vector(values)


def _negative(cost: ExactVector) -> ExactVector:
    return ExactVector({r: [-x for x in v] for r, v in cost.numerators.items()}, cost.denominator)


def _value(problem: FrictionProblem, result: LinearProgramResult, sign: int) -> Surd | None:
    """The bound; None where there is none; an error where no network is admissible."""
    if result.status == "infeasible":
        assert result.y is not None
        raise InadmissibleError(problem.motion(result.y))
    return None if result.value is None else result.value * sign


def _bound(problem: FrictionProblem, result: LinearProgramResult, sign: int) -> Bound:
    value = _value(problem, result, sign)
    assert result.x is not None
    ray = None if result.ray is None else problem.network(result.ray)
    return Bound(value, problem.network(result.x), ray)


def _representatives(scene: Scene) -> list[int]:
    """For every contact the first of it and its mirror image."""
    symmetry = mirror(scene)
    numbers = range(len(scene.contacts))
    if symmetry is None:
        return list(numbers)
    return [min(k, image) for k, image in zip(numbers, symmetry.contacts.tolist(), strict=True)]
