"""All solutions of first loading, for piles of few contacts: every state, searched with proofs.

Depth first: a node has the first contacts in chosen states, the others being in any state or in
none. Where a linear programme of that has no point, a Farkas vector proves it, and nothing below is
looked at. At the end all contacts have states: where these leave as many unknowns as equations, the
signs of the one solution decide, elsewhere the affine hull of what they admit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..errors import InputError
from ..linear.sparse_exact import SingularError
from ..numbers.exact import Exact, Surd
from ..numbers.vectors import ExactVector
from ..programs.affine_hull import affine_hull
from ..programs.certificates import is_feasible
from ..scenes.scene import Scene
from .first_loading import FirstLoading, loaded
from .loading import LoadingProblem, State, loading_problem
from .loading_proof import admitted, solved, spread

_MOST = 12


@dataclass(frozen=True, eq=False)
class AllFirstLoadings:
    """Every solution of first loading, proved complete.

    `solutions` differ in a force. `continuum` says whether forces vary within the states of one of
    them, so that there are more than those named. `programs` is how many linear programmes it took.
    """

    solutions: tuple[FirstLoading, ...]
    continuum: bool
    programs: int

    @property
    def unique(self) -> bool:
        """Whether forces are unique: one solution, proved to be the only one."""
        return len(self.solutions) == 1 and not self.continuum

    def __repr__(self) -> str:
        more = ", with forces that vary" if self.continuum else ""
        return f"<AllFirstLoadings: {len(self.solutions)}{more}>"


def all_first_loadings(
    scene: Scene,
    mu: Exact,
    rough: Sequence[str] = (),
    *,
    ratio: Exact = 1,
    progress: Callable[[int], None] | None = None,
) -> AllFirstLoadings:
    """Every solution of `first_loading`, by a search of all states of the contacts.

    For piles of at most 12 contacts: it takes seconds for 7, minutes for 9.

    Parameters
    ----------
    scene : Scene
        A plane scene of contacts with compliance.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    rough : sequence of str, optional
        The supports that are rough; others are smooth.
    ratio : exact number, default 1
        The tangential stiffness of a contact over its normal one, a positive rational.
    progress : callable, optional
        Called with the number of linear programmes so far.

    Returns
    -------
    AllFirstLoadings
        The `solutions`, and whether the forces are `unique`.

    Raises
    ------
    InputError
        For more contacts, contacts without compliance, and a scene, friction or ratio that is none
        of these.

    Examples
    --------
    >>> from lcp_piles import tbs
    >>> all_first_loadings(tbs(1), "1/5*sqrt(3)").unique
    True
    """
    if len(scene.contacts) > _MOST:
        raise InputError("the number of contacts", len(scene.contacts), f"at most {_MOST}")
    problem = loading_problem(scene, mu, rough, ratio)
    found: dict[tuple[Surd, ...], FirstLoading] = {}
    waiting: list[tuple[State, ...]] = [()]
    continuum, programs = False, 0
    while waiting:
        states = waiting.pop()
        if len(states) == len(problem.choices):
            x, varies = _point(problem, states)
            if x is not None:
                solution = loaded(problem, states, x)
                forces = solution.network.normal, solution.network.tangential
                found.setdefault(tuple(f for vector in forces for f in vector), solution)
                continuum |= varies
            continue
        programs += 1
        if progress is not None:
            progress(programs)
        if admitted(problem, [*states, *[None] * (len(problem.choices) - len(states))]) is not None:
            waiting += [(*states, state) for state in problem.choices[len(states)]]
    return AllFirstLoadings(tuple(found.values()), continuum, programs)


def _point(problem: LoadingProblem, states: Sequence[State]) -> tuple[ExactVector | None, bool]:
    """A point of the states, if there is one, and whether forces vary over all of them."""
    try:
        x = solved(problem, states)
    except SingularError:
        columns = problem.columns(states)
        hull = affine_hull(problem.constraints.of(columns))
        if hull is None:
            return None, False
        forces = {*problem.forces.plus, *problem.forces.minus}
        vary = any(v and j in forces for j, v in zip(columns, hull.varies, strict=True))
        return spread(hull.point, columns, len(problem.constraints.columns)), vary
    return (x if is_feasible(problem.constraints, x) else None), False
