"""Any LCP: floating point proposes a basis, exact arithmetic proves it, Lemke's method comes last.

A basis is 2^n guesses away from blind search, but one exact solve away from a proof: with z_B from
M_BB z_B = -q_B and all else zero, the exact signs of z_B and of w = M z + q say whether it is the
solution. So whatever is proposed can change how long the answer takes and never the answer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, SupportsIndex

from ..errors import VerificationError
from ..numbers.exact import Exact
from ..pivoting.lcp import lcp_of
from ..pivoting.lemke import LemkeResult, lemke, pivot_limit
from .exact_basis import proved
from .matrix_class import MatrixClass, matrix_class
from .proposals import proposals


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class LCPSolution(LemkeResult):
    """What `solve_lcp` found, and by which road: a `LemkeResult` with what is known of M.

    Attributes
    ----------
    status : {"solved", "infeasible", "ray", "limit"}
        "infeasible" where no z >= 0 has M z + q >= 0; the last two are ends that may prove nothing.
    z_vector : ExactVector or None, shape (n,)
        The solution; `z` has it as plain numbers.
    w_vector : ExactVector or None, shape (n,)
        Its M z + q; `w` has it as plain numbers.
    pivots : int
        How many Lemke's method took, 0 where floating point named the basis.
    ray : Ray or None
        Where the pivots ended without a solution.
    certificate : tuple of Fraction or None
        y >= 0 with M^T y <= 0 and q . y < 0 where it is infeasible.
    road : {"proposed", "pivots"}
        Whether floating point named the basis.
    matrix : MatrixClass
        What has been proved about M; `meaning` says what that makes of the status.

    Examples
    --------
    >>> solve_lcp([[-1]], [-1]).meaning
    'No z >= 0 has M z + q >= 0: the certificate proves it, and was checked.'
    """

    road: Literal["proposed", "pivots"]
    matrix: MatrixClass

    def __repr__(self) -> str:
        way = "proposed, proved" if self.road == "proposed" else f"{self.pivots} pivots"
        return f"<LCPSolution {self.status}, {way}, {self.matrix.name} matrix>"

    @property
    def meaning(self) -> str:
        """What the status does and does not prove, in a sentence."""
        if self.status == "infeasible":
            return "No z >= 0 has M z + q >= 0: the certificate proves it, and was checked."
        if self.status == "solved":
            only = "it is the only solution" if self.matrix.unique else "there may be others"
            return f"z and w solve the problem exactly; {only}."
        return self.matrix.of_ray if self.status == "ray" else self.matrix.of_limit


def solve_lcp(
    M: Any,
    q: Sequence[Exact] | None = None,
    *,
    max_pivots: SupportsIndex | None = None,
    progress: Callable[[int], None] | None = None,
) -> LCPSolution:
    """Solve w = M z + q, z >= 0, w >= 0, z . w = 0 exactly, fast where floating point helps.

    Floating point proposes a basis, and one exact solve proves it; Lemke's method starts only where
    no proposal was right. Where there are several solutions it need not find the one of `lemke`.

    Parameters
    ----------
    M : matrix of exact rationals, shape (n, n), or LCP
        In any form that `lcp` takes; of an LCP q is left out.
    q : sequence of exact numbers, shape (n,), optional
        Given unless M is an LCP.
    max_pivots : int, optional
        After so many pivots Lemke's method gives up.
    progress : callable, optional
        Called with the number of its pivots after each.

    Returns
    -------
    LCPSolution
        `status`, `z`, `w`, and the `meaning` of the status.

    Raises
    ------
    InputError
        For other data, floats among them.

    Examples
    --------
    >>> result = solve_lcp([[2, 1], [1, 2]], [-5, -6])
    >>> result.status, result.z, result.matrix.name
    ('solved', (Fraction(4, 3), Fraction(7, 3)), 'positive definite')
    >>> result.meaning
    'z and w solve the problem exactly; it is the only solution.'
    """
    problem = lcp_of(M, q)
    limit = pivot_limit(max_pivots)
    known = matrix_class(problem)
    for basic in proposals(problem):
        found = proved(problem, basic)
        if found is not None:
            return LCPSolution("solved", *found, 0, road="proposed", matrix=known)
    end = lemke(problem, max_pivots=limit, progress=progress)
    if end.status == "ray" and not known.of_ray:
        raise VerificationError(f"a ray proves nothing for a matrix proved to be {known.name}")
    return LCPSolution(**vars(end), road="pivots", matrix=known)
