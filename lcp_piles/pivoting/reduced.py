"""A table of integers over one denominator in lowest terms."""

from __future__ import annotations

from random import Random

from flint import fmpz, fmpz_mat

from ..numbers.vectors import content


def reduced(table: list[list[fmpz]], den: fmpz) -> tuple[fmpz_mat, fmpz]:
    """The same fractions over the smallest common denominator.

    The common divisor of thousands of entries is guessed from a random positive combination of
    the rows and then proved: were any entry not divisible, the rest left over by the division
    would be positive in some column of the combination, because no weight is zero.
    """
    if not table or not table[0]:
        return fmpz_mat(len(table), len(table[0]) if table else 0), fmpz(1)
    rows, columns = len(table), len(table[0])
    if den < 0:
        table, den = [[-x for x in row] for row in table], -den
    random = Random(0)
    weights = fmpz_mat(1, rows, [random.randrange(1, 1 << 30) for _ in range(rows)])
    mixed = (weights * fmpz_mat(rows, columns, [x for row in table for x in row])).entries()
    common = content(mixed, den)
    numbers = fmpz_mat(rows, columns, [x // common for row in table for x in row])
    if any(x * common != y for x, y in zip((weights * numbers).entries(), mixed, strict=True)):
        common = den
        for row in table:
            common = content(row, common)
        numbers = fmpz_mat(rows, columns, [x // common for row in table for x in row])
    return numbers, den // common
