"""How much Coulomb's law leaves open: the dimension of the set of admissible networks, exactly.

The networks are the points of a polyhedron {x >= 0, A x = b} with two columns for a contact with
friction and one without. Its dimension is the number of independent ways in which forces can change
while all discs stay in balance, once contacts that no network loads are set aside, and columns of
contacts that are at Coulomb's limit in every network.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..numbers.exact import ZERO, Exact, Surd
from ..numbers.vectors import ExactVector, exact_vector
from ..programs.affine_hull import affine_hull, directions
from ..programs.certificates import is_feasible
from ..programs.linear_program import minimise
from ..scenes.scene import Scene
from .equations import FrictionProblem, Network, friction_problem
from .force_bounds import InadmissibleError


@dataclass(frozen=True, eq=False)
class Indeterminacy:
    """What balance and Coulomb's law leave open.

    `unknowns` is the number of force components and `rank` that of independent equations;
    `hyperstaticity`, their difference, counts the self-stresses of all contacts, whatever their
    signs. `dimension` is that of the admissible networks. No network loads the
    contacts of `unloaded`, all have those of `limiting` at |f_t| = mu f_n > 0, and the forces on
    those of `determined` are the same in all. `network` is one of the interior: it loads all that
    any network loads.
    """

    scene: Scene
    mu: Surd
    rough: tuple[str, ...]
    unknowns: int
    rank: int
    dimension: int
    unloaded: tuple[int, ...]
    limiting: tuple[int, ...]
    determined: tuple[int, ...]
    network: Network

    @property
    def hyperstaticity(self) -> int:
        """Unknown force components less independent equations."""
        return self.unknowns - self.rank

    def __repr__(self) -> str:
        return f"<Indeterminacy: dimension {self.dimension}, hyperstaticity {self.hyperstaticity}>"


def indeterminacy(scene: Scene, mu: Exact, rough: Sequence[str] = ()) -> Indeterminacy:
    """The dimension of the set of networks that Coulomb's law admits, proved (`affine_hull`).

    `force_bounds` says how wide the set is contact by contact.

    Parameters
    ----------
    scene : Scene
        A plane scene without contacts held closed.
    mu : exact number
        The friction between discs, and with the supports named in `rough`.
    rough : sequence of str, optional
        The supports that are rough; others are smooth.

    Returns
    -------
    Indeterminacy
        The `dimension`, the `hyperstaticity`, and the contacts on which networks agree.

    Raises
    ------
    InadmissibleError
        Where no network balances the loads.
    InputError
        For a scene or friction that is none of these.

    Examples
    --------
    >>> from lcp_piles import tbs
    >>> indeterminacy(tbs(1), 0), indeterminacy(tbs(1), "1/5*sqrt(3)")
    (<Indeterminacy: dimension 1, hyperstaticity 1>, <Indeterminacy: dimension 3, hyperstaticity 3>)
    """
    problem = friction_problem(scene, mu, rough)
    read = problem.constraints
    hull = affine_hull(read)
    if hull is None:
        nothing = exact_vector([0] * len(read.columns))
        proof = minimise(read, nothing).y
        assert proof is not None
        raise InadmissibleError(problem.motion(proof))
    everything = range(len(read.columns))
    kernel, _ = directions(read.scaled, everything)
    zero = set(hull.zero)
    pairs = [{plus, minus} for plus, minus in zip(problem.plus, problem.minus, strict=True)]
    return Indeterminacy(
        scene,
        problem.mu,
        tuple(rough),
        len(everything),
        len(everything) - kernel,
        hull.dimension,
        tuple(k for k, pair in enumerate(pairs) if pair <= zero),
        tuple(k for k, pair in enumerate(pairs) if len(pair & zero) == 1 < len(pair)),
        tuple(k for k, pair in enumerate(pairs) if not any(hull.varies[j] for j in pair)),
        problem.network(hull.point),
    )


def is_admissible(problem: FrictionProblem, normal: ExactVector, tangential: ExactVector) -> bool:
    """Whether forces balance the loads and keep to Coulomb's law, exactly.

    >>> from lcp_piles import nt30, solve
    >>> problem, forces = friction_problem(nt30(4), "3/10"), solve(nt30(4)).forces
    >>> is_admissible(problem, forces, exact_vector([0] * len(forces)))
    True
    """
    x = [ZERO] * len(problem.constraints.columns)
    for plus, minus, f, s in zip(problem.plus, problem.minus, normal, tangential, strict=True):
        if plus == minus:
            if s:
                return False
            x[plus] = f
        else:
            x[plus], x[minus] = (f + s / problem.mu) / 2, (f - s / problem.mu) / 2
    return is_feasible(problem.constraints, exact_vector(x))
