"""Any LCP: floating point proposes a basis, exact arithmetic proves it, Lemke's method comes last.

A basis is 2^n guesses away from blind search, but one exact solve away from a proof: with z_B from
M_BB z_B = -q_B and all else zero, the exact signs of z_B and of w = M z + q say whether it is the
solution. So whatever is proposed can change how long the answer takes and never the answer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, SupportsIndex

from ..errors import VerificationError
from ..numbers.exact import Exact, Surd
from ..numbers.vectors import ExactVector
from ..pivoting.lcp import lcp_of
from ..pivoting.lemke import Ray, Status, lemke, pivot_limit, plain_numbers
from .exact_basis import proved
from .matrix_class import MatrixClass, matrix_class
from .proposals import proposals


@dataclass(frozen=True, eq=False, repr=False)
class LCPSolution:
    """What `solve_lcp` found, and by which road.

    `status`, `z`, `w`, `ray` and `certificate` are as those of `LemkeResult`. `road` is "proposed"
    where floating point named the basis, or "pivots", of which it took `pivots`. `matrix` is what
    has been proved about M, and `meaning` says what that makes of the status.
    """

    status: Status
    z_vector: ExactVector | None
    w_vector: ExactVector | None
    road: Literal["proposed", "pivots"]
    pivots: int
    matrix: MatrixClass
    ray: Ray | None = None
    certificate: tuple[Fraction, ...] | None = None

    def __repr__(self) -> str:
        way = "proposed, proved" if self.road == "proposed" else f"{self.pivots} pivots"
        return f"<LCPSolution {self.status}, {way}, {self.matrix.name} matrix>"

    @property
    def success(self) -> bool:
        """Whether z and w are a solution."""
        return self.status == "solved"

    @property
    def z(self) -> tuple[Fraction | Surd, ...]:
        """The solution z; empty where there is none."""
        return plain_numbers(self.z_vector)

    @property
    def w(self) -> tuple[Fraction | Surd, ...]:
        """The solution's w = M z + q; empty where there is none."""
        return plain_numbers(self.w_vector)

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

    Parameters: `M` and `q` as of `lcp`, exact and in any form, or an `LCP` alone; `max_pivots`,
    after which Lemke's method gives up, and `progress`, called with the number of its pivots after
    each: it starts only where no proposal was right. Where there are several solutions it need not
    find the one of `lemke`. Raises `InputError` for other data, floats among them.

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
            return LCPSolution("solved", *found, "proposed", 0, known)
    end = lemke(problem, max_pivots=limit, progress=progress)
    if end.status == "ray" and not known.of_ray:
        raise VerificationError(f"a ray proves nothing for a matrix proved to be {known.name}")
    return LCPSolution(
        end.status,
        end.z_vector,
        end.w_vector,
        "pivots",
        end.pivots,
        known,
        end.ray,
        end.certificate,
    )
