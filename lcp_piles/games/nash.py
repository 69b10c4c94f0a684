"""Equilibria of games of two players, by the paths of Lemke and Howson.

With payoffs made positive, let z = (x, y) and

    w = 1 - [0 A; B^T 0] z,    z, w >= 0,    z . w = 0.

Solutions other than z = 0 are the equilibria, x and y up to their sums. From z = 0 a path of bases
that lack one label (where neither z_l nor w_l is zero) ends in one (Lemke and Howson 1964,
"Equilibrium points of bimatrix games", J. SIAM 12; von Stengel 2002, "Computing equilibria for
two-person games", Handbook of Game Theory 3). Floating point walks it first and proposes which
strategies are used; one exact solve a player gives their shares. Where that is no equilibrium,
exact pivots walk the path under the lexicographic rule, which never repeats a basis.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import index
from typing import Any, SupportsIndex

import numpy as np
from flint import fmpq, fmpq_mat, fmpz, fmpz_mat

from ..errors import InputError, VerificationError
from ..linear.threads import one_thread
from ..numbers.floats import FloatArray
from ..numbers.rational_matrix import rational_matrix
from ..numbers.vectors import Mask, exact_vector
from ..pivoting.lcp import LCP, IntegerColumn
from ..pivoting.tableau import Tableau
from .equilibrium import Equilibrium, equilibrium
from .float_path import FloatPath, float_path

Progress = Callable[[int], None]


def nash(
    A: Any, B: Any, *, label: SupportsIndex | None = None, progress: Progress | None = None
) -> Equilibrium:
    """One Nash equilibrium of a game of two players, exactly, checked from the payoffs.

    Different labels may lead to different equilibria.

    Parameters
    ----------
    A : matrix of exact rationals, shape (m, n)
        The payoffs of the row player, in nested lists or a matrix.
    B : matrix of exact rationals, shape (m, n)
        The payoffs of the column player.
    label : int, optional
        Where the path of Lemke and Howson starts: l < m for row l, m + j for column j. Without it
        one from which the path is short, since some are exponentially long.
    progress : callable, optional
        Called with the number of pivots on the present path after each.

    Returns
    -------
    Equilibrium
        The strategies and payoffs of both.

    Raises
    ------
    InputError
        For other data, floats among them, and a label that is none.

    References
    ----------
    Lemke and Howson, "Equilibrium points of bimatrix games", J. SIAM 12 (1964) 413.

    Examples
    --------
    >>> game = nash([[3, 0], [0, 2]], [[2, 0], [0, 3]], label=1)
    >>> game.x, game.payoffs
    ((Fraction(0, 1), Fraction(1, 1)), (Fraction(2, 1), Fraction(3, 1)))
    """
    game = _game(A, B)
    if label is None:
        return _from_any(game, progress)
    try:
        start = index(label)
    except TypeError:
        start = -1
    if isinstance(label, bool) or not 0 <= start < game.labels:
        raise InputError("label", label, f"a whole number from 0 to {game.labels - 1}")
    return _from_label(game, start, progress)


def nash_equilibria(A: Any, B: Any, *, progress: Progress | None = None) -> tuple[Equilibrium, ...]:
    """The different equilibria that the paths from every label lead to; see `nash`.

    A game may have more that no path from z = 0 leads to.

    Parameters
    ----------
    A : matrix of exact rationals, shape (m, n)
        The payoffs of the row player.
    B : matrix of exact rationals, shape (m, n)
        The payoffs of the column player.
    progress : callable, optional
        Called with the number of labels done after each.

    Returns
    -------
    tuple of Equilibrium
        At least one.

    Raises
    ------
    InputError
        For other data, floats among them.

    Examples
    --------
    >>> nash_equilibria([[3, 0], [0, 2]], [[2, 0], [0, 3]])
    (<Equilibrium of rows [0] and columns [0]>, <Equilibrium of rows [1] and columns [1]>)
    """
    game = _game(A, B)
    found: dict[Equilibrium, None] = {}
    for label in range(game.labels):
        found[_from_label(game, label, None)] = None
        if progress is not None:
            progress(label + 1)
    return tuple(found)


@dataclass(frozen=True, eq=False)
class _Game:
    """The payoffs as given, as positive integers and as positive floats."""

    A: fmpq_mat
    B: fmpq_mat
    rows: fmpz_mat
    columns: fmpz_mat
    floats: tuple[FloatArray, FloatArray]

    @property
    def labels(self) -> int:
        """As many as both players have strategies."""
        return self.A.nrows() + self.A.ncols()


def _game(A: Any, B: Any) -> _Game:
    first, second = rational_matrix(A, "A"), rational_matrix(B, "B")
    size = (first.nrows(), first.ncols())
    if not all(size):
        raise InputError("the shape of A", size, "one strategy of each player at least")
    if (second.nrows(), second.ncols()) != size:
        raise InputError("the shape of B", (second.nrows(), second.ncols()), f"{size}, as A has")
    rows, columns = _positive(first), _positive(second)
    return _Game(first, second, rows, columns, (_floats(rows), _floats(columns)))


@one_thread()
def _from_label(game: _Game, label: int, progress: Progress | None) -> Equilibrium:
    return _ended(game, label, float_path(*game.floats, label, None, progress), progress)


@one_thread()
def _from_any(game: _Game, progress: Progress | None) -> Equilibrium:
    """From the first label whose path ends well, in rounds of growing length over all of them."""
    limit = 2 * game.labels
    unfinished = True
    while unfinished:
        unfinished = False
        for label in range(game.labels):
            path = float_path(*game.floats, label, limit, progress)
            found = None if path.supports is None else _on_supports(game, path.supports)
            if found is not None:
                return found
            unfinished |= path.unfinished
        limit *= 8
    return _ended(game, 0, FloatPath(None), progress)


def _ended(game: _Game, label: int, path: FloatPath, progress: Progress | None) -> Equilibrium:
    """The equilibrium at the end of a path: the one proposed, or that of exact pivots."""
    found = None if path.supports is None else _on_supports(game, path.supports)
    if found is None:
        found = _on_supports(game, _exact_supports(game.rows, game.columns, label, progress))
    if found is None:
        raise VerificationError("the path of Lemke and Howson ended in no equilibrium")
    return found


def _positive(payoffs: fmpq_mat) -> fmpz_mat:
    """The payoffs in integers of at least 1: their scale and origin change no equilibrium."""
    numbers, _ = payoffs.numer_denom()
    entries = numbers.entries()
    least, most = min(entries), max(entries)
    up = max(most - least, fmpz(1)) - least
    return fmpz_mat(payoffs.nrows(), payoffs.ncols(), [x + up for x in entries])


def _floats(payoffs: fmpz_mat) -> FloatArray:
    most = int(max(payoffs.entries()))
    return np.array([[int(x) / most for x in row] for row in payoffs.tolist()])


def _on_supports(game: _Game, supports: tuple[Mask, Mask]) -> Equilibrium | None:
    """The equilibrium in which the strategies of these supports earn the same; None if none is."""
    of_rows, of_columns = (np.flatnonzero(support).tolist() for support in supports)
    if len(of_rows) != len(of_columns) or not of_rows:
        return None
    k = len(of_rows)
    ones = fmpz_mat(k, 1, [1] * k)
    earned = [
        fmpz_mat(k, k, [payoffs[i, j] for i in of_rows for j in of_columns])
        for payoffs in (game.columns, game.rows)
    ]
    try:
        x = _shares(earned[0].transpose().solve(ones).entries(), of_rows, game.A.nrows())
        y = _shares(earned[1].solve(ones).entries(), of_columns, game.A.ncols())
        return equilibrium(game.A, game.B, x, y)
    except (ZeroDivisionError, VerificationError):
        return None


def _shares(weights: Sequence[fmpq], support: Sequence[int], size: int) -> fmpq_mat:
    """Probabilities in proportion to the weights on a support."""
    total = sum(weights, fmpq(0))
    shares = fmpq_mat(size, 1)
    for i, weight in zip(support, weights, strict=True):
        shares[i, 0] = weight / total
    return shares


def _exact_supports(
    rows: fmpz_mat, columns: fmpz_mat, label: int, progress: Progress | None
) -> tuple[Mask, Mask]:
    """Which strategies are basic at the end of the path, by exact pivots."""
    m, n = rows.nrows(), rows.ncols()
    size = m + n

    def column(j: int) -> IntegerColumn:
        if j < m:
            return [fmpz(0)] * m + [-columns[j, k] for k in range(n)], fmpz(1)
        return [-rows[i, j - m] for i in range(m)] + [fmpz(0)] * n, fmpz(1)

    table = Tableau(LCP(exact_vector([1] * size), column), [0] * size)
    entering, pivots = size + label, 0
    while True:
        direction = table.direction(entering)
        leaving = table.blocking(direction)
        if leaving is None:
            raise VerificationError("the path of Lemke and Howson ended on a ray")
        table.pivot(entering, leaving, direction)
        pivots += 1
        if progress is not None:
            progress(pivots)
        if leaving in (label, size + label):
            used = np.array(table.is_basic[size : 2 * size], dtype=bool)
            return used[:m], used[m:]
        entering = table.complement(leaving)
