"""TBS: the tilted pile on a bumpy surface, two rows of discs that cannot move."""

from __future__ import annotations

from ..numbers.exact import ZERO, surd
from .kind import Kind
from .lattice import FREE, SQRT3, WEIGHT, tilted_below
from .parameters import layers_of
from .scene import Contact, Disc, Scene


def tbs(layers: int) -> Scene:
    """The tilted pile on a bumpy surface: `layers` free rows on two rows of fixed discs.

    >>> pile = tbs(1)
    >>> [disc.id for disc in pile.discs if not disc.fixed], len(pile.contacts)
    ([(1, 1)], 3)
    """
    return TBS.scene(layers=layers)


def _build(layers: int) -> Scene:
    rows = layers + 2
    columns = {c: SQRT3 * c for c in range(-rows, rows + 1)}
    fixed = nothing = (ZERO, ZERO)
    discs: list[Disc] = []
    contacts: list[Contact] = []
    for i in range(1, rows + 1):
        movable = i <= layers
        held, load = (FREE, WEIGHT) if movable else (fixed, nothing)
        y = surd(layers - i)
        for j in range(1, i + 1):
            discs.append(Disc((i, j), (columns[2 * j - i - 1], y), load, held))
            if movable:
                contacts += tilted_below(i, j, rows)
    return Scene(tuple(discs), tuple(contacts), ())


def _size(layers: int) -> tuple[int, int]:
    return (layers + 2) * (layers + 3) // 2, 3 * layers * (layers + 1) // 2


TBS = Kind(
    name="tbs",
    title="TBS",
    help="tilted lattice, 30 degree slopes, on fixed discs",
    parameters=(layers_of("tbs", 1),),
    build=_build,
    size=_size,
    mirror_symmetric=True,
)
