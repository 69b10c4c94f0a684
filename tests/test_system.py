"""The contact system and its LCP as values, and scenes that are none of the four piles."""

from dataclasses import replace
from fractions import Fraction
from operator import mul

import numpy as np
import pytest
import sympy
from helpers import equilibrium_faults, float_matrix, piles
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    SolveError,
    contact_lcp,
    contact_system,
    lemke,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.numbers.vectors import exact_vector
from lcp_piles.pivoting.checks import is_certificate

METHODS = pytest.mark.parametrize("method", ["proved", "lemke"])
ZERO, ONE = surd(0), surd(1)


def numbers(*values):
    return tuple(surd(x) for x in values)


def one_disc(contacts, load=(0, -1)):
    disc = Disc((1,), numbers(*(0 for _ in load)), numbers(*load), (None,) * len(load))
    return Scene((disc,), tuple(contacts), tuple(c.b for c in contacts))


@METHODS
def test_a_disc_in_a_groove_by_hand(method):
    """Walls with normals (3/5, 4/5) and (-4/5, 3/5), at right angles: each takes the part of the
    weight along it, 4/5 and 3/5."""
    scene = one_disc(
        [
            Contact((1,), "left", numbers("3/5", "4/5")),
            Contact((1,), "right", numbers("-4/5", "3/5")),
        ]
    )
    solution = solve(scene, method)
    assert [str(f) for f in solution.forces] == ["4/5", "3/5"]
    # At right angles every wall gives way by its own force.
    assert solution.displacement((1,)) == (0, -1)
    assert verify(scene, solution).ok


@METHODS
def test_a_sphere_on_three_others_by_hand(method):
    """Three dimensions: contacts rise at cos = sqrt(6)/3 to the vertical, so 3 f sqrt(6)/3 = 1."""
    up = "sqrt(6)/3"
    scene = one_disc(
        [
            Contact((1,), "first", numbers("sqrt(3)/3", 0, up)),
            Contact((1,), "second", numbers("-sqrt(3)/6", "1/2", up)),
            Contact((1,), "third", numbers("-sqrt(3)/6", "-1/2", up)),
        ],
        load=(0, 0, -1),
    )
    solution = solve(scene, method)
    assert [f.sympy() for f in solution.forces] == [sympy.sqrt(6) / 6] * 3
    assert solution.displacement((1,)) == (0, 0, -sympy.Rational(1, 2))
    assert equilibrium_faults(scene, solution) == []


@METHODS
def test_a_sphere_that_leans_by_hand(method):
    """Pulled sideways with 1 towards the first support's far side, it lets go of that one."""
    up = "sqrt(6)/3"
    scene = one_disc(
        [
            Contact((1,), "first", numbers("sqrt(3)/3", 0, up)),
            Contact((1,), "second", numbers("-sqrt(3)/6", "1/2", up)),
            Contact((1,), "third", numbers("-sqrt(3)/6", "-1/2", up)),
        ],
        load=("sqrt(2)/4", 0, -1),
    )
    solution = solve(scene, method)
    # f2 = f3 = f with 2 f sqrt(6)/3 = 1 and 2 f sqrt(3)/6 = sqrt(2)/4: both say f = sqrt(6)/4.
    assert [f.sympy() for f in solution.forces] == [0, sympy.sqrt(6) / 4, sympy.sqrt(6) / 4]
    assert equilibrium_faults(scene, solution) == []


def test_scenes_without_a_rational_gauge_are_refused_with_a_reason():
    contacts = [
        Contact((1,), "left", numbers("sqrt(3)/2", "1/2")),
        Contact((1,), "right", numbers("-sqrt(2)/2", "sqrt(2)/2")),
    ]
    with pytest.raises(SolveError, match=r"no scaling of the axes.*\(-1/2\*sqrt\(2\)"):
        solve(one_disc(contacts))


def test_an_asymmetric_scene_has_no_half():
    scene = nt60(4).without([(1, 1), (2, 1)])
    with pytest.raises(SolveError, match="ask for whole"):
        contact_system(scene, "even")
    assert contact_system(scene).reduction.part == "whole"
    assert solve(scene).record.part == "whole"


@pytest.mark.parametrize("spoil", ["load", "gap", "compliance", "held"])
def test_anything_that_breaks_the_symmetry_is_noticed(spoil):
    scene = nt60(3)
    discs, contacts = list(scene.discs), list(scene.contacts)
    if spoil == "load":
        discs[1] = replace(discs[1], load=numbers(0, -2))
    elif spoil == "held":
        discs[3] = replace(discs[3], held=numbers("1/9", 0))
    elif spoil == "gap":
        contacts[0] = replace(contacts[0], gap=surd("1/9"))
    else:
        contacts[0] = replace(contacts[0], compliance=Fraction(2))
    other = Scene(tuple(discs), tuple(contacts))
    assert contact_system(scene).reduction.part == "even"
    assert contact_system(other).reduction.part == "whole"
    assert equilibrium_faults(other, solve(other)) == []


@settings(max_examples=15)
@given(piles())
def test_the_integer_system_is_the_scene_up_to_one_factor_a_contact_and_an_axis(scene):
    """B of the gauge against n . (u_a - u_b) from the scene's own normals, in floats."""
    system = contact_system(scene, "whole")
    assert np.issubdtype(system.B.dtype, np.integer)
    assert all(type(c) is Fraction for c in system.compliance)
    B, _, _ = float_matrix(scene)
    held = np.array([h is not None for disc in scene.discs for h in disc.held])
    axis = np.arange(len(held))[~held] % 2
    stretch = np.array([float(x) for x in system.displacement_factor])[axis]
    gap = np.array([float(x) for x in system.gap_factor])[system.factor_of]
    assert np.allclose(gap[:, None] * system.B.toarray() / stretch, B)


@pytest.mark.parametrize(
    ("scene", "half", "whole"),
    [
        # 8 free discs, two of them on the axis and with one freedom there; 18 contacts between
        # discs and 2 with the floor, of which (2,1)-(2,2) and (4,2)-(4,3) are their own images.
        (nt60(4), (8, 11), (16, 20)),
        # (1,1), (3,2) on the axis, (2,1) and (2,2) beside it; two upright contacts on the axis.
        (tss(3), (4, 5), (8, 8)),
        # (1,1) on the axis, (2,2) and (2,3) beside it; (2,2)-(2,3) is its own image.
        (nt30(2), (3, 4), (6, 7)),
    ],
)
def test_sizes_before_and_after_the_reduction(scene, half, whole):
    record = solve(scene).record
    assert (record.dof, record.contacts) == half
    assert (record.whole_dof, record.whole_contacts) == whole


@settings(max_examples=15)
@given(piles(rigid=False))
def test_the_lcp_is_symmetric_semidefinite_of_the_rank_of_the_self_stresses(scene):
    """And any other solver may have it: exact and dense, floating and dense, sparse."""
    system = contact_system(scene)
    problem = contact_lcp(system).problem
    exact = problem.M
    assert exact == [list(row) for row in zip(*exact, strict=True)]
    M, q = problem.floats()
    assert np.allclose(M, [[float(x) for x in row] for row in exact])
    assert np.allclose(q, [float(x) for x in problem.q])
    sparse, _ = problem.sparse()
    assert (sparse.toarray() == M).all()
    eigenvalues = np.linalg.eigvalsh(M)
    scale = max(1.0, float(np.abs(M).max()))
    assert eigenvalues.min() > -1e-9 * scale
    rank = np.linalg.matrix_rank(system.B.toarray().astype(float))
    assert int((eigenvalues > 1e-9 * scale).sum()) == system.contacts - rank
    assert list(lemke(exact, list(problem.q)).w) == list(lemke(problem).w)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda c: replace(c, normal=numbers(1, 1)), "normal of contact.*an exact unit vector"),
        (lambda c: replace(c, normal=numbers(1)), "normal of contact"),
        (
            lambda c: replace(c, compliance=0.5),
            r"compliance of contact \(1,1\)-\(2,1\) is 0\.5.*floats_exactly",
        ),
        (lambda c: replace(c, a=(7, 7)), "a contact is .*expected discs of the scene"),
        (lambda c: replace(c, b=(7, 7)), "a contact is .*expected discs of the scene"),
    ],
)
def test_bad_contacts_are_refused(change, message):
    scene = nt60(2)
    with pytest.raises(InputError, match=message):
        Scene(scene.discs, (change(scene.contacts[0]), *scene.contacts[1:]))


def test_bad_discs_are_refused():
    scene = nt60(2)
    with pytest.raises(InputError, match="at least one disc"):
        Scene((), ())
    with pytest.raises(InputError, match="every id once"):
        Scene(scene.discs * 2, ())
    with pytest.raises(InputError, match="2 components"):
        Scene((replace(scene.discs[0], load=(ONE,)), scene.discs[1]), ())
    with pytest.raises(InputError, match="the method is 'magic', expected one of"):
        solve(scene, "magic")


@settings(max_examples=15)
@given(piles(), st.randoms(use_true_random=False))
def test_products_with_the_matrix_are_those_of_its_columns(scene, random):
    """M z and M^T y by one exact solve each, for any set that starts closed without mechanisms."""
    system = contact_system(scene)
    closed = np.array([c != 0 or random.random() < 0.5 for c in system.compliance])
    try:
        problem = contact_lcp(system, closed).problem
    except SolveError:
        closed[:] = True
        problem = contact_lcp(system, closed).problem
    M = problem.M
    z = exact_vector([Fraction(random.randint(-9, 9), random.randint(1, 5)) for _ in M])
    v = list(z)
    assert list(problem.times(z)) == [sum(map(mul, row, v), ZERO) for row in M]
    assert list(problem.transpose_times(z)) == [
        sum(map(mul, column, v), ZERO) for column in zip(*M, strict=True)
    ]


def test_the_certificate_of_a_collapse_costs_no_column():
    """One exact solve gives M^T y; a column for every contact was nearly all of the time."""
    scene = tbs(8).without([(9, 3), (10, 3), (10, 4)])
    problem = contact_lcp(contact_system(scene)).problem
    asked = []

    def column(j):
        asked.append(j)
        return problem.column(j)

    result = lemke(replace(problem, column=column))
    assert result.certificate is not None
    assert len(asked) <= result.pivots
    assert is_certificate(problem, result.certificate)
    negative = [-x for x in result.certificate]
    assert not is_certificate(problem, negative)
    assert not is_certificate(problem, [Fraction(1)] * len(problem))
