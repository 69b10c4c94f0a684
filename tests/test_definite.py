"""The floating-point proof of positive definiteness is never wrong, and mostly succeeds."""

import numpy as np
import pytest
from flint import fmpq_mat, fmpz_mat
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

from lcp_piles import contact_system, nt30, tbs
from lcp_piles.linear.definite import is_positive_definite, least_eigenvalue


def _definite_by_minors(A: np.ndarray) -> bool:
    """Sylvester's criterion, exactly: all leading minors are positive."""
    sizes = range(1, len(A) + 1)
    return all(fmpz_mat(k, k, [int(x) for x in A[:k, :k].ravel()]).det() > 0 for k in sizes)


@st.composite
def symmetric(draw) -> np.ndarray:
    """B^T B of a small integer matrix B that often lacks rank, sometimes made indefinite."""
    rows, columns = draw(st.integers(1, 7)), draw(st.integers(1, 6))
    entry = st.integers(-4, 4)
    B = np.array(draw(st.lists(entry, min_size=rows * columns, max_size=rows * columns)))
    B = B.reshape(rows, columns)
    shift = draw(st.sampled_from([0, 0, 0, -1, 1]))
    return B.T @ B + shift * np.eye(columns, dtype=np.int64)


@given(symmetric())
def test_a_proof_is_right(A: np.ndarray) -> None:
    """Small integer matrices are far from singular or exactly so: the proof decides both."""
    assert is_positive_definite(csr_array(A)) == _definite_by_minors(A)


@given(symmetric(), st.floats(1e-9, 2))
def test_a_bound_is_a_lower_bound(A: np.ndarray, alpha: float) -> None:
    """A - bound I is positive semidefinite, by exact leading minors of a slightly lower shift."""
    bound = least_eigenvalue(csr_array(A), (alpha,))
    assert 0 <= bound <= alpha * max(int(A.diagonal().max()), 0)
    if bound:
        num, den = (bound * (1 - 2**-40)).as_integer_ratio()
        n = len(A)
        shifted = fmpq_mat(n, n, [int(x) for x in A.ravel()])
        shift = fmpz_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])
        exact = shifted - fmpq_mat(shift) * num / den
        for k in range(1, n + 1):
            block = fmpq_mat(k, k, [exact[i, j] for i in range(k) for j in range(k)])
            assert block.det() > 0


def test_matrices_of_piles_are_proved_and_mechanisms_are_not() -> None:
    K = contact_system(tbs(20)).B
    assert is_positive_definite(csr_array(K.T @ K))
    system = contact_system(nt30(6))
    B = csr_array(system.B[: system.dof - 1])  # too few contacts to hold anything
    assert not is_positive_definite(csr_array(B.T @ B))


@pytest.mark.parametrize("A", [np.zeros((2, 2), dtype=np.int64), -np.eye(3, dtype=np.int64)])
def test_nothing_is_claimed_without_a_positive_diagonal(A: np.ndarray) -> None:
    assert not is_positive_definite(csr_array(A))
    assert least_eigenvalue(csr_array(A), (0.1,)) == 0


def test_no_unknowns_are_definite() -> None:
    assert is_positive_definite(csr_array((0, 0), dtype=np.int64))
