"""A kind of scene as a value: what it is called, what it depends on, how it is built.

Whoever needs to know something about a kind (the command line its options, a file how to read it,
a picture its title, a push what to move) reads it here, and compares no names. A new kind is a
file with a `Kind` and a line in `kinds`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from ..errors import InputError
from ..numbers.exact import Surd
from .scene import Scene

Values = tuple[tuple[str, Any], ...]
"""The parameters of a scene as (name, value) pairs, all of them, in the order of the kind."""

_LONGEST = 24


@dataclass(frozen=True, slots=True)
class Parameter:
    """Something that a kind of scene depends on.

    `check` turns what a person hands in into the value (or raises `InputError`), `read` does so
    for a word of text, and `write` turns the value into what stands in a file. `default` is None
    where a value has to be given. `title` is the value's part in the title of a picture, shown
    where it is not at its default: mathtext, with {} where the value goes. `help` and `metavar`
    are for the command line, and so are the `choices`, if only a few values are possible.
    """

    name: str
    check: Callable[[Any], Any] = field(compare=False, repr=False)  # methods have no equals
    read: Callable[[str], Any] = field(compare=False, repr=False)
    default: Any
    help: str
    title: str
    metavar: str | None = None
    choices: tuple[str, ...] = ()
    write: Callable[[Any], str | int] = str


@dataclass(frozen=True, slots=True)
class Push:
    """What pushing means for a kind: the parameter that grows, and its step on a path.

    A path is followed in multiples of `unit`, for which the gauge of the kind stays rational.
    """

    parameter: str
    unit: Surd


@dataclass(frozen=True, slots=True, repr=False)
class Kind:
    """A kind of scene.

    `build` makes the scene from checked values of all `parameters`, and `size` tells its number of
    discs and of contacts beforehand; call `scene` instead of `build`. `push` is None where nothing
    can be pushed. Where `unique_above` is not None, forces are proved to be unique as long as every
    compliance is above it (notes/paper.md, section 2); without negative compliances they always
    are.
    """

    name: str
    title: str
    help: str
    parameters: tuple[Parameter, ...]
    build: Callable[..., Scene]
    size: Callable[..., tuple[int, int]]
    push: Push | None = None
    unique_above: Fraction | None = None

    def __repr__(self) -> str:
        return f"<Kind {self.name}: {self.help}>"

    def parameter(self, name: str) -> Parameter:
        """The parameter of this name."""
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        known = ", ".join(parameter.name for parameter in self.parameters)
        raise InputError(f"the parameter of {self.name}", name, f"one of {known}")

    def values(self, given: Mapping[str, Any]) -> Values:
        """All parameters, checked, with defaults for those that are not given."""
        for name in given:
            self.parameter(name)
        for p in self.parameters:
            if p.default is None and p.name not in given:
                raise InputError(f"{p.name} of {self.name}", "missing", p.help)
        return tuple((p.name, p.check(given.get(p.name, p.default))) for p in self.parameters)

    def scene(self, **given: Any) -> Scene:
        """The scene with these parameters; its origin is this kind with all of them.

        >>> from lcp_piles.scenes.kinds import KINDS
        >>> KINDS["nt30"].scene(layers=6, push="20")
        <Scene NT30, layers 6, push 20: 51 discs, 129 contacts>
        """
        values = self.values(given)
        scene = self.build(**dict(values))
        object.__setattr__(scene, "origin", Origin(self, values))
        return scene


@dataclass(frozen=True, slots=True, repr=False)
class Origin:
    """Where a scene comes from: its kind, and all parameters in the order of the kind."""

    kind: Kind
    parameters: Values

    def scene(self, **changes: Any) -> Scene:
        """The scene of the same kind with some parameters changed."""
        return self.kind.scene(**(dict(self.parameters) | changes))

    @property
    def changed(self) -> tuple[tuple[Parameter, Any], ...]:
        """The parameters that are not at their defaults, with their values."""
        pairs = zip(self.kind.parameters, self.parameters, strict=True)
        return tuple((p, value) for p, (_, value) in pairs if value != p.default)

    def __repr__(self) -> str:
        return f"<Origin {self}>"

    def __str__(self) -> str:
        named = [f"{p.name.replace('_', ' ')} {_cut(value)}" for p, value in self.changed]
        return ", ".join([self.kind.title, *named])


def _cut(value: object) -> str:
    text = str(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def origin_of(scene: Scene) -> Origin:
    """The origin of a scene; `InputError` where it is one of the user's own."""
    if scene.origin is None:
        raise InputError("the scene", scene, "one made by the builder of a kind, unchanged")
    return scene.origin


def has_unique_forces(scene: Scene) -> bool:
    """Whether theory says that the elastic forces of a scene are unique.

    They are where no compliance is negative, and for some kinds beyond (see `Kind.unique_above`).

    >>> from lcp_piles import nt30
    >>> has_unique_forces(nt30(6, floor_compliance="-1/2")), has_unique_forces(nt30(3, 0, -2))
    (True, False)
    """
    if scene.definite or scene.origin is None:
        return scene.definite
    bound = scene.origin.kind.unique_above
    return bound is not None and all(contact.compliance > bound for contact in scene.contacts)
