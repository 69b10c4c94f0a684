"""The study of disorder: resumable rows, figures from them, and the bars' comparison."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.disorder import figures, study
from benchmarks.disorder.bars import CASES, row
from benchmarks.disorder.base_chain import counts


def test_rows_are_made_once_and_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cases = [study.Case("nt60", 5, "1"), study.Case("nt60", 5, "100")]
    monkeypatch.setattr(study, "CASES", cases[:1])
    study.run(20, tmp_path)
    first = (tmp_path / "study.csv").read_text()
    monkeypatch.setattr(study, "CASES", cases)
    study.run(20, tmp_path)
    assert (tmp_path / "study.csv").read_text().startswith(first)
    found = study.rows(tmp_path)
    assert [r["case"] for r in found] == ["nt60 5 1", "nt60 5 100"]
    assert set(study.curves(tmp_path)) == {"nt60 5 1", "nt60 5 100"}
    # Closed contacts less freedoms, and mechanisms, make self-stresses.
    for r in found:
        stresses = float(r["contacts less freedoms"]) + float(r["mechanisms"])
        assert float(r["self-stresses"]) == pytest.approx(stresses, abs=1e-3)


def test_every_case_of_the_study_is_kept() -> None:
    assert [r["case"] for r in study.rows()] == [case.name for case in study.CASES]
    assert set(study.curves()) == {case.name for case in study.CASES}


@pytest.mark.slow
def test_the_figures_are_drawn_from_what_is_kept(tmp_path: Path) -> None:
    figures.draw_all(tmp_path)
    assert len(list(tmp_path.glob("disorder-*.png"))) == 5


def test_the_rest_of_self_stress_is_the_bottom_row() -> None:
    found = counts("nt60", 5, 60)
    told = sum(number for (closed, stresses), number in found.items() if stresses == closed)
    assert told >= 57
    assert {closed for closed, _ in found} == {True, False}


def test_a_row_of_bars_is_a_row() -> None:
    assert row(*CASES[0][:1], 3, "1", 2).startswith("| NT30 3 | 1 | ")
