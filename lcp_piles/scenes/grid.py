"""Scenes on a lattice of any sort: cells that discs or spheres stand in, what is held, supports.

A cell has one integer an axis, its position in the units of the grid. All radii are 1.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import add

from ..errors import InputError
from ..numbers.exact import ZERO, Exact, Surd, surd
from .names import DiscId, end_name
from .scene import Contact, Disc, Numbers, Scene

Cell = tuple[int, ...]
_SOFT = Fraction(1)


@dataclass(frozen=True, slots=True)
class Grid:
    """The unit of every axis, and the neighbours of a cell.

    `neighbours` has half of them: where they are, and the normal from there to here. For each the
    cell on the other side is a neighbour as well. Gravity is along the last axis.
    """

    units: tuple[Surd, ...]
    neighbours: tuple[tuple[Cell, Numbers], ...]


@dataclass(frozen=True, slots=True)
class Hold:
    """How a disc is held, for `lattice`.

    Attributes
    ----------
    displacement : tuple of Surd or None, default (0, 0)
        The prescribed displacement along each axis (w tau), or None where it is free.
    load : tuple of Surd or None
        The load on it (w); None, the default, is its weight.
    compliance : Fraction, default 1
        That of its contacts (tau), which are held closed where it is negative.

    Examples
    --------
    >>> arch = {"left": (-1, 0), "right": (1, 0), "top": (0, 1)}
    >>> from lcp_piles import Hold, lattice
    >>> scene = lattice(arch, {"left": Hold(), "right": Hold(load=(ZERO, ZERO))})
    >>> [str(disc.load[1]) for disc in scene.discs]
    ['-1', '0', '-1']
    """

    displacement: tuple[Surd | None, ...] = (ZERO, ZERO)
    load: Numbers | None = None
    compliance: Fraction = _SOFT


@dataclass(frozen=True, slots=True)
class Support:
    """A flat support, for `lattice`.

    Attributes
    ----------
    name : str
        What contacts call it, as "floor".
    normal : tuple of Surd
        Its unit normal, towards the discs.
    touching : collection of int, str or tuple
        The ids of the discs that touch it.
    compliance : Fraction, default 1
        That of its contacts (tau), which are held closed where it is negative.

    Examples
    --------
    >>> from lcp_piles import Support, lattice
    >>> lattice({1: (0, 0), 2: (2, 0)}, {}, [Support("floor", (ZERO, surd(1)), [1, 2])])
    <Scene: 2 discs, 3 contacts>
    """

    name: str
    normal: Numbers
    touching: Collection[DiscId]
    compliance: Fraction = _SOFT


def on_grid(
    grid: Grid,
    cells: Mapping[DiscId, Cell],
    held: Mapping[DiscId, Hold],
    supports: Sequence[Support] = (),
    weight: Exact = 1,
) -> Scene:
    """The scene of these cells of a grid, with the contacts that can carry a force.

    All neighbours are contacts, except where nothing can change the distance of two held ones.
    """
    _check(cells, held, supports)
    places = [
        {x: unit * x for x in {cell[axis] for cell in cells.values()}}
        for axis, unit in enumerate(grid.units)
    ]
    dimension = len(places)
    pull = (*[ZERO] * (dimension - 1), -surd(weight))
    free = Hold((None,) * dimension)
    discs = []
    for id, cell in cells.items():
        hold = held.get(id, free)
        load = pull if hold.load is None else hold.load
        position = tuple(place[x] for place, x in zip(places, cell, strict=True))
        discs.append(Disc(id, position, load, hold.displacement))
    contacts = _contacts(cells, held, grid)
    for support in supports:
        bilateral = support.compliance < 0
        contacts += [
            Contact(id, support.name, support.normal, support.compliance, bilateral=bilateral)
            for id in support.touching
        ]
    return Scene(tuple(discs), tuple(contacts), tuple(support.name for support in supports))


def _contacts(
    cells: Mapping[DiscId, Cell], held: Mapping[DiscId, Hold], grid: Grid
) -> list[Contact]:
    """The contacts of all neighbours that can carry a force, disc by disc."""
    at = {cell: id for id, cell in cells.items()}
    found = []
    for a, cell in cells.items():
        for step, normal in grid.neighbours:
            b = at.get(tuple(map(add, cell, step)))
            if b is None:
                continue
            if held:
                one, two = held.get(a), held.get(b)
                if one is not None and two is not None and _fixed_distance(one, two, normal):
                    continue
                hold = one or two
                if hold is not None and hold.compliance is not _SOFT:
                    soft = hold.compliance
                    found.append(Contact(a, b, normal, soft, bilateral=soft < 0))
                    continue
            found.append(Contact(a, b, normal))
    return found


def _fixed_distance(one: Hold, two: Hold, normal: Numbers) -> bool:
    """Whether two held discs are held along their contact."""
    pairs = zip(normal, one.displacement, two.displacement, strict=True)
    return all(x is not None and y is not None for n, x, y in pairs if n)


def _check(
    cells: Mapping[DiscId, Cell], held: Mapping[DiscId, Hold], supports: Sequence[Support]
) -> None:
    for id in [*held, *(id for support in supports for id in support.touching)]:
        if id not in cells:
            raise InputError("a held or supported disc", id, "one that has a cell")
    taken: dict[Cell, DiscId] = {}
    for id, cell in cells.items():
        other = taken.setdefault(cell, id)
        if other is not id:
            expected = f"one that disc {end_name(other)} is not in"
            raise InputError(f"the cell of disc {end_name(id)}", cell, expected)
