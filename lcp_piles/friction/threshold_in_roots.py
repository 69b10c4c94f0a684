"""The least friction where it is a number of the field of the normals, proved at any size of pile.

Ends that are near each other show a candidate alpha = p + q sqrt(r): a short vector of a lattice.
Linear programmes at mu = alpha itself then prove it:

* there is a network at alpha: the pile stands;
* a network with less friction is one at alpha, and has |f_t| < alpha f_n wherever it has a force,
  so that both columns n +- alpha t of the contact are positive. Columns that are zero in all
  networks at alpha (`affine_hull`) so leave their contacts without force. Without these contacts
  there is no network even at alpha, or the same is said again of those that are left.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import isqrt, lcm
from typing import Any

from flint import fmpz_mat

from ..numbers.exact import ZERO, Surd, sqrt_of
from ..programs.affine_hull import AffineHull, affine_hull
from ..programs.roots import group_of
from ..scenes.scene import Scene
from .algebraic import AlgebraicNumber
from .equations import FrictionProblem, friction_problem

_LARGEST = 10**4  # numerator or denominator of a candidate, which is a guess


def threshold_in_roots(scene: Scene, lower: Fraction, upper: Fraction) -> Surd | None:
    """The least friction in (lower, upper], supports being rough; None where not recognised.

    >>> from lcp_piles import nt60
    >>> from .critical_friction import free_standing
    >>> scene = free_standing(nt60(2))
    >>> str(threshold_in_roots(scene, Fraction(267949, 10**6), Fraction(26795, 10**5)))
    '2 - sqrt(3)'
    """
    alpha = _candidate(scene, lower, upper)
    return alpha if alpha is not None and is_least(scene, alpha) else None


def as_algebraic(alpha: Surd, lower: Fraction, upper: Fraction) -> AlgebraicNumber:
    """A number p + q sqrt(r) between two ends as the root of its polynomial."""
    parts = dict(alpha.terms)
    p = parts.pop(1, Fraction(0))
    powers = [-p, Fraction(1)]
    for r, q in parts.items():
        powers = [p * p - q * q * r, -2 * p, Fraction(1)]
    common = lcm(*(x.denominator for x in powers))
    return AlgebraicNumber(tuple(int(x * common) for x in powers), lower, upper)


def _candidate(scene: Scene, lower: Fraction, upper: Fraction) -> Surd | None:
    """A number p + q sqrt(r) of few digits between the ends, r a radicand of the normals."""
    radicands = {r for normal in scene.normals[0] for x in normal for r, _ in x.terms}
    middle, scale = (lower + upper) / 2, int(1 / (upper - lower))
    for r in group_of(radicands)[1:] or (1,):
        root = isqrt(r * scale * scale)
        lattice: Any = fmpz_mat([[1, 0, 0, int(middle * scale)], [0, 1, 0, scale], [0, 0, 1, root]])
        a, p, q, _ = (int(x) for x in lattice.lll().entries()[:4])
        if a == 0 or max(abs(a), abs(p), abs(q)) > _LARGEST:
            continue
        alpha = ZERO + Fraction(-p, a) + Fraction(-q, a) * sqrt_of(r)
        if lower < alpha <= upper:
            return alpha
    return None


def is_least(scene: Scene, alpha: Surd) -> bool:
    """Whether the scene stands with friction alpha, and with no less."""
    problem, hull = _hull(scene, alpha)
    if hull is None:
        return False
    while hull is not None:
        zero = set(hull.zero)
        ends = zip(problem.scene.contacts, problem.plus, problem.minus, strict=True)
        left = tuple(contact for contact, *columns in ends if not zero & set(columns))
        if len(left) == len(problem.scene.contacts):
            return False
        problem, hull = _hull(replace(problem.scene, contacts=left), alpha)
    return True


def _hull(scene: Scene, mu: Surd) -> tuple[FrictionProblem, AffineHull | None]:
    problem = friction_problem(scene, mu, scene.supports)
    return problem, affine_hull(problem.constraints)
