"""The solution of a scene: forces, gaps, displacements, states and how they were found.

`Solution` is one of three plain types, told apart by `status`: `Solved`, `Unstable` (the proof that
no forces balance the load) and `Unresolved` (nothing is proved). Whoever only handles the first
may read forces at once: the other two answer with a `NotSolvedError` that says what to do.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NoReturn, get_args

import numpy as np

from ..errors import InputError, NotSolvedError
from ..numbers.exact import Surd
from ..numbers.vectors import ExactVector, FloatArray
from ..scenes.names import DiscId
from ..scenes.scene import Contact, Scene
from .describe import brief
from .notebook import page
from .record import Record
from .stability import Stability

if TYPE_CHECKING:
    import sympy

Status = Literal["solved", "unstable", "unresolved"]
ContactState = Literal["closed", "open", "osculatory"]
Vector = ExactVector | FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class Solved:
    """A scene in balance.

    Vectors follow the scene's order: `forces` (w) and `gaps` (w tau) one entry a contact,
    `displacements` (w tau) one a disc and axis, flat. They are exact (`ExactVector`, entries are
    `Surd`) or, from floating-point methods, float arrays. `states` names the optimal partition, and
    `gap_unique` says which gaps are the only possible ones; `forces_unique` is None where a
    negative compliance leaves it open. A floating-point solution makes no claims: its states are
    read off, `gap_unique` is empty, `forces_unique` and `stability` are None.
    """

    scene: Scene
    record: Record
    forces: Vector
    gaps: Vector
    displacements: Vector
    states: tuple[ContactState, ...]
    gap_unique: tuple[bool, ...] = ()
    forces_unique: bool | None = None
    stability: Stability | None = None
    status: ClassVar[Literal["solved"]] = "solved"

    @property
    def exact(self) -> bool:
        """Whether the numbers are exact."""
        return self.record.exact

    @cached_property
    def force_array(self) -> FloatArray:
        """All forces (w) as floats, in the order of `scene.contacts`."""
        return as_floats(self.forces)

    @cached_property
    def gap_array(self) -> FloatArray:
        """All gaps (w tau) as floats, in the order of `scene.contacts`."""
        return as_floats(self.gaps)

    @cached_property
    def displacement_array(self) -> FloatArray:
        """Displacements (w tau) as floats, of shape (discs, axes)."""
        return as_floats(self.displacements).reshape(-1, self.scene.dimension)

    def contact_index(self, a: DiscId, b: DiscId | str) -> int:
        """Where the contact between a and b stands in `scene.contacts`, in either order."""
        try:
            return self._contact_at[(a, b)]
        except (KeyError, TypeError):
            raise InputError("the contact", (a, b), "a contact of the scene") from None

    def force(self, a: DiscId, b: DiscId | str) -> sympy.Expr | float:
        """The force (w) between disc a and disc or support b, as a sympy number if exact.

        >>> from lcp_piles import nt60, solve
        >>> solve(nt60(2)).force((1, 1), (2, 2))
        sqrt(3)/3
        """
        return _readable(self.forces[self.contact_index(a, b)])

    def gap(self, a: DiscId, b: DiscId | str) -> sympy.Expr | float:
        """The gap (w tau) between disc a and disc or support b."""
        return _readable(self.gaps[self.contact_index(a, b)])

    def displacement(self, disc: DiscId) -> tuple[sympy.Expr | float, ...]:
        """The displacement (w tau) of a disc."""
        dimension = self.scene.dimension
        first = self.scene.disc_index(disc) * dimension
        return tuple(_readable(self.displacements[first + axis]) for axis in range(dimension))

    def state(self, a: DiscId, b: DiscId | str) -> ContactState:
        """The state of the contact between a and b: closed, open or osculatory."""
        return self.states[self.contact_index(a, b)]

    def count(self, state: ContactState) -> int:
        """How many contacts are in a state."""
        return self.states.count(state)

    def largest_force(self) -> tuple[Contact, Surd | float]:
        """A contact with the largest force, and the force: the first of several."""
        k = int(np.argmax(self.force_array))
        return self.scene.contacts[k], self.forces[k]

    @cached_property
    def _contact_at(self) -> dict[tuple[Any, Any], int]:
        at: dict[tuple[Any, Any], int] = {}
        for k, contact in enumerate(self.scene.contacts):
            at[(contact.a, contact.b)] = k
            at[(contact.b, contact.a)] = k
        return at

    def __repr__(self) -> str:
        verdict = f"; {self.stability.verdict}" if self.stability else ""
        return f"<Solved {brief(self.scene)}: {self._counts()}{verdict}; {self.record.arithmetic}>"

    def _counts(self) -> str:
        return ", ".join(f"{self.count(state)} {state}" for state in get_args(ContactState))

    def _repr_html_(self) -> str:
        rows = [("scene", brief(self.scene)), ("contacts", self._counts())]
        if len(self.forces):
            contact, force = self.largest_force()
            rows.append(("largest force", f"{float(force):.6g} w at {contact.a}-{contact.b}"))
        if self.stability:
            count = self.stability.mechanisms
            rows.append(("stability", f"{self.stability.verdict}, mechanisms: {count}"))
        rows += _made(self.record)
        return page(self.scene, rows, self.states, self.force_array)


_OF_ALL = {"scene", "record", "status", "exact"}
_OF_SOLVED = {
    name
    for name in ({field.name for field in fields(Solved)} | vars(Solved).keys()) - _OF_ALL
    if not name.startswith("_")
}


@dataclass(frozen=True, eq=False, repr=False)
class Unstable:
    """The proof that a scene cannot stand: no forces balance the load.

    `collapse` is a motion along which the scene gives way (w tau, any scale), exact, one entry a
    disc and axis, flat: it closes no contact, moves nothing that is held, and the load does work on
    it. To ask for forces raises `NotSolvedError`.
    """

    scene: Scene
    record: Record
    collapse: ExactVector
    status: ClassVar[Literal["unstable"]] = "unstable"

    @property
    def exact(self) -> bool:
        """Whether the numbers are exact."""
        return self.record.exact

    def __getattr__(self, name: str) -> NoReturn:
        _refuse(self, name, "no forces balance the load: `collapse` is how the scene gives way")

    def __repr__(self) -> str:
        return f"<Unstable {brief(self.scene)}: no forces balance the load; proved>"

    def _repr_html_(self) -> str:
        why = "unstable: no forces balance the load; it gives way as the red discs show"
        rows = [("scene", brief(self.scene)), ("status", why), *_made(self.record)]
        return page(self.scene, rows, motion=self.collapse.array())


@dataclass(frozen=True, eq=False, repr=False)
class Unresolved:
    """No answer: the method gave up, and nothing is proved. `record.proof` says why.

    To ask for forces raises `NotSolvedError`.
    """

    scene: Scene
    record: Record
    status: ClassVar[Literal["unresolved"]] = "unresolved"

    @property
    def exact(self) -> bool:
        """Whether the arithmetic was exact."""
        return self.record.exact

    def __getattr__(self, name: str) -> NoReturn:
        _refuse(self, name, "`record.proof` says why; another method may have the answer")

    def __repr__(self) -> str:
        return f"<Unresolved {brief(self.scene)}: nothing is proved; method {self.record.method}>"

    def _repr_html_(self) -> str:
        status = "unresolved: nothing is proved"
        return page(
            self.scene,
            [("scene", brief(self.scene)), ("status", status), *_made(self.record)],
        )


Solution = Solved | Unstable | Unresolved


def _refuse(solution: Unstable | Unresolved, name: str, remedy: str) -> NoReturn:
    if name not in _OF_SOLVED:
        raise AttributeError(f"{type(solution).__name__!r} object has no attribute {name!r}")
    expected = f'"solved", to have {name}'
    raise NotSolvedError("the status of the solution", solution.status, expected, remedy)


def _made(record: Record) -> list[tuple[str, str]]:
    """How it was made, for a table."""
    return [("method", f"{record.method}, {record.arithmetic}"), ("proof", record.proof)]


def as_floats(vector: Vector) -> FloatArray:
    """A vector as float64, whichever arithmetic made it."""
    return vector.array() if isinstance(vector, ExactVector) else vector


def states_of(forces: ExactVector, gaps: ExactVector) -> tuple[ContactState, ...]:
    """closed, open or osculatory by the signs of force and gap."""
    pairs = zip(forces.signs(), gaps.signs(), strict=True)
    return tuple("closed" if f else "open" if g else "osculatory" for f, g in pairs)


def _readable(value: Any) -> Any:
    return value.sympy() if isinstance(value, Surd) else float(value)
