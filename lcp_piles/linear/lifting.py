"""The lifting of Wan (2006): digits of A^-1 b from factors of A in floating point, exactly kept.

    x_k = round(A^-1 r_k),   r_(k+1) = 2^s (r_k - A x_k) + next digits of b,

so A^-1 b = sum_k x_k 2^(-s k), each r_k an exact integer vector. It works on vectors of int64: a
matrix whose rows sum up to less than 2^28 as it is, a larger one cut into limbs,

    A = sum_l A_l 2^(w l),   r = sum_l r_l 2^(w l),

with w so small that no product and no shift leaves int64. Rows are divided by powers of two before
they become floats; columns are only multiplied by such, beforehand, where their sizes are far
apart (`column_shifts`): the digits of all unknowns are rounded alike, so they should matter alike.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from ..numbers.floats import FloatArray
from ..numbers.vectors import IntArray
from .factors import sparse_factors
from .integer_matrix import BigMatrix, IntegerMatrix, entries

SHIFTS = (32, 24, 16, 8)
"""Bits of a step, to be tried from the first on."""
_LIMIT = 2.0**62
_SMALL_ROW = 2.0 ** (62 - 2 - SHIFTS[0])
_TINY_PIVOT = 1e-11  # noise leaves pivots of about 1e-16 where an exact one is zero
_FAR = 16  # columns are far apart where their sizes are so many bits apart
_ROUNDS = 8


class LiftingError(Exception):
    """Floating point is not good enough for this matrix at this shift."""


class Step(NamedTuple):
    """All digits so far, the residual that they leave by limbs, and how many steps b itself takes.

    `digits[k]` and `rest[l]` have a row for each unknown and a column for each right-hand side.
    """

    digits: list[IntArray]
    rest: IntArray
    length: int


@dataclass(frozen=True, eq=False)
class Lifting:
    """A matrix with its columns shifted, made ready to lift: factors, limbs and sizes of rows.

    Each row counts in a unit of its own: `units[l]` is what limb l of it then counts, `row_sums`
    are sums of |A|. `reach` is the largest row sum of a limb, and `det_bits` a bound of the bits of
    the determinant (Hadamard).
    """

    factors: Any
    limbs: list[csr_array]
    width: int
    units: list[FloatArray]
    row_sums: FloatArray
    reach: float
    det_bits: int

    def steps(self, rights: Sequence[Sequence[fmpz]], shift: int) -> Iterator[Step]:
        """The lifting of some right-hand sides together, step by step and without end."""
        feed = [_digits(b, shift) for b in rights]
        length = max(d.shape[0] for d in feed)
        n, count = len(self.row_sums), len(rights)
        padded = np.zeros((length, n, count), dtype=np.int64)
        for c, d in enumerate(feed):
            padded[length - d.shape[0] :, :, c] = d
        bound = 0.75 * self.row_sums[:, None] + self.units[0]
        digits: list[IntArray] = []
        residual = np.zeros((len(self.limbs), n, count), dtype=np.int64)
        near = np.zeros((n, count))  # the residual in floats
        while True:
            if len(digits) < length:
                residual[0] += padded[len(digits)]
                near = near + padded[len(digits)] * self.units[0]
            with np.errstate(all="ignore"):
                x = np.rint(self.factors.solve(near))
            largest = float(np.abs(x).max())
            # The products A_l x have to fit int64; a digit of the solution has about `shift` bits,
            # more only in the first steps, where the digits of b come in.
            if not np.isfinite(largest) or largest * self.reach > _LIMIT / 2:
                raise LiftingError
            whole = x.astype(np.int64)
            for limb, part in zip(self.limbs, residual, strict=True):
                part -= limb @ whole
            self._carry(residual)
            # |rest| <= |A| (1/2 + error): more means that the factors do not invert A. Within this
            # bound the limbs are below 2^29, so that the shift stays within int64.
            near = self._floats(residual)
            if not (np.abs(near) <= bound).all():
                raise LiftingError
            digits.append(whole)
            yield Step(digits, residual, length)
            residual = residual << shift
            near *= 2.0**shift

    def _floats(self, residual: IntArray) -> FloatArray:
        """The residual, each row in its unit."""
        total: FloatArray = residual[0] * self.units[0]
        for part, unit in zip(residual[1:], self.units[1:], strict=True):
            total += part * unit
        return total

    def _carry(self, residual: IntArray) -> None:
        """Make all limbs but the last one short, so that zero is all zeros."""
        for k in range(len(residual) - 1):
            over = (residual[k] + (1 << (self.width - 1))) >> self.width
            residual[k] -= over << self.width
            residual[k + 1] += over


def lifting(A: IntegerMatrix, columns: IntArray, *, symmetric: bool) -> Lifting | None:
    """A with column j times 2^columns[j], ready to lift; None where it is singular in floats."""
    n = A.shape[0]
    rows = np.repeat(np.arange(n), np.diff(A.indptr))
    mantissas, exponents = _float_entries(A)
    exponents = exponents + columns[A.indices]
    row_bits = np.zeros(n, dtype=np.int64)
    np.maximum.at(row_bits, rows, exponents)
    scaled = np.ldexp(mantissas, exponents - row_bits[rows])
    row_sums: FloatArray = np.bincount(rows, np.abs(scaled), n).astype(np.float64)
    try:
        matrix = csr_array((scaled, A.indices, A.indptr), shape=A.shape)
        factors = sparse_factors(matrix, symmetric=symmetric)
    except RuntimeError:  # exactly singular in floating point
        return None
    pivots = np.abs(factors.U.diagonal())
    if not pivots.min() >= _TINY_PIVOT * pivots.max():  # singular, or too close to tell
        return None
    largest = float(np.ldexp(row_sums, np.minimum(row_bits, 900)).max())
    width, parts = _parts(A, columns[A.indices], largest)
    limbs = [csr_array((part, A.indices, A.indptr), shape=A.shape) for part in parts]
    reach = max(float(abs(limb).sum(axis=1).max()) for limb in limbs)
    sizes = np.zeros(n, dtype=np.int64)
    np.maximum.at(sizes, A.indices, exponents)
    filled = np.bincount(A.indices, minlength=n)
    det_bits = int((sizes + np.log2(np.maximum(filled, 1)) / 2).sum()) + 1
    # Limbs that a short row does not have are zero: their unit only has to be finite.
    bits = [np.minimum(width * k - row_bits, 900) for k in range(len(limbs))]
    units = [np.ldexp(1.0, each)[:, None] for each in bits]
    return Lifting(factors, limbs, width, units, row_sums, reach * (1 + 1e-9), det_bits)


def column_shifts(A: IntegerMatrix) -> IntArray:
    """Shifts, multiples of 16 bits, that bring columns of very different sizes together.

    Rows and columns are divided in turn by the roots of their largest entries, which tends to a
    matrix with largest entries of one everywhere (Ruiz 2001); the shifts are what the columns are
    divided by least, rounded.
    """
    n = A.shape[0]
    _, exponents = _float_entries(A)
    if not len(exponents) or exponents.max() - exponents.min() < _FAR:
        return np.zeros(n, dtype=np.int64)
    row_of = np.repeat(np.arange(n), np.diff(A.indptr))
    rows, columns = np.zeros(n), np.zeros(n)
    for _ in range(_ROUNDS):
        sizes = exponents + rows[row_of] + columns[A.indices]
        for part, places in ((rows, row_of), (columns, A.indices)):
            largest = np.full(n, -np.inf)
            np.maximum.at(largest, places, sizes)
            part -= np.where(np.isfinite(largest), largest, 0.0) / 2
    shifts: IntArray = ((columns - columns.min()) // _FAR * _FAR).astype(np.int64)
    return shifts


def _float_entries(A: IntegerMatrix) -> tuple[FloatArray, IntArray]:
    """(m, e) with m 2^e the entries of A, 1/2 <= |m| <= 1."""
    if not isinstance(A, BigMatrix):
        mantissas, exponents = np.frexp(A.data.astype(np.float64))
        return mantissas, exponents.astype(np.int64)
    bits = np.array([int(x.bit_length()) for x in A.data], dtype=np.int64)
    over = np.maximum(bits - 62, 0)
    leading = [float(int(x >> s)) for x, s in zip(A.data, over.tolist(), strict=True)]
    return np.ldexp(np.array(leading), over - bits), bits


def _parts(A: IntegerMatrix, shifts: IntArray, largest_row: float) -> tuple[int, list[IntArray]]:
    """(w, the limbs of the entries times 2^shifts in base 2^w); one where rows are small."""
    if largest_row <= _SMALL_ROW and not isinstance(A, BigMatrix):
        return 0, [A.data << shifts]
    most = int(np.diff(A.indptr).max())
    width = (62 - 2 - SHIFTS[0] - most.bit_length()) // 8 * 8
    shifted = [x << s for x, s in zip(entries(A), shifts.tolist(), strict=True)]
    return width, _limbs(shifted, width)


def _limbs(numbers: Sequence[int | fmpz], width: int) -> list[IntArray]:
    """Digits of integers in base 2^width, the least first, each with the sign of its number.

    The width is a whole number of bytes, up to seven.
    """
    size = width // 8
    count = max(1, max((-(-int(x.bit_length()) // width) for x in numbers), default=1))
    # Through bytes: shifting a long integer for every digit takes the square of its length.
    packed = b"".join(abs(int(x)).to_bytes(count * size, "little") for x in numbers)
    table = np.zeros((len(numbers), count, 8), dtype=np.uint8)
    table[:, :, :size] = np.frombuffer(packed, dtype=np.uint8).reshape(len(numbers), count, size)
    signs = np.array([-1 if x < 0 else 1 for x in numbers], dtype=np.int64)
    return list(signs * table.view("<i8")[:, :, 0].astype(np.int64).T)


def _digits(b: Sequence[fmpz], shift: int) -> IntArray:
    """Digits of b in base 2^shift, most significant first, all with the sign of the entry."""
    return np.array(_limbs(b, shift)[::-1])
