"""Solved, unstable or contradictory: a property of the scene, the same by every method.

Random scenes with rigid contacts are held against linear programmes (`random_scenes.truth`), which
share nothing with the package. Certificates are checked once more in plain Surds (`endings`).
"""

import pickle
from collections import Counter
from dataclasses import replace

import pytest
from endings import FLOAT, assert_all_alike, assert_floats_claim_nothing_else, ending
from flint import fmpz
from random_scenes import ROOT, custom, random_scene, truth

from lcp_piles import (
    Contact,
    ContradictionError,
    Disc,
    VerificationError,
    contact_system,
    nt60,
    solve,
    surd,
    verify,
)
from lcp_piles.mechanics.contradiction import contradiction, stress_faults
from lcp_piles.numbers.vectors import exact_vector

ZERO = surd(0)


@pytest.mark.parametrize("first", range(0, 96, 24))
def test_random_scenes_end_alike(first):
    seen, gave_up = Counter(), Counter()
    for seed in range(first, first + 24):
        scene = random_scene(seed)
        expected = truth(scene)
        seen[expected] += 1
        gave_up[expected] += assert_all_alike(scene, expected)[1]
    assert len(seen) == 3  # all three kinds are among them
    # What has no solution more often makes a cycle.
    assert gave_up["solved"] <= max(1, seen["solved"] // 10)
    assert not gave_up["contradictory"]


@pytest.mark.slow
def test_many_random_scenes_end_alike():
    for seed in range(1000, 1080):
        scene = random_scene(seed)
        assert_all_alike(scene, truth(scene))


@pytest.mark.parametrize("first", [0, 24])
def test_floating_point_may_give_up_and_claims_nothing_else(first):
    solved, seen = Counter(), 0
    for seed in range(first, first + 24):
        scene = random_scene(seed)
        expected = truth(scene)
        exact = solve(scene) if expected == "solved" else None
        solved.update(assert_floats_claim_nothing_else(scene, expected, exact))
        seen += expected == "solved"
    assert solved["newton"] == solved["z-float64"] == seen
    assert set(FLOAT) - set(solved) <= {"lemke-float64", "lemke-float32"}  # for springs alone


# --- scenes whose answer can be read off ---


def reported():
    """Five rigid discs, two of them held: methods used to differ on what this is."""
    third = ROOT * 2 / 3
    places = {
        (1, 1): (-4, 0),
        (1, 2): (-2, 0),
        (2, 1): (-3, ROOT),
        (2, 2): (-1, ROOT),
        (2, 3): (1, ROOT),
    }
    held = {(1, 1): (0, 0), (2, 3): (0, 0)}
    free = (None, None)
    discs = [Disc(k, place, (0, -1), held.get(k, free)) for k, place in places.items()]
    half = ROOT / 2
    contacts = [
        Contact((1, 2), (1, 1), (1, 0), 0, ROOT - 1),
        Contact((2, 1), (1, 1), ("1/2", half), 0),
        Contact((1, 2), (2, 2), ("-1/2", -half), 0, surd("3/2") - third),
        Contact((2, 1), (1, 2), ("-1/2", half), 0, "2/3", True),
        Contact((1, 2), "floor", (0, 1), 0, "3/5"),
        Contact((2, 2), (2, 1), (1, 0), 0, surd("1/2") - third),
        Contact((2, 3), (2, 2), (1, 0), 0, "-5/6", True),
    ]
    return custom(discs, contacts)


def test_the_reported_scene():
    scene = reported()
    assert_all_alike(scene, truth(scene))


def clamped(gaps, load=(0, -1), held=("0", None), bilateral=True, normals=None):
    """One disc in rigid clamps "floor", "floor2", ... with these gaps."""
    names = ["floor", *(f"floor{k}" for k in range(2, len(gaps) + 1))]
    contacts = [
        Contact(1, name, normal, 0, gap, bilateral)
        for name, gap, normal in zip(names, gaps, normals or [(0, 1)] * len(gaps), strict=True)
    ]
    return custom([Disc(1, (0, 0), load, held)], contacts)


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("gap", ["0", "2/3", "sqrt(3)"])
def test_rigid_clamps_that_agree_are_no_error(count, gap):
    scene = clamped([gap] * count)
    assert_all_alike(scene, "solved")
    solution = solve(scene)
    assert sum(solution.forces, ZERO) == 1
    assert solution.displacements[1] == -surd(gap)
    assert solution.forces_unique is False
    assert solution.states == ("closed",) * count


@pytest.mark.parametrize("gaps", [["0", "1/1000000000000000000000"], ["0", "sqrt(2)", "0"]])
def test_rigid_clamps_that_differ_contradict_each_other(gaps):
    scene = clamped(gaps)
    assert_all_alike(scene, "contradictory")
    with pytest.raises(ContradictionError, match=r"1-floor2"):
        solve(scene)


def test_clamps_of_three_directions_agree_or_not():
    """The third direction is the sum of the others: its gap has to be the sum of theirs."""
    normals = [("1/2", ROOT / 2), ("1/2", -ROOT / 2), (1, 0)]
    free = {"held": (None, None), "normals": normals}
    assert_all_alike(clamped(["1", "1/3", "4/3"], **free), "solved")
    assert_all_alike(clamped(["1", "1/3", "1"], **free), "contradictory")


def test_what_a_clamp_carries_is_asked_of_all_solutions():
    """A third clamp of the same disc from the side stays without force in every solution."""
    normals = [(0, 1), (0, 1), (1, 0)]
    scene = clamped(["0"] * 3, held=(None, None), normals=normals)
    assert_all_alike(scene, "solved")
    assert solve(scene).states == ("closed", "closed", "osculatory")
    idle = clamped(["0"] * 2, load=(0, 0))
    assert_all_alike(idle, "solved")
    assert solve(idle).states == ("closed", "closed")  # one may pull while the other presses
    assert verify(idle, solve(idle)).ok


def walls(room, load=(0, 0), c=0):
    """A disc between two walls that leave it this much room."""
    contacts = [Contact(1, "left", (1, 0), c, room), Contact(1, "right", (-1, 0), c)]
    return custom([Disc(1, (0, 0), load, (None, None))], contacts)


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        (walls(0), "solved"),
        (walls(1), "solved"),
        (walls(-1), "contradictory"),
        (walls(-1, c="1/1000"), "solved"),
        (walls(0, (0, -1)), "unstable"),
        (walls(-1, (0, -1)), "contradictory"),  # it would fall, had it a place to fall from
        (walls(-1, (0, -1), c=1), "unstable"),
        (walls(-1, (5, 0)), "contradictory"),
    ],
    ids=str,
)
def test_geometry_comes_before_loads(scene, expected):
    assert truth(scene) == expected
    assert_all_alike(scene, expected)


def test_a_free_fall_elsewhere_does_not_hide_a_contradiction():
    """Two parts that do not touch: one is jammed too tight, the other falls."""
    tight = walls(-1)
    falls = replace(tight.discs[0], id=2, load=(0, -1))
    scene = custom([*tight.discs, falls], list(tight.contacts))
    assert truth(scene) == "contradictory"
    assert_all_alike(scene, "contradictory")
    with pytest.raises(ContradictionError):
        solve(scene, "z")


def test_prescribed_displacements_count_as_gaps():
    """A rigid disc between two that are pushed together by 1 each."""
    discs = [
        Disc(k, (2 * k, 0), (0, 0), held)
        for k, held in ((-1, ("1", 0)), (0, (None, None)), (1, ("-1", 0)))
    ]
    contacts = [Contact(0, -1, (1, 0), 0), Contact(1, 0, (1, 0), 0)]
    scene = custom(discs, contacts)
    assert_all_alike(scene, "contradictory")
    roomy = replace(scene, contacts=(replace(contacts[0], gap=2), contacts[1]))
    assert_all_alike(roomy, "solved")


def test_the_error_survives_pickling_and_names_the_contacts():
    with pytest.raises(ContradictionError, match="1-left, 1-right") as caught:
        solve(walls(-1))
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value)
    assert list(again.stress) == list(caught.value.stress) != [0, 0]


def test_the_check_of_a_stress_refuses_what_proves_nothing():
    scene = walls(-1)

    def faults(stress, scene=scene):
        return " ".join(stress_faults(scene, exact_vector(stress)))

    assert faults([1, 1]) == ""
    assert "is not balanced" in faults([1, 2])
    assert "pulls" in faults([-1, -1])
    assert "no negative work" in faults([0, 0])
    assert "no negative work" in faults([1, 1], walls(0))
    assert "is not rigid" in faults([1, 1], walls(-1, c=1))
    held = replace(scene, discs=(replace(scene.discs[0], held=(0, None)),))
    assert faults([1, 0], held) == ""  # what is held takes any force
    assert "is not balanced" in faults([1, 0])


def test_a_contradiction_is_only_raised_with_a_stress_that_proves_it():
    system = contact_system(walls(-1))
    assert list(contradiction(system, [fmpz(1), fmpz(1)]).stress) == [1, 1]
    for stress in ([1, 2], [-1, -1], [0, 0]):
        with pytest.raises(VerificationError, match="fails its own check"):
            contradiction(system, [fmpz(x) for x in stress])


@pytest.mark.parametrize("discs", [1, 3, 4, 6])
def test_the_first_four_contacts_of_a_contradiction_are_named(discs):
    """A row of rigid discs between walls that leave no room: every contact takes part."""
    contacts = [Contact(0, "left", (1, 0), 0, -1), Contact(discs - 1, "right", (-1, 0), 0)]
    contacts[1:1] = [Contact(k, k - 1, (1, 0), 0) for k in range(1, discs)]
    row = [Disc(k, (2 * k, 0), (0, 0), (None, None)) for k in range(discs)]
    with pytest.raises(ContradictionError) as caught:
        solve(custom(row, contacts))
    text = str(caught.value)
    assert sum(f"{c.a}-{c.b}" in text for c in contacts) == min(discs + 1, 4)
    assert ("more" in text) == (discs > 3)
    assert (f"and {discs - 3} more;" in text) == (discs > 3)


def test_a_ray_of_an_indefinite_scene_is_no_collapse_unless_it_is_one():
    """Bilateral contacts of negative compliance: a certificate of the LCP may be no motion."""
    statuses = Counter()
    for seed in range(40):
        scene = random_scene(seed)
        contacts = list(scene.contacts)
        contacts[::3] = [replace(c, compliance="-7/10", bilateral=True) for c in contacts[::3]]
        statuses[ending(replace(scene, contacts=tuple(contacts)), "lemke")[0]] += 1
    assert len(statuses) == 4


def test_large_piles_without_a_stone_on_a_rigid_floor_are_asked_quickly():
    scene = nt60(12, floor_compliance=0, push=3).without([(12, 1)])
    assert_all_alike(scene, "unstable", ("proved", "lemke"))
