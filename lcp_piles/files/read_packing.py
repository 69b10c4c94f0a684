"""Packings from tables and dumps of discs."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import FileFormatError
from ..packings.build import packing
from ..packings.packing import Packing
from .column_rows import columns_of, read_rows
from .read_forces import DISC_COLUMNS


def read_packing(
    path: str | os.PathLike[str],
    columns: Mapping[str, str] | None = None,
    *,
    gravity: float = 1.0,
    **how: Any,
) -> Packing:
    r"""The packing of the discs in a table (CSV or blanks) or the last snapshot of a LAMMPS dump.

    Discs are plane where all z are the same.

    Parameters
    ----------
    path : str or path
        The file. Columns are x, y, perhaps z, radius, and where there are such, id and weight (or
        mass).
    columns : mapping of str to str, optional
        Which column is what, where they have other names, as `{"radius": "c_r"}`.
    gravity : float, default 1
        Weights are this times those of the file, or just this.
    **how : optional
        Everything else is as in `packing`: `supports`, `stiffness`, `tolerance`, ...

    Returns
    -------
    Packing
        The packing, in the file's units.

    Raises
    ------
    FileFormatError
        For a file that cannot be read; it names file and line.
    InputError
        As `packing` does.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "discs.csv")
    ...     _ = file.write_text("x,y,radius\n0,1,1\n2,1,1\n")
    ...     read_packing(file, supports={"floor": 0})
    <Packing: 2 discs, 3 contacts>
    """
    rows = read_rows(path)
    at = columns_of(rows, DISC_COLUMNS, columns or {})
    for role in ("x", "y", "radius"):
        if role not in at:
            expected = f"a column of {role}"
            raise FileFormatError(f"{rows.file}, its columns", ", ".join(rows.names), expected)
    if not rows.rows:
        raise FileFormatError(rows.file, "without discs", "a row a disc")
    numbers = {
        role: np.array([rows.number(line, cells[at[role]]) for line, cells in rows.rows])
        for role in at
        if role != "id"
    }
    plane = "z" not in numbers or bool((numbers["z"] == numbers["z"][0]).all())
    weights = gravity * numbers.get("weight", np.ones(len(rows.rows)))
    return packing(
        np.stack([numbers[axis] for axis in ("xy" if plane else "xyz")], axis=1),
        numbers["radius"],
        weights=weights,
        ids=[cells[at["id"]] for _, cells in rows.rows] if "id" in at else None,
        **how,
    )
