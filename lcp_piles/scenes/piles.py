"""The four piles of Oron and Herrmann: TBS, TSS, NT60 and NT30.

Disc (i, j) is the j-th from the left of the i-th row from the apex down. All discs have radius 1
and weight 1; rows are centred on x = 0; discs two apart are neighbours.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, Surd, rational, sqrt_of, surd
from .scene import Contact, Disc, DiscId, Scene

_SQRT3 = sqrt_of(3)
_HALF = surd("1/2")
_WEIGHT = (ZERO, -ONE)
_UP = (ZERO, ONE)
MAX_LAYERS = 2000
"""More layers than any machine holds: a guard against a slip of the finger."""

_Rows = Callable[[int], int]


def nt60(
    layers: int,
    push: Exact = 0,
    floor_compliance: Exact = 1,
    corner_stones: str = "held",
) -> Scene:
    """The untilted pile with 60 degree slopes on a smooth floor, layers >= 2.

    Parameters: `push`, by which both corner stones are moved towards the axis (exact, in w tau,
    negative pulls); `floor_compliance` (exact, in tau; 0 is rigid, and a negative one is the
    paper's published floor, whose contacts are held closed); `corner_stones`, "held" at their
    lattice points or "resting" on the floor, held horizontally only.

    >>> pile = nt60(3)
    >>> len(pile.discs), len(pile.contacts), pile.disc((3, 1)).fixed
    (6, 10, True)
    """
    return _smooth("nt60", layers, push, floor_compliance, corner_stones)


def nt30(
    layers: int,
    push: Exact = 0,
    floor_compliance: Exact = 1,
    corner_stones: str = "held",
) -> Scene:
    """The untilted pile with 30 degree slopes (rows of 3i - 2 discs), layers >= 2; as `nt60`."""
    return _smooth("nt30", layers, push, floor_compliance, corner_stones)


def tss(
    layers: int,
    push: Exact = 0,
    floor_compliance: Exact = 1,
    corner_stones: str = "held",
) -> Scene:
    """The tilted pile on a smooth floor (30 degree slopes), layers >= 2; parameters as `nt60`."""
    return _smooth("tss", layers, push, floor_compliance, corner_stones)


def tbs(layers: int) -> Scene:
    """The tilted pile on a bumpy surface: `layers` free rows on two rows of fixed discs.

    >>> pile = tbs(1)
    >>> [disc.id for disc in pile.discs if not disc.fixed], len(pile.contacts)
    ([(1, 1)], 3)
    """
    _check_layers("tbs", layers, 1)
    discs = []
    columns = {c: _SQRT3 * c for c in range(-layers - 1, layers + 2)}
    free, fixed, nothing = (None, None), (ZERO, ZERO), (ZERO, ZERO)
    for i in range(1, layers + 3):
        held, load = (free, _WEIGHT) if i <= layers else (fixed, nothing)
        y = surd(layers - i)
        discs += [Disc((i, j), (columns[2 * j - i - 1], y), load, held) for j in range(1, i + 1)]
    contacts = []
    for i in range(1, layers + 1):
        for j in range(1, i + 1):
            contacts += _tilted_below(i, j, layers + 2)
    return Scene("tbs", (("layers", layers),), tuple(discs), tuple(contacts))


BUILDERS: dict[str, Callable[..., Scene]] = {"nt30": nt30, "nt60": nt60, "tss": tss, "tbs": tbs}

_UNIQUE_ABOVE = Fraction(-2, 3)


def has_unique_forces(scene: Scene) -> bool:
    """Whether theory says that the elastic forces of a scene are unique.

    They are where no compliance is negative, and in the four piles for every floor compliance
    above -2/3: the energy is still strictly convex on the forces that balance (notes/paper.md,
    section 2).

    >>> has_unique_forces(nt30(6, floor_compliance="-1/2")), has_unique_forces(nt30(3, 0, -2))
    (True, False)
    """
    return scene.definite or (
        scene.kind in BUILDERS and all(c.compliance > _UNIQUE_ABOVE for c in scene.contacts)
    )


def pile(kind: str, layers: int, **parameters: Exact) -> Scene:
    """The pile of this kind ("nt30", "nt60", "tss" or "tbs") by name.

    >>> pile("nt30", 6, push="20").kind
    'nt30'
    """
    if kind not in BUILDERS:
        raise InputError("the kind of pile", kind, "one of " + ", ".join(BUILDERS))
    if kind == "tbs":
        for name, value in parameters.items():
            _refuse_for_tbs(name, value)
        parameters = {}
    return BUILDERS[kind](layers, **parameters)


def _refuse_for_tbs(name: str, value: Exact) -> None:
    """TBS has neither floor nor corner stones: only the defaults say nothing about them."""
    defaults = {"push": 0, "floor_compliance": 1, "corner_stones": "held"}
    if name not in defaults:
        raise InputError("the parameter", name, "one of layers, " + ", ".join(defaults))
    same = value == "held" if name == "corner_stones" else surd(value) == defaults[name]
    if not same:
        thing = "floor" if name == "floor_compliance" else "corner stones"
        raise InputError(name, value, f"nothing for tbs, which has no {thing}", "leave it out")


def _check_layers(kind: str, layers: int, least: int) -> None:
    if not isinstance(layers, int) or isinstance(layers, bool):
        raise InputError("layers", layers, "a whole number")
    if not least <= layers <= MAX_LAYERS:
        raise InputError(f"layers of {kind}", layers, f"a number from {least} to {MAX_LAYERS}")


def _smooth(
    kind: str, layers: int, push: Exact, floor_compliance: Exact, corner_stones: str
) -> Scene:
    """A pile on a smooth floor between two corner stones."""
    _check_layers(kind, layers, 2)
    shift = surd(push)
    floor = rational(floor_compliance, "the floor compliance")
    if corner_stones not in ("held", "resting"):
        raise InputError("corner_stones", corner_stones, '"held" or "resting"')
    tilted = kind == "tss"
    row_length: _Rows = (lambda i: 3 * i - 2) if kind == "nt30" else (lambda i: i)
    base = row_length(layers)
    vertical = ZERO if corner_stones == "held" else None
    free = (None, None)
    columns = {c: _SQRT3 * c if tilted else surd(c) for c in range(-base, base + 1)}

    discs = []
    for i in range(1, layers + 1):
        count = row_length(i)
        y = surd(layers - i) if tilted else _SQRT3 * (layers - i)
        for j in range(1, count + 1):
            held: tuple[Surd | None, ...] = free
            if i == layers and j in (1, base):
                held = (shift if j == 1 else -shift, vertical)
            discs.append(Disc((i, j), (columns[2 * j - count - 1], y), _WEIGHT, held))

    contacts: list[Contact] = []
    for i in range(1, layers + 1):
        for j in range(1, row_length(i) + 1):
            if tilted:
                contacts += _tilted_below(i, j, layers)
            else:
                contacts += _untilted_below(i, j, layers, row_length)
    resting = range(1, base + 1) if corner_stones == "resting" else range(2, base)
    bilateral = floor < 0
    contacts += [
        Contact((layers, j), "floor", _UP, compliance=floor, bilateral=bilateral) for j in resting
    ]
    contacts = [c for c in contacts if not _between_corner_stones(c, layers, base)]
    parameters = (
        ("layers", layers),
        ("push", shift),
        ("floor_compliance", floor),
        ("corner_stones", corner_stones),
    )
    return Scene(kind, parameters, tuple(discs), tuple(contacts))


def _between_corner_stones(contact: Contact, layers: int, base: int) -> bool:
    """Two stones whose distance nothing can change carry nothing that matters to the pile."""
    corners = ((layers, 1), (layers, base))
    return contact.a in corners and contact.b in corners


_ABOVE_RIGHT = (_SQRT3 * _HALF, _HALF)  # tilted: from the lower left disc to this one
_ABOVE_LEFT = (-_SQRT3 * _HALF, _HALF)
_STEEP_RIGHT = (_HALF, _SQRT3 * _HALF)  # untilted
_STEEP_LEFT = (-_HALF, _SQRT3 * _HALF)
_LEFT = (-ONE, ZERO)


def _tilted_below(i: int, j: int, rows: int) -> list[Contact]:
    """Contacts of disc (i, j) with the discs below it, rows of i discs."""
    found: list[tuple[DiscId, tuple[Surd, ...]]] = []
    if i < rows:
        found += [((i + 1, j), _ABOVE_RIGHT), ((i + 1, j + 1), _ABOVE_LEFT)]
    if i + 1 < rows:
        found.append(((i + 2, j + 1), _UP))
    return [Contact((i, j), below, normal) for below, normal in found]


def _untilted_below(i: int, j: int, rows: int, row_length: _Rows) -> list[Contact]:
    """Contacts of disc (i, j) with its right neighbour and the discs of the next row."""
    found: list[tuple[DiscId, tuple[Surd, ...]]] = []
    if j < row_length(i):
        found.append(((i, j + 1), _LEFT))
    if i < rows:
        # The next row is wider by t' - t discs; its disc j + (t' - t + 1)/2 stands one radius to
        # the right of this disc, the one before it one radius to the left.
        right = j + (row_length(i + 1) - row_length(i) + 1) // 2
        found += [((i + 1, right - 1), _STEEP_RIGHT), ((i + 1, right), _STEEP_LEFT)]
    return [Contact((i, j), below, normal) for below, normal in found]
