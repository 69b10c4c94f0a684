"""Piles of spheres: geometry by brute force, known loads, closed forms and another solver.

The other solver is scipy's quasi-Newton descent of the energy, in floating point.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from helpers import assert_touching_are_contacts, equilibrium_faults, float_matrix
from scipy.optimize import minimize

from lcp_piles import (
    InputError,
    Scene,
    base_load,
    nt60,
    pile,
    pyramid,
    solve,
    surd,
    tetrahedron,
)
from lcp_piles.cli.parser import main
from lcp_piles.pictures import draw_base_map, draw_solid

KINDS = pytest.mark.parametrize("kind", ["tetrahedron", "pyramid"])
BASES = pytest.mark.parametrize("base", ["held", "edges", "corners"])


@KINDS
@BASES
@pytest.mark.parametrize("layers", [1, 2, 3, 4])
def test_spheres_that_touch_are_contacts(kind: str, base: str, layers: int) -> None:
    scene = pile(kind, layers, base=base)
    assert_touching_are_contacts(scene)
    lowest = min(d.position[2] for d in scene.discs if base != "held" or not d.fixed)
    assert lowest == 0
    on_floor = {c.a for c in scene.contacts if c.b == "floor"}
    on_bottom = {d.id for d in scene.discs if d.position[2] == 0 and not d.fixed}
    assert on_floor == (set() if base == "held" else on_bottom)


@KINDS
@pytest.mark.parametrize("layers", [2, 3, 5])
def test_which_spheres_are_held(kind: str, layers: int) -> None:
    """Corners are farthest from the axis, and edges on the convex hull of the lowest layer."""
    corners = 3 if kind == "tetrahedron" else 4
    squares = [
        {
            d.position[0] * d.position[0] + d.position[1] * d.position[1]
            for d in scene.discs
            if d.fixed
        }
        for scene in (pile(kind, layers, base=base) for base in ("corners", "edges"))
    ]
    scene = pile(kind, layers, base="corners")
    reach = max(d.position[0] * d.position[0] + d.position[1] * d.position[1] for d in scene.discs)
    assert squares[0] == {reach} <= squares[1]
    assert sum(d.fixed for d in scene.discs) == corners
    edges = pile(kind, layers, base="edges")
    assert sum(d.fixed for d in edges.discs) == corners * (layers - 1)


@KINDS
@BASES
@pytest.mark.parametrize("compliance", ["0", "1", "2/3"])
def test_the_base_bears_the_weight_of_the_free_spheres(
    kind: str, base: str, compliance: str
) -> None:
    for layers in (1, 2, 3) if base == "corners" else (1, 2, 3, 5):
        scene = pile(kind, layers, base=base, floor_compliance=compliance)
        solution = solve(scene)
        assert equilibrium_faults(scene, solution) == []
        free = [disc for disc in scene.discs if not disc.fixed]
        assert sum((p.load for p in base_load(solution)), surd(0)) == len(free)


@pytest.mark.parametrize("layers", [1, 2, 4, 7])
def test_a_tetrahedron_on_a_held_base_in_closed_form(layers: int) -> None:
    """Sphere (a, b, c) presses on the three below with (a + 1, b + 1, c + 1)/sqrt(6)."""
    scene = tetrahedron(layers)
    solution = solve(scene)
    for contact, force in zip(scene.contacts, solution.forces, strict=True):
        if contact.normal[2] == 0:
            assert force == 0  # beside each other
            continue
        axis = [y - x for x, y in zip(contact.a, contact.b, strict=True)].index(1)
        assert force == surd("1/6*sqrt(6)") * (contact.a[axis] + 1)


@pytest.mark.parametrize(
    ("layers", "loads"),
    [(2, ["7/16", "5/8", "3/4"]), (3, ["73/124", "113/124", "135/124"])],
)
def test_known_loads_under_a_pyramid(layers: int, loads: list[str]) -> None:
    """At the corner, beside it along the edge, and beside that on the diagonal."""
    found = {p.disc[1:]: p.load for p in base_load(solve(pyramid(layers)))}
    assert [found[1, 1], found[1, 2], found[2, 2]] == [surd(load) for load in loads]


@KINDS
def test_corners_alone_hold_three_layers_and_no_more(kind: str) -> None:
    for layers in (1, 2, 3):
        assert solve(pile(kind, layers, base="corners")).status == "solved"
    for layers in (4, 5):
        assert solve(pile(kind, layers, base="corners")).status == "unstable"


def least_energy(scene: Scene) -> np.ndarray:
    """The forces where elastic energy less the work of the load is least."""
    B, _, p = float_matrix(scene)
    c = np.array([float(contact.compliance) for contact in scene.contacts])

    def energy(u: np.ndarray) -> tuple[float, np.ndarray]:
        f = np.maximum(-(B @ u), 0) / c
        return float((f * f * c).sum() / 2 - p @ u), -(B.T @ f) - p

    found = minimize(
        energy,
        np.zeros(B.shape[1]),
        jac=True,
        method="L-BFGS-B",
        options={"ftol": 0, "gtol": 1e-11, "maxiter": 10**5, "maxfun": 10**5, "maxcor": 60},
    )
    return np.maximum(-(B @ found.x), 0) / c


@KINDS
@pytest.mark.parametrize(("base", "layers"), [("held", 3), ("edges", 4), ("corners", 3)])
def test_another_solver_finds_the_same_forces(kind: str, base: str, layers: int) -> None:
    scene = pile(kind, layers, base=base, floor_compliance="1/2")
    assert solve(scene).force_array == pytest.approx(least_energy(scene), abs=1e-7)


@KINDS
@pytest.mark.parametrize(("base", "layers"), [("held", 5), ("edges", 5), ("corners", 3)])
def test_the_symmetric_part_is_enough(kind: str, base: str, layers: int) -> None:
    scene = pile(kind, layers, base=base)
    part, whole = solve(scene), solve(scene, whole=True)
    assert list(part.forces) == list(whole.forces)
    assert part.states == whole.states
    assert part.gap_unique == whole.gap_unique
    assert part.stability == whole.stability
    assert part.record.dof < whole.record.dof


def test_pictures_of_spheres() -> None:
    solved, collapsed = (solve(tetrahedron(n, base="corners")) for n in (3, 4))
    forces, base, bar = draw_solid(solved).axes
    assert max(len(c.get_linewidth()) for c in forces.collections) == solved.count("closed")
    loads = {p.load for p in base_load(solved)}
    assert {text.get_text() for text in base.texts} == {f"{float(x):.3g}" for x in loads}
    assert bar.get_ylabel() == "load  ($w$)"
    (motion,) = draw_solid(collapsed).axes
    assert "collapse" in motion.get_title()
    with pytest.raises(InputError, match="the number of axes is 2, expected 3"):
        draw_solid(solve(nt60(3)))
    with pytest.raises(InputError, match="expected one of spheres on a base"):
        draw_base_map(solve(nt60(3)), base)


def test_lines_of_larger_pyramids_are_thinner_and_dots_are_named() -> None:
    """Bases of 3 + 1 and 7 + 1 spheres across are 6 and 14 radii wide."""
    widest = []
    for layers in (3, 7):
        forces, *_ = draw_solid(solve(pyramid(layers))).axes
        (lines,) = [c for c in forces.collections if len(c.get_linewidth()) > 1]
        widest.append(max(lines.get_linewidth()))
        names = [text.get_text() for text in forces.get_legend().get_texts()]
        assert names == ["centre of a sphere", "held sphere"]
    assert widest == pytest.approx([4, 32 / 14])


def test_the_command_line_knows_spheres(tmp_path, capsys) -> None:
    picture = tmp_path / "pyramid.png"
    assert main(["solve", "pyramid", "--layers", "2", "--plot", str(picture)]) == 0
    assert "under the axis  (3,2,2): 3/4 = 0.75 w" in capsys.readouterr().out
    assert picture.stat().st_size > 10_000
    assert main(["fields", "pyramid", "--layers", "2", "--show", "base"]) == 0
    assert "(3,1,1)" in capsys.readouterr().out
    assert main(["solve", "tetrahedron", "--layers", "4", "--base", "corners"]) == 3


def test_a_rigid_base_of_three_layers_by_hand() -> None:
    """Two layers on edges: the apex rests on three stones, 1/3 over the cosine on each."""
    solution = solve(tetrahedron(2, base="edges"))
    assert [str(f) for f in solution.forces] == ["1/6*sqrt(6)"] * 3
    assert [p.load for p in base_load(solution)] == [Fraction(1, 3)] * 3
