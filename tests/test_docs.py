"""What the documentation shows comes out: Python, commands, files, and every public name."""

from __future__ import annotations

import ast
import doctest
import re
from pathlib import Path

import pytest

import lcp_piles
from docs.blocks import blocks, commands
from lcp_piles.cli.parser import COMMANDS, main

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.glob("*.md")) + sorted(
    page for folder in ("how-to", "explanation") for page in DOCS.glob(f"{folder}/*.md")
)
OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def test_there_are_pages() -> None:
    assert DOCS / "how-to" / "own_lcp.md" in PAGES


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(DOCS)))
def test_what_a_page_shows_comes_out(page: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    """Blocks in order, in one folder: files are written, commands and Python run.

    A block of text below commands is what they print on standard output.
    """
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    printed = None
    for block in blocks(page):
        place = f"{page}:{block.line + 1}"
        if block.file:
            Path(block.file).write_text(block.text, encoding="utf-8")
        elif block.kind == "sh":
            lines = commands(block)
            assert lines, f"{place}: no command of this package"
            for words, status in lines:
                assert main([*words, "--quiet"]) == status, f"{place}: {words}"
            printed = capsys.readouterr().out
            continue
        elif block.kind == "python":
            test = doctest.DocTestParser().get_doctest(
                block.text, names, page.stem, str(page), block.line
            )
            assert test.examples, f"{place}: nothing to run"
            test.globs = names
            run = doctest.DocTestRunner(optionflags=OPTIONS)
            failed = run.run(test, clear_globs=False).failed
            assert failed == 0, capsys.readouterr().out
        elif block.kind == "text" and printed is not None:
            same = doctest.OutputChecker().check_output(block.text, printed, OPTIONS)
            assert same, f"{place}:\n{printed}"
        printed = None


def test_every_public_name_has_its_place_in_the_reference() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in DOCS.glob("reference/*.md"))
    shown = re.findall(r"^\.\. (?:auto\w+|data):: (\w+)$", text, flags=re.MULTILINE)
    assert sorted(shown) == sorted(lcp_piles.__all__)
    listed = (DOCS / "reference" / "index.md").read_text(encoding="utf-8")
    assert set(re.findall(r"`(\w+)`", listed)) >= set(lcp_piles.__all__)


def test_every_note_has_a_page() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in DOCS.rglob("*.md"))
    for note in (ROOT / "notes").glob("*.md"):
        assert f"notes/{note.name}\n" in text, note.name


def test_every_command_is_shown_somewhere() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    for command in COMMANDS:
        name = command.__name__.rsplit(".", 1)[-1].removesuffix("_command")
        assert f"lcp-piles {name}" in text, name


def test_programs_that_pages_show_are_python() -> None:
    """Those that need a cluster are not run, but they parse and import what there is."""
    shown = [block for page in PAGES for block in blocks(page) if (block.file or "").endswith("py")]
    assert shown
    for block in shown:
        for node in ast.walk(ast.parse(block.text)):
            if isinstance(node, ast.ImportFrom) and node.module == "lcp_piles":
                assert {name.name for name in node.names} <= set(lcp_piles.__all__)
