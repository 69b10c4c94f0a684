"""`lcp-piles bounds`, and the pictures of friction."""

import csv
from pathlib import Path

import numpy as np
import pytest
from test_cli import run

from lcp_piles import InputError, contact_bounds, force_bounds, nt30, solve, surd, tbs, tss
from lcp_piles.pictures import draw_bounds, draw_friction


def test_the_table_the_csv_and_the_picture(capsys, tmp_path: Path) -> None:
    file, picture = tmp_path / "bounds.csv", tmp_path / "bounds.png"
    words = ("bounds", "nt30", "--layers", "4", "--friction", "1/10*sqrt(3)")
    status, out, err = run(capsys, *words, "--csv", str(file), "--plot", str(picture))
    assert status == 0
    assert "every bound by duality" in out
    rows = {row["contact"]: row for row in csv.DictReader(file.open())}
    assert rows["(4,6)-floor"]["least"] == "0"
    assert rows["(4,6)-floor"]["largest"] == "31995041471/4077740898"
    assert rows["(4,5)-(4,6)"]["largest"] == ""
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert "wrote" in err


def test_csv_on_standard_output_stands_alone(capsys) -> None:
    words = ("bounds", "tss", "--layers", "4", "--friction", "1/10*sqrt(3)", "--rough")
    status, out, err = run(capsys, *words, "--csv", "-", "--jobs", "2")
    assert status == 0
    rows = {row["contact"]: row for row in csv.DictReader(out.splitlines())}
    assert rows["(4,3)-floor"]["least"] == "1990/1663"
    assert rows["(4,3)-floor"]["largest"] == "1992752/467467"
    assert "floor as rough" in err


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("tbs", "--friction", "1/5", "--rough"), 2, "no supports"),
        (("tbs", "--friction", "-1/5"), 1, "at least 0"),
        (("tbs", "--friction", "x"), 2, "x"),
        (("tbs",), 2, "--friction"),
        (("tbs", "--friction", "1/5", "--jobs", "0"), 2, "processes"),
        (("nt30", "--friction", "1/5", "--floor-compliance", "-1/2"), 1, "held closed"),
    ],
)
def test_what_cannot_be_done_is_said(capsys, words, status, said) -> None:
    found, out, err = run(capsys, "bounds", words[0], "--layers", "2", *words[1:])
    assert found == status
    assert said in err + out


def test_the_widths_of_the_intervals_are_those_of_the_forces() -> None:
    bounds = contact_bounds(nt30(3), "1/10*sqrt(3)")
    lines = {c.get_label(): c for c in draw_bounds(bounds).collections}
    assert set(lines) == {"discs", "no largest force", "largest force", "least force"}
    assert len(lines["no largest force"].get_segments()) == bounds.largest.count(None)
    least = np.array([float(x) for x in bounds.least if x])
    widths = np.array(lines["least force"].get_linewidths())
    wide = widths > 0.5
    ratios = (widths / least)[wide]
    assert len(ratios) > 2
    assert ratios == pytest.approx(np.full(len(ratios), ratios[0]))


def test_forces_inside_are_pieces_in_the_scale_of_the_largest() -> None:
    """Each piece is as much narrower than the outer line as its force is less than the largest."""
    bounds = contact_bounds(tbs(2), "1/10*sqrt(3)")
    forces = solve(tbs(2)).forces
    ax = draw_bounds(bounds, inside={"frictionless": list(forces)})
    lines = {c.get_label(): c for c in ax.collections}
    outer = np.array(lines["largest force"].get_linewidths())
    inner = np.array(lines["frictionless"].get_linewidths())
    shares = np.array([float(f / most) for f, most in zip(forces, bounds.largest, strict=True)])
    assert inner == pytest.approx(outer * shares)
    assert ax.get_legend().get_texts()[0].get_text() == "frictionless, same scale"
    with pytest.raises(InputError, match="networks inside is 3"):
        draw_bounds(bounds, inside={name: list(forces) for name in "abc"})


def test_slipping_contacts_are_those_at_the_limit() -> None:
    scene, mu = tss(4), surd("1/10*sqrt(3)")
    network = force_bounds(scene, mu, {((4, 3), "floor"): 1}, ("floor",)).largest.network
    lines = {c.get_label(): c for c in draw_friction(scene, network, mu).collections}
    pairs = list(zip(network.normal, network.tangential, strict=True))
    slipping = sum(bool(f) and abs(s) == mu * f for f, s in pairs)
    assert slipping > 0
    assert len(lines["slips"].get_segments()) == slipping
