"""A proposed basis, proved by exact signs, or repaired by them."""

from __future__ import annotations

import numpy as np

from ..errors import SolveError
from ..numbers.vectors import ExactVector, Mask
from ..pivoting.basic_solution import basic_z
from ..pivoting.lcp import LCP

_REPAIRS = 3


def proved(
    problem: LCP, basic: Mask, free: Mask | None = None
) -> tuple[ExactVector, ExactVector] | None:
    """(z, w) of the basis, with the right signs exactly; None where it is none.

    Where some signs are wrong, their variables change sides, and that is tried a few times. `free`
    marks z without a condition on their signs.

    >>> from lcp_piles import lcp
    >>> z, _ = proved(lcp([[2, 1], [1, 2]], [-5, -1]), np.array([True, True]))
    >>> [str(x) for x in z]
    ['5/2', '0']
    """
    for _ in range(_REPAIRS + 1):
        places = np.flatnonzero(basic).tolist()
        try:
            z = basic_z(problem, places)
        except SolveError:  # a singular matrix
            return None
        w = problem.w(z)
        z_signs, w_signs = np.array(z.signs(), dtype=int), np.array(w.signs(), dtype=int)
        wrong = np.where(basic, z_signs, w_signs) < 0
        if free is not None:
            wrong &= ~free
        if not wrong.any():
            return None if w_signs[basic].any() or z_signs[~basic].any() else (z, w)
        basic = basic ^ wrong
    return None
