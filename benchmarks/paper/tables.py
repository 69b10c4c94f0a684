"""What the tables for notes/paper.md have in common: their register and their form."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from lcp_piles import Solution, Surd, decimal

FLOORS = ("1", "0", "-1/2")
"""A floor as soft as the discs, a rigid one, and the paper's."""

TABLES: dict[str, Callable[[], None]] = {}


def table(function: Callable[[], None]) -> Callable[[], None]:
    """Enter a function as a table under its own name."""
    TABLES[function.__name__.replace("_", "-")] = function
    return function


def show(header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Print a Markdown table, each row as soon as it is known."""
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(str(field) for field in row) + " |", flush=True)


def digits(value: Surd | None, count: int = 5) -> str:
    """A number to a few digits, "-" for none."""
    return "-" if value is None else decimal(value, count)


def horizontal(solution: Solution, above_row: int) -> tuple[int, int]:
    """How many horizontal contacts above a row are closed, and how many osculatory."""
    states = [
        state
        for c, state in zip(solution.scene.contacts, solution.states, strict=True)
        if not isinstance(c.b, str) and c.a[0] == c.b[0] < above_row
    ]
    return states.count("closed"), states.count("osculatory")
