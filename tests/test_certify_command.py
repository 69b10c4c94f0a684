"""`lcp-piles certify`, and certificates as other commands write them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from lcp_piles.certificates import check_certificate as checker
from lcp_piles.cli.parser import main

WRITTEN = {
    "solve": ["solve", "nt30", "--layers", "3"],
    "push": ["push", "nt30", "--layers", "3"],
    "bounds": ["bounds", "nt60", "--layers", "2", "--friction", "3/10", "--rough"],
}


@pytest.mark.parametrize("name", WRITTEN)
def test_commands_write_certificates_that_the_checker_proves(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "certificate.json"
    assert main([*WRITTEN[name], "--certificate", str(file)]) == 0
    words = checker.check(file.read_bytes())
    capsys.readouterr()
    assert main(["certify", str(file)]) == 0
    shown = capsys.readouterr().out
    assert shown.splitlines() == ["proved:", *(f"  {word}" for word in words)]


def test_a_result_file_is_certified(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result, file = tmp_path / "result.json", tmp_path / "certificate.json"
    assert main(["solve", "tss", "--layers", "3", "--json", str(result)]) == 0
    capsys.readouterr()
    assert main(["certify", str(result), "--out", str(file)]) == 0
    assert "the equilibrium is saddle" in capsys.readouterr().out
    assert checker.check(file.read_bytes())[-1] == "the equilibrium is saddle"


def test_a_result_file_that_lies_is_not_certified(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result, file = tmp_path / "result.json", tmp_path / "certificate.json"
    assert main(["solve", "tss", "--layers", "3", "--json", str(result)]) == 0
    content = json.loads(result.read_text())
    content["stability"] |= {"mechanisms": 3}
    result.write_text(json.dumps(content))
    assert main(["certify", str(result), "--out", str(file)]) == 1
    assert "mechanisms is 3" in capsys.readouterr().err
    assert not file.exists()


def test_an_altered_certificate_is_not_proved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "certificate.json"
    assert main(["solve", "nt30", "--layers", "2", "--certificate", str(file)]) == 0
    content = json.loads(file.read_text())
    content["scene"]["layers"] = 3
    file.write_text(json.dumps(content))
    capsys.readouterr()
    assert main(["certify", str(file)]) == 1
    assert capsys.readouterr().out.startswith("not proved: ")


def test_words_that_do_not_fit(tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"
    assert main(["solve", "nt30", "--layers", "2", "--certificate", str(file)]) == 0
    assert main(["certify", str(file), "--out", str(tmp_path / "other.json")]) == 2
    assert main(["solve", "nt30", "--layers", "2", "--json", str(tmp_path / "r.json")]) == 0
    assert main(["certify", str(tmp_path / "r.json")]) == 2
    assert main(["certify", str(tmp_path / "nowhere.json")]) == 1
    (tmp_path / "list.json").write_text("[]")
    assert main(["certify", str(tmp_path / "list.json")]) == 1
    words = ["solve", "nt30", "--layers", "2", "--method", "newton"]
    assert main([*words, "--certificate", str(tmp_path / "float.json")]) == 1


def test_rows_on_request(tmp_path: Path) -> None:
    file = tmp_path / "result.json"
    words = ["solve", "tbs", "--layers", "40", "--json", str(file)]
    assert main(words) == 0
    assert "vectors" in json.loads(file.read_text())
    assert main([*words, "--rows"]) == 0
    assert len(json.loads(file.read_text())["contacts"]) == 2460
