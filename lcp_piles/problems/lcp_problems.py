"""Linear complementarity problems with their solutions: where pivoting takes long, ties or cycles.

Every answer comes from the publication, a closed form or how the problem was made, never from a
solver.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

import numpy as np

from ..numbers.vectors import FloatArray

Numbers = tuple[Fraction, ...]


@dataclass(frozen=True)
class LCPCase:
    """An LCP (M, q) and its solution; `z` may be one of several, `w` is unique."""

    name: str
    M: tuple[Numbers, ...]
    q: Numbers
    z: Numbers
    w: Numbers

    def floats(self) -> tuple[FloatArray, FloatArray]:
        """(M, q) in floating point."""
        return np.array(self.M, dtype=float), np.array(self.q, dtype=float)


def _case(
    name: str, M: Sequence[Sequence[Fraction]], z: Sequence[Fraction], w: Sequence[Fraction]
) -> LCPCase:
    """The problem that has the solution (z, w): q = w - M z."""
    q = [
        b - sum((x * y for x, y in zip(row, z, strict=True)), Fraction(0))
        for row, b in zip(M, w, strict=True)
    ]
    return LCPCase(name, tuple(map(tuple, M)), tuple(q), tuple(z), tuple(w))


def _published(
    name: str, M: Sequence[Sequence[int]], q: Sequence[int], z: Sequence[Fraction]
) -> LCPCase:
    """The problem (M, q) with its published solution z: w = M z + q."""
    exact = [[Fraction(x) for x in row] for row in M]
    w = [
        b + sum((x * y for x, y in zip(row, z, strict=True)), Fraction(0))
        for row, b in zip(exact, q, strict=True)
    ]
    return _case(name, exact, z, w)


def kostreva() -> LCPCase:
    """Kostreva (1979), "Cycling in linear complementarity problems", Math. Program. 16.

    A P-matrix whose rows all tie at the start; z = (1, 1, 1)/3.
    """
    M = [[Fraction(x) for x in row] for row in ([1, 2, 0], [0, 1, 2], [2, 0, 1])]
    return _case("kostreva", M, [Fraction(1, 3)] * 3, [Fraction(0)] * 3)


def murty(n: int) -> LCPCase:
    """Murty (1978), "Computational complexity of complementary pivot methods": 2^n pivots.

    M is lower triangular, 1 on and 2 below the diagonal, q_i = -(2^n + ... + 2^(n - i + 1)) for
    i = 1..n; z = (2^n, 0, ..., 0).
    """
    M = [[Fraction(1 if i == j else 2 * (j < i)) for j in range(n)] for i in range(n)]
    z = [Fraction(2**n * (j == 0)) for j in range(n)]
    return _case(f"murty {n}", M, z, [Fraction(2 ** (n - i) * (i > 0)) for i in range(n)])


def fathi(n: int) -> LCPCase:
    """Fathi (1979), "Computational complexity of LCPs associated with positive definite matrices".

    M = L L^T with Murty's L. Fathi's q is -(1, ..., 1); here q_i = -1 + 4^-(i + 2), i = 1..n, so
    that no rows tie and every rule takes the 2^n pivots; z = (63/64, 0, ..., 0).
    """
    L = murty(n).M
    M = [[sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0)) for b in L] for a in L]
    z = [Fraction(63 * (j == 0), 64) for j in range(n)]
    w = [row[0] * z[0] - 1 + Fraction(1, 4 ** (i + 3)) for i, row in enumerate(M)]
    return _case(f"fathi {n}", M, z, w)


def degenerate(seed: int, size: int, rank: int, decades: int = 0) -> LCPCase:
    """A random positive semidefinite LCP in which 30 % of the pairs are both zero.

    M = D A A^T D with A (size, rank) of small fractions and D powers of ten from 10^-decades to
    10^decades; z and w are drawn, q follows. M being symmetric, w is unique, z may not be.
    """
    random = Random(seed)
    A = []
    for _ in range(size):
        scale = Fraction(10) ** random.randint(-decades, decades)
        A.append([scale * random.randint(-9, 9) / random.randint(1, 9) for _ in range(rank)])
    M = [[sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0)) for b in A] for a in A]
    z, w = [Fraction(0)] * size, [Fraction(0)] * size
    for i in range(size):
        kind = random.random()
        if kind >= 0.3:
            (z if kind < 0.65 else w)[i] = Fraction(random.randint(1, 9))
    return _case(f"degenerate {seed} {size} {rank} {decades}", M, z, w)


def newton_min_definite() -> LCPCase:
    """A symmetric positive definite problem on which the Z iteration cycles.

    From z_1 basic its sets are {1}, {2}, {1, 2, 3}, {1}.
    """
    M, q = [[5, -4, 3], [-4, 6, -3], [3, -3, 2]], [1, -7, 3]
    return _published("definite", M, q, (Fraction(11, 7), Fraction(31, 14), Fraction(0)))


def gilbert() -> LCPCase:
    """Ben Gharbia and Gilbert (2012), "Nonconvergence of the plain Newton-min algorithm for LCPs".

    A P-matrix of order 3 on which the Z iteration cycles; z = 0.
    """
    return _published("gilbert", [[1, 0, 2], [2, 1, 0], [0, 2, 1]], [1, 1, 1], [Fraction(0)] * 3)


GRAIN_C = ((0, 4), (4, -2), (2, -4))
GRAIN_Q = (14, -1, -13)


def grain() -> LCPCase:
    """One grain between two springs and three walls, f_i = max(0, c_i . u - q_i), u = -sum c_i f_i.

    So w = (C C^T + I) f + q with the rows c_i of `GRAIN_C`. From all contacts closed the sets of
    the Z iteration are {1, 3}, and then {}, {2, 3}, {1, 3} for ever; only f_3 = 13/21 is not zero.
    As a scene it is `scene_problems.grain_scene`.
    """
    M = [
        [sum(x * y for x, y in zip(a, b, strict=True)) + (i == j) for j, b in enumerate(GRAIN_C)]
        for i, a in enumerate(GRAIN_C)
    ]
    return _published("grain", M, GRAIN_Q, (Fraction(0), Fraction(0), Fraction(13, 21)))
