"""NT60: the untilted pile with 60 degree slopes on a smooth floor."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..numbers.exact import Exact, Surd
from .corner_stones import PUSH_OF_CORNER_STONES, UNIQUE_ABOVE, floor_contacts, smooth_pile
from .kind import Kind
from .lattice import UNTILTED
from .parameters import CORNER_STONES, FLOOR_COMPLIANCE, PUSH, layers_of
from .scene import Scene


def nt60(
    layers: int,
    push: Exact = PUSH.default,
    floor_compliance: Exact = FLOOR_COMPLIANCE.default,
    corner_stones: str = CORNER_STONES.default,
) -> Scene:
    """The untilted pile with 60 degree slopes on a smooth floor: row i has i discs.

    Parameters
    ----------
    layers : int
        The rows of discs, 2 or more.
    push : exact number, default 0
        How far both corner stones are moved towards the axis (w tau); negative pulls.
    floor_compliance : exact number, default 1
        That of the contacts with the floor (tau), rational. 0 is rigid, and a negative one is the
        paper's published floor (-1/2), whose contacts are held closed.
    corner_stones : {"held", "resting"}, default "held"
        Held at their lattice points, or resting on the floor and held horizontally only.

    Returns
    -------
    Scene
        The pile; disc (i, j) is the j-th from the left of the i-th row from the apex.

    Raises
    ------
    InputError
        For a parameter that is none of these.

    References
    ----------
    Oron and Herrmann (1997), "Exact calculation of force networks in granular piles".

    Examples
    --------
    >>> pile = nt60(3)
    >>> len(pile.discs), len(pile.contacts), pile.disc((3, 1)).fixed
    (6, 10, True)
    """
    return NT60.scene(
        layers=layers, push=push, floor_compliance=floor_compliance, corner_stones=corner_stones
    )


def _build(**parameters: Any) -> Scene:
    return smooth_pile(_length, UNTILTED, **parameters)


def _length(i: int) -> int:
    return i


def _size(
    layers: int, push: Surd, floor_compliance: Fraction, corner_stones: str
) -> tuple[int, int]:
    discs = layers * (layers + 1) // 2
    between = 3 * layers * (layers - 1) // 2
    if layers == 2:  # the corner stones are neighbours
        between -= 1
    return discs, between + floor_contacts(layers, corner_stones)


NT60 = Kind(
    name="nt60",
    title="NT60",
    help="untilted lattice, 60 degree slopes, smooth floor",
    parameters=(layers_of("nt60", 2), PUSH, FLOOR_COMPLIANCE, CORNER_STONES),
    build=_build,
    size=_size,
    push=PUSH_OF_CORNER_STONES,
    unique_above=UNIQUE_ABOVE,
)
