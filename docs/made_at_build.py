"""What pages show but nobody writes: pictures that their commands draw, and the help of each."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path

from blocks import blocks, commands

from lcp_piles.cli.parser import build_parser, main


def make(folder: Path, pages: list[Path]) -> None:
    """Write the help of all commands, and of each page the pictures of its commands."""
    folder.mkdir(exist_ok=True)
    (folder / "commands.md").write_text(help_of_commands(), encoding="utf-8")
    for page in pages:
        draw(folder / page.stem, page)


def help_of_commands() -> str:
    """A section for each command, with what `--help` says."""
    parser = build_parser()
    (names,) = (action.choices for action in parser._subparsers._group_actions)
    pages = {"lcp-piles": parser} | {f"lcp-piles {name}": names[name] for name in names}
    sections = (f"## {name}\n\n```text\n{page.format_help()}```\n" for name, page in pages.items())
    return "\n".join(sections)


def draw(folder: Path, page: Path) -> None:
    """Run the commands of a page that draw, in a folder with the files of the page."""
    folder.mkdir(exist_ok=True)
    with contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()):
        for block in blocks(page):
            if block.file:
                Path(block.file).write_text(block.text, encoding="utf-8")
            for words, status in commands(block) if block.kind == "sh" else ():
                if "--plot" in words and main([*words, "--quiet"]) != status:
                    raise RuntimeError(f"{page}: {' '.join(words)}")
