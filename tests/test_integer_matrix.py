"""Parts, blocks, products and kernels of integer matrices of any size, against Python's integers.

The same tables as numpy arrays of objects, and flint's ranks, say what is right.
"""

import numpy as np
import pytest
from flint import fmpz, fmpz_mat
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array

import lcp_piles.linear.elimination
from lcp_piles.linear.elimination import PRIME, pivots
from lcp_piles.linear.integer_matrix import BigMatrix, dense, diagonal, integer_matrix, residues
from lcp_piles.linear.integer_product import product, times, times_words
from lcp_piles.linear.kernel import kernel
from lcp_piles.linear.rearrangement import (
    blocks,
    columns_of,
    diagonal_of_rows,
    rows_of,
    rows_reaching,
    transposed,
)

ENTRIES = st.sampled_from(
    [0, 0, 0, 1, -2, 3, 2**31, -(2**31) - 1, 2**61, 2**62 - 1, -(2**62), 10**30, -(10**30) - 7]
)


def tables(rows=None, columns=None):
    """Tables of integers, short and long, as arrays of objects."""
    sizes = st.integers(1, 4)
    return st.tuples(
        sizes if rows is None else st.just(rows), sizes if columns is None else st.just(columns)
    ).flatmap(
        lambda shape: st.lists(
            ENTRIES, min_size=shape[0] * shape[1], max_size=shape[0] * shape[1]
        ).map(lambda x: np.array(x, dtype=object).reshape(shape))
    )


def assert_is(A, table):
    """The matrix is the table, in int64 exactly where that holds it."""
    assert A.shape == table.shape
    assert [[int(x) for x in row] for row in dense(A).tolist()] == table.tolist()
    assert isinstance(A, BigMatrix) == any(abs(x) >= 2**62 for x in table.ravel())


@given(tables(), st.data())
def test_parts(table, data):
    A = integer_matrix(table)
    for axis, part in ((0, rows_of), (1, columns_of)):
        size = table.shape[axis]
        places = data.draw(st.lists(st.integers(0, size - 1), min_size=1))
        mask = np.array(data.draw(st.lists(st.booleans(), min_size=size, max_size=size)))
        assert_is(part(A, places), table.take(places, axis))
        assert_is(part(A, mask), table.compress(mask, axis))
    reached = rows_reaching(A, mask)
    assert reached.tolist() == np.flatnonzero((table[:, mask] != 0).any(axis=1)).tolist()
    assert_is(transposed(A), table.T)


@given(tables(2, 3), tables(2, 2), tables(1, 3), tables(1, 2))
def test_blocks(one, two, three, four):
    made = blocks([[integer_matrix(x) for x in row] for row in ([one, two], [three, four])])
    assert_is(made, np.block([[one, two], [three, four]]))
    apart = np.zeros((2, 6), dtype=object)
    apart[0, :3], apart[1, 3:] = one
    assert_is(diagonal_of_rows(integer_matrix(one)), apart)
    assert_is(diagonal(two[0].tolist()), np.diag(two[0]))


@given(tables(3, 2), tables(2, 3), st.lists(ENTRIES, min_size=2, max_size=2))
def test_products(one, two, vector):
    A, B = integer_matrix(one), integer_matrix(two)
    assert_is(product(A, B), one @ two)
    expected = [sum(a * x for a, x in zip(row, vector, strict=True)) for row in one]
    assert times(A, [fmpz(x) for x in vector]) == expected
    words = [x % 2**40 for x in vector]
    expected = [sum(a * x for a, x in zip(row, words, strict=True)) for row in one]
    assert times_words(A, np.array(words)) == expected
    assert residues(A, PRIME).toarray().tolist() == (one % PRIME).tolist()


@pytest.mark.parametrize("prime", [2, PRIME])
@given(tables())
def test_kernels(prime, table):
    """As many vectors as flint's rank says, all in the kernel, whatever the prime."""
    A = integer_matrix(table)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lcp_piles.linear.elimination, "PRIME", prime)
        basis, pinned = kernel(A)
    rank = fmpz_mat(table.tolist()).rank()
    assert len(basis) == len(pinned) == table.shape[1] - rank
    for vector, own in zip(basis, pinned, strict=True):
        assert [j for j in pinned if vector[j] != 0] == [own]
        assert not any(times(A, vector))
    assert len(pivots(A).rows) <= rank  # a prime may divide a minor, 2^62 - 1 for one


def test_the_kernel_of_long_rows_in_a_band():
    """By hand: rows q u_j = u_(j + 1), so u_j = q^j."""
    n, q = 30, 10**25
    table = np.zeros((n - 1, n), dtype=object)
    for j in range(n - 1):
        table[j, j], table[j, j + 1] = q, -1
    assert kernel(integer_matrix(table))[0] == [[fmpz(q) ** j for j in range(n)]]
    assert kernel(csr_array(np.array([[2**61]])))[0] == []
