"""The path of Lemke and Howson in floating point: it proposes which strategies are used.

The two polytopes {y >= 0, A y <= 1} and {x >= 0, B^T x <= 1} of a game with positive payoffs have a
tableau each. Label l < m is the row strategy l: x_l in the tableau of B and the slack of row l in
that of A; label m + j is the column strategy j, likewise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..numbers.floats import FloatArray
from ..numbers.vectors import Mask

_RENEW = 50  # pivots, after which a tableau is computed anew from its basis
_SMALL = 1e-11


@dataclass(frozen=True, eq=False)
class FloatPath:
    """Where a path in floating point came to.

    `supports` are the rows and columns that are basic at its end; None where it has none: rounding
    led onto a ray or to a basis that was there before, or, with `unfinished`, a limit was reached.
    """

    supports: tuple[Mask, Mask] | None
    unfinished: bool = False


class _FloatTableau:
    """Rows of a polytope's system in terms of its basis; the last column are the values."""

    def __init__(self, system: FloatArray, basis: list[int]) -> None:
        self._system = np.hstack([system, np.ones((len(system), 1))])
        self._table = self._system.copy()
        self._basis = np.array(basis)
        self._pivots = 0
        self.is_basic = np.zeros(system.shape[1], dtype=bool)
        self.is_basic[basis] = True

    def exchange(self, entering: int, wanted: int) -> int | None:
        """Let a label enter, and the one leave that reaches zero first; of equals `wanted`."""
        column = self._table[:, entering]
        rows = np.flatnonzero(column > _SMALL)
        if not len(rows):
            return None
        ratios = np.maximum(self._table[rows, -1], 0) / column[rows]
        least = ratios.min()
        tied = rows[ratios <= least + 1e-10 * (1 + least)]
        row = tied[np.argmax(column[tied])]
        if wanted in self._basis[tied]:
            row = tied[self._basis[tied] == wanted][0]
        leaving = int(self._basis[row])
        self._basis[row] = entering
        self.is_basic[leaving], self.is_basic[entering] = False, True
        self._pivots += 1
        if self._pivots % _RENEW == 0:
            self._table = np.linalg.solve(self._system[:, self._basis], self._system)
        else:
            line = self._table[row] / column[row]
            self._table -= np.outer(column, line)
            self._table[row] = line
        return leaving


def float_path(
    A: FloatArray,
    B: FloatArray,
    label: int,
    limit: int | None,
    progress: Callable[[int], None] | None,
) -> FloatPath:
    """The path that lacks a label, for positive payoffs, up to a limit of pivots."""
    m, n = A.shape
    of_y = _FloatTableau(np.hstack([np.eye(m), A]), list(range(m)))
    of_x = _FloatTableau(np.hstack([B.T, np.eye(n)]), list(range(m, m + n)))
    mine, other = (of_x, of_y) if label < m else (of_y, of_x)
    entering = label
    seen: set[bytes] = set()
    while len(seen) != limit:
        try:
            leaving = mine.exchange(entering, label)
        except np.linalg.LinAlgError:
            leaving = None
        state = of_x.is_basic.tobytes() + of_y.is_basic.tobytes()
        if leaving is None or state in seen:
            return FloatPath(None)
        if leaving == label:
            return FloatPath((of_x.is_basic[:m], of_y.is_basic[m:]))
        seen.add(state)
        if progress is not None:
            progress(len(seen))
        mine, other, entering = other, mine, leaving
    return FloatPath(None, unfinished=True)
