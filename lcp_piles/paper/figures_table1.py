"""The paper's Table 1 on three floors: where the contact network of the pushed pile rearranges."""

from __future__ import annotations

import json
from importlib.resources import files
from itertools import zip_longest

from ..files.tables import csv_text
from ..numbers.exact import Surd, decimal
from ..push.push_path import Rearrangement, push_path
from ..scenes.names import end_name
from ..scenes.scene import Contact
from .plate import PAPERS_FLOOR, PHYSICAL_FLOOR, Plate

_FLOORS = (PAPERS_FLOOR, PHYSICAL_FLOOR, "0")
_DIGITS = 10


def table1_plate() -> Plate:
    """Every -q of NT30 6 at which a contact opens or closes: exact, in decimals, and which.

    Columns for what the paper prints, for the paper's floor, for a floor as soft as the discs, and
    for a rigid one. The k-th changes on different floors are neighbours by their number only.
    """
    found = [push_path("nt30", 6, floor_compliance=c).rearrangements for c in _FLOORS]
    header = ["k", "printed"]
    for floor in _FLOORS:
        header += [f"push_floor_{floor}", f"decimal_floor_{floor}", f"changes_floor_{floor}"]
    rows: list[list[object]] = []
    lines = [
        "| k | printed | "
        + " | ".join(f"floor {floor}, exact | decimal" for floor in _FLOORS)
        + " |",
        "|---" * (2 + 2 * len(_FLOORS)) + "|",
    ]
    values = printed()
    for k, changes in enumerate(zip_longest(*found), 1):
        entry = values[k - 1] if k <= len(values) else ""
        shown = [str(k), f"{entry}*sqrt(3)" if entry else ""]
        row = list(shown)
        for change in changes:
            exact, approximate, what = ("", "", "") if change is None else _fields(change)
            row += [exact, approximate, what]
            shown += [exact, approximate]
        rows.append(list(row))
        lines.append("| " + " | ".join(shown) + " |")
    return Plate(None, {".csv": csv_text(header, rows), ".md": "\n".join(lines) + "\n"})


def printed() -> list[str]:
    """The values of -q that the paper prints, in w tau sqrt(3), exact fractions as text."""
    text = files(__package__).joinpath("printed_table1.json").read_text(encoding="utf-8")
    entries: list[str] = json.loads(text)["entries"]
    return entries


def _fields(change: Rearrangement) -> tuple[str, str, str]:
    """The push exactly and in decimals, and the contacts that change, both mirror images."""
    push: Surd = change.push
    what = [_named(c, "opens") for c in change.opens] + [_named(c, "closes") for c in change.closes]
    return str(push), decimal(push, _DIGITS), "; ".join(what)


def _named(contact: Contact, what: str) -> str:
    return f"{end_name(contact.a)}-{end_name(contact.b)} {what}"
