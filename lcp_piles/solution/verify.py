"""The check of a solution: its identities from the scene alone, and everything else it claims.

`identities` evaluates balance, Hooke's law, signs and complementarity with nothing of the solver.
`claims` makes anew what else a solution says: optimal partition, mechanisms, verdict, uniqueness
and sizes, on the whole pile, where the solver used its symmetric and antisymmetric halves. What
`solve` returns has passed the first; the second is for whoever has a solution from elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from ..errors import InputError
from ..linear.threads import one_thread
from ..numbers.exact import Surd
from ..numbers.vectors import ExactVector
from ..scenes.scene import Scene
from .claims import claim_faults, float_claim_faults, record_faults
from .identities import collapse_faults, identity_faults
from .solution import Solution, Solved


@dataclass(frozen=True)
class Verification:
    """The outcome: `faults` lists everything that fails, in words (at most `shown` of them).

    `exact` says whether the numbers are exact. For floating-point solutions it is false, and
    `residual` is the largest violation of an identity (w, or w tau), which is no fault by itself.
    """

    exact: bool
    faults: tuple[str, ...]
    residual: float = 0.0

    @property
    def ok(self) -> bool:
        """Whether everything holds exactly."""
        return self.exact and not self.faults


@one_thread()
def verify(scene: Scene, solution: Solution, *, shown: int = 10) -> Verification:
    """Check everything that a solution says of a scene, exactly.

    Its identities: balance, Hooke's law, signs and complementarity. If these hold, its claims: that
    the states are those of the optimal partition, the number of mechanisms, the verdict of
    stability, which gaps and whether the forces are unique, and the sizes and the arithmetic of the
    record. (What only its history could tell, the method and how long it took, is not checked.)

    For an unstable scene: that the collapse closes no contact, moves nothing that is held, and that
    the load does work on it. A solution without answer ("unresolved") is a fault. A floating-point
    solution gets its residual; it may not claim what floating point cannot prove.

    Parameters
    ----------
    scene : Scene
        The scene.
    solution : Solved, Unstable or Unresolved
        What is said of it.
    shown : int, default 10
        The most faults to list.

    Returns
    -------
    Verification
        `ok`, and the `faults` in words.

    Raises
    ------
    InputError
        Where sizes do not fit the scene.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> verify(nt60(3), solve(nt60(3))).ok
    True
    """
    if solution.status == "unresolved":
        return Verification(solution.exact, ("the scene is unresolved: nothing is claimed",))
    places, count = len(scene.discs) * scene.dimension, len(scene.contacts)
    if solution.status == "unstable":
        if len(solution.collapse) != places:
            raise InputError("the size of the collapse", len(solution.collapse), f"{places}")
        faults = collapse_faults(scene, solution.collapse)
        records = record_faults(scene, solution.record, exact=True)
        return Verification(True, _first(faults, records, shown))
    u, f, g = solution.displacements, solution.forces, solution.gaps
    lengths = (len(u), len(f), len(g))
    if lengths != (places, count, count):
        raise InputError("the sizes of u, f and g", lengths, f"{(places, count, count)}")
    if len(solution.states) != count:
        raise InputError("the number of states", len(solution.states), f"{count}")
    if isinstance(u, ExactVector) and isinstance(f, ExactVector) and isinstance(g, ExactVector):
        faults = identity_faults(scene, u, f, g, solution.states)
        return Verification(True, _first(faults, claim_faults(scene, solution, f, g), shown))
    claimed = _first(float_claim_faults(scene, solution), iter(()), shown)
    return Verification(False, claimed, _residual(scene, solution))


def _first(faults: Iterator[str], claims: Iterator[str], shown: int) -> tuple[str, ...]:
    """The first faults; claims are only asked for where there are none before them."""
    return tuple(islice(faults, shown)) or tuple(islice(claims, shown))


def _residual(scene: Scene, solution: Solved) -> float:
    """The largest violation of a floating-point solution."""
    u, f, g = solution.displacement_array, solution.force_array, solution.gap_array
    normals, which = scene.normals
    n = np.array([[float(x) for x in normal] for normal in normals])[which]
    a, b = scene.ends
    relative = u[a] - np.where((b >= 0)[:, None], u[b], 0.0)
    c = np.array([float(contact.compliance) for contact in scene.contacts])
    o = np.array([float(contact.gap) if contact.gap else 0.0 for contact in scene.contacts])
    hooke = np.abs(g - o - c * f - (n * relative).sum(axis=1))
    balance = np.array([[float(p) for p in disc.load] for disc in scene.discs])
    np.add.at(balance, a, n * f[:, None])
    np.add.at(balance, b[b >= 0], -(n * f[:, None])[b >= 0])
    free = np.array([[h is None for h in disc.held] for disc in scene.discs])
    wanted = np.array([[float(h or Surd(())) for h in disc.held] for disc in scene.discs])
    held = np.abs(u - wanted)[~free]
    one_sided = np.array([not contact.bilateral for contact in scene.contacts])
    both = np.minimum(np.abs(f), np.abs(g))
    parts = [hooke, np.abs(g[~one_sided]), np.abs(balance)[free], held, -f[one_sided], -g, both]
    return float(max((part.max() for part in parts if part.size), default=0.0))
