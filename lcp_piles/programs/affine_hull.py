"""The affine hull of {x : A x = b, x >= 0}, exactly: which columns are always zero, what is left.

One linear programme finds a point with as many positive columns as there can be (Freund, Roundy and
Todd 1985, "Identifying the set of always-active constraints in a system of linear inequalities by a
single linear program", MIT working paper 1674):

    maximise sum p    subject to    A (p + q) = t b,   0 <= p <= 1,   q >= 0,   t >= 1,

where (p + q) / t is such a point and p is 1 on its support. The multipliers y of its dual have
A^T y >= 0, more than zero off the support, and b . y = 0: so y . A x = 0 makes those columns zero
in all points. What is left is the kernel of A over the support.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpz

from ..errors import VerificationError
from ..linear.integer_matrix import from_triplets
from ..linear.kernel import kernel
from ..numbers.exact import ONE
from ..numbers.vectors import ExactVector, combination
from .certificates import inner, is_feasible, slopes
from .constraints import Constraints, StandardForm
from .linear_program import minimise
from .proposal import Proposer
from .roots import sign
from .simplex import simplex


@dataclass(frozen=True, eq=False)
class AffineHull:
    """The affine hull of the feasible points.

    `point` is positive in every column that is positive anywhere; `multipliers` prove that those
    of `zero` vanish in all points. `dimension` is that of the set; column j has the same value in
    all points unless `varies[j]`.
    """

    point: ExactVector
    zero: tuple[int, ...]
    multipliers: ExactVector
    dimension: int
    varies: tuple[bool, ...]


def affine_hull(problem: Constraints) -> AffineHull | None:
    """The affine hull of {x : A x = b, x >= 0}, proved; None where the set is empty, proved too.

    >>> from .constraints import constraints
    >>> hull = affine_hull(constraints([[1, 1, 1, 1], [0, 0, 1, 1]], [1, 0]))
    >>> hull.dimension, hull.zero, hull.varies
    (1, (2, 3), (True, True, False, False))
    """
    scaled = problem.scaled
    m, n = scaled.rows, len(scaled.columns)
    nothing = ExactVector({1: [fmpz(0)] * n}, fmpz(1))
    if minimise(problem, nothing).status == "infeasible":
        return None
    wide = _wide(scaled)
    fewest = ExactVector({1: [fmpz(-1)] * n + [fmpz(0)] * (2 * n + 1)}, fmpz(1))
    end = simplex(wide, fewest, Proposer(wide).propose(fewest).basis)
    assert end.x is not None
    assert end.y is not None  # feasible, and no p is above 1
    both = combination([(ONE, _part(end.x, 0, n, 1)), (ONE, _part(end.x, n, 2 * n, 1))])
    t = 1 + int(scaled.b.denominator) * end.x[2 * n]
    point = problem.given_point(combination([(1 / t, both)]))
    multipliers = problem.given_multipliers(_part(end.y, 0, m, -1))
    zero = tuple(j for j, s in enumerate(both.signs()) if s == 0)
    if not _is_proved(problem, point, zero, multipliers):
        raise VerificationError("the proof that columns are always zero does not hold")
    support = sorted(set(range(n)) - set(zero))
    dimension, moving = directions(scaled, support)
    return AffineHull(point, zero, multipliers, dimension, tuple(j in moving for j in range(n)))


def _wide(problem: StandardForm) -> StandardForm:
    """The programme that finds the support, with the columns p, q, (t - 1) / d, and idle ones.

    d is the denominator of b, and the idle columns are those of p <= 1.
    """
    m, n = problem.rows, len(problem.columns)
    b = problem.b.plain()
    bounded = [(*column, (m + j, 1, 1)) for j, column in enumerate(problem.columns)]
    loads = [
        (i, r, -int(x)) for r, values in b.numerators.items() for i, x in enumerate(values) if x
    ]
    idle = [((m + j, 1, 1),) for j in range(n)]
    right = {r: [*values, *[fmpz(0)] * n] for r, values in b.numerators.items()}
    right[1][m:] = [b.denominator] * n
    columns = [*bounded, *problem.columns, tuple(loads), *idle]
    return StandardForm(columns, ExactVector(right, b.denominator))


def _part(vector: ExactVector, start: int, end: int, sign: int) -> ExactVector:
    return vector.take(range(start, end), [sign] * (end - start))


def _is_proved(
    problem: Constraints, point: ExactVector, zero: Sequence[int], multipliers: ExactVector
) -> bool:
    """Whether the point is feasible, and the multipliers make these columns zero in all points."""
    off = set(zero)
    signs = slopes(problem, multipliers)
    return (
        is_feasible(problem, point)
        and all(s > 0 if j in off else s == 0 for j, s in enumerate(signs))
        and sign(inner(problem.b, multipliers)[0]) == 0
    )


def directions(problem: StandardForm, columns: Sequence[int]) -> tuple[int, set[int]]:
    """The dimension of the kernel of some columns, and which of them it moves."""
    count, blocks = len(columns), len(problem.group)
    rows, places, values = [], [], []
    for k, j in enumerate(columns):
        expanded = problem.expanded[j]
        for block in range(blocks):
            rows += expanded.rows[block].tolist()
            places += [block * count + k] * len(expanded.rows[block])
            values += expanded.values[block].tolist()
    shape = (problem.rows * blocks, count * blocks)
    basis, _ = kernel(from_triplets(shape, rows, places, values))
    moving = {columns[k % count] for vector in basis for k, x in enumerate(vector) if x != 0}
    return len(basis) // blocks, moving
