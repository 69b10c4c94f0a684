"""What the README says holds: its map, its commands and its snippets."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

import lcp_piles
from lcp_piles.cli.parser import build_parser

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PACKAGE = Path(lcp_piles.__file__).parent
MAP = re.findall(r"^\| (?:`(\w+)`|\(itself\)) \| [^|]+ \| ([^|]+) \|$", README, flags=re.MULTILINE)
SNIPPETS = re.findall(r"```python\n(.*?)```", README, flags=re.DOTALL)
COMMANDS = re.findall(r"^\| `lcp-piles (.+?)` \|", README, flags=re.MULTILINE)


def test_the_map_names_every_folder_once() -> None:
    folders = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    named = [folder for folder, _ in MAP if folder]
    assert sorted(named) == sorted(folders)


@pytest.mark.parametrize(("folder", "modules"), MAP, ids=[folder or "itself" for folder, _ in MAP])
def test_the_map_names_modules_that_are_there(folder: str, modules: str) -> None:
    names = re.findall(r"`(\w+)`", modules)
    assert names
    for name in names:
        place = PACKAGE / folder / name
        assert place.is_dir() or place.with_suffix(".py").is_file(), name


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_are_understood(command: str) -> None:
    assert build_parser().parse_args(shlex.split(command)).run


@pytest.mark.parametrize("number", range(len(SNIPPETS)))
def test_snippets_run(number: int, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(SNIPPETS[number], f"README snippet {number + 1}", "exec"), {})


def test_every_command_is_named() -> None:
    parser = build_parser()
    (commands,) = (a.choices for a in parser._subparsers._group_actions)
    assert {command.split()[0] for command in COMMANDS} == set(commands)
