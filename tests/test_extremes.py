"""Corners and volume of the set of admissible networks, against all bases in floating point.

A corner of {x >= 0, A x = b} is a point whose positive columns are independent, so every corner is
found by solving for each choice of as many columns as A has rank. The volume is that of the convex
hull of the corners by Qhull.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from lcp_piles import (
    SolveError,
    contact_bounds,
    extremes,
    indeterminacy,
    nt30,
    nt60,
    surd,
    tbs,
    tss,
)
from lcp_piles.friction.equations import balance, friction_problem
from lcp_piles.friction.indeterminacy import is_admissible
from lcp_piles.programs.vertices import TooManyError, vertices, volume

SCENES = [
    (tbs(1), "0", ()),
    (tbs(1), "1/5*sqrt(3)", ()),
    (tbs(2), "0", ()),
    (nt60(3), "0", ()),
    (nt30(2), "1/10*sqrt(3)", ()),
    (nt30(2), "3/10", ()),
    (tss(3), "1/5*sqrt(3)", ()),
    (tss(3), "1/5*sqrt(3)", ("floor",)),
]


def corners_by_bases(scene, mu, rough) -> list[np.ndarray]:
    """Normal forces of all corners, in floats."""
    given = balance(scene, mu, rough)
    A = np.zeros(given.matrix.shape)
    for i, j, x in zip(given.matrix.rows, given.matrix.columns, given.matrix.values, strict=True):
        A[i, j] += float(x)
    b = np.array([float(x) for x in given.loads])
    rank, found = np.linalg.matrix_rank(A), {}
    for columns in combinations(range(A.shape[1]), int(rank)):
        part = A[:, columns]
        if np.linalg.matrix_rank(part, tol=1e-9) < rank:
            continue
        x = np.linalg.lstsq(part, b, rcond=None)[0]
        if x.min(initial=0) > -1e-9 and np.abs(part @ x - b).max() < 1e-9:
            whole = np.zeros(A.shape[1])
            whole[list(columns)] = x
            found[tuple(np.round(whole, 7) + 0.0)] = whole
    return list(found.values())


@pytest.mark.parametrize(("scene", "mu", "rough"), SCENES, ids=lambda x: str(x)[:24])
def test_the_corners_are_those_of_all_bases(scene, mu, rough) -> None:
    found = extremes(scene, mu, rough)
    expected = corners_by_bases(scene, mu, rough)
    problem = friction_problem(scene, mu, rough)
    mine = []
    for network in found.networks:
        assert is_admissible(problem, network.normal, network.tangential)
        x = np.zeros(len(problem.constraints.columns))
        slip = network.tangential.array() / (float(surd(mu)) or 1.0)
        for k, (p, m) in enumerate(zip(problem.plus, problem.minus, strict=True)):
            f = network.normal.array()[k]
            if p == m:
                x[p] = f
            else:
                x[p], x[m] = (f + slip[k]) / 2, (f - slip[k]) / 2
        mine.append(x)
    assert len(mine) == len(expected)
    for x in mine:
        assert min(np.abs(x - y).max() for y in expected) < 1e-8


def test_the_volume_is_that_of_qhull() -> None:
    for scene, mu in ((tbs(1), "1/5*sqrt(3)"), (tbs(2), "0"), (tss(3), "1/5*sqrt(3)")):
        found = extremes(scene, mu)
        assert not found.rays
        assert len(found.coordinates) == indeterminacy(scene, mu).dimension
        friction = float(surd(mu))
        points = []
        for network in found.networks:
            normal, shear = network.normal.array(), network.tangential.array()
            points.append(
                [
                    normal[k] if not side else (normal[k] + side * shear[k] / friction) / 2
                    for k, side in found.coordinates
                ]
            )
        assert float(found.volume) == pytest.approx(ConvexHull(points).volume, rel=1e-9)


def test_tbs_2_without_friction_is_a_cube() -> None:
    """Each of its three discs in turn may lean or stand by itself: a closed form."""
    found = extremes(tbs(2), 0)
    assert (len(found.networks), found.volume) == (8, 1)


@pytest.mark.parametrize(("scene", "mu"), [(tss(3), "1/5*sqrt(3)"), (nt30(2), "3/10")])
def test_the_corners_reach_the_bounds(scene, mu) -> None:
    """Where there is no ray along a force, its least and largest values are at corners."""
    found, bounds = extremes(scene, mu), contact_bounds(scene, mu)
    for k, (least, largest) in enumerate(zip(bounds.least, bounds.largest, strict=True)):
        values = [network.normal[k] for network in found.networks]
        assert min(values) == least
        assert (largest is None) == any(ray.normal[k] for ray in found.rays)
        if largest is not None:
            assert max(values) == largest


@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 4), max_size=4))
@settings(max_examples=40, deadline=None)
def test_a_cut_cube_has_the_volume_of_qhull(cuts) -> None:
    """The cube [0, 2]^3 cut by planes that leave its centre inside."""
    rows = [[int(i == k) for i in range(3)] for k in range(3)]
    D = [*rows, *([-x for x in row] for row in rows), *(list(cut[:3]) for cut in cuts)]
    c = [0] * 3 + [2] * 3 + [abs(cut[3]) + 1 - sum(cut[:3]) for cut in cuts]
    found = vertices([surd(x) for x in c], [[surd(x) for x in row] for row in D])
    assert not found.rays
    points = np.array([[float(x) for x in point] for point in found.points])
    assert (np.array(D) @ points.T + np.array(c)[:, None] > -1e-12).all()
    hull = ConvexHull(points)
    assert len(hull.vertices) == len(points)
    assert float(volume(found)) == pytest.approx(hull.volume, rel=1e-9)
    assert volume(found) <= Fraction(8)


def test_what_is_not_tiny_is_refused() -> None:
    with pytest.raises(SolveError, match="92 force components: corners are listed for at most 60"):
        extremes(nt30(4), "1/10*sqrt(3)")
    with pytest.raises(TooManyError, match="more than 400 rays"):
        extremes(tss(4), "1/10*sqrt(3)")
    assert extremes(tbs(2), "1/10*sqrt(3)").volume is None
