"""The floating-point proof of positive definiteness is never wrong, and mostly succeeds."""

import warnings
from functools import partial

import numpy as np
import pytest
from flint import fmpq_mat, fmpz_mat
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

import lcp_piles.linear.definite
import lcp_piles.linear.springs
from lcp_piles import contact_system, nt30, tbs
from lcp_piles.linear.banded import lower_band
from lcp_piles.linear.definite import (
    has_independent_columns,
    is_positive_definite,
    least_eigenvalue,
)
from lcp_piles.linear.springs import springs


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


@given(st.integers(1, 7), st.integers(0, 6), st.integers(0, 40), st.data())
def test_columns_said_to_be_independent_are(
    rows: int, columns: int, bits: int, data: st.DataObject
) -> None:
    """By FLINT's rank: the last column is nearly a multiple of the first, or is one."""
    entries = st.integers(-3, 3)
    table = [data.draw(st.lists(entries, min_size=columns, max_size=columns)) for _ in range(rows)]
    if columns > 1:
        for i, row in enumerate(table):
            row[-1] = row[0] * 2**bits + (i == data.draw(st.integers(0, rows)))
    B = csr_array(np.array(table, dtype=np.int64).reshape(rows, columns))
    rank = fmpz_mat(rows, columns, [x for row in table for x in row]).rank()
    independent = has_independent_columns(B)
    assert rank == columns or not independent
    if bits <= 3:
        assert independent == (rank == columns)


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


def no_band(monkeypatch, module) -> None:
    """Make every band of a module one that is too wide to be stored."""
    monkeypatch.setattr(module, "lower_band", partial(lower_band, most=1))


def test_nothing_is_claimed_of_a_band_too_wide(monkeypatch) -> None:
    A = csr_array(np.array([[2, 1], [1, 2]]))
    no_band(monkeypatch, lcp_piles.linear.definite)
    assert least_eigenvalue(A) == 0


@pytest.mark.parametrize("angle", [0.1, 0.7, 1.5])
@pytest.mark.parametrize("soft", [1.0, 1e-3, 1e5])
def test_springs_at_an_angle_are_as_weak_as_their_eigenvalue(angle: float, soft: float) -> None:
    """Two springs of one freedom each, at an angle: the eigenvalues of D K D in closed form."""
    B = csr_array(np.array([[1.0, 0.0], [np.cos(angle), np.sin(angle)]]))
    held = springs(B, np.array([1.0, soft]))
    c, s = np.cos(angle), np.sin(angle)
    K = np.array([[1 + c * c / soft, c * s / soft], [c * s / soft, s * s / soft]])
    scaled = held.D[:, None] * K * held.D
    assert (np.log2(held.D) % 1 == 0).all()
    assert (scaled.diagonal() >= 0.5).all()
    assert (scaled.diagonal() <= 2).all()
    half, spread = scaled.trace() / 2, np.hypot((scaled[0, 0] - scaled[1, 1]) / 2, scaled[0, 1])
    assert 0 < held.least <= half - spread
    force = np.array([2.0, -3.0])
    assert np.allclose(K @ held.solve(force), force, rtol=1e-9)


@pytest.mark.parametrize(
    "B",
    [
        np.array([[1.0, -1.0]]),  # a motion of both that no spring resists
        np.array([[1.0, 0.0]]),  # a freedom without a spring
        np.zeros((0, 2)),
    ],
)
def test_springs_that_leave_a_motion_free_have_no_bound(B: np.ndarray) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        free = springs(csr_array(B), np.ones(len(B)))
    assert free.least == 0


def test_springs_of_a_band_too_wide_have_neither_factors_nor_a_bound(monkeypatch) -> None:
    no_band(monkeypatch, lcp_piles.linear.springs)
    wide = springs(csr_array(np.array([[1.0, 0.0], [-0.6, 0.8]])), np.ones(2))
    assert (wide.least, wide.factors) == (0, None)
    with pytest.raises(ValueError, match="no factors"):
        wide.solve(np.ones(2))


def test_springs_without_a_freedom_are_as_strong_as_any() -> None:
    assert springs(csr_array(np.zeros((3, 0))), np.ones(3)).least > 0


def test_springs_of_a_matrix_that_floats_round_to_nothing_prove_nothing():
    """1e-340 would be zero in B, but 1e-50 in S: no bound may come of it."""
    B = csr_array(np.array([[1.0, 1e-340], [0.0, 1e-140]]))
    assert springs(B, np.array([1e-300, 1.0])).least == 0
    assert springs(csr_array(np.diag([1.0, 1e-140])), np.ones(2)).least > 0
