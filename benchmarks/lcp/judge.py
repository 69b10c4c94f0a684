"""How right an answer in floating point is: its floats read as the exact numbers that they are."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from benchmarks.lcp.public_problems import PublicGame, PublicLCP, PublicQP, Rows

GOOD = Fraction(1, 10**6)
"""The error, relative to the data, up to which an answer counts as right."""


class NoAnswerError(Exception):
    """A solver that says itself that it has none, and how it says so."""


def lcp_error(problem: PublicLCP, z: Iterable[object]) -> Fraction:
    """The largest |min(z_i, w_i)| over the largest |q_i|."""
    point = _exactly(z, len(problem.q))
    rows = zip(problem.M, problem.q, point, strict=True)
    worst = max(abs(min(x, _dot(row, point) + b)) for row, b, x in rows)
    return worst / max(abs(b) for b in problem.q)


def game_error(problem: PublicGame, x: Iterable[object], y: Iterable[object]) -> Fraction:
    """What a player gains at most by another strategy, over the spread of the payoffs.

    Shares are made to add up to one; a negative one counts as an error itself.
    """
    rows, columns = _exactly(x, len(problem.A)), _exactly(y, len(problem.A[0]))
    if sum(rows) <= 0 or sum(columns) <= 0:
        raise NoAnswerError("no probabilities")
    rows, columns = [v / sum(rows) for v in rows], [v / sum(columns) for v in columns]
    turned = tuple(zip(*problem.B, strict=True))
    worst = max(Fraction(0), -min(rows), -min(columns))
    for payoffs, mine, others in ((problem.A, rows, columns), (turned, columns, rows)):
        gains = [_dot(row, others) for row in payoffs]
        worst = max(worst, (max(gains) - _dot(gains, mine)) / _spread(payoffs))
    return worst


def qp_error(problem: PublicQP, x: Iterable[object]) -> Fraction:
    """The largest distance from the solution, which is unique, over 1 + its largest entry."""
    right = problem.case.x
    found = _exactly(x, len(right))
    worst = max(abs(a - b) for a, b in zip(found, right, strict=True))
    return worst / (1 + max(abs(v) for v in right))


def _exactly(values: Iterable[object], size: int) -> list[Fraction]:
    try:
        exact = [Fraction(v if isinstance(v, Fraction) else float(v)) for v in values]  # type: ignore[arg-type]
    except (ValueError, OverflowError, TypeError) as error:
        raise NoAnswerError("not numbers") from error
    if len(exact) != size:
        raise NoAnswerError(f"{len(exact)} numbers for {size}")
    return exact


def _dot(one: Iterable[Fraction], two: Iterable[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(one, two, strict=True)), Fraction(0))


def _spread(payoffs: Rows) -> Fraction:
    entries = [x for row in payoffs for x in row]
    return max(entries) - min(entries) or Fraction(1)
