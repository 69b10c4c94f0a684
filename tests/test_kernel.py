"""Kernels and definiteness of integer matrices, against FLINT's fraction-free elimination."""

import warnings
from functools import partial
from math import lcm

import numpy as np
import pytest
from flint import fmpz, fmpz_mat
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

import lcp_piles.linear.elimination
import lcp_piles.linear.kernel
from lcp_piles import contact_system, tss
from lcp_piles.linear.banded import lower_band
from lcp_piles.linear.definite import is_positive_definite
from lcp_piles.linear.elimination import pivots, product
from lcp_piles.linear.integer_product import times
from lcp_piles.linear.kernel import common_denominators, kernel


@st.composite
def matrices(draw):
    """Integer matrices of every shape and rank, some rows and columns repeated or zero."""
    rows, columns = draw(st.integers(1, 7)), draw(st.integers(1, 7))
    inner = draw(st.integers(0, min(rows, columns)))
    entry = st.integers(-6, 6)
    left = draw(st.lists(entry, min_size=rows * inner, max_size=rows * inner))
    right = draw(st.lists(entry, min_size=inner * columns, max_size=inner * columns))
    A = np.array(left, dtype=np.int64).reshape(rows, inner)
    return A @ np.array(right, dtype=np.int64).reshape(inner, columns)


def exact(A):
    return fmpz_mat(*A.shape, [int(x) for x in A.ravel()])


def assert_kernel(A):
    basis, pinned = kernel(csr_array(A))
    columns = A.shape[1]
    assert len(basis) == columns - exact(A).rank()
    assert len(pinned) == len(basis)
    for k, vector in enumerate(basis):
        assert all(x == 0 for x in (exact(A) * fmpz_mat(columns, 1, vector)).entries())
        assert [i for i, j in enumerate(pinned) if vector[j] != 0] == [k]
    # With the pinned columns left out nothing is free any more.
    rest = [j for j in range(columns) if j not in pinned]
    assert not rest or exact(A[:, rest]).rank() == len(rest)


def assert_independent(A):
    chosen = pivots(csr_array(A)).rows
    assert len(chosen) == exact(A).rank()
    assert not chosen or exact(A[chosen]).rank() == len(chosen)


@given(matrices())
def test_kernel_and_independent_rows(A):
    assert_kernel(A)
    assert_independent(A)


def greedy(A, preference):
    """Row after row in this order, each kept that is independent of those kept before."""
    kept = []
    for k in preference:
        if exact(A[[*kept, k]]).rank() > len(kept):
            kept.append(k)
    return sorted(kept)


@given(matrices(), st.data())
def test_pivots_are_the_preferred_rows_and_independent_columns(A, data):
    preference = data.draw(st.permutations(range(len(A))))
    found = pivots(csr_array(A), preference)
    assert found.rows == greedy(A, preference)
    assert len(found.columns) == len(found.rows)
    assert not found.columns or exact(A[:, found.columns]).rank() == len(found.columns)
    assert pivots(csr_array(A)).rows == greedy(A, range(len(A)))


def test_the_prime_is_none_that_small_numbers_hide():
    for k in range(1, 3000):
        assert pivots(csr_array(np.array([[1, 0], [0, k]]))).rows == [0, 1]


@given(matrices(), st.data())
def test_products_modulo_the_prime(A, data):
    scale = data.draw(st.sampled_from([1, 2**20, 2**40]))
    entry = st.integers(-(10**30), 10**30)
    vectors = data.draw(
        st.lists(st.lists(entry, min_size=A.shape[1], max_size=A.shape[1]), max_size=3)
    )
    found = product(csr_array(A * scale), vectors).toarray()
    wanted = [
        [sum(scale * int(a) * x for a, x in zip(row, v, strict=True)) for v in vectors] for row in A
    ]
    assert found.tolist() == [[x % (2**31 - 1) for x in row] for row in wanted]


def test_pivots_of_a_long_band():
    """Rows of three entries each: their windows move on many times."""
    rng = np.random.default_rng(4)
    A = np.zeros((90, 60), dtype=np.int64)
    for k, row in enumerate(A):
        at = min(2 * k // 3, 57)
        row[at : at + 3] = rng.integers(-2, 3, 3)
    A = A[:, rng.permutation(60)]
    preference = rng.permutation(90).tolist()
    assert pivots(csr_array(A), preference).rows == greedy(A, preference)


def no_proposal(B):
    return None


def everything_depends(B):
    return list(range(B.shape[1]))


@pytest.mark.parametrize("proposal", [no_proposal, everything_depends])
@pytest.mark.parametrize("prime", [2, 3, 5])
@given(A=matrices())
def test_proposals_that_mislead_cannot_make_the_kernel_wrong(proposal, prime, A):
    """Modulo a small prime many ranks drop; the exact checks behind have to notice."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lcp_piles.linear.kernel, "_dependent_columns", proposal)
        patch.setattr(lcp_piles.linear.elimination, "PRIME", prime)
        assert_kernel(A)


def test_the_misleading_prime_does_mislead():
    """The test above means something: modulo 2 this matrix has rank 0, and its kernel is zero."""
    A = csr_array(np.array([[2, 0], [0, 4]]))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lcp_piles.linear.kernel, "_dependent_columns", no_proposal)
        patch.setattr(lcp_piles.linear.elimination, "PRIME", 2)
        assert pivots(A).rows == []
        assert kernel(A) == ([], [])


def is_definite(K):
    """Sylvester's criterion, in integers."""
    return all(exact(K[:k, :k]).det() > 0 for k in range(1, len(K) + 1))


@given(matrices(), st.integers(-1, 1), st.sampled_from([1, 10**3, 10**9]))
def test_a_proof_of_definiteness_is_true(A, shift, scale):
    """Floating point may fail to prove, but never proves what is false, however close it is."""
    K = A @ A.T * scale + shift * np.eye(len(A), dtype=np.int64)
    if is_positive_definite(csr_array(K)):
        assert is_definite(K)


@given(matrices())
def test_a_matrix_far_from_singular_is_proved_definite(A):
    assert is_positive_definite(csr_array(A @ A.T + np.eye(len(A), dtype=np.int64)))


@pytest.mark.parametrize("n", [2**13, 2**22, 2**26])
def test_definiteness_on_the_edge(n):
    """[[n + 1, n], [n, n - 1]] has determinant -1: to floats as good as definite for a large n."""
    assert not is_positive_definite(csr_array(np.array([[n + 1, n], [n, n - 1]])))
    assert not is_positive_definite(csr_array(np.array([[n, n], [n, n]])))


@pytest.mark.parametrize("shape", [(0, 3), (3, 0), (0, 0)])
def test_matrices_without_rows_or_columns(shape):
    basis, pinned = kernel(csr_array(np.zeros(shape, dtype=np.int64)))
    assert basis == np.eye(shape[1], dtype=int).tolist()
    assert pinned == list(range(shape[1]))


@given(matrices(), st.data())
def test_times_in_integers_of_any_size(A, data):
    vector = data.draw(
        st.lists(st.integers(-(10**50), 10**50), min_size=A.shape[1], max_size=A.shape[1])
    )
    product = times(csr_array(A), [fmpz(x) for x in vector])
    assert product == [sum(int(a) * x for a, x in zip(row, vector, strict=True)) for row in A]


def test_entries_that_floating_point_does_not_show_come_from_the_exact_solver(monkeypatch):
    A = np.array([[1009, -913, 0, 813], [0, 1019, -1021, 577]])
    read = lcp_piles.linear.kernel._read_off
    seen = []

    def watched(*words):
        found = read(*words)
        seen.append(list(found))
        return found

    monkeypatch.setattr(lcp_piles.linear.kernel, "_read_off", watched)
    monkeypatch.setattr(lcp_piles.linear.kernel, "pivots", None)  # no second proposal is needed
    assert_kernel(A)
    assert seen == [[None, None]]


def test_mechanisms_of_a_pile_are_read_off_floats(monkeypatch):
    """Their entries are short: no exact solve is needed."""
    system = contact_system(tss(8))
    loaded = np.arange(system.contacts) % 3 > 0
    read = lcp_piles.linear.kernel._read_off
    seen = []

    def watched(*words):
        seen.extend(read(*words))
        return list(seen)

    monkeypatch.setattr(lcp_piles.linear.kernel, "_read_off", watched)
    basis, pinned = kernel(csr_array(system.B[loaded]))
    assert len(seen) == len(basis) == len(pinned) > 3
    assert None not in seen


def test_a_band_too_wide_to_store_leaves_the_same_kernel(monkeypatch):
    monkeypatch.setattr(lcp_piles.linear.kernel, "lower_band", partial(lower_band, most=1))
    assert_kernel(np.array([[1, -2, 0, 3], [0, 1, 1, -1]]))


@given(
    st.lists(st.fractions(max_denominator=60).filter(lambda x: abs(x) < 1000), min_size=1),
    st.floats(-1, 1),
)
def test_denominators_are_read_off_floats(numbers, noise):
    common = lcm(*(x.denominator for x in numbers))
    column = np.array([float(x) * (1 + noise * 1e-13) for x in numbers])
    assert common_denominators(column[:, None]).tolist() == [common if common < 2**30 else 0]


@pytest.mark.parametrize("x", [2**0.5, 1 / 5003, 1e300, np.inf, np.nan])
def test_no_denominator_is_seen_where_there_is_none(x):
    X = np.array([[x], [0.5]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert common_denominators(X).tolist() == [2 if x == 1e300 else 0]


def test_products_of_short_and_of_long_integers():
    B = csr_array(np.array([[1, -2, 0], [0, 3, 1]]))
    for scale in (1, 2**30, 2**31, 2**200):
        vector = [fmpz(x * scale) for x in (1, -5, 7)]
        assert times(B, vector) == [11 * scale, -8 * scale]
