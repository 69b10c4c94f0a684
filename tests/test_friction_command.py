"""`lcp-piles friction`: first loading on the command line."""

import csv
from pathlib import Path

import pytest
from test_cli import run

from lcp_piles.cli import friction_command
from lcp_piles.friction.first_loading import UnresolvedError


def test_the_summary_the_csv_and_the_picture(capsys, tmp_path: Path) -> None:
    file, picture = tmp_path / "forces.csv", tmp_path / "forces.png"
    words = ("friction", "tss", "--layers", "4", "--friction", "1/10*sqrt(3)", "--rough")
    status, out, err = run(capsys, *words, "--csv", str(file), "--plot", str(picture))
    assert status == 0
    assert "10 stick, 4 slip, 3 open" in out
    rows = {row["contact"]: row for row in csv.DictReader(file.open())}
    assert rows["(4,3)-floor"]["normal"] == "3335/1092"
    assert rows["(4,3)-floor"]["state"] == "stick"
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert "wrote" in err


def test_a_search_says_that_the_solution_is_the_only_one(capsys) -> None:
    words = ("friction", "nt60", "--layers", "2", "--friction", "3/10", "--ratio", "1/2", "--all")
    status, out, _ = run(capsys, *words)
    assert status == 0
    assert "one: no other states have a solution" in out
    assert "tangential stiffness 1/2" in out


def test_what_is_not_resolved_is_said(capsys, monkeypatch) -> None:
    def fails(*_, **__):
        raise UnresolvedError("nothing is proved")

    monkeypatch.setattr(friction_command, "first_loading", fails)
    status, out, _ = run(capsys, "friction", "tbs", "--layers", "1", "--friction", "1/5")
    assert (status, out) == (5, "unresolved: nothing is proved\n")


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("tbs", "--friction", "1/5", "--rough"), 2, "no supports"),
        (("tbs", "--friction", "1/5", "--ratio", "0"), 2, "positive"),
        (("tbs", "--friction", "1/5", "--ratio", "sqrt(2)"), 1, "rational"),
        (("nt30", "--friction", "1/5", "--floor-compliance", "0"), 1, "compliance"),
        (("nt30", "--layers", "4", "--friction", "1/5", "--all"), 1, "number of contacts"),
    ],
)
def test_what_cannot_be_done_is_said(capsys, words, status, said) -> None:
    layers = () if "--layers" in words else ("--layers", "2")
    found, out, err = run(capsys, "friction", *words, *layers)
    assert found == status
    assert said in err + out


def test_bounds_count_the_corners_of_a_tiny_pile(capsys) -> None:
    """TSS 3: seven corners (all bases tried, see the tests of corners)."""
    words = ("tss", "--layers", "3", "--friction", "1/5*sqrt(3)", "--inside")
    status, out, _ = run(capsys, "bounds", *words)
    assert status == 0
    assert "corners         7, volume 141/640" in out
