"""The kernel of an integer matrix, exactly: which motions change no gap.

Elimination modulo one large prime proposes the rank and the pivot columns P; a rank modulo a prime
is never too large. Every other column f then has to be a combination of those of P, which one exact
solve of the normal equations gives and an exact product checks. So both bounds on the rank are
proved, and the prime cannot make the result wrong.
"""

from __future__ import annotations

from functools import reduce
from itertools import pairwise

from flint import fmpz, fmpz_mat, nmod_mat
from scipy.sparse import csr_array

from .sparse_exact import ExactSolver, SingularError
from .vectors import content

_PRIME = 9223372036854775783


def independent_rows(B: csr_array) -> list[int]:
    """Numbers of linearly independent rows of B, as many as there are (but for a bad prime).

    >>> import numpy as np
    >>> independent_rows(csr_array(np.array([[1, 1], [2, 2], [0, 1]])))
    [0, 2]
    """
    return _pivots(csr_array(B.T))


def kernel(B: csr_array) -> tuple[list[list[fmpz]], list[int]]:
    """A basis of {u : B u = 0} in integers, and the columns that make the rest independent.

    Vector k of the basis is not zero in column `pinned[k]` and zero in the other pinned ones.

    >>> import numpy as np
    >>> kernel(csr_array(np.array([[1, -1, 0], [0, 1, -1]])))
    ([[1, 1, 1]], [2])
    """
    columns = B.shape[1]
    pivots = _pivots(B)
    if len(pivots) == columns:
        return [], []
    pinned = sorted(set(range(columns)) - set(pivots))
    basis = _combinations(B, pivots, pinned)
    return (basis, pinned) if basis is not None else _kernel_by_elimination(B)


def _pivots(B: csr_array) -> list[int]:
    rows, columns = B.shape
    if rows == 0 or columns == 0:
        return []
    matrix = nmod_mat(rows, columns, [int(x) for x in B.toarray().ravel()], _PRIME)
    reduced, rank = matrix.rref()
    pivots, at = [], 0
    for i in range(rank):
        while int(reduced[i, at]) == 0:
            at += 1
        pivots.append(at)
    return pivots


def _combinations(B: csr_array, pivots: list[int], pinned: list[int]) -> list[list[fmpz]] | None:
    """The kernel vectors that are one column of `pinned` less its expression in the pivots'."""
    B_P = csr_array(B[:, pivots])
    solver = ExactSolver(B_P.T @ B_P, symmetric=True)
    basis = []
    for f in pinned:
        right = -(B_P.T @ B[:, [f]].toarray().ravel())
        try:
            numerators, den = solver.solve([int(x) for x in right])
        except SingularError:
            return None
        vector = [fmpz(0)] * B.shape[1]
        for j, x in zip(pivots, numerators, strict=True):
            vector[j] = x
        vector[f] = den
        if any(x != 0 for x in times(B, vector)):
            return None
        common = content(vector, den)
        basis.append([x // common for x in vector])
    return basis


def _kernel_by_elimination(B: csr_array) -> tuple[list[list[fmpz]], list[int]]:
    """The same by exact elimination over the rationals, where the prime misled."""
    rows, columns = B.shape
    reduced, den, rank = fmpz_mat(rows, columns, [int(x) for x in B.toarray().ravel()]).rref()
    pivots, at = [], 0
    for i in range(rank):
        while reduced[i, at] == 0:
            at += 1
        pivots.append(at)
    pinned = sorted(set(range(columns)) - set(pivots))
    basis = []
    for f in pinned:
        vector = [fmpz(0)] * columns
        vector[f] = fmpz(abs(den))
        for i, j in enumerate(pivots):
            vector[j] = -reduced[i, f] if den > 0 else reduced[i, f]
        common = reduce(lambda a, b: a.gcd(b), vector)
        basis.append([x // common for x in vector])
    return basis, pinned


def times(B: csr_array, vector: list[fmpz]) -> list[fmpz]:
    """B v in integers of any size."""
    indptr, indices, data = B.indptr.tolist(), B.indices.tolist(), B.data.tolist()
    return [
        sum((data[k] * vector[indices[k]] for k in range(a, b)), fmpz(0))
        for a, b in pairwise(indptr)
    ]
