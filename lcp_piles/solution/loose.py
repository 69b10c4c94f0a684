"""Discs that are not held by forces: rattlers of a solved scene, and what falls of an unstable one.

Under gravity every disc of a scene in balance bears at least its own weight, so that rattlers are
found without it: where only a load from outside, or what is pressed together, makes forces.
"""

from __future__ import annotations

import numpy as np

from ..scenes.names import DiscId
from .solution import Solved, Unstable


def rattlers(solution: Solved) -> tuple[DiscId, ...]:
    """The discs that are free to move and that no force holds.

    Parameters
    ----------
    solution : Solved
        A scene in balance.

    Returns
    -------
    tuple of int, str or tuple
        Their ids, in the order of the scene.

    Examples
    --------
    >>> from lcp_piles import slab, solve
    >>> rattlers(solve(slab(2, 1, weight=0)))
    ((1, 1), (1, 2))
    """
    scene = solution.scene
    held = np.array([disc.fixed for disc in scene.discs])
    loaded = np.array(solution.states, dtype=object) == "closed"
    for end in scene.ends:
        held[end[loaded & (end >= 0)]] = True
    return tuple(scene.discs[k].id for k in np.flatnonzero(~held).tolist())


def falling(solution: Unstable) -> tuple[DiscId, ...]:
    """The discs that the collapse of an unstable scene moves; others may fall too.

    Parameters
    ----------
    solution : Unstable
        A scene that cannot stand.

    Returns
    -------
    tuple of int, str or tuple
        Their ids, in the order of the scene.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> falling(solve(nt60(2).without([(2, 2)])))
    ((1, 1),)
    """
    scene = solution.scene
    moves = np.array(solution.collapse.signs()).reshape(len(scene.discs), -1).any(axis=1)
    return tuple(scene.discs[k].id for k in np.flatnonzero(moves).tolist())
