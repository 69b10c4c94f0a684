"""The blocks of a page between fences: what is a file, a command, an example in Python."""

from __future__ import annotations

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

_FENCED = re.compile(
    r"^```(?P<kind>\S*)(?P<rest>[^\n]*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL
)
_CAPTION = re.compile(r"\A:caption: (\S+)\n\n?")


@dataclass(frozen=True)
class Block:
    """A block of some kind, beginning at a line; the `file` that its caption names, if it does."""

    kind: str
    text: str
    line: int
    file: str | None = None


def blocks(page: Path) -> list[Block]:
    """The blocks of a page, in order."""
    whole = page.read_text(encoding="utf-8")
    found = []
    for match in _FENCED.finditer(whole):
        kind, text = match["kind"], match["text"]
        caption = None
        if kind == "{code-block}":
            kind = match["rest"].strip()
            caption = _CAPTION.match(text)
            text = text[caption.end() :] if caption else text
        line = whole.count("\n", 0, match.start("text"))
        found.append(Block(kind, text, line, caption[1] if caption else None))
    return found


_STATUS = re.compile(r"# exit status (\d+)$")


def commands(block: Block) -> list[tuple[list[str], int]]:
    """The commands of this package in a shell's block: the words after its name, and the status.

    That is 0 but where a comment at the end says so: `# exit status 4`.
    """
    found = []
    for line in block.text.replace("\\\n", " ").splitlines():
        words = shlex.split(line, comments=True)
        status = _STATUS.search(line)
        if words[:1] == ["lcp-piles"]:
            found.append((words[1:], int(status[1]) if status else 0))
    return found
