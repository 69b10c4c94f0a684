"""The figures of the paper, by their numbers. Pictures are only asked to be there.

Table 1 is held against the 23 values that the paper prints (printed_table1.json). The contacts that
change first and last, and the last pushes on other floors, are those of the notes on conventions
that the project started from, found there by another solver.
"""

from __future__ import annotations

import csv
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from lcp_piles import InputError, base_pressure, decimal, nt30, nt60, push_path, solve, surd
from lcp_piles.paper.figures_fields import size_plate
from lcp_piles.paper.figures_flowchart import _LOOKS
from lcp_piles.paper.figures_networks import hong_remark, network_plate
from lcp_piles.paper.figures_push import apex_pressure_plate
from lcp_piles.paper.figures_table1 import printed
from lcp_piles.paper.reproduce import FIGURES, NAMES, reproduce
from lcp_piles.pictures.drawing import BLACK, BLUE, GREEN, RED

PRINTED = printed()
SQRT3 = surd("sqrt(3)")


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def changes(rearrangement: object) -> set[tuple[object, object, str]]:
    return {(c.a, c.b, "opens") for c in rearrangement.opens} | {
        (c.a, c.b, "closes") for c in rearrangement.closes
    }


# --- Table 1 ---


def test_all_23_printed_values_come_out_exactly_on_the_papers_floor():
    path = push_path("nt30", 6, floor_compliance="-1/2")
    assert [r.push for r in path.rearrangements] == [surd(x) * SQRT3 for x in PRINTED]
    assert path.end == "asymptotic"


def test_first_and_last_rearrangement_of_the_papers_floor():
    found = push_path("nt30", 6, floor_compliance="-1/2").rearrangements
    assert changes(found[0]) == {
        ((3, 2), (3, 3), "closes"),
        ((3, 5), (3, 6), "closes"),
    }
    assert changes(found[22]) == {
        ((2, 2), (3, 4), "opens"),
        ((2, 3), (3, 4), "opens"),
    }


@pytest.mark.parametrize(("floor", "last"), [("1", "667/6*sqrt(3)"), ("0", "577/6*sqrt(3)")])
def test_other_floors_also_rearrange_23_times_but_elsewhere(floor, last):
    found = [r.push for r in push_path("nt30", 6, floor_compliance=floor).rearrangements]
    assert len(found) == 23
    assert found[-1] == surd(last)
    assert not set(found) & {surd(x) * SQRT3 for x in PRINTED}


def test_the_table_that_is_written_holds_the_printed_one(tmp_path):
    files = reproduce(tmp_path, ["table1"])
    assert [file.name for file in files] == ["table1.csv", "table1.md"]
    table = rows_of(files[0])
    assert [surd(row["push_floor_-1/2"]) for row in table] == [surd(x) * SQRT3 for x in PRINTED]
    for row in table:
        for floor in ("-1/2", "1", "0"):
            exact = surd(row[f"push_floor_{floor}"])
            assert row[f"decimal_floor_{floor}"] == decimal(exact, 10)
    assert table[22]["changes_floor_-1/2"] == "(2,2)-(3,4) opens; (2,3)-(3,4) opens"
    lines = files[1].read_text(encoding="utf-8").splitlines()
    assert len(lines) == 2 + 23
    assert len({line.count("|") for line in lines}) == 1
    value = "64757787245/13047053469*sqrt(3)"
    assert lines[2].startswith(f"| 1 | {value} | {value} | 8.596866562 |")


# --- figures ---


def test_names_are_in_the_papers_order():
    kinds = [name.split("-")[-1] for name in NAMES if name.startswith("network")]
    assert kinds == ["tbs", "tss", "nt60", "nt30"]
    assert NAMES[0] == "scenes-tbs"
    assert NAMES[-1] == "table1"


def test_every_picture_has_its_numbers_beside_it(tmp_path):
    said = []
    wanted = ["scenes-nt60", "flowchart", "network-tss", "stress-nt30", "pressure-tbs"]
    files = reproduce(tmp_path / "new", wanted, said.append)
    assert said == wanted
    assert [file.name for file in files] == [
        n + e for n in wanted for e in (".png", ".pdf", ".csv")
    ]
    for file in files:
        if file.suffix == ".png":
            assert file.read_bytes().startswith(b"\x89PNG\r\n")
        elif file.suffix == ".pdf":
            assert file.read_bytes().startswith(b"%PDF")
        else:
            assert len(rows_of(file)) > 3


def test_network_numbers_are_those_of_the_solution(tmp_path):
    *_, file = reproduce(tmp_path, ["network-nt30"])
    rows = rows_of(file)
    assert {row["floor"] for row in rows} == {"1", "-1/2"}
    for floor in ("1", "-1/2"):
        solution = solve(nt30(6, floor_compliance=floor))
        mine = [row for row in rows if row["floor"] == floor]
        assert [surd(row["force"]) for row in mine] == list(solution.forces)
        assert [row["state"] for row in mine] == list(solution.states)


def test_osculatory_contacts_of_the_tss_figure_are_zero_forces_that_z_keeps(tmp_path):
    """The paper: "the force vanishes exactly, even though the corresponding contact does exist"."""
    *_, file = reproduce(tmp_path, ["network-tss"])
    rows = rows_of(file)
    kept = [row for row in rows if row["floor"] == "-1/2 by Z" and row["state"] == "osculatory"]
    assert {(row["a"], row["b"]) for row in kept} == {("(8,2)", "(9,2)"), ("(8,7)", "(9,8)")}
    assert {row["force"] for row in kept} == {"0"}
    mine = [row for row in rows if row["floor"] == "-1/2"]
    assert "osculatory" not in {row["state"] for row in mine}


def test_the_figure_of_nt60_says_where_it_differs_from_the_paper():
    """On the paper's floor nothing above the base row is pressed sideways, as the paper says."""
    figure = network_plate("nt60", 9, remark=hong_remark).picture
    soft, papers = (ax.get_title().split("\n") for ax in figure.axes)
    assert papers[0].endswith("(the paper's floor)")
    assert papers[-1] == "horizontal contacts with force above the base row: 0 (the paper: none)"
    solution = solve(nt60(9))
    pressed = {
        (c.a, c.b)
        for c, state in zip(solution.scene.contacts, solution.states, strict=True)
        if state == "closed" and c.b != "floor" and c.a[0] == c.b[0] < 9
    }
    assert soft[-1].startswith(f"horizontal contacts with force above the base row: {len(pressed)}")
    assert len(pressed) == 6


def test_base_row_and_stones_carry_the_weight_in_the_pressure_figure(tmp_path):
    """51 discs; the stones carry themselves, and what rests on them of the rows above: nothing."""
    *_, file = reproduce(tmp_path, ["pressure-nt30"])
    for floor in ("1", "-1/2"):
        rows = [r for r in rows_of(file) if (r["floor"], r["layers"]) == (floor, "6")]
        assert len(rows) == 14
        assert sum((surd(r["normal"]) for r in rows), surd(0)) == 51 - 2


def test_apex_curve_starts_at_the_unpushed_pile_and_ends_at_three_halves(tmp_path):
    *_, file = reproduce(tmp_path, ["apex-pressure"])
    for floor in ("1", "-1/2"):
        rows = [row for row in rows_of(file) if row["floor"] == floor]
        profile = base_pressure(solve(nt30(6, floor_compliance=floor)))
        assert surd(rows[0]["force"]) == profile[6].normal == profile[7].normal
        assert [row["rearrangement"] for row in rows] == ["no"] + ["yes"] * 23 + ["no"]
        assert {surd(row["force"]) for row in rows[-3:]} == {surd(Fraction(3, 2))}


def test_unknown_figures_and_places_are_refused(tmp_path):
    with pytest.raises(InputError, match="'network-nt45', expected one of scenes-tbs"):
        reproduce(tmp_path, ["scenes-tbs", "network-nt45"])
    assert not list(tmp_path.iterdir())
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InputError, match="directory of the figures"):
        reproduce(tmp_path / "file", ["scenes-tbs"])


@pytest.mark.slow
def test_the_whole_paper(tmp_path, monkeypatch):
    """Of the sizes of two figures only some, the largest among them."""
    for kind, letters, sizes in (("tbs", "adef", (2, 30, 120)), ("tss", "ade", (4, 13, 30))):
        plate = partial(size_plate, kind, letters, sizes)
        monkeypatch.setitem(FIGURES, f"size-{kind}", plate)
    files = reproduce(tmp_path)
    pictures = {file.stem for file in files if file.suffix == ".png"}
    assert pictures == set(NAMES) - {"table1"}
    size = rows_of(tmp_path / "size-tbs.csv")
    after = {row["letter"]: row["force"] for row in size if row["layers"] == "120"}
    assert after == {"a": "1", "d": "2", "e": "0", "f": "1"}


def test_the_first_rearrangements_have_a_panel_of_their_own():
    """On the paper's floor ten of the 23 printed pushes are below 15 w tau."""
    whole, first = apex_pressure_plate(6).picture.axes
    dots = [ax.lines[1].get_xdata() for ax in (whole, first)]
    below = sum(float(surd(x)) * 3**0.5 < 15 for x in PRINTED)
    assert [sum(x < 15 for x in found) for found in dots] == [0, below] == [0, 10]
    assert len(dots[1]) == 23
    low, high = first.get_xlim()
    assert (low, whole.get_title()) == (0, "NT30, $N = 6$; dots: the network rearranges")
    assert high > 15
    across = first.get_position().width * 6.4 * 72 / (high - low)
    assert min(np.diff([x for x in dots[1] if x < high])) * across > 1  # points apart


@pytest.mark.parametrize("colours", [[look[0] for look in _LOOKS.values()], [BLACK, BLUE, RED]])
def test_colours_that_stand_for_something_differ_for_the_colour_blind(colours):
    """Machado, Oliveira and Fernandes (2009) at severity 1; 25 is far above what is just noticed.

    Red and green of the package are closer than that, as the last line asserts.
    """
    assert least_difference(colours) > 25
    assert least_difference([RED, GREEN]) < 25


def least_difference(colours):
    """The least CIE76 difference of two of the colours without red or green cones, from sRGB."""
    blind = (
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
    )
    xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    rgb = np.array([to_rgb(colour) for colour in colours])
    light = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    least = np.inf
    for seen in blind:
        part = np.clip(light @ np.transpose(seen), 0, 1) @ np.transpose(xyz) / [0.9505, 1, 1.089]
        f = np.where(part > 0.008856, np.cbrt(part), 7.787 * part + 16 / 116)
        x, y, z = f.T
        lab = np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=1)
        apart = np.linalg.norm(lab[:, None] - lab, axis=2)
        least = min(least, apart[~np.eye(len(lab), dtype=bool)].min())
    return least
