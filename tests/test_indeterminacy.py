"""What Coulomb's law leaves open: dimensions by counting, by hand, and from the intervals."""

import csv

import numpy as np
import pytest
from test_cli import run
from test_friction import assert_admissible

from lcp_piles import (
    Contact,
    Disc,
    Scene,
    contact_bounds,
    first_loading,
    indeterminacy,
    nt30,
    nt60,
    pile,
    solve,
    surd,
    tbs,
    tss,
)
from lcp_piles.friction.equations import balance, friction_problem
from lcp_piles.friction.force_bounds import InadmissibleError
from lcp_piles.friction.indeterminacy import is_admissible
from lcp_piles.numbers.vectors import exact_vector


@pytest.mark.parametrize(
    ("scene", "mu", "rough"),
    [
        (nt30(4), 0, ()),
        (nt30(4), "3/10", ()),
        (nt60(4), "1/10*sqrt(3)", ("floor",)),
        (tss(5), "3/10", ("floor",)),
        (tbs(3), "1/10*sqrt(3)", ()),
    ],
    ids=str,
)
def test_ranks_and_dimensions(scene, mu, rough):
    found = indeterminacy(scene, mu, rough)
    matrix, *_ = balance(scene, mu, rough)
    A = np.zeros(matrix.shape)
    np.add.at(A, (matrix.rows, matrix.columns), [float(x) for x in matrix.values])
    assert (found.unknowns, found.rank) == (A.shape[1], np.linalg.matrix_rank(A))
    assert_admissible(scene, found.network, mu, rough)
    # Without implied equalities the set fills the kernel.
    assert found.dimension <= found.hyperstaticity
    if not (found.unloaded or found.limiting):
        assert found.dimension == found.hyperstaticity


@pytest.mark.parametrize(("kind", "mu"), [("nt60", 0), ("tss", "3/10"), ("tbs", "1/10*sqrt(3)")])
def test_determined_and_unloaded_contacts_are_those_of_the_intervals(kind, mu):
    scene = pile(kind, 3)
    found, bounds = indeterminacy(scene, mu), contact_bounds(scene, mu)
    assert set(found.unloaded) == {k for k, x in enumerate(bounds.largest) if x == 0}
    for k in found.determined:
        assert bounds.least[k] == bounds.largest[k]
    positive = {k for k, f in enumerate(found.network.normal) if f > 0}
    assert positive == set(range(len(scene.contacts))) - set(found.unloaded)


def test_contacts_at_the_limit_in_every_network():
    # Two free discs on a rough floor, a third on top, with just the friction they need, the tangent
    # of 15 degrees: both lines of force through the top disc are at the edge of the cones.
    discs = [
        Disc(1, (-1, 0), (0, -1), (None, None)),
        Disc(2, (1, 0), (0, -1), (None, None)),
        Disc(3, (0, "sqrt(3)"), (0, -1), (None, None)),
    ]
    contacts = [
        Contact(3, 1, ("1/2", "1/2*sqrt(3)")),
        Contact(3, 2, ("-1/2", "1/2*sqrt(3)")),
        Contact(2, 1, (1, 0)),
        Contact(1, "floor", (0, 1)),
        Contact(2, "floor", (0, 1)),
    ]
    found = indeterminacy(Scene(discs, contacts), "2 - sqrt(3)", ("floor",))
    assert found.dimension == 0
    assert found.determined == (0, 1, 2, 3, 4)
    assert (found.unloaded, found.limiting) == ((2,), (0, 1))
    less = surd("2 - sqrt(3)") - surd("1/1000000")
    with pytest.raises(InadmissibleError):
        indeterminacy(Scene(discs, contacts), less, ("floor",))


def test_what_is_admissible():
    scene, mu = nt30(3), surd("1/10*sqrt(3)")
    problem = friction_problem(scene, mu)
    forces, nothing = solve(scene).forces, exact_vector([0] * len(scene.contacts))
    assert is_admissible(problem, forces, nothing)
    network = first_loading(scene, mu).network
    assert is_admissible(problem, network.normal, network.tangential)
    flipped = exact_vector([-x for x in network.tangential])
    assert not is_admissible(problem, network.normal, flipped)
    assert not is_admissible(problem, exact_vector([2 * x for x in forces]), nothing)
    assert not is_admissible(friction_problem(scene, 0), network.normal, network.tangential)


def test_the_command_line_shows_what_is_inside(capsys, tmp_path):
    file = tmp_path / "bounds.csv"
    words = ("bounds", "tbs", "--layers", "2", "--friction", "1/10*sqrt(3)", "--inside")
    status, out, _ = run(capsys, *words, "--csv", str(file))
    assert status == 0
    assert "a set of dimension 9" in out
    assert out.count("within the bounds") == 2
    rows = {row["contact"]: row for row in csv.DictReader(file.open())}
    assert rows["(1,1)-(3,2)"]["first loading"] == "1260/1429"
    frictionless = solve(tbs(2)).force((1, 1), (3, 2))
    assert surd(rows["(1,1)-(3,2)"]["frictionless"]) == surd(frictionless)
