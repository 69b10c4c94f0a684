"""The command line: output, exit statuses, bad input."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest

from lcp_piles import load, verify
from lcp_piles.cli.parser import main


def run(capsys, *words: str) -> tuple[int, str, str]:
    """Exit status, standard output and standard error of a command."""
    try:
        status = main(words)
    except SystemExit as stop:
        status = int(stop.code or 0)
    captured = capsys.readouterr()
    assert "Traceback" not in captured.err
    return status, captured.out, captured.err


def test_solve_prints_a_summary_and_writes_its_files(capsys, tmp_path: Path) -> None:
    file, picture = tmp_path / "pile.json", tmp_path / "pile.png"
    words = ("solve", "nt30", "--layers", "6", "--json", str(file), "--plot", str(picture))
    status, out, err = run(capsys, *words)
    assert status == 0
    for piece in ("exact", "yes", "98 degrees of freedom, 129 contacts", "113 closed, 16 open"):
        assert piece in out
    assert "stable (0 mechanisms)" in out
    assert "the same states" in out
    assert "wrote" in err
    solution = load(file)
    assert verify(solution.scene, solution).ok
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_json_on_standard_output_is_json_alone(capsys) -> None:
    status, out, err = run(capsys, "solve", "tbs", "--layers", "2", "--json", "-")
    assert status == 0
    assert json.loads(out)["scene"] == {"kind": "tbs", "layers": 2}
    assert "largest force" in err


@pytest.mark.parametrize(
    "words",
    [
        ("--floor-compliance", "-1/2"),
        ("--push", "-10"),
        ("--push=-10",),
        ("--push", "-1/2*sqrt(3)"),
        ("--push", "-sqrt(3)"),
        ("--push", "0.5"),
        ("--push", "1e-3"),
        ("--push", "-1.5e2"),
        ("--floor-compliance", "0.5"),
        ("--push", "2 - 1/2*sqrt(3)"),
        ("--corner-stones", "resting", "--whole"),
        ("--method", "lemke"),
        ("--method", "newton"),
        ("--digits", "30"),
    ],
    ids=" ".join,
)
def test_parameters_as_people_write_them(words: tuple[str, ...], capsys) -> None:
    status, out, _ = run(capsys, "solve", "nt30", "--layers", "3", *words)
    assert status == 0
    assert "largest force" in out


def test_digits_are_decimals_of_the_largest_force(capsys) -> None:
    """NT60 of two layers: the apex rests on two stones, each with 1/sqrt(3)."""
    _, out, _ = run(capsys, "solve", "nt60", "--layers", "2", "--digits", "30")
    assert "1/3*sqrt(3) = 0.577350269189625764509148780502 w" in out


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("solve", "nt30", "--layers", "0"), 2, "layers of nt30 is 0, expected"),
        (("solve", "nt30", "--layers", "-3"), 2, "layers of nt30 is '-3'"),
        (("solve", "nt30", "--layers", "six"), 2, "layers of nt30 is 'six'"),
        (("solve", "nt45", "--layers", "6"), 2, "'nt45' is neither a kind (nt30, "),
        (("solve", "nt30", "--layers", "6", "--push", "0.5."), 2, "0.5."),
        (("solve", "nt30", "--layers", "6", "--push", "nan"), 2, "nan"),
        (("solve", "nt30", "--layers", "6", "--push", "1/0"), 2, "1/0"),
        (("solve", "nt30", "--layers", "6", "--digits", "0"), 2, "'0' is not a whole number"),
        (("solve", "nt30"), 2, "--layers"),
        ((), 2, "COMMAND"),
        (("solve", "nt30", "--layers", "1"), 2, "layers of nt30 is 1"),
        (("solve", "tbs", "--layers", "3", "--push", "1"), 2, "nothing for tbs"),
        (("solve", "nt30", "--layers", "3", "--json", "/nowhere/x.json"), 1, "/nowhere/x.json"),
        (("solve", "nt30", "--layers", "3", "--plot", "x.gif3"), 1, "gif3"),
        (("compare", "nt30", "--layers", "5..3"), 2, "empty range"),
        (("push", "tbs", "--layers", "3"), 2, "invalid choice: 'tbs'"),
        (("reproduce", "--only", "figure-99"), 1, "figure-99"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else None,
)
def test_bad_input_is_an_error_without_a_traceback(words, status, said, capsys) -> None:
    got, _, err = run(capsys, *words)
    assert got == status
    assert said in err


def test_push_lists_every_rearrangement(capsys, tmp_path: Path) -> None:
    """The paper's floor: first and last line of its Table 1, with q = -push."""
    file = tmp_path / "push.json"
    words = ("push", "nt30", "--layers", "6", "--floor-compliance", "-1/2", "--json", str(file))
    status, out, _ = run(capsys, *words)
    assert status == 0
    assert "64757787245/13047053469*sqrt(3)" in out
    assert "negative compliance" in out
    content = json.loads(file.read_text())
    pushes = [entry["push"] for entry in content["breakpoints"]]
    assert len(pushes) == 23
    assert pushes[-1] == "266/3*sqrt(3)"
    opened = [c for c in content["breakpoints"][-1]["changes"] if c["change"] == "opens"]
    assert {(tuple(c["a"]), tuple(c["b"])) for c in opened} == {((2, 2), (3, 4)), ((2, 3), (3, 4))}


def test_compare_prints_a_line_a_size(capsys) -> None:
    status, out, _ = run(capsys, "compare", "tbs", "--layers", "2..4")
    assert status == 0
    rows = [line.split() for line in out.splitlines()]
    assert [row[:3] for row in rows[1:]] == [
        ["2", "9", "equal"],
        ["3", "18", "equal"],
        ["4", "30", "equal"],
    ]


def test_fields_are_tables_in_decimals_and_exact_in_their_files(capsys, tmp_path: Path) -> None:
    """NT60 of two layers: the fabric is diag(1/4, 3/4), pi sigma_yy of the apex -sqrt(3)/2."""
    table, picture = tmp_path / "pile.csv", tmp_path / "pile.png"
    words = ("fields", "nt60", "--layers", "2", "--show", "fabric,stress")
    status, out, err = run(capsys, *words, "--csv", str(table), "--plot", str(picture))
    assert status == 0
    assert [line.split() for line in out.splitlines()][2] == [
        "pile",
        "2",
        *["0.25", "0", "0.75", "0.5", "90"],
    ]
    assert "\n\nstress: " in out
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        *("pile-fabric.csv", "pile-fabric.png", "pile-stress.csv", "pile-stress.png")
    ]
    with (tmp_path / "pile-stress.csv").open(newline="") as file:
        (apex,) = csv.DictReader(file)
    assert (apex["disc"], apex["pi_sigma_yy"]) == ("(1,1)", "-1/2*sqrt(3)")
    assert float(apex["pi_sigma_yy_decimal"]) == -(3**0.5) / 2
    assert err.count("wrote") == err.count("drew") == 2


def test_one_field_goes_to_the_file_that_is_named_or_to_standard_output(capsys, tmp_path) -> None:
    words = ("fields", "nt60", "--layers", "2", "--show", "coordination")
    status, out, err = run(capsys, *words, "--csv", "-")
    assert status == 0
    assert out.splitlines()[0] == "disc,x,x_decimal,y,y_decimal,loaded,touching"
    assert "mean over the free discs: 2" in err
    status, said, _ = run(capsys, *words, "--csv", str(tmp_path / "z.csv"))
    assert status == 0
    assert (tmp_path / "z.csv").read_text() == out
    assert said.startswith("coordination: ")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--show", "stress,temperature"), "'temperature' is none of stress, pressure"),
        (("--show", ""), "'' is none of"),
        (("--show", "letters", "--plot", "x.png"), "there is no picture of letters"),
        (("--show", "stress", "--csv", ""), "the name is empty"),
        ((), "--show"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else None,
)
def test_fields_that_are_not_there(words, said, capsys) -> None:
    status, out, err = run(capsys, "fields", "nt60", "--layers", "2", *words)
    assert (status, out) == (2, "")
    assert said in err


def test_python_m_is_the_same_command() -> None:
    words = [sys.executable, "-m", "lcp_piles", "solve", "nt60", "--layers", "3"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "NT60, layers 3" in done.stdout


def test_stiffness_is_said_beside_the_rigid_values(capsys) -> None:
    """Rigid, first order and difference; the values of the nonlinear pile are off by 7e-5."""
    words = ("solve", "nt30", "--layers", "6", "--push", "20", "--stiffness", "1/1000")
    status, out, _ = run(capsys, *words)
    assert status == 0
    for piece in ("w rigid", "to first order (+", "no contact changes below tau = 0.0749226"):
        assert piece in out
    assert "off the rigid limit by at most 0.013 w, off the first order by 6.68e-05 w" in out
    _, out, _ = run(capsys, "solve", "tss", "--layers", "4", "--stiffness", "1/1000")
    assert "no equilibrium keeps this network" in out
    assert "(1,1)-(3,2)" in out
    _, out, _ = run(capsys, "solve", "nt30", "--layers", "6", "--stiffness", "1/10")
    assert "no longer" in out


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("--stiffness", "-1"), 2, "positive"),
        (("--stiffness", "0"), 2, "positive"),
        (("--stiffness", "x"), 2, "number"),
        (("--stiffness", "1/10", "--method", "newton"), 1, "newton"),
    ],
)
def test_stiffness_that_makes_no_sense(words, status, said, capsys) -> None:
    found, _, err = run(capsys, "solve", "nt30", "--layers", "3", *words)
    assert found == status
    assert said in err


def test_decimal_text_is_exact(capsys) -> None:
    """-0.5 is -1/2 and 2.5e-1 is 1/4: the same pile, and so the same words but for the times."""
    shown = []
    for push, compliance in (("0.5", "2.5e-1"), ("1/2", "1/4")):
        words = ("solve", "nt30", "--layers", "3", "--push", push)
        status, out, _ = run(capsys, *words, "--floor-compliance", compliance)
        assert status == 0
        shown.append([line for line in out.splitlines() if " s" not in line])
    assert shown[0] == shown[1]
