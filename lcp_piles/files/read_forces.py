"""Contact forces from tables and dumps, as `check` takes them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

from ..checking.given import GivenForce, Place
from ..errors import FileFormatError
from .column_rows import Rows, columns_of, read_rows

FORCE_COLUMNS: dict[str, Sequence[str]] = {
    "a": ("a", "id1"),
    "b": ("b", "id2"),
    "ax": ("ax", "x1"),
    "ay": ("ay", "y1"),
    "az": ("az", "z1"),
    "bx": ("bx", "x2"),
    "by": ("by", "y2"),
    "bz": ("bz", "z2"),
    "x": ("x",),
    "y": ("y",),
    "z": ("z",),
    "force": ("force", "fn"),
    "fx": ("fx",),
    "fy": ("fy",),
    "fz": ("fz",),
}
"""What columns may stand for, with the names that are understood by themselves: the ends by name
or by their centres, the point of contact, the force along the normal, and the force on end a."""
DISC_COLUMNS: dict[str, Sequence[str]] = {
    "id": ("id",),
    "x": ("x", "xu"),
    "y": ("y", "yu"),
    "z": ("z", "zu"),
    "radius": ("radius", "r"),
    "weight": ("weight", "mass"),
}
"""The same for tables of discs."""


def read_forces(
    path: str | os.PathLike[str],
    columns: Mapping[str, str] | None = None,
    *,
    discs: str | os.PathLike[str] | None = None,
    disc_columns: Mapping[str, str] | None = None,
) -> list[GivenForce]:
    r"""The contact forces of a table (CSV or blanks) or of the last snapshot of a LAMMPS dump.

    Parameters
    ----------
    path : str or path
        The file.
    columns : mapping of str to str, optional
        Which column is what, `{"a": "c_ends[1]", "b": "c_ends[2]", "force": "c_f[2]"}`; names in
        `FORCE_COLUMNS` need no mention.
    discs : str or path, optional
        A table or dump of discs. With it the ends are the ids there, which are then looked up by
        their places; without, the ids of the scene.
    disc_columns : mapping of str to str, optional
        Which column of that is what.

    Returns
    -------
    list of GivenForce
        The forces and their ends, in the file's units, for `check`.

    Raises
    ------
    FileFormatError
        For a file that cannot be read; it names file and line.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "forces.csv")
    ...     _ = file.write_text('a,b,force\n"(2,1)","(1,1)",0.577\n')
    ...     found = read_forces(file)
    >>> found[0].force
    0.577
    """
    rows = read_rows(path)
    at = columns_of(rows, FORCE_COLUMNS, columns or {})
    if "force" not in at and "fx" not in at:
        expected = "a column of forces: force, or fx, fy"
        raise FileFormatError(f"{rows.file}, its columns", ", ".join(rows.names), expected)
    named = "a" in at and "b" in at
    places = read_places(discs, disc_columns) if discs is not None else None
    found = []
    for line, cells in rows.rows:
        force = _numbers(rows, line, cells, at, ("force",))
        ends = [_end(cells[at[end]], places) if end in at else (None, None) for end in "ab"]
        (a, at_a), (b, at_b) = ends
        if a is None and at_a is None:
            at_a = _numbers(rows, line, cells, at, ("ax", "ay", "az"))
        if b is None and at_b is None:
            at_b = _numbers(rows, line, cells, at, ("bx", "by", "bz"))
        whole = named or (at_a is not None and (at_b is not None or b is not None))
        found.append(
            GivenForce(
                force[0] if force else None,
                _numbers(rows, line, cells, at, ("fx", "fy", "fz")),
                a,
                b,
                at_a,
                at_b,
                None if whole else _numbers(rows, line, cells, at, ("x", "y", "z")),
                rows.where(line),
            )
        )
    return found


def read_places(
    path: str | os.PathLike[str], columns: Mapping[str, str] | None = None
) -> dict[str, Place]:
    """The centres of discs by their ids, from a table or dump; rows count from 0 without ids."""
    rows = read_rows(path)
    at = columns_of(rows, DISC_COLUMNS, columns or {})
    if "x" not in at:
        expected = "columns x, y with the centres of discs"
        raise FileFormatError(f"{rows.file}, its columns", ", ".join(rows.names), expected)
    found: dict[str, Place] = {}
    for number, (line, cells) in enumerate(rows.rows):
        id = cells[at["id"]] if "id" in at else str(number)
        if id in found:
            raise FileFormatError(f"the disc of {rows.where(line)}", id, "an id that stands once")
        found[id] = _numbers(rows, line, cells, at, ("x", "y", "z")) or ()
    return found


def _end(name: str, places: Mapping[str, Place] | None) -> tuple[str | None, Place | None]:
    """An end by its name, or by its place where that is known."""
    if places is not None and name in places:
        return None, places[name]
    return name, None


def _numbers(
    rows: Rows, line: int, cells: Sequence[str], at: Mapping[str, int], roles: Sequence[str]
) -> Place | None:
    """The numbers in some columns, None where the file has not even the first of them."""
    if roles[0] not in at:
        return None
    return tuple(rows.number(line, cells[at[role]]) for role in roles if role in at)
