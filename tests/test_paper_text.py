"""The paper about the package: its references are there, and its figures are those of the notes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAPER = (ROOT / "docs" / "paper" / "paper.md").read_text(encoding="utf-8")
REFERENCES = (ROOT / "docs" / "paper" / "paper.bib").read_text(encoding="utf-8")
BODY = PAPER.split("---\n", 2)[2]
NOTED = re.compile(r"([^.*]*(?:\.\d[^.*]*)*)\(`notes/(\w+)\.md`\)")
"""What is said, up to the name of the note that it is from."""


def test_every_reference_is_cited_and_every_citation_is_a_reference() -> None:
    cited = set(re.findall(r"@(\w+)", BODY))
    assert cited == set(re.findall(r"^@\w+\{(\w+),", REFERENCES, flags=re.MULTILINE))


def test_the_authors_are_those_of_the_citation_file() -> None:
    (name,) = re.findall(
        r'^authors:\n  - name: "(.*)"', (ROOT / "CITATION.cff").read_text(), re.MULTILINE
    )
    assert f"authors:\n  - name: {name}\n" in PAPER


SAID = [(" ".join(text.split()), note) for text, note in NOTED.findall(BODY)]


def test_figures_name_their_notes() -> None:
    assert len(SAID) == 8


@pytest.mark.parametrize(("text", "note"), SAID)
def test_a_figure_stands_in_its_note(text: str, note: str) -> None:
    numbers = re.findall(r"(?<![\w.])-?\d[\d.,e/-]*\d|(?<![\w.])\d(?![\w.])", text)
    assert numbers
    known = (ROOT / "notes" / f"{note}.md").read_text(encoding="utf-8")
    for number in numbers:
        assert re.search(rf"(?<![\d.,]){re.escape(number)}(?!\d)", known), number


def test_its_length() -> None:
    """The Journal of Open Source Software asks for 250 to 1000 words or a little more."""
    assert 700 < len(re.findall(r"\w[\w'-]*", BODY)) < 1300
