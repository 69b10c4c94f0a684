"""TSS: the tilted pile on a smooth surface."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..numbers.exact import Exact, Surd
from .corner_stones import PUSH_OF_CORNER_STONES, UNIQUE_ABOVE, floor_contacts, smooth_pile
from .kind import Kind
from .lattice import TILTED
from .parameters import CORNER_STONES, FLOOR_COMPLIANCE, PUSH, layers_of
from .scene import Scene


def tss(
    layers: int,
    push: Exact = PUSH.default,
    floor_compliance: Exact = FLOOR_COMPLIANCE.default,
    corner_stones: str = CORNER_STONES.default,
) -> Scene:
    """The tilted pile with 30 degree slopes on a smooth floor: row i has i discs.

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
    >>> len(tss(3).contacts)
    8
    """
    return TSS.scene(
        layers=layers, push=push, floor_compliance=floor_compliance, corner_stones=corner_stones
    )


def _build(**parameters: Any) -> Scene:
    return smooth_pile(_length, TILTED, **parameters)


def _length(i: int) -> int:
    return i


def _size(
    layers: int, push: Surd, floor_compliance: Fraction, corner_stones: str
) -> tuple[int, int]:
    discs = layers * (layers + 1) // 2
    between = layers * (layers - 1) + (layers - 1) * (layers - 2) // 2
    return discs, between + floor_contacts(layers, corner_stones)


TSS = Kind(
    name="tss",
    title="TSS",
    help="tilted lattice, 30 degree slopes, smooth floor",
    parameters=(layers_of("tss", 2), PUSH, FLOOR_COMPLIANCE, CORNER_STONES),
    build=_build,
    size=_size,
    push=PUSH_OF_CORNER_STONES,
    unique_above=UNIQUE_ABOVE,
)
