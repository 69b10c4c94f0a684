"""The comparison of Lemke and Z against separate runs and against dense linear algebra."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import float_matrix, image_contacts, nullity

from lcp_piles import compare, pile, solve, z_algorithm
from lcp_piles.paper.compare import Comparison

CASES = [
    ("nt60", range(2, 8), {}),
    ("nt30", [2, 3, 6, 8], {}),
    ("nt30", [4], {"push": "59/3*sqrt(3)", "floor_compliance": "0"}),
    ("tss", [4, 10, 13], {}),
    ("tbs", range(1, 6), {}),
]


def solved() -> list[tuple[Comparison, dict]]:
    return [
        (record, parameters)
        for kind, layers, parameters in CASES
        for record in compare(kind, layers, **parameters)
    ]


def test_records_are_those_of_separate_runs() -> None:
    for record, parameters in solved():
        scene = pile(record.kind, record.layers, **parameters)
        lemke, z = solve(scene, "lemke"), z_algorithm(scene)
        assert (record.lemke_status, record.z_status) == ("solved", "solved")
        assert record.contacts == len(scene.contacts)
        assert record.pivots == lemke.record.pivots
        assert record.iterations == len(z.trace)
        assert record.reintroductions == z.reintroductions
        assert record.singular == z.singular
        assert record.cycle == 0
        assert record.lemke_seconds > 0
        assert record.z_seconds > 0
        assert record.forces_equal is (list(lemke.forces) == list(z.solution.forces)) is True
        assert record.states_equal is True


def test_differences_are_all_there_and_for_the_reason_given() -> None:
    """Both sets once more; a mechanism is a row that the loaded contacts do not determine."""
    seen = set()
    for record, parameters in solved():
        scene = pile(record.kind, record.layers, **parameters)
        forces = solve(scene, "lemke").force_array
        image = image_contacts(scene)
        Z = set(z_algorithm(scene).Z)
        Z |= {image[k] for k in Z}
        loaded = {k for k, f in enumerate(forces) if f > 1e-9}
        B, _, _ = float_matrix(scene)
        number = {(c.a, c.b): k for k, c in enumerate(scene.contacts)}
        named = {number[(d.a, d.b)] for d in record.differences}
        named |= {image[k] for k in named}
        assert named >= {k for k in range(len(forces)) if (k in loaded) == (k in Z)}
        assert record.equal is (not record.differences)
        for difference in record.differences:
            k = number[(difference.a, difference.b)]
            seen.add(difference.reason)
            assert difference.kept is (k not in Z)
            rows = B[sorted(loaded)]
            moved = nullity(np.vstack([rows, B[k]])) < nullity(rows)
            if difference.reason == "mechanism":
                assert (difference.state, moved) == ("open", True)
            else:
                assert difference.reason == "osculatory contact kept"
                assert difference.state == "osculatory"
    assert seen == {"mechanism", "osculatory contact kept"}


def test_osculatory_contact_of_nt60() -> None:
    """The horizontal contacts of three layers touch without force: Z keeps them, one set of two."""
    (record,) = compare("nt60", [3])
    assert record.equal is False
    assert record.states_equal is True
    (difference,) = record.differences  # and its mirror image
    assert (difference.a, difference.b) == ((3, 1), (3, 2))
    assert (difference.state, difference.kept) == ("osculatory", True)
    assert difference.reason == "osculatory contact kept"


def test_cycle_is_reported_and_nothing_compared() -> None:
    (record,) = compare("tss", [6], push=95)
    assert (record.lemke_status, record.z_status, record.cycle) == ("solved", "cycle", 1)
    assert (record.equal, record.states_equal, record.forces_equal) == (None, None, None)
    assert record.differences == ()
    assert record.reintroductions > 0


def test_paper_floor() -> None:
    """An indefinite scene: bilateral floor contacts belong to neither set."""
    (record,) = compare("nt30", [6], push=50, floor_compliance="-1/2")
    assert (record.z_status, record.equal, record.forces_equal) == ("solved", True, True)


@pytest.mark.parametrize("layers", [[], range(0)])
def test_no_sizes_no_records(layers: list[int]) -> None:
    assert compare("tbs", layers) == []
