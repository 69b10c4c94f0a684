"""What states of the contacts admit in first loading, exactly."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpz

from ..linear.sparse_exact import SingularError
from ..numbers.vectors import ExactVector
from ..programs.certificates import is_feasible
from ..programs.field_solver import FieldSolver
from ..programs.linear_program import minimise
from .loading import LoadingProblem, State


def point_of(problem: LoadingProblem, states: Sequence[State]) -> ExactVector | None:
    """A point of the states, checked; None where there is none.

    States mostly leave as many unknowns as there are equations. Where those are singular, as with
    discs that nothing holds, a linear programme decides.
    """
    try:
        x = solved(problem, states)
    except SingularError:
        return admitted(problem, states)
    return x if is_feasible(problem.constraints, x) else None


def admitted(problem: LoadingProblem, states: Sequence[State | None]) -> ExactVector | None:
    """A point where contacts without a state are in any or in none; None where proved absent."""
    columns = problem.columns(states)
    nothing = ExactVector({1: [fmpz(0)] * len(columns)}, fmpz(1))
    found = minimise(problem.constraints.of(columns), nothing).x
    return None if found is None else spread(found, columns, len(problem.constraints.columns))


def spread(x: ExactVector, columns: Sequence[int], size: int) -> ExactVector:
    """A vector over all columns from one over some, the others being zero."""
    plain = x.plain()
    numerators = {}
    for r, values in plain.numerators.items():
        numerators[r] = [fmpz(0)] * size
        for j, value in zip(columns, values, strict=True):
            numerators[r][j] = value
    return ExactVector(numerators, plain.denominator)


def solved(problem: LoadingProblem, states: Sequence[State]) -> ExactVector:
    """The only point of the states, whose signs need not be right."""
    scaled, opposite = problem.constraints.scaled, {j: j + 1 for j in problem.motions}
    basis: list[int] = []
    for state, choice in zip(states, problem.choices, strict=True):
        own = choice[state]
        basis += own[:2]
        if len(own) > 2:  # the slips of an open contact: one of them, of either sign
            opposite[own[1]] = own[2]
    basis += problem.motions
    x = FieldSolver([scaled.expanded[j] for j in basis], scaled.group).solve(scaled.b)
    signs = x.signs()
    columns = [opposite.get(j, j) if s < 0 else j for j, s in zip(basis, signs, strict=True)]
    flips = [-1 if j != k else 1 for j, k in zip(basis, columns, strict=True)]
    positive = x.take(range(len(basis)), flips)
    return problem.constraints.given_point(spread(positive, columns, len(scaled.columns)))
