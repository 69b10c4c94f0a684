"""Linear programmes, exactly: HiGHS proposes a basis, exact arithmetic proves or repairs it.

One sparse exact solve gives the point, one the dual solution; where a sign is wrong, exact pivots
go on from there (`simplex`). What is returned has been checked from the data alone
(`certificates`): a proof of optimality, of infeasibility (Farkas) or of unboundedness (a ray).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from flint import fmpz

from ..errors import InputError, VerificationError
from ..numbers.exact import Surd, surd
from ..numbers.vectors import ExactVector, exact_vector
from .certificates import inner, is_farkas, is_feasible, is_optimal, is_ray
from .constraints import Constraints, StandardForm, constraints
from .infeasible import least_violation
from .proposal import Proposal, Proposer
from .roots import number, sign
from .simplex import Progress, SimplexEnd, Status, simplex


@dataclass(frozen=True, eq=False)
class LinearProgramResult:
    """A proved end of min c . x subject to A x = b, x >= 0.

    status      value     x            y               ray
    optimal     least     attains it   dual solution   None
    infeasible  None      None         Farkas vector   None
    unbounded   None      feasible     None            direction of a fall without end

    y is optimal with c - A^T y >= 0 and b . y = c . x; Farkas with A^T y <= 0 and b . y > 0. The
    ray d has d >= 0, A d = 0, c . d < 0. `basis` is where the simplex method ended (column numbers;
    n + i for an idle row i), and `pivots` how many exact ones it took after the proposal.
    """

    status: Status
    value: Surd | None
    x: ExactVector | None
    y: ExactVector | None
    ray: ExactVector | None
    basis: tuple[int, ...]
    pivots: int


def linear_program(
    c: Sequence[Any], A: Any, b: Sequence[Any], *, progress: Progress | None = None
) -> LinearProgramResult:
    """Minimise c . x subject to A x = b, x >= 0, exactly, with a certificate that is checked.

    An inequality is an equation with a column of its own (a slack), a free variable the difference
    of two columns. Cost: one float solve, then a few sparse exact solves of size m times the degree
    of the field.

    Parameters
    ----------
    c : sequence of exact numbers, shape (n,)
        Rationals or sums of square roots (see `surd`).
    A : matrix of exact numbers, shape (m, n)
        Nested lists, a matrix of sympy or flint, an integer array of numpy or scipy.sparse, or
        `SparseSurds`. Rows may depend on each other.
    b : sequence of exact numbers, shape (m,)
        The right-hand side.
    progress : callable, optional
        Called with a line of text at each exact pivot.

    Returns
    -------
    LinearProgramResult
        The `status` ("optimal", "infeasible" or "unbounded"), `value`, `x` and what proves them.

    Raises
    ------
    InputError
        For other data.

    Examples
    --------
    >>> result = linear_program([-1, -1, 0], [[1, "sqrt(2)", 1]], [2])
    >>> result.status, result.value, [str(x) for x in result.x]
    ('optimal', Surd('-2'), ['2', '0', '0'])
    >>> linear_program([0, 0], [[1, 1]], [-1]).status
    'infeasible'
    """
    problem = constraints(A, b, len(c))
    return minimise(problem, c, progress=progress)


def minimise(
    problem: Constraints,
    c: Sequence[Any] | ExactVector,
    *,
    proposer: Proposer | None = None,
    start: Sequence[int] | None = None,
    progress: Progress | None = None,
) -> LinearProgramResult:
    """`linear_program` for constraints that were read before.

    A `proposer` of these constraints saves making one; with a `start` nothing is proposed, and the
    pivots begin at that basis.
    """
    given = c if isinstance(c, ExactVector) else exact_vector([surd(x) for x in c])
    if len(given) != len(problem.columns):
        raise InputError("the length of c", len(given), f"{len(problem.columns)}, the columns of A")
    cost = problem.scaled_cost(given)
    if start is not None:
        end = simplex(problem.scaled, cost, start, progress)
    else:
        end = _from_proposal(problem.scaled, cost, proposer or Proposer(problem.scaled), progress)
    result = _result(problem, given, end)
    if not _is_proved(problem, given, result):
        raise VerificationError(f"the certificate of the end {result.status!r} does not hold")
    return result


def _from_proposal(
    problem: StandardForm, c: ExactVector, proposer: Proposer, progress: Progress | None
) -> SimplexEnd:
    """The simplex method from where floating point ends; a ray is sought where it has no end."""
    proposal = proposer.propose(c)
    if proposal.claim != "nothing":
        return _bounded(problem, c, proposal, progress)
    nothing = ExactVector({1: [fmpz(0)] * len(problem.columns)}, fmpz(1))
    point = _bounded(problem, nothing, proposer.propose(nothing), progress)
    if point.status == "infeasible":
        return point
    ray = _steepest_ray(problem, c, progress)
    if ray is not None:
        return replace(point, status="unbounded", ray=ray, y=None)
    return simplex(problem, c, point.basis, progress)


def _bounded(
    problem: StandardForm, c: ExactVector, proposal: Proposal, progress: Progress | None
) -> SimplexEnd:
    """The simplex method from a proposed basis, or from one where violations are least."""
    if proposal.claim != "infeasible":
        return simplex(problem, c, proposal.basis, progress)
    basis, y = least_violation(problem) or (None, None)
    if basis is not None and y is not None:
        return SimplexEnd("infeasible", basis, 0, y=y)
    return simplex(problem, c, basis, progress)


def _steepest_ray(
    problem: StandardForm, c: ExactVector, progress: Progress | None
) -> ExactVector | None:
    """The direction d >= 0, A d = 0 of unit sum along which c falls most; None if none falls."""
    m = problem.rows
    columns = [(*column, (m, 1, 1)) for column in problem.columns]
    unit = ExactVector({1: [fmpz(0)] * m + [fmpz(1)]}, fmpz(1))
    cone = StandardForm(columns, unit)
    end = _bounded(cone, c, Proposer(cone).propose(c), progress)
    if end.status != "optimal" or end.x is None or sign(inner(c, end.x)[0]) >= 0:
        return None
    return end.x


def _result(problem: Constraints, c: ExactVector, end: SimplexEnd) -> LinearProgramResult:
    x = None if end.x is None else problem.given_point(end.x)
    y = None if end.y is None else problem.given_multipliers(end.y)
    ray = None if end.ray is None else problem.given_point(end.ray)
    value = None
    if end.status == "optimal" and x is not None:
        value = number(*inner(c, x))
    return LinearProgramResult(end.status, value, x, y, ray, tuple(end.basis), end.pivots)


def _is_proved(problem: Constraints, c: ExactVector, result: LinearProgramResult) -> bool:
    """Whether the certificate that belongs to the status holds."""
    x, y, ray = result.x, result.y, result.ray
    if result.status == "optimal":
        return x is not None and y is not None and is_optimal(problem, c, x, y)
    if result.status == "infeasible":
        return y is not None and is_farkas(problem, y)
    if x is None or ray is None:
        return False
    return is_feasible(problem, x) and is_ray(problem, c, ray)
