"""Exact solution of sparse square integer systems A x = b.

A is factored once in floating point, and each step of the `lifting` takes some more bits of the
solution out of the exact integer residual (Wan 2006, "An algorithm to solve integer linear systems
exactly using numerical methods", J. Symb. Comput. 41). When enough bits are there, one common
denominator is read off by continued fractions (`reconstruction`), and A N = D b is checked in
integers before anything is returned. A solution of n unknowns has about 2 log2(det A) bits, so the
cost is that many bits over those of a step, each step one pair of triangular solves; fraction-free
elimination of the same system costs n^3 products of numbers of log2(det A) bits.

What could go wrong, and what is done: int64 overflow (bounded beforehand from |A| and the digits,
never hoped for; what is larger comes in limbs); a bad factorisation (digits stop shrinking: fewer
bits a step, then the dense p-adic solver of FLINT); a singular A (decided exactly there). Nothing
wrong is returned: the last check is exact.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from time import perf_counter
from typing import Any

import numpy as np
from flint import fmpz, fmpz_mat

from ..errors import InputError, SolveError
from ..numbers.vectors import IntArray, content
from .integer_matrix import BigMatrix, IntegerMatrix, dense, integer_matrix
from .integer_product import times
from .lifting import SHIFTS, Lifting, LiftingError, column_shifts, lifting
from .reconstruction import SLACK, denominator, joined, reconstruct
from .threads import one_thread

_FIRST_TRY, _TRY_GROWTH = 6, 1.15
_FEW = 200  # unknowns of a long matrix, for which many limbs cost more than dense arithmetic
_SMALL = 90  # unknowns of any matrix, for which making its factors costs more than that


class SingularError(SolveError):
    """The system has no solution, or more than one: its matrix is singular."""


@dataclass(frozen=True, eq=False)
class Approximation:
    """x = A^-1 b to many bits: x = sum_k digits[k] 2^(shift (length - 1 - k)) + A^-1 r.

    The residual r = rest * 2^(shift (length - len(digits))) is exact.
    """

    digits: list[IntArray]
    rest: list[fmpz]
    shift: int
    length: int


class ExactSolver:
    """Exact solver for one square integer matrix and any number of right-hand sides.

    The factors are made at the first `solve` and kept; they and `progress` stay behind where the
    solver is pickled.

    Parameters
    ----------
    A : integer matrix, shape (n, n)
        Anything that `integer_matrix` takes: scipy.sparse and numpy with any integer dtype, nested
        lists of ints, and a `BigMatrix` (see `from_triplets`) for entries of any size.
    symmetric : bool, default False
        Whether A is symmetric and its factors need no pivoting.
    progress : callable, optional
        Called with a line of text every two seconds.

    Attributes
    ----------
    A : IntegerMatrix
        The matrix.

    Raises
    ------
    InputError
        Where A is not square, or not of integers.

    References
    ----------
    Wan, J. Symbolic Computation 41 (2006) 621.

    Examples
    --------
    >>> solver = ExactSolver([[2, 1], [1, 3]])
    >>> solver.solve([1, 0])
    ([3, -1], 5)
    >>> ExactSolver([[10**30]]).solve([10**15])
    ([1], 1000000000000000)
    """

    def __init__(
        self, A: Any, *, symmetric: bool = False, progress: Callable[[str], None] | None = None
    ) -> None:
        self.A: IntegerMatrix = integer_matrix(A)
        if self.A.shape[0] != self.A.shape[1]:
            raise InputError("the shape of A", self.A.shape, "a square matrix")
        self._symmetric = symmetric
        self._progress = progress

    def __getstate__(self) -> dict[str, Any]:
        return {"A": self.A, "_symmetric": self._symmetric, "_progress": None}

    def solve(self, b: Sequence[int | fmpz]) -> tuple[list[fmpz], fmpz]:
        """The exact solution of A x = b over one denominator.

        If floating point hides that A is singular, and the system is consistent all the same, the
        answer is one of its solutions: where it matters that it is the only one, prove A regular
        (`definite`, `kernel`).

        Parameters
        ----------
        b : sequence of int, shape (n,)
            The right-hand side.

        Returns
        -------
        N : list of fmpz
            Numerators: A N = D b exactly, and N / D is the solution.
        D : fmpz
            The denominator, positive.

        Raises
        ------
        SingularError
            Where A is seen to be singular.
        InputError
            For a b of another length.
        """
        return self.solve_many([b])[0]

    @one_thread()
    def solve_many(
        self, columns: Sequence[Sequence[int | fmpz]], likely: fmpz | None = None
    ) -> list[tuple[list[fmpz], fmpz]]:
        """`solve` for several right-hand sides together, which share every step.

        Parameters
        ----------
        columns : sequence of sequences of int
            The right-hand sides.
        likely : fmpz, optional
            A denominator that the solutions may have, such as that of another solution with this
            matrix: to read off numerators takes half as many bits as a fraction. Where it is none
            of theirs, only time is lost.

        Returns
        -------
        list of (list of fmpz, fmpz)
            (N, D) of each, as of `solve`.
        """
        n = self.A.shape[0]
        for b in columns:
            if len(b) != n:
                raise InputError("the length of b", len(b), f"{n}, the rows of A")
        rights = [[fmpz(x) for x in b] for b in columns]
        if not rights or n == 0:
            return [([], fmpz(1)) for _ in rights]
        few = n <= (_FEW if isinstance(self.A, BigMatrix) else _SMALL)
        for shift in SHIFTS if not few and self._lifting else ():
            try:
                return self._lift(rights, shift, likely)
            except LiftingError:
                pass
        return self._solve_dense(rights)

    @cached_property
    def _column_shifts(self) -> IntArray:
        """The powers of two that columns are multiplied by for the lifting."""
        return column_shifts(self.A)

    @cached_property
    def _lifting(self) -> Lifting | None:
        return lifting(self.A, self._column_shifts, symmetric=self._symmetric)

    @one_thread()
    def approximate(self, b: Sequence[int | fmpz], steps: int) -> Approximation:
        """The first bits of A^-1 b, with an exact residual.

        Parameters
        ----------
        b : sequence of int, shape (n,)
            The right-hand side.
        steps : int
            How many steps beyond those of b.

        Returns
        -------
        Approximation
            The digits and what they leave.

        Raises
        ------
        SolveError
            Where floating point is not good enough for this matrix.
        """
        if not len(b):
            return Approximation([np.zeros(0, dtype=np.int64)], [], SHIFTS[0], 1)
        made = self._lifting
        if self._column_shifts.any():
            made = lifting(self.A, np.zeros_like(self._column_shifts), symmetric=self._symmetric)
        try:
            if made is None:
                raise LiftingError
            for digits, rest, length in made.steps([[fmpz(x) for x in b]], SHIFTS[0]):
                if len(digits) >= length + steps:
                    left = joined([part[:, 0] for part in rest[::-1]], made.width)
                    return Approximation([d[:, 0] for d in digits], left, SHIFTS[0], length)
        except LiftingError as error:
            raise SolveError("the matrix is too ill-conditioned for floating point") from error
        raise AssertionError("the steps do not end")

    def _lift(
        self, rights: list[list[fmpz]], shift: int, likely: fmpz | None
    ) -> list[tuple[list[fmpz], fmpz]]:
        made = self._lifting
        assert made is not None
        n, count = self.A.shape[0], len(rights)
        # One random combination of the unknowns has their common denominator but for bad luck.
        mix = np.random.default_rng(0).choice(np.array([-1, 1]), size=n)
        mixed = [fmpz(0)] * count
        solved: list[tuple[list[fmpz], fmpz] | None] = [None] * count
        next_try = 0
        said = perf_counter()
        for digits, rest, length in made.steps(rights, shift):
            high, low = mix @ (digits[-1] >> 31), mix @ (digits[-1] & 0x7FFFFFFF)
            mixed = [
                (x << shift) + (fmpz(h) << 31) + k
                for x, h, k in zip(mixed, high.tolist(), low.tolist(), strict=True)
            ]
            if self._progress and perf_counter() - said > 2:
                said = perf_counter()
                self._progress(f"{shift * len(digits)} bits of the exact solution")
            bits = shift * (len(digits) - length)
            ended = len(digits) >= length and not rest.any()
            guess = None
            if likely is not None and bits >= likely.bit_length() + SLACK:
                guess, likely = likely, None  # it has one try
            elif not ended and (
                likely is not None or len(digits) < max(next_try, length + _FIRST_TRY)
            ):
                continue
            else:
                next_try = max(int(len(digits) * _TRY_GROWTH), len(digits) + 1)
            for c in range(count):
                if solved[c] is None:
                    den = guess or denominator(mixed[c], bits)
                    if den is not None:
                        found = reconstruct([d[:, c] for d in digits], den, bits, shift)
                        solved[c] = self._proved(found, rights[c])
            if None not in solved:
                break
            # Digits without end: A is singular, though its factors in floating point are not.
            if bits > 2 * (made.det_bits + n.bit_length() + SLACK):
                raise LiftingError
        return [s for s in solved if s is not None]

    def _proved(
        self, found: tuple[list[fmpz], fmpz] | None, b: list[fmpz]
    ) -> tuple[list[fmpz], fmpz] | None:
        """The solution for A from that of the shifted columns, if it is one."""
        if found is None:
            return None
        numerators, den = found
        if self._column_shifts.any():
            pairs = zip(numerators, self._column_shifts.tolist(), strict=True)
            numerators = [x << s for x, s in pairs]
        right = all(x == den * y for x, y in zip(times(self.A, numerators), b, strict=True))
        return (numerators, den) if right else None

    def _solve_dense(self, rights: list[list[fmpz]]) -> list[tuple[list[fmpz], fmpz]]:
        """The dense p-adic solver of FLINT, for what floating point cannot do, or not so fast."""
        n, count = self.A.shape[0], len(rights)
        table = fmpz_mat(count, n, [x for b in rights for x in b]).transpose()
        try:
            solution: Any = dense(self.A).solve(table)
        except ZeroDivisionError as error:
            raise SingularError(f"the matrix of {n} unknowns is singular") from error
        numerators, den = solution.numer_denom()
        found = []
        for column in numerators.transpose().tolist():
            common = content(column, den)
            found.append(([x // common for x in column], den // common))
        return found
