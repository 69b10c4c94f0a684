"""The affine hull of a feasible set: against brute force over vertices, and by hand."""

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import surd
from lcp_piles.errors import VerificationError
from lcp_piles.friction.equations import balance
from lcp_piles.programs import affine_hull as module
from lcp_piles.programs.affine_hull import affine_hull
from lcp_piles.programs.constraints import constraints
from lcp_piles.scenes.kinds import pile


def vertices(A, b):
    """Every basic feasible point, with sympy."""
    A, b = sympy.Matrix(A), sympy.Matrix(b)
    n = A.shape[1]
    found = []
    for size in range(n + 1):
        for support in combinations(range(n), size):
            part = A[:, list(support)]
            if part.rank() < size:
                continue
            if part.row_join(b).rank() > size:
                continue
            x = [sympy.S(0)] * n
            if size:
                solution = (part.T * part).LUsolve(part.T * b)
                for j, value in zip(support, solution, strict=True):
                    x[j] = value
            if min(x) >= 0 and x not in found:
                found.append(x)
    return found


@st.composite
def bounded_sets(draw):
    """Slices of a simplex: bounded, so that vertices say it all."""
    n, m = draw(st.integers(2, 5)), draw(st.integers(0, 2))
    small = st.integers(-2, 2)
    A = [[1] * n, *draw(st.lists(st.lists(small, min_size=n, max_size=n), min_size=m, max_size=m))]
    right = st.sampled_from([0, 0, 0, 1, Fraction(1, 3)])
    return A, [1, *(draw(right) for _ in range(m))]


@given(bounded_sets())
@settings(max_examples=40, deadline=None)
def test_against_all_vertices(problem):
    A, b = problem
    corners = vertices(A, [sympy.Rational(str(x)) for x in b])
    hull = affine_hull(constraints(A, b))
    if not corners:
        assert hull is None
        return
    differences = sympy.Matrix(
        [[x - y for x, y in zip(c, corners[0], strict=True)] for c in corners]
    )
    assert hull.dimension == differences.rank()
    columns = list(zip(*corners, strict=True))
    assert hull.zero == tuple(j for j, column in enumerate(columns) if not any(column))
    assert hull.varies == tuple(len(set(column)) > 1 for column in columns)


def test_unbounded_directions_and_irrational_entries_count():
    hull = affine_hull(constraints([[1, "-sqrt(2)", 0], [0, 0, "1 + sqrt(2)"]], ["1/3", 0]))
    assert (hull.dimension, hull.zero, hull.varies) == (1, (2,), (True, True, False))
    point = list(hull.point)
    assert point[0] - surd("sqrt(2)") * point[1] == Fraction(1, 3)
    assert point[1] > 0


@pytest.mark.parametrize("mu", ["1/10*sqrt(3)", "3/10"])
def test_networks_of_a_pile_fill_the_kernel_of_the_equations(mu):
    # No contact of TSS 4 is idle by necessity: the dimension is that of the kernel, in floats.
    matrix, loads, *_ = balance(pile("tss", 4), mu, ())
    A = np.zeros(matrix.shape)
    np.add.at(A, (matrix.rows, matrix.columns), [float(x) for x in matrix.values])
    hull = affine_hull(constraints(matrix, loads))
    assert hull.zero == ()
    assert hull.dimension == A.shape[1] - np.linalg.matrix_rank(A)


def test_a_wrong_proof_is_an_error(monkeypatch):
    monkeypatch.setattr(module, "slopes", lambda problem, y: [0] * len(problem.columns))
    with pytest.raises(VerificationError):
        affine_hull(constraints([[1, 1]], [0]))
