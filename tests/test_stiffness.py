"""Factors of bands and stiffness matrices against dense linear algebra."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

import lcp_piles.linear.stiffness
from lcp_piles import contact_system, nt30, tbs, tss
from lcp_piles.linear.banded import band_order, cholesky, lower_band
from lcp_piles.linear.stiffness import factor, stiffness


def dense(B, D, soft):
    return B.toarray().T @ np.diag(D) @ B.toarray() + soft * np.eye(B.shape[1])


@st.composite
def weighted(draw):
    """A sparse matrix of small integers with empty rows and columns, and a diagonal."""
    rows, columns = draw(st.integers(1, 9)), draw(st.integers(1, 7))
    entry = st.sampled_from([0, 0, 0, 1, -1, 2])
    B = np.array(draw(st.lists(entry, min_size=rows * columns, max_size=rows * columns)))
    D = draw(st.lists(st.floats(0, 10), min_size=rows, max_size=rows))
    return csr_array(B.reshape(rows, columns).astype(float)), np.array(D)


@given(weighted())
def test_solves_with_any_diagonal(case):
    B, D = case
    b = np.arange(1.0, B.shape[1] + 1)
    K = dense(B, D, 1.0)
    assert np.allclose(K @ factor(stiffness(B), D, 1.0)(b), b, atol=1e-9)


@pytest.mark.parametrize("scene", [nt30(8), tss(9), tbs(12)], ids=str)
def test_one_pattern_serves_many_diagonals(scene):
    B, C, _, p = contact_system(scene).floats()
    pattern = stiffness(B)
    random = np.random.default_rng(3)
    for _ in range(3):
        D = random.uniform(0.1, 1, len(C))
        x = factor(pattern, D, 1e-3)(p)
        assert np.allclose(dense(B, D, 1e-3) @ x, p, atol=1e-10)


def test_a_band_too_wide_and_a_negative_stiffness_are_left_to_sparse_elimination(monkeypatch):
    B, C, _, p = contact_system(nt30(5)).floats()
    monkeypatch.setattr(lcp_piles.linear.stiffness, "_LARGEST_BAND", 10)
    wide = stiffness(B)
    assert wide.entries is None
    monkeypatch.undo()
    negative = np.where(np.arange(len(C)) % 7 == 0, -0.1, 1.0)
    for pattern, D in ((wide, 1 / C), (stiffness(B), negative)):
        x = factor(pattern, D, 1e-6)(p)
        assert np.allclose(dense(B, D, 1e-6) @ x, p, atol=1e-9)


def test_what_is_singular_is_said_to_be():
    B = csr_array(np.array([[1.0, -1.0]]))
    with pytest.raises(RuntimeError, match="positive definite"):
        factor(stiffness(B), np.array([1.0]), 0.0)


def test_an_indefinite_band_has_no_factors_and_a_wide_one_is_not_stored():
    A = csr_array(np.array([[1.0, 2.0], [2.0, 1.0]]))
    order = band_order(A)
    assert cholesky(lower_band(A, order, most=4), order) is None
    assert lower_band(A, order, most=3) is None


def test_a_pile_is_a_narrow_band():
    """About as wide as the pile has layers, whatever the order it was built in."""
    for layers in (10, 20, 40):
        B = contact_system(tbs(layers)).B
        K = csr_array(B.T @ B)
        assert lower_band(K, band_order(K), most=2 * layers * K.shape[0]) is not None
