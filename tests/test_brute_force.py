"""Small piles by trying all 2^c sets of closed contacts, in Q(sqrt(3)) and without any gauge.

On each set S the forces of least energy that balance the load are found, whatever their signs. Of
those that pull nowhere the one of least energy is the solution: it is the least on its own S.
"""

import pytest
from flint import fmpq, fmpq_mat
from helpers import ZERO, along, fmpq_of, small_fractions, subsets, with_gaps
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import Surd, pile, solve, surd

ROOT = surd("sqrt(3)")
SMALL = ["nt60-2", "nt60-3", "nt30-2", "tss-2", "tss-3", "tbs-1", "tbs-2"]


def named(name, **parameters):
    kind, layers = name.split("-")
    return pile(kind, int(layers), **parameters)


def pair(x: Surd) -> list[fmpq]:
    """[a, b] of a + b sqrt(3)."""
    parts = dict(x.terms)
    assert set(parts) <= {1, 3}
    return [fmpq_of(parts.get(r, 0)) for r in (1, 3)]


def over_rationals(rows):
    """A matrix over Q(sqrt(3)) as one over Q: a + b sqrt(3) becomes [[a, 3 b], [b, a]]."""
    table = []
    for row in rows:
        pairs = [pair(x) for x in row]
        table.append([y for a, b in pairs for y in (a, 3 * b)])
        table.append([y for a, b in pairs for y in (b, a)])
    return fmpq_mat(table)


def some_solution(K, right):
    """Any u with K u = right, or None where there is none."""
    n = K.ncols()
    reduced, rank = fmpq_mat([[*row, r] for row, r in zip(K.tolist(), right, strict=True)]).rref()
    u = [fmpq(0)] * n
    for i in range(rank):
        j = next(j for j in range(n + 1) if reduced[i, j] != 0)
        if j == n:
            return None
        u[j] = reduced[i, n]
    return [surd(a) + surd(b) * ROOT for a, b in zip(u[::2], u[1::2], strict=True)]


def balanced_forces(scene):
    """For every contact set that can hold the load without pulling: its energy and its forces.

    With u the multipliers of the balance, f = -(B u + o) / c on the set, so the balance
    B^T f + p = 0 becomes sum b b^T / c u = p - sum b o / c. Where u is not unique, f is.
    """
    axes = range(scene.dimension)
    free = [(disc, a) for disc in scene.discs for a in axes if disc.held[a] is None]
    load = [disc.load[a] for disc, a in free]
    rows, gaps = [], []
    for contact in scene.contacts:
        signs = {contact.a: 1, contact.b: -1}
        rows.append([signs.get(disc.id, 0) * contact.normal[a] for disc, a in free])
        held = ((disc, signs[disc.id]) for disc in scene.discs if disc.id in signs)
        shifts = (s * along(contact.normal, [h or ZERO for h in d.held]) for d, s in held)
        gaps.append(sum(shifts, contact.gap))
    soft = [contact.compliance for contact in scene.contacts]
    tensors = [
        over_rationals([[x * y / c for y in row] for x in row])
        for row, c in zip(rows, soft, strict=True)
    ]
    found = []
    for chosen in subsets(len(rows)):
        K = sum((tensors[k] for k in chosen), fmpq_mat(2 * len(free), 2 * len(free)))
        right = [
            p - sum((rows[k][i] * gaps[k] / soft[k] for k in chosen), ZERO)
            for i, p in enumerate(load)
        ]
        u = some_solution(K, [y for x in right for y in pair(x)])
        if u is None:
            continue
        forces = [ZERO] * len(rows)
        for k in chosen:
            forces[k] = -(along(rows[k], u) + gaps[k]) / soft[k]
        if all(f >= 0 for f in forces):
            terms = zip(forces, gaps, soft, strict=True)
            found.append((sum((c * f * f / 2 + o * f for f, o, c in terms), ZERO), forces))
    return found


def assert_least_energy(scene):
    _, best = min(balanced_forces(scene), key=lambda pair: pair[0])
    for method in ("proved", "lemke"):
        assert list(solve(scene, method).forces) == best


@pytest.mark.parametrize("name", SMALL)
def test_small_piles(name):
    assert_least_energy(named(name))


@pytest.mark.parametrize("name", [name for name in SMALL if not name.startswith("tbs")])
@pytest.mark.parametrize("push", [20, "-7/3 + sqrt(3)"])
def test_small_piles_pushed(name, push):
    assert_least_energy(named(name, push=push, floor_compliance="1/2"))


@pytest.mark.parametrize("name", ["nt60-2", "nt30-2"])
def test_small_piles_with_resting_corner_stones(name):
    assert_least_energy(named(name, corner_stones="resting"))


@settings(max_examples=6)
@given(st.sampled_from(["nt30-2", "tss-3", "tbs-2"]), st.data())
def test_small_piles_with_random_initial_gaps(name, data):
    scene = named(name)
    n = len(scene.contacts)
    assert_least_energy(
        with_gaps(scene, data.draw(st.lists(small_fractions, min_size=n, max_size=n)))
    )
