"""Base pressure against equilibrium, closed forms and what the paper says of its figures."""

from dataclasses import replace

import numpy as np
import pytest

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    base_pressure,
    letter_force,
    nt30,
    nt60,
    solve,
    support_forces,
    surd,
    tbs,
    tss,
)
from lcp_piles.fields.base_pressure import force_from_above, force_to_below
from lcp_piles.numbers.exact import ONE, ZERO, sqrt_of

_ROOT3, _HALF = sqrt_of(3), surd("1/2")
SCENES = {
    "tbs": tbs(6),
    "tss": tss(7),
    "tss-resting": tss(6, corner_stones="resting"),
    "nt60": nt60(6),
    "nt60-resting": nt60(6, corner_stones="resting"),
    "nt30": nt30(5),
    "nt30-rigid-push": nt30(5, push="30", floor_compliance=0),
    "nt30-pull": nt30(4, push="-7"),
    "nt30-paper-floor": nt30(5, floor_compliance="-1/2"),
}


def row(scene: Scene, i: int) -> list:
    return [disc.id for disc in scene.discs if disc.id[0] == i]


def normals(forces) -> list:
    return [force.normal for force in forces]


def holders(solution) -> list:
    """What holds the corner stones."""
    return [p for p in support_forces(solution) if p.support is None]


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_support_carries_the_whole_weight_and_no_net_shear(scene):
    carried = support_forces(solve(scene))
    weight = -sum((disc.load[1] for disc in scene.discs), ZERO)
    assert sum((force.y for force in carried), ZERO) == -weight
    assert sum((force.x for force in carried), ZERO) == 0


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_floating_point_solutions_agree(scene):
    solution = solve(scene)
    as_float = replace(solution, forces=solution.force_array)
    for read, where, forces in (
        (base_pressure, ("disc", "x", "held"), ("normal", "shear")),
        (support_forces, ("disc", "support"), ("x", "y")),
    ):
        exact, found = read(solution), read(as_float)
        for name in where:
            assert [getattr(f, name) for f in found] == [getattr(f, name) for f in exact]
        for name in forces:
            values = [getattr(f, name) for f in found]
            assert all(isinstance(value, float) for value in values)
            expected = [float(getattr(f, name)) for f in exact]
            np.testing.assert_allclose(values, expected, rtol=0, atol=1e-11)


@pytest.mark.parametrize("scene", [tss(7), nt60(6), nt30(5)], ids=str)
def test_on_a_floor_the_profile_is_the_floor_forces_between_the_corner_stones(scene):
    solution = solve(scene)
    on_floor = [c.a for c in scene.contacts if c.b == "floor"]
    profile = base_pressure(solution)
    assert [p.disc for p in profile] == on_floor
    assert [p.normal.sympy() for p in profile] == [solution.force(d, "floor") for d in on_floor]
    assert all(p.shear == 0 and not p.held for p in profile)


@pytest.mark.parametrize(
    ("scene", "contacts"),
    [
        (tss(7), {"a": (_ROOT3 / 2, _HALF)}),
        (nt60(6), {"a": (ONE, ZERO), "b": (_HALF, _ROOT3 / 2)}),
        (nt30(5), {"a": (ONE, ZERO)}),
    ],
    ids=["tss", "nt60", "nt30"],
)
def test_corner_stones_carry_their_own_weight_and_their_contacts(scene, contacts):
    """The left stone's contacts push it to the left and down, and the right one mirrors it."""
    solution = solve(scene)
    stones = holders(solution)
    left, right = row(scene, scene.discs[-1].id[0])[:: len(base_pressure(solution)) + 1]
    assert [stone.disc for stone in stones] == [left, right]
    forces = {letter: letter_force(solution, left, letter) for letter in contacts}
    shear = -sum((forces[k] * x for k, (x, _) in contacts.items()), ZERO)
    normal = 1 + sum((forces[k] * y for k, (_, y) in contacts.items()), ZERO)
    assert [(-p.y, p.x) for p in stones] == [(normal, shear), (normal, -shear)]
    assert shear < 0


def test_resting_corner_stones_are_part_of_the_profile_and_hold_the_shear():
    solution = solve(nt60(4, corner_stones="resting"))
    profile = base_pressure(solution)
    assert [p.disc for p in profile] == row(solution.scene, 4)
    floor = [p for p in support_forces(solution) if p.support == "floor"]
    assert [(p.disc, p.normal) for p in floor] == [(p.disc, p.normal) for p in profile]
    assert all((p.x, p.y) == (0, -p.normal) for p in floor)
    left, right = holders(solution)
    assert left.x == -right.x < 0
    assert left.y == right.y == 0


def test_the_profile_runs_from_left_to_right_whatever_the_order_of_the_discs():
    scene = nt30(4)
    turned = replace(scene, discs=scene.discs[::-1])
    assert base_pressure(solve(turned)) == base_pressure(solve(scene))


def test_a_slope_and_what_holds_its_disc_are_two_supports():
    """The slope carries f = 2/sqrt(3) along its normal, and the holder the thrust f/2 of it."""
    slope = Contact((1,), "floor", (_HALF, _ROOT3 / 2))
    disc = Disc((1,), (ZERO, ZERO), (ZERO, -ONE), (ZERO, None))
    solution = solve(Scene((disc,), (slope,)))
    assert solution.force((1,), "floor") == (2 / _ROOT3).sympy()
    below, holder = support_forces(solution)
    assert (below.support, below.normal) == ("floor", 2 / _ROOT3)
    assert (below.x, below.y) == (-1 / _ROOT3, -1)
    assert (holder.support, holder.normal, holder.x, holder.y) == (None, None, 1 / _ROOT3, 0)


def test_a_wall_and_a_floor_of_one_disc_are_two_supports():
    """A load of (-2, -1) on a disc in a corner: the wall takes 2 along its normal, no shear."""
    contacts = (Contact((1,), "floor", (ZERO, ONE)), Contact((1,), "wall", (ONE, ZERO)))
    disc = Disc((1,), (ZERO, ZERO), (surd(-2), -ONE), (None, None))
    floor, wall = support_forces(solve(Scene((disc,), contacts, ("floor", "wall"))))
    assert (floor.support, floor.normal, floor.x, floor.y) == ("floor", 1, 0, -1)
    assert (wall.support, wall.normal, wall.x, wall.y) == ("wall", 2, -2, 0)


@pytest.mark.parametrize("layers", [1, 2, 5, 8])
def test_tbs_rows_add_up(layers):
    """Row N with the vertical forces of row N - 1 is all; both fixed rows together are all."""
    solution = solve(tbs(layers))
    weight = layers * (layers + 1) // 2
    profile = base_pressure(solution)
    assert [p.disc for p in profile] == row(solution.scene, layers)
    second = [letter_force(solution, disc, "e") for disc in row(solution.scene, layers - 1)]
    assert sum(normals(profile), ZERO) + sum(second, ZERO) == weight
    carried = support_forces(solution)
    fixed = row(solution.scene, layers + 1) + row(solution.scene, layers + 2)
    assert [p.disc for p in carried] == fixed
    from_above = force_from_above(solution, fixed)
    assert [(-p.y, p.x) for p in carried] == [(p.normal, p.shear) for p in from_above]
    # The last row is touched by nothing but the vertical contacts of row N.
    last = [p for p in carried if p.disc[0] == layers + 2]
    assert all(p.x == 0 for p in last)
    vertical = [letter_force(solution, disc, "e") for disc in row(solution.scene, layers)]
    assert [-p.y for p in last] == [0, *vertical, 0]


def test_tbs_17_as_the_paper_shows_it():
    """Shear vanishes at the centre, the sum is below the weight, both layers peak at the apex."""
    solution = solve(tbs(17))
    profile = base_pressure(solution)
    centre = len(profile) // 2
    assert (profile[centre].x, profile[centre].shear) == (0, 0)
    shears = [p.shear for p in profile]
    assert shears == [-s for s in shears[::-1]]
    assert all(s < 0 for s in shears[:centre])  # the pile pushes outwards
    assert sum(normals(profile), ZERO) < 17 * 18 // 2
    row_16 = [letter_force(solution, disc, "e") for disc in row(solution.scene, 16)]
    for layer in (normals(profile), row_16):
        peak = max(layer)
        half = len(layer) // 2
        assert peak == layer[half] == layer[-1 - half]


def hong_shear(x):
    """Straight force lines through every disc: x/(2 sqrt(3)), linear in x (Hong 1993)."""
    return x / (2 * _ROOT3)


def fixed_base(layers: int) -> Scene:
    """NT60 on a base row that cannot move: no floor, no contact within the row."""
    scene = nt60(layers)
    base = set(row(scene, layers))
    discs = [replace(d, held=(ZERO, ZERO)) if d.id in base else d for d in scene.discs]
    contacts = [c for c in scene.contacts if not (c.a in base and (c.b == "floor" or c.b in base))]
    return Scene(tuple(discs), tuple(contacts))


@pytest.mark.parametrize("layers", range(2, 13))
def test_hong_on_a_fixed_base_at_every_size(layers):
    carried = support_forces(solve(fixed_base(layers)))
    assert [-p.y for p in carried] == [surd(layers + 1) / 2] * layers
    assert [p.x for p in carried] == [
        hong_shear(surd(2 * j - layers - 1)) for j in range(1, layers + 1)
    ]


@pytest.mark.parametrize("layers", range(2, 8))
def test_hong_on_a_rigid_floor_up_to_7_layers(layers):
    """Uniform normal forces with the corner stones in, linear shear from the row above."""
    solution = solve(nt60(layers, floor_compliance=0))
    assert [-p.y for p in support_forces(solution)] == [surd(layers + 1) / 2] * layers
    shear = force_from_above(solution, row(solution.scene, layers))
    assert [p.shear for p in shear] == [hong_shear(p.x) for p in shear]


def test_hong_on_a_rigid_floor_ends_at_8_layers():
    """The squeezed base row closes horizontal contacts above it: the paper saw none."""
    solution = solve(nt60(8, floor_compliance=0))
    assert solution.state((7, 1), (7, 2)) == "closed"
    assert len(set(normals(base_pressure(solution)))) > 1


def test_what_comes_from_above_goes_below_with_the_weight():
    solution = solve(tss(7))
    discs = [(3, 2), (4, 2), (5, 4)]
    for above, below in zip(
        force_from_above(solution, discs), force_to_below(solution, discs), strict=True
    ):
        assert below.normal == above.normal + 1
        assert below.shear == above.shear  # the tilted lattice has no horizontal contacts


def test_refuses_a_solution_without_forces():
    with pytest.raises(InputError, match="no forces"):
        base_pressure(solve(nt60(3).without([(3, 1)])))
