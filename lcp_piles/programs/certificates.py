"""What proves each end of a linear programme, checked from the data alone.

    minimise c . x  subject to  A x = b, x >= 0

* optimal: x feasible and y with c - A^T y >= 0 and b . y = c . x (weak duality: no feasible point
  has less than b . y);
* infeasible: y with A^T y <= 0 and b . y > 0 (Farkas: 0 >= y . A x = y . b > 0 for any x >= 0);
* unbounded: x feasible, and a ray d >= 0 with A d = 0 and c . d < 0.

Nothing of how they were found is used here.
"""

from __future__ import annotations

from collections.abc import Iterator

from flint import fmpz

from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector
from .constraints import Constraints
from .roots import Number, dot, less, sign, times


def is_feasible(problem: Constraints, x: ExactVector) -> bool:
    """Whether A x = b and x >= 0."""
    return _is_image(problem, x, problem.b)


def is_optimal(problem: Constraints, c: ExactVector, x: ExactVector, y: ExactVector) -> bool:
    """Whether x is feasible and y proves that no feasible point has less than c . x."""
    if not (is_feasible(problem, x) and _lies_below(problem, y, c)):
        return False
    one, below = inner(c, x)
    two, above = inner(problem.b, y)
    return sign(less(_scaled(one, above), _scaled(two, below))) == 0


def is_farkas(problem: Constraints, y: ExactVector) -> bool:
    """Whether y proves that there is no feasible point."""
    nothing = ExactVector({1: [fmpz(0)] * len(problem.columns)}, fmpz(1))
    return _lies_below(problem, y, nothing) and sign(inner(problem.b, y)[0]) > 0


def is_ray(problem: Constraints, c: ExactVector, d: ExactVector) -> bool:
    """Whether the objective falls without end along d from any feasible point."""
    nothing = ExactVector({1: [fmpz(0)] * len(problem.b)}, fmpz(1))
    return _is_image(problem, d, nothing) and sign(inner(c, d)[0]) < 0


def inner(one: ExactVector, two: ExactVector) -> tuple[dict[int, fmpz], fmpz]:
    """The product of two vectors: a number and its positive denominator."""
    one, two = one.plain(), two.plain()
    total: dict[int, fmpz] = {}
    for r, xs in one.numerators.items():
        for s, ys in two.numerators.items():
            part = sum((x * y for x, y in zip(xs, ys, strict=True) if x != 0 and y != 0), fmpz(0))
            for root, value in times({r: part}, {s: fmpz(1)}).items():
                total[root] = total.get(root, fmpz(0)) + value
    return total, one.denominator * two.denominator


def _is_image(problem: Constraints, x: ExactVector, b: ExactVector) -> bool:
    """Whether A x = b and x >= 0."""
    if len(x) != len(problem.columns) or min(x.signs(), default=0) < 0:
        return False
    x, b = x.plain(), b.plain()
    left: dict[int, list[fmpz]] = {}
    for j, column in enumerate(problem.columns):
        own = {s: v[j] for s, v in x.numerators.items() if v[j] != 0}
        for i, q, a in column if own else ():
            for s, value in own.items():
                g, r = root_product(q, s)
                if r not in left:
                    left[r] = [fmpz(0)] * len(problem.b)
                left[r][i] += value * (a * g)
    # Rows of the columns are multiples of those of A: b is multiplied here.
    for i, multiple in enumerate(problem.multiples):
        given = {r: v[i] * (multiple * x.denominator) for r, v in b.numerators.items()}
        found = {r: v[i] * b.denominator for r, v in left.items()}
        if any(value != 0 for value in less(found, given).values()):
            return False
    return True


def _lies_below(problem: Constraints, y: ExactVector, c: ExactVector) -> bool:
    """Whether A^T y <= c."""
    if len(y) != len(problem.b) or len(c) != len(problem.columns):
        return False
    return all(s <= 0 for s in _slopes(problem, y, c))


def slopes(problem: Constraints, y: ExactVector) -> list[int]:
    """The signs of A^T y."""
    nothing = ExactVector({1: [fmpz(0)] * len(problem.columns)}, fmpz(1))
    return list(_slopes(problem, y, nothing))


def _slopes(problem: Constraints, y: ExactVector, c: ExactVector) -> Iterator[int]:
    """The signs of A^T y - c, column by column."""
    y, c = y.plain(), c.plain()
    # y of a multiplied row is y over the multiple.
    common = fmpz(1)
    for multiple in set(problem.multiples):
        common = common.lcm(multiple)
    ups = [common // multiple for multiple in problem.multiples]
    shared = {
        r: [x * up if x != 0 and up != 1 else x for x, up in zip(v, ups, strict=True)]
        for r, v in y.numerators.items()
    }
    bottom = y.denominator * common
    for j, column in enumerate(problem.columns):
        own = {r: v[j] * bottom for r, v in c.numerators.items() if v[j] != 0}
        yield sign(less(_scaled(dot(column, shared), c.denominator), own))


def _scaled(number: Number, factor: fmpz) -> dict[int, fmpz]:
    return {r: x * factor for r, x in number.items()}
