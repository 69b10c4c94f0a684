"""Rigid contacts anywhere: forces that need not be unique, and overlaps that nothing can cure."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from helpers import equilibrium_faults, float_matrix, image_contacts
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from lcp_piles import Scene, SolveError, pile, solve, surd


def with_rigid(scene, rigid, gaps):
    contacts = tuple(
        replace(contact, compliance=Fraction(0 if hard else 1), gap=surd(gap))
        for contact, hard, gap in zip(scene.contacts, rigid, gaps, strict=True)
    )
    return Scene(scene.discs, contacts)


@st.composite
def hard_piles(draw):
    kind = draw(st.sampled_from(["nt60", "nt30", "tss", "tbs"]))
    scene = pile(kind, draw(st.integers(2, 2 if kind == "nt30" else 3)))
    n = len(scene.contacts)
    rigid = draw(st.lists(st.booleans(), min_size=n, max_size=n))
    gaps = draw(st.lists(st.sampled_from([0, 0, 0, 1, -1]), min_size=n, max_size=n))
    if draw(st.booleans()):
        rigid, gaps = [True] * n, [0] * n
    if draw(st.booleans()):
        images = [min(pair) for pair in enumerate(image_contacts(scene))]
        rigid, gaps = [rigid[k] for k in images], [gaps[k] for k in images]
    return with_rigid(scene, rigid, gaps)


def newton_finds_this_singular():
    scene = pile("tss", 3, push=5)
    return with_rigid(scene, [k != 5 for k in range(8)], [1, 0, 0, 0, 1, -1, 0, -1])


def fits(scene):
    """Whether some displacements leave no rigid contact overlapping."""
    B, o, _ = float_matrix(scene)
    rigid = np.array([contact.compliance == 0 for contact in scene.contacts])
    size = B.shape[1]
    # The largest t with B u + o >= t at all rigid contacts.
    rows = np.hstack([-B[rigid], np.ones((rigid.sum(), 1))])
    bounds = [(None, None)] * size + [(None, 1)]
    best = linprog(np.append(np.zeros(size), -1), A_ub=rows, b_ub=o[rigid], bounds=bounds)
    assert best.status == 0
    return -best.fun > -1e-7


def ranges(scene, forces):
    """Least and largest force of every rigid contact over all solutions.

    All have the same elastic forces and the same o . f, because both follow from least energy.
    """
    B, o, p = float_matrix(scene)
    elastic = [k for k, contact in enumerate(scene.contacts) if contact.compliance]
    A = np.vstack([B.T, o, np.eye(len(o))[elastic]])
    b = np.concatenate([-p, [o @ forces], forces[elastic]])
    found = {}
    for k in set(range(len(o))) - set(elastic):
        one = np.eye(len(o))[k]
        low, high = (linprog(s * one, A_eq=A, b_eq=b) for s in (1, -1))
        assert low.status == 0
        assert high.status in (0, 3)  # 3: as large as you like
        found[k] = (low.fun, np.inf if high.status == 3 else -high.fun)
    return found


@pytest.mark.parametrize("method", ["proved", "lemke"])
@settings(max_examples=25)
@given(scene=hard_piles())
@example(scene=newton_finds_this_singular())
def test_rigid_contacts_anywhere(method, scene):
    if not fits(scene):
        with pytest.raises(SolveError, match="rigid contacts"):
            solve(scene, method)
        return
    solution = solve(scene, method)
    assert solution.status == "solved"
    assert equilibrium_faults(scene, solution) == []
    found = ranges(scene, solution.force_array)
    assert solution.forces_unique == all(high - low < 1e-7 for low, high in found.values())
    for k, (_, high) in found.items():  # closed: some solution loads it
        assert (solution.states[k] == "closed") == (high > 1e-7)
