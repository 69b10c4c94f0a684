"""Forces with friction when a pile is loaded once, from nothing, on elastic springs: exactly.

The inequality |f_t| <= mu f_n leaves forces open. Elastic springs along the tangents, without a
past, close the system: each contact sticks, slips or is open (`loading`). Floating point proposes
which (`loading_states`); one exact solve and the signs of all its numbers prove it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from ..errors import SolveError
from ..numbers.exact import Exact, Surd
from ..numbers.vectors import ExactVector
from ..scenes.scene import Scene
from .equations import Network
from .loading import LoadingProblem, State, loading_problem
from .loading_proof import point_of
from .loading_states import proposals


class UnresolvedError(SolveError):
    """No states that floating point proposed were right: nothing is proved, neither way."""


@dataclass(frozen=True, eq=False)
class FirstLoading:
    """Forces of first loading with friction, proved: one solution, perhaps of several.

    `states` says for every contact whether it is open, sticks, slips (+ where f_t = mu f_n, - where
    f_t = -mu f_n) or, smooth, is closed. `displacements` are x, y (in w tau) and the clockwise turn
    times R of every disc, flat, nothing for what is held; where discs are loose, one choice.
    """

    scene: Scene
    mu: Surd
    rough: tuple[str, ...]
    ratio: Fraction
    states: tuple[State, ...]
    network: Network
    displacements: ExactVector

    def count(self, *states: State) -> int:
        """How many contacts are in one of these states."""
        return sum(state in states for state in self.states)

    def __repr__(self) -> str:
        slips, sticks = self.count("slip+", "slip-"), self.count("stick")
        return f"<FirstLoading mu = {self.mu}: {sticks} contacts stick, {slips} slip>"


def first_loading(
    scene: Scene, mu: Exact, rough: Sequence[str] = (), *, ratio: Exact = 1
) -> FirstLoading:
    """Exact forces with friction and elastic tangential springs, loaded once from nothing.

    The solution is proved to be one; whether there are others, `all_first_loadings` finds for few
    contacts.

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

    Returns
    -------
    FirstLoading
        The forces (`network`, in w), and what sticks and slips (`states`).

    Raises
    ------
    InputError
        For contacts without compliance, and a scene, friction or ratio that is none of these.
    UnresolvedError
        Where no proposal is right.

    Examples
    --------
    >>> from lcp_piles import tbs
    >>> found = first_loading(tbs(1), "1/5*sqrt(3)")
    >>> [str(f) for f in found.network.normal], found.states
    (['5/18', '5/18', '5/9'], ('slip+', 'slip-', 'stick'))
    """
    problem = loading_problem(scene, mu, rough, ratio)
    for states in proposals(problem):
        x = point_of(problem, states)
        if x is not None:
            return loaded(problem, states, x)
    raise UnresolvedError(
        "no proposal of which contacts stick and slip is right: nothing is proved"
    )


def loaded(problem: LoadingProblem, states: Sequence[State], x: ExactVector) -> FirstLoading:
    """The solution that a point of some states is."""
    forces = problem.forces
    rough = tuple(name for name in forces.scene.supports if name in forces.rough)
    network, moved = forces.network(x), problem.displacements(x)
    return FirstLoading(
        forces.scene, forces.mu, rough, problem.ratio, tuple(states), network, moved
    )
