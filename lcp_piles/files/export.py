"""Solutions in the formats of other programs. The ending of a file's name says which."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from math import isnan

from ..errors import InputError
from ..solution.solution import Solution
from .lammps_dump import atoms_text, entries_text
from .safe_write import write_text
from .solution_tables import Rows, table
from .tables import csv_text
from .vtp import vtp_text
from .write_result import dumps


@dataclass(frozen=True, slots=True)
class Format:
    """A format: what it is for people, and the text of a solution in it."""

    title: str
    text: Callable[[Solution], str]


def export(solution: Solution, path: str | os.PathLike[str]) -> None:
    """Write a solution in the format that the ending of the path says.

    Parameters
    ----------
    solution : Solved, Unstable or Unresolved
        What to write.
    path : str or path
        `.csv` has the contacts and `.discs.csv` the discs, with the columns of `table`; `.vtp` is
        for ParaView (points, lines and their forces); `.lammpstrj` has the discs as LAMMPS dumps
        atoms and `.local` the contacts as it dumps local entries; `.json` is the result file of
        `save`.

    Raises
    ------
    InputError
        For another ending and for a path that cannot be written.
    NotSolvedError
        Where a format wants forces that are not there.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from lcp_piles import nt60, solve
    >>> with TemporaryDirectory() as folder:
    ...     export(solve(nt60(2)), Path(folder, "pile.vtp"))
    ...     Path(folder, "pile.vtp").read_text()[:21]
    '<?xml version="1.0"?>'
    """
    write_text(path, format_of(path).text(solution))


def format_of(path: str | os.PathLike[str]) -> Format:
    """The format of a file of this name; `InputError` where the ending is none of ours.

    >>> format_of("pile.discs.csv").title
    'discs as a table'
    """
    name = os.path.basename(os.fspath(path)).lower()
    for ending, format in FORMATS.items():
        if name.endswith(ending):
            return format
    known = ", ".join(FORMATS)
    raise InputError("the file to export to", str(path), f"a name that ends in one of {known}")


def _csv(rows: Rows) -> Callable[[Solution], str]:
    def text(solution: Solution) -> str:
        found = table(solution, rows)
        return csv_text(found.dtype.names or (), ([*map(_cell, row)] for row in found.tolist()))

    return text


def _cell(value: object) -> object:
    return "" if isinstance(value, float) and isnan(value) else value


FORMATS: dict[str, Format] = {
    ".discs.csv": Format("discs as a table", _csv("discs")),
    ".csv": Format("contacts as a table", _csv("contacts")),
    ".vtp": Format("for ParaView", vtp_text),
    ".lammpstrj": Format("discs as atoms of LAMMPS", atoms_text),
    ".local": Format("contacts as local entries of LAMMPS", entries_text),
    ".json": Format("result file", dumps),
}
"""Formats by the endings of names, a longer ending before one that it ends in."""
