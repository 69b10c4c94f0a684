"""Tables as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence


def csv_text(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Rows as CSV; a `Surd` becomes its exact text, None an empty field.

    >>> from lcp_piles import surd
    >>> print(csv_text(["x", "force"], [[surd("1/2*sqrt(3)"), 0.5]]), end="")
    x,force
    1/2*sqrt(3),0.5
    """
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return buffer.getvalue()
