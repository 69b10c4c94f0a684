"""The support of an LCP's solution, proved without its digits, and the solution within bounds.

For problems whose exact solution has too many digits to be of use. Floating point proposes a basis
B; some bits of M_BB^-1 (-q_B) are lifted, with a residual r that is exact
(`ExactSolver.approximate`), and what is missing, M_BB^-1 r, is bounded (`inverse_bound`).
Where every z of B and every w beside it is positive by more than its bound, the basis is proved: it
is regular, and its exact z and w, which nobody has computed, have the right signs. A z or w that is
exactly zero cannot be told from a tiny one, unless the digits end, and is named.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np
from flint import fmpz

from ..errors import SolveError
from ..linear.reconstruction import joined
from ..linear.sparse_exact import ExactSolver
from ..numbers.exact import Exact
from ..numbers.floats import LOST, UP, Bounded
from ..numbers.vectors import ExactVector, FloatArray, Mask
from ..pivoting.lcp import LCP, lcp_of
from ..pivoting.rows import RationalRows, rational_rows
from .inverse_bound import InverseBound, inverse_bound, sizes
from .matrix_class import MatrixClass, matrix_class
from .proposals import proposals

_STEPS = 4  # of 32 bits each, beyond those that the right-hand side takes


@dataclass(frozen=True, eq=False, repr=False)
class LCPProof:
    """The support of a solution of an LCP, proved without exact fractions.

    Attributes
    ----------
    support : array of bool, shape (n,)
        Marks the z that are positive.
    z : Bounded, shape (n,)
        The solution within bounds.
    w : Bounded, shape (n,)
        Its w = M z + q within bounds.
    unproved : tuple of int
        The variables of which neither z nor w is known to be positive; the support is proved, and
        with it all bounds, where there are none.
    way : str
        How the inverse was bounded.
    matrix : MatrixClass
        What has been proved about M: where `matrix.unique`, there is no other solution.

    Examples
    --------
    >>> prove_lcp([[2, 1], [1, 2]], [-5, -1]).unproved
    ()
    """

    support: Mask
    z: Bounded
    w: Bounded
    unproved: tuple[int, ...]
    way: str
    matrix: MatrixClass

    def __repr__(self) -> str:
        told = "proved" if self.proved else f"{len(self.unproved)} variables not proved"
        return f"<LCPProof {told}, {int(self.support.sum())} of {len(self.support)} positive>"

    @property
    def proved(self) -> bool:
        """Whether the support and all bounds are proved."""
        return not self.unproved


def prove_lcp(M: Any, q: Sequence[Exact] | None = None) -> LCPProof:
    """Prove which z of w = M z + q, z >= 0, w >= 0, z . w = 0 are positive, and bound z and w.

    For problems whose exact solution has too many digits to be of use.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n), or LCP
        In any form that `lcp` takes; of an LCP q is left out.
    q : sequence of exact numbers, shape (n,), optional
        Given unless M is an LCP.

    Returns
    -------
    LCPProof
        The `support` and the bounds.

    Raises
    ------
    InputError
        For other data, floats among them.
    SolveError
        Where floating point proposes no basis, or its matrix is too ill-conditioned for bounds: the
        exact `solve_lcp` is for those.

    Examples
    --------
    >>> proof = prove_lcp([[2, 1], [1, 2]], [-5, -1])
    >>> proof.proved, proof.support.tolist(), bool(abs(proof.z.middle[0] - 2.5) < 1e-15)
    (True, [True, False], True)
    """
    problem = lcp_of(M, q)
    rows = problem.rows or rational_rows(problem.M)
    known = matrix_class(problem)
    best: LCPProof | None = None
    for basic in proposals(problem):
        proof = _proof(problem, rows, basic, known)
        if best is None or len(proof.unproved) < len(best.unproved):
            best = proof
        if best.proved:
            break
    if best is None:
        raise SolveError("floating point proposes no basis of this LCP: use solve_lcp")
    return best


def _proof(problem: LCP, rows: RationalRows, basic: Mask, known: MatrixClass) -> LCPProof:
    places = np.flatnonzero(basic).tolist()
    bound = inverse_bound(rows, places)
    z, lost = _approximate(problem, rows, places, bound)
    w = problem.w(z)
    ends = not lost.any()  # the digits end, so that these are exactly z and w
    if ends:
        z_signs, w_signs = np.array(z.signs(), dtype=int), np.array(w.signs(), dtype=int)
        right = np.where(basic, (z_signs >= 0) & (w_signs == 0), w_signs >= 0)
        support = basic & (z_signs > 0)
    z_near, w_near = z.bounded(), w.bounded()
    with np.errstate(all="ignore"):
        spread = abs(rows.floats()) @ lost * UP + LOST
        z_near = Bounded(z_near.middle, (z_near.radius + lost) * UP)
        w_near = Bounded(
            np.where(basic, 0.0, w_near.middle),
            np.where(basic, 0.0, (w_near.radius + spread) * UP),
        )
    if not ends:
        right = np.where(basic, z_near.signs() > 0, w_near.signs() > 0)
        support = basic
    unproved = tuple(np.flatnonzero(~right).tolist())
    return LCPProof(support, z_near, w_near, unproved, bound.way, known)


def _approximate(
    problem: LCP, rows: RationalRows, places: list[int], bound: InverseBound
) -> tuple[ExactVector, FloatArray]:
    """A z of the basis to many bits, and how far each entry of the exact one is from it at most."""
    size, q = len(problem), problem.q.plain()
    part = rows.part(places)
    solver = ExactSolver(part.A)
    lost = np.zeros(size)
    found: dict[int, tuple[list[fmpz], int]] = {}
    for r, numbers in q.numerators.items():
        right = [-numbers[i] * den for i, den in zip(places, part.denominators, strict=True)]
        near = solver.approximate(right, _STEPS)
        bits = near.shift * (len(near.digits) - near.length)
        found[r] = joined(near.digits, near.shift), bits
        if any(near.rest):
            rest = sizes(near.rest, q.denominator << bits)
            lost[places] += bound.of(rest) * sqrt(r) * UP
    most = max(bits for _, bits in found.values())
    numerators = {}
    for r, (values, bits) in found.items():
        column = [fmpz(0)] * size
        for i, x in zip(places, values, strict=True):
            column[i] = x << (most - bits)
        numerators[r] = column
    return ExactVector(numerators, q.denominator << most), lost
