"""Blocks of the triangular lattice: silos and slabs, their geometry and what their bases bear.

The geometry is checked by brute force over all pairs of discs. Loads are sums of weights, or the
values of an independent solution in floating point by whoever asked for silos.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from helpers import assert_touching_are_contacts, equilibrium_faults
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import Hold, InputError, Scene, Support, lattice, silo, slab, solve, surd
from lcp_piles.scenes.symmetry import mirror

ORIENTATIONS = ("untilted", "tilted")


@st.composite
def blocks(draw: st.DrawFn) -> Scene:
    """A small silo or slab of any sort."""
    width, height = draw(st.integers(2, 6)), draw(st.integers(1, 6))
    floor, orientation = (
        draw(st.sampled_from(["smooth", "bumpy"])),
        draw(st.sampled_from(ORIENTATIONS)),
    )
    if draw(st.booleans()):
        compliances = [draw(st.sampled_from([0, 1, "2/7"])) for _ in range(2)]
        walls = draw(st.sampled_from(["smooth", "bumpy"]))
        return silo(width, height, walls, floor, orientation, *compliances)
    sides = draw(st.sampled_from(["smooth", "free"]))
    return slab(width, height, sides, floor, orientation, draw(st.sampled_from([0, 1, "1/2"])))


@given(blocks())
@settings(max_examples=40)
def test_all_that_touches_is_a_contact_and_nothing_overlaps(scene: Scene) -> None:
    """Squares of distances in Surds; walls one radius beyond the outermost free discs."""
    assert_touching_are_contacts(scene)
    place = {disc.id: disc.position for disc in scene.discs}
    held = {disc.id for disc in scene.discs if disc.fixed}
    among = [c for c in scene.contacts if not isinstance(c.b, str)]
    assert held <= {id for c in among for id in (c.a, c.b)}  # no held disc that nothing touches

    free = [position for id, position in place.items() if id not in held]
    low, high = min(x for x, _ in free), max(x for x, _ in free)
    planes = {"floor": (1, 0), "left wall": (0, low), "right wall": (0, high)}
    for name in scene.supports:
        axis, at = planes[name]
        on = {id for id, position in place.items() if position[axis] == at and id not in held}
        assert {c.a for c in scene.contacts if c.b == name} == on
    if "left wall" in scene.supports:
        assert all(low <= x <= high for x, _ in place.values())
    if "floor" in scene.supports:
        assert all(y >= 0 for _, y in place.values())


@given(blocks())
@settings(max_examples=25)
def test_solutions_hold_disc_by_disc(scene: Scene) -> None:
    solution = solve(scene)
    parameters = dict(scene.origin.parameters)
    if solution.status == "solved":
        assert equilibrium_faults(scene, solution) == []
    else:  # a slab without walls, whose ends roll off
        assert parameters["sides"] == "free"
        assert parameters["weight"] != 0


def base_load(scene: Scene, method: str = "proved"):
    """The vertical force that the floor bears, whatever it is made of."""
    solution = solve(scene, method)
    height = dict(scene.origin.parameters)["height"]
    on_floor = [c.b == "floor" if isinstance(c.b, str) else c.b[0] > height for c in scene.contacts]
    pairs = zip(scene.contacts, solution.forces, on_floor, strict=True)
    number = surd if solution.exact else float
    return sum(f * number(c.normal[1]) for c, f, low in pairs if low)


@pytest.mark.parametrize(("orientation", "floor"), [*product(ORIENTATIONS, ("smooth", "bumpy"))])
@pytest.mark.parametrize("compliance", [0, 1])
def test_smooth_walls_carry_nothing(orientation: str, floor: str, compliance: int) -> None:
    """The base bears the whole weight, exactly, however high the silo is."""
    for width, height in ((3, 1), (4, 7), (3, 12)):
        scene = silo(width, height, "smooth", floor, orientation, compliance)
        assert base_load(scene) == sum(not disc.fixed for disc in scene.discs)


@pytest.mark.parametrize(
    ("orientation", "floor", "width", "load"),
    [
        ("untilted", "smooth", 6, 4.394),
        ("untilted", "smooth", 10, 7.480),
        ("tilted", "bumpy", 6, 5.456),
        ("tilted", "bumpy", 10, 8.802),
    ],
)
def test_the_base_load_saturates_between_bumpy_walls(
    orientation: str, floor: str, width: int, load: float
) -> None:
    """A silo of twice the height bears on its base the same; known values a disc of the base."""
    heights = [80, 160] if width == 6 else [110, 220]
    if orientation == "tilted":
        heights = [2 * height for height in heights]
    scenes = [silo(width, h, "bumpy", floor, orientation) for h in heights]
    loads = [float(base_load(scene, "newton")) / width for scene in scenes]
    assert loads[1] == pytest.approx(load, abs=5e-4)
    assert loads[0] == pytest.approx(loads[1], rel=1e-4)


def stepped_silo(width: int, height: int) -> Scene:
    """A tilted silo whose floor has a step under every second column: no kind, but a lattice.

    Its bumpy walls go one disc deeper than the lowest row.
    """
    cells = {
        (height - r, c + 1): (c, r)
        for r in range(-1, height)
        for c in range(-1, width + 1)
        if (c + r) % 2 == 0 and (r >= 0 or c in (-1, width))
    }
    held = {id: Hold() for id, (c, _) in cells.items() if c in (-1, width)}
    low = [id for id, (_, r) in cells.items() if 0 <= r <= 1 and id not in held]
    return lattice(cells, held, [Support("floor", (surd(0), surd(1)), low)], "tilted")


@pytest.mark.parametrize(("width", "load"), [(6, 5.359), (10, 8.675)])
def test_a_stepped_floor_is_a_lattice_too(width: int, load: float) -> None:
    """Known values: floor and lowest wall disc together, a column."""
    height = 150
    scene = stepped_silo(width, height)
    solution = solve(scene, "newton")
    borne = sum(
        f * float(c.normal[1])
        for c, f in zip(scene.contacts, solution.force_array, strict=True)
        if c.b == "floor" or c.b[0] > height
    )
    assert borne / width == pytest.approx(load, abs=6e-4)


def test_a_narrow_silo_by_hand() -> None:
    """Two discs in the lowest row and one above: it presses on each with 1/sqrt(3)."""
    scene = silo(2, 2, walls="smooth")
    solution = solve(scene)
    assert solution.force((1, 1), (2, 1)) == surd("1/3*sqrt(3)").sympy()
    assert solution.force((2, 1), "floor") == Fraction(3, 2)
    assert solution.force((2, 1), "left wall") == surd("1/6*sqrt(3)").sympy()


@pytest.mark.parametrize(
    ("orientation", "width"), [("untilted", 4), ("untilted", 5), ("tilted", 5)]
)
def test_where_the_lattice_has_a_mirror_half_is_solved(orientation: str, width: int) -> None:
    scene = silo(width, 6, orientation=orientation)
    assert mirror(scene) is not None
    half, whole = solve(scene), solve(scene, whole=True)
    assert list(half.forces) == list(whole.forces)
    assert half.stability == whole.stability


def test_a_weightless_slab_bears_nothing() -> None:
    solution = solve(slab(6, 4, sides="free", weight=0))
    assert solution.status == "solved"
    assert not np.any(solution.force_array)


def test_what_the_lattice_refuses() -> None:
    right = {"a": (0, 0), "b": (1, 1)}
    with pytest.raises(InputError, match=r"cell of disc b is .* column . row even for all"):
        lattice({"a": (0, 0), "b": (1, 0)}, {})
    with pytest.raises(InputError, match=r"cell of disc b is .* one that disc a is not in"):
        lattice({"a": (0, 0), "b": (0, 0)}, {})
    with pytest.raises(InputError, match="a held or supported disc is 'c'"):
        lattice(right, {"c": Hold()})
    with pytest.raises(InputError, match="orientation is 'upside down', expected one of untilted"):
        lattice(right, {}, orientation="upside down")
    with pytest.raises(InputError, match=r"wall compliance is .*-1/2.*, expected a number from 0"):
        silo(3, 3, wall_compliance="-1/2")
    with pytest.raises(InputError, match=r'walls is .free., expected "bumpy" or "smooth"'):
        silo(3, 3, walls="free")
    with pytest.raises(InputError, match="width of silo is 1, expected a number from 2 to"):
        silo(1, 3)
