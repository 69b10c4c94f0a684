"""What Lemke's method claims, checked exactly on the LCP itself and not on the tableau.

Pivots propose z, or a ray; w and its changes are computed here anew, from the columns of M.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from ..errors import VerificationError
from ..numbers.exact import ONE, Surd
from ..numbers.vectors import ExactVector, combination, exact_vector
from .lcp import LCP


def checked_w(problem: LCP, z: ExactVector) -> ExactVector:
    """W = M z + q; `VerificationError` unless z >= 0, w >= 0 and z . w = 0."""
    w = solved_w(problem, z)
    if w is None:
        raise VerificationError("the z that Lemke's method found is not a solution")
    return w


def solved_w(problem: LCP, z: ExactVector) -> ExactVector | None:
    """W = M z + q where z >= 0, w >= 0 and z . w = 0, else None."""
    w = problem.w(z)
    return w if _complementary(z, w) else None


def checked_dw(
    problem: LCP, d: ExactVector, foot: tuple[ExactVector, Surd], step: tuple[ExactVector, Surd]
) -> ExactVector:
    """Dw = M dz + d dz0 along the ray z + t dz, z0 + t dz0 of w = M z + q + d z0.

    `VerificationError` unless z0 > 0 and z, w and all changes are >= 0, not all changes zero, and
    z + t dz and w + t dw are complementary for all t >= 0.
    """
    (z, z0), (dz, dz0) = foot, step
    w = combination([(ONE, problem.w(z)), (z0, d)])
    dw = combination([(ONE, problem.times(dz)), (dz0, d)])
    right = (
        all(_complementary(x, y) for x in (z, dz) for y in (w, dw))
        and z0.sign() > 0
        and dz0.sign() >= 0
        and any([*dz.signs(), dz0.sign()])
    )
    if not right:
        raise VerificationError("the ray that Lemke's method ended on is none")
    return dw


def _complementary(x: ExactVector, y: ExactVector) -> bool:
    """Whether x >= 0, y >= 0 and x . y = 0."""
    return all(a >= 0 <= b and a * b == 0 for a, b in zip(x.signs(), y.signs(), strict=True))


def is_certificate(problem: LCP, y: Sequence[Fraction]) -> bool:
    """Whether y >= 0, M^T y <= 0 and q . y < 0, exactly: then the LCP has no feasible point."""
    if len(y) != len(problem) or min(y, default=Fraction(0)) < 0:
        return False
    if max(problem.transpose_times(exact_vector(y)).signs(), default=0) > 0:
        return False
    return sum((problem.q[i] * x for i, x in enumerate(y) if x), Surd(())).sign() < 0
