"""The solution of a scene: forces, gaps, displacements, states and how they were found."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..errors import InputError
from ..numbers.exact import Surd
from ..numbers.vectors import ExactVector, FloatArray
from ..scenes.scene import Contact, DiscId, Scene
from .stability import Stability

if TYPE_CHECKING:
    import os

    import sympy

Status = Literal["solved", "unstable", "unresolved"]
ContactState = Literal["closed", "open", "osculatory"]
Vector = ExactVector | FloatArray


@dataclass(frozen=True)
class Record:
    """How a solution was made.

    `method` and `arithmetic` ("exact" or "float64") name it; `proof` says in words why the answer
    is one. `dof` and `contacts` are the sizes that were solved, `whole_dof` and `whole_contacts`
    those of the whole pile. `seconds` is wall time from scene to verified solution, and
    `guess_errors` how many contacts of the solved part a floating-point guess had named wrongly.
    """

    method: str
    arithmetic: str
    pivots: int
    proof: str
    part: str
    dof: int
    contacts: int
    whole_dof: int
    whole_contacts: int
    seconds: float
    guess_errors: int | None = None


@dataclass(frozen=True, eq=False)
class Solution:
    """A solved scene, or the proof that it cannot stand.

    `status` is "solved", "unstable" (then `collapse` is a motion along which the scene gives way,
    and there are no forces) or "unresolved" (an indefinite scene on which the method gave up:
    nothing is proved). Vectors follow the scene's order: `forces` (w) and `gaps` (w tau) one entry
    a contact, `displacements` (w tau) one a disc and axis, flat. They are exact (`ExactVector`,
    entries are `Surd`) or, from floating-point methods, float arrays.
    """

    scene: Scene
    status: Status
    record: Record
    forces: Vector | None = None
    gaps: Vector | None = None
    displacements: Vector | None = None
    states: tuple[ContactState, ...] = ()
    gap_unique: tuple[bool, ...] = ()
    forces_unique: bool | None = None
    stability: Stability | None = None
    collapse: Vector | None = None

    @property
    def exact(self) -> bool:
        """Whether the numbers are exact."""
        return self.record.arithmetic == "exact"

    @cached_property
    def force_array(self) -> FloatArray:
        """All forces (w) as floats, in the order of `scene.contacts`."""
        return as_floats(self._present(self.forces))

    @cached_property
    def gap_array(self) -> FloatArray:
        """All gaps (w tau) as floats, in the order of `scene.contacts`."""
        return as_floats(self._present(self.gaps))

    @cached_property
    def displacement_array(self) -> FloatArray:
        """Displacements (w tau) as floats, of shape (discs, axes)."""
        return as_floats(self._present(self.displacements)).reshape(-1, self.scene.dimension)

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
        return _readable(self._present(self.forces)[self.contact_index(a, b)])

    def gap(self, a: DiscId, b: DiscId | str) -> sympy.Expr | float:
        """The gap (w tau) between disc a and disc or support b."""
        return _readable(self._present(self.gaps)[self.contact_index(a, b)])

    def displacement(self, disc: DiscId) -> tuple[sympy.Expr | float, ...]:
        """The displacement (w tau) of a disc."""
        dimension = self.scene.dimension
        first = self.scene.disc_index(disc) * dimension
        values = self._present(self.displacements)
        return tuple(_readable(values[first + axis]) for axis in range(dimension))

    def state(self, a: DiscId, b: DiscId | str) -> ContactState:
        """The state of the contact between a and b: closed, open or osculatory."""
        return self.states[self.contact_index(a, b)]

    def count(self, state: ContactState) -> int:
        """How many contacts are in a state."""
        return self.states.count(state)

    def largest_force(self) -> tuple[Contact, Surd | float]:
        """A contact with the largest force, and the force: the first of several."""
        forces = self._present(self.forces)
        k = int(np.argmax(self.force_array))
        return self.scene.contacts[k], forces[k]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result file (JSON, format lcp-piles/1). `load` reads it back."""
        from ..files.write_result import save

        save(self, path)

    @cached_property
    def _contact_at(self) -> dict[tuple[Any, Any], int]:
        at: dict[tuple[Any, Any], int] = {}
        for k, contact in enumerate(self.scene.contacts):
            at[(contact.a, contact.b)] = k
            at[(contact.b, contact.a)] = k
        return at

    def _present(self, vector: Vector | None) -> Vector:
        if vector is None:
            raise InputError("the solution", self.status, '"solved": there are no forces here')
        return vector


def as_floats(vector: Vector) -> FloatArray:
    """A vector as float64, whichever arithmetic made it."""
    return vector.array() if isinstance(vector, ExactVector) else vector


def states_of(forces: ExactVector, gaps: ExactVector) -> tuple[ContactState, ...]:
    """closed, open or osculatory by the signs of force and gap."""
    pairs = zip(forces.signs(), gaps.signs(), strict=True)
    return tuple("closed" if f else "open" if g else "osculatory" for f, g in pairs)


def _readable(value: Any) -> Any:
    return value.sympy() if isinstance(value, Surd) else float(value)
