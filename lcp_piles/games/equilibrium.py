"""What a Nash equilibrium of a game of two players is, and the check of it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq, fmpq_mat

from ..errors import VerificationError
from ..numbers.rational_matrix import fractions


@dataclass(frozen=True, repr=False)
class Equilibrium:
    """Mixed strategies of both players, each a best response to the other.

    Attributes
    ----------
    x : tuple of Fraction, shape (m,)
        The probabilities of the rows.
    y : tuple of Fraction, shape (n,)
        The probabilities of the columns.
    payoffs : tuple of Fraction, shape (2,)
        What the players expect: x . A y and x . B y.

    Examples
    --------
    >>> from lcp_piles import nash
    >>> nash([[1, -1], [-1, 1]], [[-1, 1], [1, -1]]).x
    (Fraction(1, 2), Fraction(1, 2))
    """

    x: tuple[Fraction, ...]
    y: tuple[Fraction, ...]
    payoffs: tuple[Fraction, Fraction]

    def __repr__(self) -> str:
        of_rows, of_columns = (
            [i for i, share in enumerate(shares) if share] for shares in (self.x, self.y)
        )
        return f"<Equilibrium of rows {of_rows} and columns {of_columns}>"


def equilibrium(A: fmpq_mat, B: fmpq_mat, x: fmpq_mat, y: fmpq_mat) -> Equilibrium:
    """The equilibrium of these strategies (columns), checked from the payoffs alone.

    `VerificationError` unless both are probabilities and nobody gains by any other strategy.
    """
    value_of_rows = _value(x, A * y)
    value_of_columns = _value(y, B.transpose() * x)
    if value_of_rows is None or value_of_columns is None:
        raise VerificationError("the strategies are not best responses to each other")
    payoffs = fractions(fmpq_mat(2, 1, [value_of_rows, value_of_columns]))
    return Equilibrium(fractions(x), fractions(y), (payoffs[0], payoffs[1]))


def _value(shares: fmpq_mat, payoffs: fmpq_mat) -> fmpq | None:
    """What the shares earn, if they are probabilities on strategies that earn the most."""
    parts, earned = shares.entries(), payoffs.entries()
    if min(parts) < 0 or sum(parts, fmpq(0)) != 1:
        return None
    most = max(earned)
    best = all(x == 0 or gain == most for x, gain in zip(parts, earned, strict=True))
    return most if best else None
