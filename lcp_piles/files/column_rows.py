"""Tables of text with named columns: CSV, columns set apart by blanks, and the dumps of LAMMPS.

A file that begins with `ITEM:` is a dump (`dump atom`, `custom` or `local`), of which the last
snapshot counts. Others have a header line of names and then a row a line, cells set apart by
commas, semicolons or blanks. The header may be a comment (`# x y z r`), and that of Yade's
`export.textExt` (`#format x_y_z_r`) is understood. Where there is none, and the first line is all
numbers, columns are named "1", "2", ...
"""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from math import isfinite

from ..errors import FileFormatError, InputError
from .safe_read import read_lines

Lines = Iterator[tuple[int, str]]


@dataclass(frozen=True, eq=False, repr=False)
class Rows:
    """The rows of a file under the names of its columns, each row with the number of its line."""

    file: str
    names: tuple[str, ...]
    rows: Sequence[tuple[int, Sequence[str]]]

    def where(self, line: int) -> str:
        """What people call a line of the file."""
        return f"{self.file}, line {line}"

    def column(self, name: str) -> int:
        """The place of a column, by its name."""
        if self.names.count(name) != 1:
            known = ", ".join(self.names)
            expected = f"one of the columns {known}, once"
            raise FileFormatError(f"the column of {self.file}", name, expected)
        return self.names.index(name)

    def number(self, line: int, cell: str) -> float:
        """The finite number that a cell of some line is."""
        try:
            value = float(cell)
        except ValueError:
            value = float("nan")
        if not isfinite(value) or "_" in cell:
            raise FileFormatError(self.where(line), cell, "a finite number")
        return value


def read_rows(path: str | os.PathLike[str]) -> Rows:
    """The rows of a table or of the last snapshot of a dump; `FileFormatError` by file and line."""
    file = os.fspath(path)
    lines = ((n, line) for n, line in read_lines(path) if line.strip())
    first = next(lines, None)
    if first is None:
        raise FileFormatError(file, "empty", "a table with a header, or a dump of LAMMPS")
    whole = chain([first], lines)
    return _dump(file, whole) if first[1].startswith("ITEM:") else _table(file, whole)


def is_table(path: str | os.PathLike[str]) -> bool:
    """Whether a file may be a table or dump, by its first line: JSON begins with a bracket."""
    first = next((line for _, line in read_lines(path) if line.strip()), "")
    return bool(first) and first.lstrip()[0] not in "{["


def columns_of(
    rows: Rows, known: Mapping[str, Sequence[str]], given: Mapping[str, str]
) -> dict[str, int]:
    """Where the columns are that stand for something: `given` by name, else by a `known` name.

    >>> rows = Rows("forces.csv", ("id1", "id2", "Fn"), [])
    >>> columns_of(rows, {"a": ("a", "id1"), "force": ("force",)}, {"force": "Fn"})
    {'a': 0, 'force': 2}
    """
    for role in given:
        if role not in known:
            raise InputError("the meaning of a column", role, "one of " + ", ".join(known))
    found = {}
    for role, names in known.items():
        name = given.get(role) or next((n for n in names if n in rows.names), None)
        if name is not None:
            found[role] = rows.column(name)
    return found


def _table(file: str, lines: Lines) -> Rows:
    comments: list[str] = []
    number, line = next(lines)
    while line.startswith("#"):
        comments.append(line.lstrip("#").strip())
        number, line = next(lines, (0, ""))
    if not line:
        raise FileFormatError(file, "comments only", "a table")
    split = _splitter(line)
    first = split(number, line)
    names = _names(comments, len(first)) or first
    rows = chain([(number, line)], lines) if names is not first else lines
    if all(map(_is_number, names)):
        names = [str(k + 1) for k in range(len(first))]
        rows = chain([(number, line)], lines)
    return _checked(
        file, names, ((n, split(n, text)) for n, text in rows if not text.startswith("#"))
    )


def _names(comments: Sequence[str], width: int) -> list[str]:
    """The names in the comments above a table of this width, if they have any."""
    for k, comment in enumerate(comments):
        words = comment.split()
        if len(words) == 2 and words[0] == "format":  # Yade: the names of `attrs` come last
            names = words[1].split("_")
            if names[-1] == "attrs":
                names[-1:] = comments[-1].split() if k + 1 < len(comments) else []
            return names
    last = comments[-1].replace(",", " ").replace(";", " ").split() if comments else []
    return last if len(last) == width else []


def _splitter(line: str) -> Callable[[int, str], list[str]]:
    """What splits the lines of a table into cells, by its first one."""
    mark = next((mark for mark in ",;" if mark in line), None)
    if mark is None:
        return lambda _, text: text.split()

    def split(number: int, text: str) -> list[str]:
        try:
            return [cell.strip() for cell in next(csv.reader([text], delimiter=mark))]
        except csv.Error as error:
            raise FileFormatError(f"line {number}", text[:40], f"a row ({error})") from error

    return split


def _checked(file: str, names: Sequence[str], rows: Iterable[tuple[int, Sequence[str]]]) -> Rows:
    """Rows that all have a cell a column."""
    found = []
    for number, cells in rows:
        if len(cells) != len(names):
            where = f"the number of cells in {file}, line {number}"
            raise FileFormatError(where, len(cells), f"{len(names)}: {', '.join(names)}")
        found.append((number, cells))
    return Rows(file, tuple(names), found)


def _dump(file: str, lines: Lines) -> Rows:
    """The last snapshot of a dump; only one is kept at a time."""
    table = count = None
    box: list[tuple[int, str]] = []
    for number, line in lines:
        words = line.split()[1:] if line.startswith("ITEM:") else []
        if words[:2] == ["NUMBER", "OF"]:
            table, count = None, _count(file, *next(lines, (number, "")))
        elif words[:2] == ["BOX", "BOUNDS"]:
            box = list(islice(lines, 3))
        elif words[:1] and words[0] in ("TIMESTEP", "UNITS", "TIME"):
            next(lines, None)
        elif words[1:] and words[0] in ("ATOMS", "ENTRIES") and count is not None:
            rows = ((n, text.split()) for n, text in islice(lines, count))
            table = _checked(file, words[1:], rows)
            if len(table.rows) < count:
                where = f"the number of rows below {file}, line {number}"
                raise FileFormatError(where, len(table.rows), f"{count}, as the dump says")
        else:
            expected = "a line of a snapshot of dump atom, custom or local"
            raise FileFormatError(f"{file}, line {number}", line[:60], expected)
    if table is not None:
        return _unscaled(table, box)
    raise FileFormatError(file, "without a whole snapshot", "ITEM: ATOMS or ENTRIES, with rows")


def _unscaled(table: Rows, box: Sequence[tuple[int, str]]) -> Rows:
    """Places as they are where a dump has them in parts of its box, as `dump atom` writes them."""
    scaled = [(axis, f"{axis}s") for axis in "xyz" if f"{axis}s" in table.names]
    if not scaled or {axis for axis, _ in scaled} & set(table.names):
        return table
    rows = [(line, list(cells)) for line, cells in table.rows]
    for axis, name in scaled:
        k = "xyz".index(axis)
        if len(box) < 3 or len(box[k][1].split()) != 2:
            expected = "two bounds of a box with right angles, for its scaled places"
            raise FileFormatError(f"{table.file}, the box", [text for _, text in box], expected)
        number, text = box[k]
        low, high = (table.number(number, cell) for cell in text.split())
        column = table.column(name)
        for line, cells in rows:
            cells[column] = repr(low + (high - low) * table.number(line, cells[column]))
    plain = {name: axis for axis, name in scaled}
    return Rows(table.file, tuple(plain.get(name, name) for name in table.names), rows)


def _count(file: str, number: int, text: str) -> int:
    digits = text.strip()
    if not (digits.isascii() and digits.isdecimal()) or len(digits) > 18:
        raise FileFormatError(f"{file}, line {number}", text[:40], "a number of rows")
    return int(digits)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
