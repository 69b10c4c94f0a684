"""Sparse factors in floating point: singular matrices are told, in whatever way they are so."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array
from scipy.sparse.csgraph import structural_rank

from lcp_piles.linear.factors import has_transversal, sparse_factors


@pytest.mark.parametrize("symmetric", [False, True])
def test_the_factors_solve(symmetric) -> None:
    A = np.array([[4.0, 1, 0], [1, 3, 1], [0, 1, 5]])
    found = sparse_factors(csr_array(A), symmetric=symmetric).solve(np.array([5.0, 5, 6]))
    np.testing.assert_allclose(found, [1, 1, 1])


def test_a_pattern_that_is_singular_never_reaches_superlu() -> None:
    """k columns whose entries stand in k - 1 rows: SuperLU read beyond its arrays on many such."""
    random = np.random.default_rng(3)
    for _ in range(300):
        n = int(random.integers(3, 60))
        k = int(random.integers(2, n + 1))
        A = np.where(random.random((n, n)) < 0.3, random.integers(1, 9, (n, n)), 0.0)
        A[k - 1 :, :k] = 0
        A = A[np.ix_(random.permutation(n), random.permutation(n))]
        with pytest.raises(RuntimeError, match="pattern"):
            sparse_factors(csr_array(A))


def test_numbers_that_are_singular() -> None:
    with pytest.raises(RuntimeError, match="singular"):
        sparse_factors(csr_array(np.ones((3, 3))))


def test_transversals_are_those_of_scipy() -> None:
    """Its matching is exponential on some large patterns, but right on small ones."""
    random = np.random.default_rng(7)
    found = []
    for _ in range(600):
        n = int(random.integers(1, 12))
        A = (random.random((n, n)) < random.choice([0.15, 0.3, 0.5])).astype(float)
        found.append(has_transversal(csc_array(A)))
        assert found[-1] == (structural_rank(csr_array(A)) == n)
    assert 100 < sum(found) < 500
