"""Linear complementarity problems as JSON files: {"M": [[...], ...], "q": [...]}.

Entries are whole numbers, or exact ones as text, such as "-7/3" or "0.1"; those of q may hold roots
("1 - sqrt(3)").
"""

from __future__ import annotations

import os

from ..errors import FileFormatError
from ..pivoting.lcp import LCP, lcp
from .json_fields import Entry, field, json_object, only, whole_or_exact
from .safe_read import read_text

MOST_VARIABLES = 3_000


def load_lcp(path: str | os.PathLike[str]) -> LCP:
    """The problem in a file. Raises `FileFormatError` for what is no such file.

    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as place:
    ...     file = Path(place, "lcp.json")
    ...     _ = file.write_text('{"M": [[2, 1], [1, "2"]], "q": [-5, "-6"]}')
    ...     load_lcp(file)
    <LCP of 2 variables>
    """
    content: Entry = json_object(read_text(path))
    only(content, ("M", "q"))
    q, M = field(content, "q", list), field(content, "M", list)
    if not 0 < len(q) <= MOST_VARIABLES:
        raise FileFormatError("the length of q", len(q), f"1 to {MOST_VARIABLES} entries")
    if len(M) != len(q):
        raise FileFormatError("the number of rows of M", len(M), f"{len(q)}, the length of q")
    rows = []
    for i, row in enumerate(M):
        if not isinstance(row, list) or len(row) != len(q):
            raise FileFormatError(f"M[{i}]", row, f"a list of {len(q)} numbers")
        entries = [whole_or_exact(x, f"M[{i}][{j}]") for j, x in enumerate(row)]
        for j, x in enumerate(entries):
            if not x.is_rational:
                raise FileFormatError(f"M[{i}][{j}]", row[j], "a rational number")
        rows.append(entries)
    return lcp(rows, [whole_or_exact(x, f"q[{i}]") for i, x in enumerate(q)])
