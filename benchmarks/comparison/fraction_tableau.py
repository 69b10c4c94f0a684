"""The textbook: Lemke's method on a dense tableau whose every entry is a fraction of its own.

The baseline for exact arithmetic, written as plainly as the books have it and sharing nothing with
`lcp_piles.lemke`: w - M z - d z0 = q, the lexicographic rule on the columns of the first basis.
(Cottle, Pang and Stone 1992, algorithm 4.4.5.)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any


def lemke_tableau(
    M: Sequence[Sequence[Fraction]],
    q: Sequence[Fraction],
    number: Callable[[int, int], Any] = Fraction,
) -> tuple[list[Any], int] | None:
    """(z, pivots) with w = M z + q, z >= 0, w >= 0, z . w = 0; None on a secondary ray.

    `number` makes an entry of numerator and denominator: `Fraction`, or `gmpy2.mpq`.

    >>> z, pivots = lemke_tableau([[2, 1], [1, 2]], [-5, -6])
    >>> z, pivots
    ([Fraction(4, 3), Fraction(7, 3)], 3)
    """
    n = len(q)
    zero, one = number(0, 1), number(1, 1)

    def entry(x: Any) -> Any:
        exact = Fraction(x)
        return number(exact.numerator, exact.denominator)

    # Columns: w (n), z (n), z0, q. Row i belongs to the basic variable basis[i].
    rows = []
    for i in range(n):
        unit = [one if i == j else zero for j in range(n)]
        rows.append([*unit, *(-entry(x) for x in M[i]), -one, entry(q[i])])
    basis = list(range(n))
    if all(row[-1] >= 0 for row in rows):
        return [zero] * n, 0

    def lexicographic(i: int, column: int) -> list[Any]:
        return [rows[i][-1] / rows[i][column], *(x / rows[i][column] for x in rows[i][:n])]

    entering = 2 * n
    # z0 lifts all w together: the row with the least (q, e_i), lexicographically, leaves.
    leaving = min(range(n), key=lambda i: [rows[i][-1], *rows[i][:n]])
    pivots = 0
    while True:
        _pivot(rows, leaving, entering)
        left, basis[leaving] = basis[leaving], entering
        pivots += 1
        if left == 2 * n:
            z = [zero] * n
            for row, variable in zip(rows, basis, strict=True):
                if n <= variable < 2 * n:
                    z[variable - n] = row[-1]
            return z, pivots
        entering = left + n if left < n else left - n
        able = [i for i in range(n) if rows[i][entering] > 0]
        if not able:
            return None
        least = min(rows[i][-1] / rows[i][entering] for i in able)
        able = [i for i in able if rows[i][-1] / rows[i][entering] == least]
        z0 = [i for i in able if basis[i] == 2 * n]
        leaving = z0[0] if z0 else min(able, key=lambda i: lexicographic(i, entering))


def _pivot(rows: list[list[Any]], r: int, c: int) -> None:
    head = rows[r][c]
    rows[r] = [x / head for x in rows[r]]
    line = [(k, x) for k, x in enumerate(rows[r]) if x]
    for i, row in enumerate(rows):
        factor = row[c]
        if i != r and factor:
            for k, x in line:
                row[k] -= factor * x
