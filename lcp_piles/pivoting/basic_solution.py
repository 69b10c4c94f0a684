"""The exact solution of an LCP that a complementary basis is."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpz

from ..linear.integer_matrix import integer_matrix
from ..linear.sparse_exact import ExactSolver
from ..numbers.vectors import ExactVector
from .lcp import LCP
from .rows import common_multiple


def basic_z(problem: LCP, basic: Sequence[int]) -> ExactVector:
    """The z that is zero outside `basic` and whose w is zero there.

    Signs are not looked at. Raises `SolveError` where that principal submatrix is singular.

    >>> from lcp_piles import lcp
    >>> [str(x) for x in basic_z(lcp([[2, 1], [1, 2]], [-5, -6]), [1])]
    ['0', '3']
    """
    if problem.basic is not None:
        return problem.basic(basic)
    q, rows = problem.q.plain(), list(basic)
    if problem.rows is not None:
        part = problem.rows.part(rows)
        A, sides, scales = part.A, part.denominators, (fmpz(1),) * len(rows)
    else:
        columns = [problem.column(j) for j in rows]
        A = integer_matrix([[numbers[i] for numbers, _ in columns] for i in rows])
        sides, scales = (fmpz(1),) * len(rows), tuple(den for _, den in columns)
    rights = [[-x[i] * s for i, s in zip(rows, sides, strict=True)] for x in q.numerators.values()]
    solutions = ExactSolver(A).solve_many(rights)
    common = common_multiple(den for _, den in solutions)
    numerators = {}
    for r, (found, den) in zip(q.numerators, solutions, strict=True):
        z = [fmpz(0)] * len(problem)
        for j, x, scale in zip(rows, found, scales, strict=True):
            z[j] = x * (scale * (common // den))
        numerators[r] = z
    return ExactVector(numerators, common * q.denominator)
