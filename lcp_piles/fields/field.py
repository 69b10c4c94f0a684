"""What a field is: something read off a solution, with its table and what there is to draw of it.

A field of your own is one file that defines a `Field`, and one line in `registry`. It says which
shape its picture has and never how it is drawn: `pictures` has one drawer for each shape, and no
field needs a drawing library.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from ..numbers.exact import Surd, decimal
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.scene import Scene
from ..solution.solution import Solution

Value = TypeVar("Value")
Cell = Surd | float | int | str | None

DECIMALS = 17
"""Digits of the decimals beside an exact number in a table: as many as tell two floats apart."""


@dataclass(frozen=True)
class Column:
    """A column of a table; `exact` for numbers that an exact solution has in exact form."""

    name: str
    exact: bool = False


@dataclass(frozen=True)
class Table:
    """Rows of cells under named columns: numbers, text, or None where there is nothing.

    `facts` are what is said of the scene as a whole, as (name, number or text).
    """

    columns: tuple[Column, ...]
    rows: Sequence[Sequence[Cell]]
    facts: Sequence[tuple[str, Cell]] = ()

    def header(self) -> list[str]:
        """The names of the columns of `lines`: an exact column is followed by its decimals.

        >>> Table((Column("disc"), Column("x", exact=True)), []).header()
        ['disc', 'x', 'x_decimal']
        """
        return [
            name
            for column in self.columns
            for name in (column.name, f"{column.name}_decimal")[: 1 + column.exact]
        ]

    def lines(self) -> Iterator[list[str]]:
        """The rows as text, as many fields each as `header` has.

        Exact numbers as their exact text and in decimals; of a number that only floating point
        knows, the exact text is left empty.

        >>> from lcp_piles import surd
        >>> table = Table((Column("disc"), Column("x", exact=True)), [["(1,1)", surd("sqrt(3)/2")]])
        >>> list(table.lines())
        [['(1,1)', '1/2*sqrt(3)', '0.86602540378443865']]
        """
        for row in self.rows:
            line: list[str] = []
            for column, cell in zip(self.columns, row, strict=True):
                if column.exact:
                    line.append(str(cell) if isinstance(cell, Surd) else "")
                line.append(cell_text(cell, DECIMALS))
            yield line


def cell_text(cell: Cell, digits: int) -> str:
    """A cell as text, numbers in decimals of so many significant digits; None is empty."""
    if cell is None:
        return ""
    if isinstance(cell, Surd):
        return decimal(cell, digits)
    if isinstance(cell, float):
        return "" if cell != cell else f"{cell:.{digits}g}"  # NaN: there is no such number
    return str(cell)


@dataclass(frozen=True, eq=False)
class DiscScalars:
    """A number on every disc of a scene, NaN where a disc has none; `label` says which."""

    scene: Scene
    values: FloatArray
    label: str


@dataclass(frozen=True, eq=False)
class DiscTensors:
    """A symmetric tensor on every disc of a scene, shape (discs, 2, 2), NaN where there is none.

    `negative` and `positive` are what eigenvalues of either sign are called, `usual` (-1 or 1) is
    the sign that is nothing special, and `unit` theirs in mathtext.
    """

    scene: Scene
    tensors: FloatArray
    negative: str
    positive: str
    usual: int
    unit: str = ""


@dataclass(frozen=True, eq=False)
class DiscVectors:
    """Vectors on discs of a scene: `discs` (n,) indices, `vectors` (n, 2), in a `unit`."""

    scene: Scene
    discs: IntArray
    vectors: FloatArray
    label: str
    unit: str


@dataclass(frozen=True, eq=False)
class Profile:
    """Named series along the base, all over the same positions `x` in disc radii.

    `marks` are points to point out, by what they are called: (x, y) each.
    """

    x: Sequence[float]
    series: Mapping[str, Sequence[float]]
    ylabel: str
    marks: Mapping[str, Sequence[tuple[float, float]]]


Shape = DiscScalars | DiscTensors | DiscVectors | Profile


@dataclass(frozen=True)
class Field(Generic[Value]):
    """A field by its name: how it is read off a solution, its table, the shape of its picture.

    `shape` is None for a field of which there is only a table.
    """

    name: str
    title: str
    compute: Callable[[Solution], Value]
    table: Callable[[Value], Table]
    shape: Callable[[Value], Shape] | None
