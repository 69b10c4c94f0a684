"""The exact solution held against floating point that shares no code with the pivots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import SolveError
from .scenes.scene import Contact
from .solution.solution import ContactState, Solution
from .solve import solve


@dataclass(frozen=True, repr=False)
class CrossCheck:
    """Largest difference of a force (w), and the contacts whose state the two name differently.

    Each of `differing` is (contact, exact state, floating-point state). Differences of state are
    no fault of the exact solution: floating point cannot tell a tie from a tiny force.
    """

    largest_difference: float
    differing: tuple[tuple[Contact, ContactState, ContactState], ...]

    def __repr__(self) -> str:
        size = f"{self.largest_difference:.1e}"
        return f"<CrossCheck: forces differ by {size} w, {len(self.differing)} states differ>"


def cross_check(solution: Solution) -> CrossCheck:
    """Solve the scene of an exact solution again by Newton's method and compare.

    Parameters
    ----------
    solution : Solved
        An exact solution.

    Returns
    -------
    CrossCheck
        The largest difference of a force (w), and the contacts whose states differ.

    Raises
    ------
    SolveError
        Where Newton's method does not converge on the scene.
    NotSolvedError
        Where the solution has no forces.

    Examples
    --------
    >>> from lcp_piles import nt30, solve
    >>> check = cross_check(solve(nt30(4)))
    >>> check.largest_difference < 1e-12, check.differing
    (True, ())
    """
    other = solve(solution.scene, "newton")
    if other.status != "solved":
        raise SolveError("Newton's method did not converge on this scene: no cross-check")
    difference = np.abs(solution.force_array - other.force_array).max(initial=0.0)
    differing = tuple(
        (contact, one, two)
        for contact, one, two in zip(
            solution.scene.contacts, solution.states, other.states, strict=True
        )
        if one != two
    )
    return CrossCheck(float(difference), differing)
