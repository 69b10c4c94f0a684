"""The registry of fields, and the two newest: fabric and coordination.

Expected values are worked out by hand on small piles, come from closed forms, or are counted from
the states of the contacts one by one.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from lcp_piles import (
    FIELDS,
    InputError,
    Scene,
    coordination,
    fabric,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    tss,
)
from lcp_piles.fields.fabric import anisotropy, major_angle
from lcp_piles.fields.field import Column, Field, Table
from lcp_piles.pictures import draw_field

SCENES = {
    "tbs": tbs(5),
    "tss": tss(6),
    "nt60": nt60(5),
    "nt30": nt30(5),
    "resting": nt60(4, corner_stones="resting", floor_compliance=0),
    "paper's floor": nt30(4, floor_compliance="-1/2"),
}
EVERY_SCENE = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
EVERY_FIELD = pytest.mark.parametrize("field", FIELDS.values(), ids=FIELDS.keys())


def touching(scene: Scene, disc: object) -> list[int]:
    return [k for k, c in enumerate(scene.contacts) if disc in (c.a, c.b)]


# --- fabric ---


def test_fabric_of_three_discs_by_hand() -> None:
    """Two contacts along (+-1/2, sqrt(3)/2): F = diag(1/4, 3/4); a stone has only one of them."""
    found = fabric(solve(nt60(2)))
    quarter, mixed = surd("1/4"), surd("1/4*sqrt(3)")
    assert (found.count, found.counts.tolist()) == (2, [2, 1, 1])
    assert found.pile == found.of((1, 1)) == (quarter, 0, surd("3/4"))
    assert found.of((2, 1)) == (quarter, mixed, surd("3/4"))
    assert found.of((2, 2)) == (quarter, -mixed, surd("3/4"))
    assert (anisotropy(found.pile), major_angle(found.pile)) == (0.5, 90.0)
    assert anisotropy(found.of((2, 1))) == pytest.approx(1)
    assert major_angle(found.of((2, 1))) == pytest.approx(60)
    assert major_angle(found.of((2, 2))) == pytest.approx(-60)


def test_fabric_of_six_equal_directions_is_isotropic() -> None:
    """A disc within six held ones that all press on it: F = I/2, and z = 6."""
    hexagon = [
        ("1", "0"), ("1/2", "1/2*sqrt(3)"), ("-1/2", "1/2*sqrt(3)"),
        ("-1", "0"), ("-1/2", "-1/2*sqrt(3)"), ("1/2", "-1/2*sqrt(3)"),
    ]  # fmt: skip
    inner = replace(nt60(2).disc((1, 1)), position=(surd(0), surd(0)), load=(surd(0), surd(0)))
    model = replace(inner, held=(surd(0), surd(0)))
    discs, contacts = [inner], []
    for k, (x, y) in enumerate(hexagon):
        n = (surd(x), surd(y))
        discs.append(replace(model, id=(2, k), position=(2 * n[0], 2 * n[1])))
        contacts.append(
            replace(nt60(2).contacts[0], a=(1, 1), b=(2, k), normal=(-n[0], -n[1]), gap=surd(-1))
        )
    scene = replace(nt60(2).without([(1, 1)]), discs=tuple(discs), contacts=tuple(contacts))
    solution = solve(scene)
    tensor = fabric(solution).of((1, 1))
    assert tensor == (surd("1/2"), 0, surd("1/2"))
    assert anisotropy(tensor) == 0
    assert np.isnan(major_angle(tensor))
    assert coordination(solution).loaded.tolist() == [6, 1, 1, 1, 1, 1, 1]


@EVERY_SCENE
def test_fabric_is_the_mean_of_n_n_over_the_contacts_with_force(scene: Scene) -> None:
    solution = solve(scene)
    found = fabric(solution)
    loaded = [k for k, f in enumerate(solution.forces) if f != 0]
    assert found.count == len(loaded)
    for tensor, chosen in [
        (found.pile, loaded),
        *(
            (found.discs[d], [k for k in loaded if k in touching(scene, disc.id)])
            for d, disc in enumerate(scene.discs)
        ),
    ]:
        if not chosen:
            assert tensor is None
            continue
        normals = [scene.contacts[k].normal for k in chosen]
        xx, xy, yy = (
            sum((n[i] * n[j] for n in normals), surd(0)) / len(chosen)
            for i, j in ((0, 0), (0, 1), (1, 1))
        )
        assert tensor == (xx, xy, yy)
        assert tensor[0] + tensor[2] == 1
        values = np.linalg.eigvalsh([[float(xx), float(xy)], [float(xy), float(yy)]])
        assert anisotropy(tensor) == pytest.approx(values[1] - values[0], abs=1e-12)


def test_a_disc_without_force_has_no_fabric() -> None:
    found = fabric(solve(tbs(2)))
    assert found.discs[-1] is None  # the corners of the last fixed row touch nothing
    assert np.isnan(found.array[-1]).all()
    with pytest.raises(InputError, match="a contact that carries a force"):
        found.of((4, 4))


def test_floating_point_gives_the_same_fabric_exactly() -> None:
    assert fabric(solve(nt30(5), "newton")).pile == fabric(solve(nt30(5))).pile


# --- coordination ---


@EVERY_SCENE
def test_coordination_counts_states_disc_by_disc(scene: Scene) -> None:
    solution = solve(scene)
    found = coordination(solution)
    for d, disc in enumerate(scene.discs):
        states = [solution.states[k] for k in touching(scene, disc.id)]
        assert found.loaded[d] == states.count("closed")
        assert found.touching[d] == states.count("closed") + states.count("osculatory")
    supports = sum(not isinstance(c.b, tuple) for c in scene.contacts)
    assert 2 * solution.count("closed") - supports <= found.loaded.sum()
    assert found.loaded.sum() <= 2 * solution.count("closed")


def test_mean_coordination_by_hand() -> None:
    """NT60 of two layers: its one free disc rests on two stones."""
    assert coordination(solve(nt60(2))).mean == Fraction(2)


# --- every field ---


@EVERY_FIELD
@pytest.mark.parametrize("scene", [nt60(4), tss(5), tbs(4)], ids=["nt60", "tss", "tbs"])
def test_every_field_has_its_table_and_picture(field: Field, scene: Scene) -> None:
    found = field.compute(solve(scene))
    table = field.table(found)
    header = table.header()
    assert len(header) == len(set(header))
    for row, line in zip(table.rows, table.lines(), strict=True):
        assert len(row) == len(table.columns)
        assert len(line) == len(header)
        for name, text in zip(header, line, strict=True):
            if name + "_decimal" in header and text:
                near = float(line[header.index(name + "_decimal")])
                assert float(surd(text)) == pytest.approx(near, rel=1e-15)
    if field.shape is not None:
        ax = draw_field(field.shape(found))
        assert ax.collections or ax.lines


@EVERY_FIELD
def test_fields_of_floating_point_solutions(field: Field) -> None:
    """The same rows as the exact solution's, with the same decimals to rounding."""
    exact = field.table(field.compute(solve(nt30(6, push=28))))
    near = field.table(field.compute(solve(nt30(6, push=28), "newton")))
    assert near.columns == exact.columns
    assert len(near.rows) == len(exact.rows)
    for one, other in zip(exact.rows, near.rows, strict=True):
        for x, y in zip(one, other, strict=True):
            if isinstance(x, str | int) or x is None:
                assert x == y
            else:
                assert float(x) == pytest.approx(float(y), abs=1e-9, nan_ok=True)


@EVERY_FIELD
def test_fields_refuse_what_is_not_solved(field: Field) -> None:
    with pytest.raises(InputError, match="unstable"):
        field.compute(solve(nt60(3).without([(3, 1)])))


def test_exact_cells_keep_their_text_and_others_leave_it_empty() -> None:
    table = Table((Column("a"), Column("b", exact=True)), [[None, surd("1/3")], [1, 0.5]])
    assert list(table.lines()) == [["", "1/3", "0.33333333333333333"], ["1", "", "0.5"]]


def test_fields_need_no_matplotlib() -> None:
    program = (
        "import sys; from lcp_piles import FIELDS, nt60, solve\n"
        "found = [(f.compute(solve(nt60(3))), f) for f in FIELDS.values()]\n"
        "[list(f.table(x).lines()) for x, f in found]\n"
        "assert 'matplotlib' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True, cwd=Path(__file__).parents[1])
