"""Triangular factors of a sparse matrix in floating point, by SuperLU."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from scipy.sparse import csc_array, csr_array

if TYPE_CHECKING:
    from scipy.sparse.linalg import SuperLU

_SYMMETRIC: dict[str, Any] = {
    "permc_spec": "MMD_AT_PLUS_A",
    "diag_pivot_thresh": 0.0,
    "options": {"SymmetricMode": True},
}
"""SuperLU's options for a symmetric matrix that needs no pivoting."""


def sparse_factors(A: csr_array | csc_array, *, symmetric: bool = False) -> SuperLU:
    """Factors of a square matrix; `RuntimeError` where it is singular in floating point.

    A matrix whose pattern alone makes it singular never reaches SuperLU, which reads beyond its
    arrays where a column is left without an entry to divide by.
    """
    from scipy.sparse.linalg import splu  # slow to import

    columns = csc_array(A)
    if not has_transversal(columns):
        raise RuntimeError("the pattern of the matrix makes it singular")
    return splu(columns, **(_SYMMETRIC if symmetric else {}))


def has_transversal(A: csc_array) -> bool:
    """Whether entries can be chosen, one in each row and each column of a square matrix.

    Else it is singular whatever its numbers are. Most columns take a row that is free; for each
    that is left a breadth-first search looks for a way to exchange rows (as Duff 1981, "On
    algorithms for obtaining a maximum transversal", ACM Trans. Math. Softw. 7, by depth). The
    matching of scipy takes exponential time on patterns of linear programmes.

    >>> has_transversal(csc_array([[1, 1], [0, 1]])), has_transversal(csc_array([[1, 1], [0, 0]]))
    (True, False)
    """
    if A.diagonal().all():
        return True
    n = A.shape[1]
    ends, indices = A.indptr.tolist(), A.indices.tolist()
    rows = [indices[ends[j] : ends[j + 1]] for j in range(n)]
    taken = [-1] * n  # the column that has each row
    left = []
    for j in sorted(range(n), key=lambda j: len(rows[j])):
        free = next((i for i in rows[j] if taken[i] < 0), None)
        if free is None:
            left.append(j)
        else:
            taken[free] = j
    return all(_exchanged(j, rows, taken) for j in left)


def _exchanged(start: int, rows: list[list[int]], taken: list[int]) -> bool:
    """Give a column a row, by handing rows on from column to column; False where none is free."""
    reached: dict[int, int] = {}  # the column from which each row was reached
    queue = deque([start])
    while queue:
        j = queue.popleft()
        for i in rows[j]:
            if i in reached:
                continue
            reached[i] = j
            if taken[i] >= 0:
                queue.append(taken[i])
                continue
            while True:  # back along the way, each column taking the row that it leads to
                j = reached[i]
                before = next((r for r in rows[j] if taken[r] == j), None)
                taken[i] = j
                if j == start or before is None:
                    return True
                i = before
    return False
