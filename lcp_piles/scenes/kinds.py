"""The registry of the kinds of scene. A new kind is a file of its own and a line here."""

from __future__ import annotations

from typing import Any

from ..errors import InputError
from ..numbers.exact import Exact
from .kind import Kind
from .nt30 import NT30
from .nt60 import NT60
from .pyramid import PYRAMID
from .scene import Scene
from .silo import SILO
from .slab import SLAB
from .tbs import TBS
from .tetrahedron import TETRAHEDRON
from .tss import TSS

KINDS: dict[str, Kind] = {
    kind.name: kind for kind in (NT30, NT60, TSS, TBS, SILO, SLAB, TETRAHEDRON, PYRAMID)
}
"""The kinds of scene by their names: what `pile` builds."""


def kind_named(name: str) -> Kind:
    """The kind of this name.

    >>> kind_named("tbs").push is None
    True
    """
    if name not in KINDS:
        raise InputError("the kind of pile", name, "one of " + ", ".join(KINDS))
    return KINDS[name]


def pile(kind: str, layers: int | None = None, **parameters: Exact) -> Scene:
    """The scene of a kind by its name; piles have `layers`.

    A parameter that only other kinds have may be given at its default, which says nothing.

    Parameters
    ----------
    kind : str
        The name, one of `KINDS`: "nt30", "silo", ...
    layers : int, optional
        The rows of discs, for kinds that have them.
    **parameters : exact number or str
        What else the builder of the kind takes.

    Returns
    -------
    Scene
        That of the builder of this name.

    Raises
    ------
    InputError
        For an unknown kind or parameter, one that is missing, and a value that it cannot have.

    Examples
    --------
    >>> pile("nt30", 6, push="20")
    <Scene NT30, layers 6, push 20: 51 discs, 129 contacts>
    """
    chosen = kind_named(kind)
    own = {parameter.name for parameter in chosen.parameters}
    for name in [name for name in parameters if name not in own]:
        _refuse_unless_default(chosen, name, parameters.pop(name))
    if layers is not None:
        parameters["layers"] = layers
    return chosen.scene(**parameters)


def _refuse_unless_default(kind: Kind, name: str, value: Any) -> None:
    elsewhere = {p.name: p for other in KINDS.values() for p in other.parameters}
    if name not in elsewhere:
        raise InputError("the parameter", name, "one of " + ", ".join(elsewhere))
    other = elsewhere[name]
    if other.check(value) != other.default:
        expected = f"nothing for {kind.name}, which has no such parameter"
        raise InputError(name, value, expected, "leave it out")
