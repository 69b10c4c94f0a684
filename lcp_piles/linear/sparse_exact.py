"""Exact solution of sparse square integer systems A x = b.

Numeric-symbolic lifting (Wan 2006, "An algorithm to solve integer linear systems exactly using
numerical methods", J. Symb. Comput. 41): A is factored once in floating point, and each step
takes `shift` more bits of the solution out of the exact integer residual,

    x_k = round(A^-1 r_k),   r_(k+1) = 2^s (r_k - A x_k) + next digits of b,

so A^-1 b = sum_k x_k 2^(-s k). When enough bits are there, one common denominator is read off by
continued fractions, and A N = D b is checked in integers before anything is returned. A solution
of n unknowns has about 2 log2(det A) bits, so the cost is that many bits over s, each step one
pair of triangular solves; fraction-free elimination of the same system costs n^3 products of
numbers of log2(det A) bits.

What could go wrong, and what is done: int64 overflow (bounded beforehand from |A| and the digits,
never hoped for); a bad factorisation (digits stop shrinking: fewer bits a step, then the dense
p-adic solver of FLINT); a singular A (decided exactly there). Nothing wrong is returned: the last
check is exact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from flint import fmpz, fmpz_mat
from scipy.sparse import csc_array, csr_array

from ..errors import InputError, SolveError
from ..numbers.vectors import IntArray

SYMMETRIC: dict[str, Any] = {
    "permc_spec": "MMD_AT_PLUS_A",
    "diag_pivot_thresh": 0.0,
    "options": {"SymmetricMode": True},
}
"""SuperLU's options for a symmetric matrix that needs no pivoting."""
_SHIFTS = (32, 24, 16, 8)
_LIMIT = 2.0**62
_FIRST_TRY, _TRY_GROWTH = 3, 1.15
_SLACK = 40
_TINY_PIVOT = 1e-11  # noise leaves pivots of about 1e-16 where an exact one is zero


class SingularError(SolveError):
    """The system has no solution, or more than one: its matrix is singular."""


class _LiftingError(Exception):
    """Floating point is not good enough for this matrix at this shift."""


class _Step(NamedTuple):
    """All digits so far, the exact residual that they leave, and how many steps b itself takes."""

    digits: list[IntArray]
    rest: IntArray
    length: int


@dataclass(frozen=True, eq=False)
class Approximation:
    """x = A^-1 b to many bits: x = sum_k digits[k] 2^(shift (length - 1 - k)) + A^-1 r.

    The residual r = rest * 2^(shift (length - len(digits))) is exact.
    """

    digits: list[IntArray]
    rest: IntArray
    shift: int
    length: int


class ExactSolver:
    """Exact solver for one square integer matrix and any number of right-hand sides.

    `A` is anything scipy.sparse takes, with integer entries. The factorisation is made at the
    first `solve` and kept. `progress` is called with a line of text every two seconds.

    >>> solver = ExactSolver([[2, 1], [1, 3]])
    >>> solver.solve([1, 0])
    ([3, -1], 5)
    """

    def __init__(
        self, A: Any, *, symmetric: bool = False, progress: Callable[[str], None] | None = None
    ) -> None:
        matrix = csr_array(A)
        if matrix.shape[0] != matrix.shape[1]:
            raise InputError("the shape of A", matrix.shape, "a square matrix")
        if not np.issubdtype(matrix.dtype, np.integer):
            raise InputError("the entries of A", matrix.dtype.name, "integers")
        self.A = matrix.astype(np.int64)
        self.A.sum_duplicates()
        self._symmetric = symmetric
        self._progress = progress
        sizes = abs(self.A.astype(np.float64))
        rows = sizes.sum(axis=1)
        self._norm = float(rows.max()) * (1 + 1e-9) if rows.size else 0.0
        # Hadamard: no denominator of a solution has more bits than this.
        columns = (sizes**2).sum(axis=0)
        self._det_bits = float(np.log2(np.maximum(columns, 1.0)).sum()) / 2
        self._factors: Any = None
        self._bits = 0  # that the last solution took: the first guess for the next
        self._shifts = list(_SHIFTS)

    def solve(self, b: Sequence[int | fmpz]) -> tuple[list[fmpz], fmpz]:
        """(N, D) with A N = D b exactly and D > 0; the vector N / D is the solution.

        Raises `SingularError` where A is seen to be singular. If floating point hides that, and the
        system is consistent all the same, the answer is one of its solutions: where it matters that
        it is the only one, prove A regular (`definite`, `kernel`).
        """
        return self.solve_many([b])[0]

    def solve_many(self, columns: Sequence[Sequence[int | fmpz]]) -> list[tuple[list[fmpz], fmpz]]:
        """`solve` for several right-hand sides together, which share every step."""
        n = self.A.shape[0]
        for b in columns:
            if len(b) != n:
                raise InputError("the length of b", len(b), f"{n}, the rows of A")
        rights = [[fmpz(x) for x in b] for b in columns]
        if n == 0:
            return [([], fmpz(1)) for _ in rights]
        while self._shifts:
            try:
                return self._lift(rights, self._shifts[0])
            except _LiftingError:
                del self._shifts[:1]
        return [self._solve_dense(b) for b in rights]

    def _factor(self) -> Any:
        if self._factors is None:
            from scipy.sparse.linalg import splu  # slow to import, needed here only

            options = SYMMETRIC if self._symmetric else {}
            try:
                self._factors = splu(csc_array(self.A.astype(np.float64)), **options)
            except RuntimeError as error:  # exactly singular in floating point
                self._shifts.clear()
                raise _LiftingError from error
            pivots = np.abs(self._factors.U.diagonal())
            if pivots.min() < _TINY_PIVOT * pivots.max():  # singular, or too close to tell
                self._shifts.clear()
                raise _LiftingError
        return self._factors

    def approximate(self, b: Sequence[int | fmpz], steps: int) -> Approximation:
        """The first bits of A^-1 b, with an exact residual; `steps` steps beyond those of b.

        Raises `SolveError` where floating point is not good enough for this matrix.
        """
        if not len(b):
            nothing = np.zeros(0, dtype=np.int64)
            return Approximation([nothing], nothing, _SHIFTS[0], 1)
        try:
            last = None
            for last in self._steps([[fmpz(x) for x in b]], _SHIFTS[0]):
                if len(last.digits) >= last.length + steps:
                    break
        except _LiftingError as error:
            raise SolveError("the matrix is too ill-conditioned for floating point") from error
        assert last is not None
        digits = [d[:, 0] for d in last.digits]
        return Approximation(digits, last.rest[:, 0], _SHIFTS[0], last.length)

    def _steps(self, rights: list[list[fmpz]], shift: int) -> Iterator[_Step]:
        """The lifting, step by step and without end."""
        if self._norm * 2.0 ** (shift + 2) > _LIMIT:
            raise _LiftingError
        lu = self._factor()
        feed = [_digits(b, shift) for b in rights]
        length = max(d.shape[0] for d in feed)
        n, count = self.A.shape[0], len(rights)
        padded = np.zeros((length, n, count), dtype=np.int64)
        for c, d in enumerate(feed):
            padded[length - d.shape[0] :, :, c] = d
        digits: list[IntArray] = []
        residual = np.zeros((n, count), dtype=np.int64)
        while True:
            if len(digits) < length:
                residual = residual + padded[len(digits)]
            with np.errstate(all="ignore"):
                x = np.rint(lu.solve(residual.astype(np.float64)))
            largest = float(np.abs(x).max())
            # The product A x has to fit int64; a digit of the solution has about `shift` bits,
            # more only in the first steps, where the digits of b come in.
            if not np.isfinite(largest) or largest * self._norm > _LIMIT / 2:
                raise _LiftingError
            whole = x.astype(np.int64)
            rest = residual - self.A @ whole
            # |rest| <= |A| (1/2 + error): more means that the factors do not invert A.
            left = float(np.abs(rest).max())
            if left > 0.75 * self._norm + 1 or left * 2.0**shift > _LIMIT / 2:
                raise _LiftingError
            residual = rest << shift
            digits.append(whole)
            yield _Step(digits, rest, length)

    def _lift(self, rights: list[list[fmpz]], shift: int) -> list[tuple[list[fmpz], fmpz]]:
        n, count = self.A.shape[0], len(rights)
        # One random combination of the unknowns has their common denominator but for bad luck.
        mix = np.random.default_rng(0).choice(np.array([-1, 1]), size=n)
        mixed = [fmpz(0)] * count
        solved: list[tuple[list[fmpz], fmpz] | None] = [None] * count
        next_try = 0
        said = perf_counter()
        for digits, rest, length in self._steps(rights, shift):
            high, low = mix @ (digits[-1] >> 31), mix @ (digits[-1] & 0x7FFFFFFF)
            mixed = [
                (x << shift) + (fmpz(h) << 31) + k
                for x, h, k in zip(mixed, high.tolist(), low.tolist(), strict=True)
            ]
            if self._progress and perf_counter() - said > 2:
                said = perf_counter()
                self._progress(f"{shift * len(digits)} bits of the exact solution")
            next_try = next_try or length + max(_FIRST_TRY, self._bits // shift)
            if len(digits) < next_try and not (len(digits) >= length and not rest.any()):
                continue
            next_try = max(int(len(digits) * _TRY_GROWTH), len(digits) + 1)
            for c in range(count):
                if solved[c] is None:
                    own = [d[:, c] for d in digits]
                    solved[c] = self._recover(own, mixed[c], rights[c], length, shift)
            bits = shift * (len(digits) - length)
            if None not in solved:
                self._bits = bits
                break
            # Digits without end: A is singular, though its factors in floating point are not.
            if bits > 2 * (self._det_bits + n.bit_length() + _SLACK):
                raise _LiftingError
        return [s for s in solved if s is not None]

    def _recover(
        self,
        digits: list[IntArray],
        mixed: fmpz,
        b: list[fmpz],
        length: int,
        shift: int,
    ) -> tuple[list[fmpz], fmpz] | None:
        """Numerators over one denominator, proved, or None where more digits are needed."""
        bits = shift * (len(digits) - length)
        den = _denominator(mixed, bits)
        if den is None:
            return None
        values = _join(digits, shift)
        numerators: list[fmpz] = []
        modulus = fmpz(1) << bits
        half = modulus >> 1
        near = fmpz(1) << (den.bit_length() + _SLACK // 2)
        for value in values:
            scaled = den * value
            numerator, rest = divmod(scaled + half, modulus)
            if not -near < rest - half < near:
                extra = _denominator(scaled, bits)
                if extra is None:
                    return None
                numerators = [x * extra for x in numerators]
                den = den * extra
                near = fmpz(1) << (den.bit_length() + _SLACK // 2)
                numerator = (den * value + half) >> bits
            numerators.append(numerator)
        return (numerators, den) if satisfies(self.A, numerators, den, b) else None

    def _solve_dense(self, b: list[fmpz]) -> tuple[list[fmpz], fmpz]:
        """The dense p-adic solver of FLINT, for what floating point cannot do."""
        n = self.A.shape[0]
        dense = fmpz_mat(n, n, [int(x) for x in self.A.toarray().ravel()])
        try:
            solution: Any = dense.solve(fmpz_mat(n, 1, b))
        except ZeroDivisionError as error:
            raise SingularError(f"the matrix of {n} unknowns is singular") from error
        numerators, den = solution.numer_denom()
        return numerators.entries(), den


def satisfies(A: csr_array, numerators: list[fmpz], den: fmpz, b: list[fmpz]) -> bool:
    """Whether A N = D b, in integers."""
    indptr, indices, data = A.indptr.tolist(), A.indices.tolist(), A.data.tolist()
    for i, right in enumerate(b):
        total = -den * right
        for k in range(indptr[i], indptr[i + 1]):
            total += data[k] * numerators[indices[k]]
        if total != 0:
            return False
    return True


def _digits(b: list[fmpz], shift: int) -> IntArray:
    """Digits of b in base 2^shift, most significant first, all with the sign of the entry."""
    length = max(1, max(-(-int(x.bit_length()) // shift) for x in b))
    size = shift // 8
    packed = b"".join(int(abs(x)).to_bytes(length * size, "little") for x in b)
    table = np.zeros((len(b), length, 8), dtype=np.uint8)
    table[:, :, :size] = np.frombuffer(packed, dtype=np.uint8).reshape(len(b), length, size)
    signs = np.array([-1 if x < 0 else 1 for x in b], dtype=np.int64)
    return signs * table.view("<i8")[:, ::-1, 0].astype(np.int64).T


def _join(digits: list[IntArray], shift: int) -> list[fmpz]:
    """sum_k digits[k] 2^(shift (last - k)) for each entry, through bytes rather than sums."""
    table = np.array(digits[::-1])  # least significant first
    size = shift // 8
    carry = np.zeros(table.shape[1], dtype=np.int64)
    mask = np.int64((1 << shift) - 1)
    packed = np.empty((table.shape[1], len(table) * size + 8), dtype=np.uint8)
    for k, row in enumerate(table):
        total = row + carry
        carry = total >> shift
        low = np.ascontiguousarray(total & mask).astype("<i8").view(np.uint8).reshape(-1, 8)
        packed[:, k * size : (k + 1) * size] = low[:, :size]
    packed[:, len(table) * size :] = carry.astype("<i8").view(np.uint8).reshape(-1, 8)
    return [fmpz(int.from_bytes(row.tobytes(), "little", signed=True)) for row in packed]


def _denominator(value: fmpz, bits: int) -> fmpz | None:
    """The q of the fraction p/q nearest to value / 2^bits, if it stands out; else None.

    Continued fractions: a convergent p/q of a rational with numerator and denominator well below
    2^(bits/2) is followed by a huge partial quotient, which is how it is known.
    """
    limit = fmpz(1) << max((bits - _SLACK) // 2, 0)
    a, b = fmpz(1) << bits, value % (fmpz(1) << bits)
    q_before, q = fmpz(0), fmpz(1)
    while b != 0:
        quotient, rest = divmod(a, b)
        following = quotient * q + q_before
        if following > limit:
            return q if quotient.bit_length() > _SLACK // 2 else None
        q_before, q = q, following
        a, b = b, rest
    return q
