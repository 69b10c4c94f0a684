"""TBS: the tilted pile on a bumpy surface, two rows of discs that cannot move."""

from __future__ import annotations

from ..numbers.exact import ZERO
from .corner_stones import rows
from .grid import Hold
from .kind import Kind
from .lattice import TILTED, lattice
from .parameters import layers_of
from .scene import Scene

_FIXED = Hold(load=(ZERO, ZERO))


def tbs(layers: int) -> Scene:
    """The tilted pile on a bumpy surface: free rows on two rows of fixed discs.

    Parameters
    ----------
    layers : int
        The free rows, 1 or more; the fixed ones come below them.

    Returns
    -------
    Scene
        The pile; disc (i, j) is the j-th from the left of the i-th row from the apex.

    Raises
    ------
    InputError
        Where `layers` is no whole number from 1 on.

    References
    ----------
    Oron and Herrmann (1997), "Exact calculation of force networks in granular piles".

    Examples
    --------
    >>> pile = tbs(1)
    >>> [disc.id for disc in pile.discs if not disc.fixed], len(pile.contacts)
    ([(1, 1)], 3)
    """
    return TBS.scene(layers=layers)


def _build(layers: int) -> Scene:
    cells = {id: (c, r - 2) for id, (c, r) in rows(list(range(1, layers + 3))).items()}
    held = {id: _FIXED for id, (_, r) in cells.items() if r < 0}
    return lattice(cells, held, orientation=TILTED)


def _size(layers: int) -> tuple[int, int]:
    return (layers + 2) * (layers + 3) // 2, 3 * layers * (layers + 1) // 2


TBS = Kind(
    name="tbs",
    title="TBS",
    help="tilted lattice, 30 degree slopes, on fixed discs",
    parameters=(layers_of("tbs", 1),),
    build=_build,
    size=_size,
)
