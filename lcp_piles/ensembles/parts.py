"""The samples of an ensemble in files: a part has the lines of `PART` numbers in a row.

A part is written to a temporary file, synced and renamed, so it is there whole or not at all. A
part that was cut short all the same, by a full disc or a copy that was stopped, loses what follows
its last whole line; those samples are made again.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..errors import FileFormatError
from ..files.safe_read import read_text
from ..files.safe_write import sync_folder, write_text
from .record import is_whole, number_of_line

PART = 32
"""Numbers of samples in a part, which is a batch of work too."""
_PREFIX, _ENDING = "part-", ".jsonl"


def part_of(k: int) -> int:
    """The part that sample k stands in."""
    return k // PART


def parts_of(folder: Path) -> list[int]:
    """The parts that a folder has, in order."""
    found = []
    for path in folder.glob(f"{_PREFIX}*{_ENDING}"):
        digits = path.name[len(_PREFIX) : -len(_ENDING)]
        if digits.isascii() and digits.isdecimal():
            found.append(int(digits))
    return sorted(found)


def lines_of_part(folder: Path, part: int) -> dict[int, str]:
    """The lines of a part by the number of their sample, in order; a torn tail is left out."""
    path = _path(folder, part)
    if not path.exists():
        return {}
    whole, _, _ = read_text(path).rpartition("\n")
    found: dict[int, str] = {}
    lines = whole.split("\n") if whole else []
    for i, line in enumerate(lines):
        k = number_of_line(line)
        if i == len(lines) - 1 and not is_whole(line):
            break  # torn
        if k is None or part_of(k) != part or k in found:
            raise FileFormatError(
                f"{path}, line {i + 1}",
                line[:40],
                "a sample of this part, each once",
                "delete the file, and its samples are made again",
            )
        found[k] = line
    return dict(sorted(found.items()))


def write_part(folder: Path, part: int, lines: dict[int, str]) -> None:
    """Write a part, in place of the one that is there."""
    text = "".join(f"{lines[k]}\n" for k in sorted(lines))
    write_text(_path(folder, part), text)
    sync_folder(folder)


def all_lines(folder: Path, samples: int | None = None) -> Iterator[str]:
    """The lines of a folder in the order of their samples, of the first so many; a part a time."""
    for part in parts_of(folder):
        for k, line in lines_of_part(folder, part).items():
            if samples is None or k < samples:
                yield line


def missing(folder: Path, samples: int) -> Iterator[tuple[int, list[int]]]:
    """The parts that lack some of the first so many samples, and which these are."""
    there = set(parts_of(folder))
    for part in range(part_of(samples + PART - 1)):
        ks = range(part * PART, min((part + 1) * PART, samples))
        found = lines_of_part(folder, part) if part in there else {}
        lacking = [k for k in ks if k not in found]
        if lacking:
            yield part, lacking


def _path(folder: Path, part: int) -> Path:
    return folder / f"{_PREFIX}{part:08d}{_ENDING}"
