"""A scene in balance: its forces, gaps and displacements, and what is read off them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal, get_args

import numpy as np

from ..errors import InputError
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

ContactState = Literal["closed", "open", "osculatory"]
Vector = ExactVector | FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class Solved:
    """A scene in balance.

    Vectors follow the scene's order. They are exact (`ExactVector`, entries are `Surd`) or, from
    floating-point methods, float arrays. A floating-point solution makes no claims: its states are
    read off, `gap_unique` is empty, `forces_unique` and `stability` are None.

    Attributes
    ----------
    scene : Scene
        The scene.
    record : Record
        How the solution was made.
    forces : ExactVector or array of float, shape (contacts,)
        The forces (w).
    gaps : ExactVector or array of float, shape (contacts,)
        The gaps (w tau).
    displacements : ExactVector or array of float, shape (discs * axes,)
        The displacements (w tau), one a disc and axis, flat.
    states : tuple of str, shape (contacts,)
        "closed", "open" or "osculatory", the optimal partition.
    gap_unique : tuple of bool, shape (contacts,)
        Which gaps are the only possible ones.
    forces_unique : bool or None
        Whether the forces are; None where a negative compliance leaves it open.
    stability : Stability or None
        The mechanisms of the whole pile, and the verdict.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> solve(nt60(3))
    <Solved NT60, layers 3: 8 closed, 0 open, 2 osculatory; stable; exact>
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
        """Where the contact between a and b stands in `scene.contacts`, in either order.

        Parameters
        ----------
        a, b : int, str or tuple
            The ids of two discs, or of one and the name of a support.

        Returns
        -------
        int
            Its place, from 0 on; `InputError` where the scene has no such contact.

        Examples
        --------
        >>> from lcp_piles import nt60, solve
        >>> solve(nt60(2)).contact_index((2, 2), (1, 1))
        1
        """
        try:
            return self._contact_at[(a, b)]
        except (KeyError, TypeError):
            raise InputError("the contact", (a, b), "a contact of the scene") from None

    def force(self, a: DiscId, b: DiscId | str) -> sympy.Expr | float:
        """The force between disc a and disc or support b.

        Parameters
        ----------
        a, b : int, str or tuple
            The ids of two discs, or of one and the name of a support.

        Returns
        -------
        sympy number or float
            The force (w), a sympy number if exact; `InputError` where the scene has no such
            contact.

        Examples
        --------
        >>> from lcp_piles import nt60, solve
        >>> solve(nt60(2)).force((1, 1), (2, 2))
        sqrt(3)/3
        """
        return _readable(self.forces[self.contact_index(a, b)])

    def gap(self, a: DiscId, b: DiscId | str) -> sympy.Expr | float:
        """The gap between disc a and disc or support b.

        Parameters
        ----------
        a, b : int, str or tuple
            The ids of two discs, or of one and the name of a support.

        Returns
        -------
        sympy number or float
            The gap (w tau), a sympy number if exact; `InputError` where the scene has no such
            contact.

        Examples
        --------
        >>> from lcp_piles import nt30, solve
        >>> solve(nt30(2)).gap((2, 2), (2, 3))
        sqrt(3)/3
        """
        return _readable(self.gaps[self.contact_index(a, b)])

    def displacement(self, disc: DiscId) -> tuple[sympy.Expr | float, ...]:
        """The displacement of a disc.

        Parameters
        ----------
        disc : int, str or tuple
            Its id.

        Returns
        -------
        tuple of sympy number or float, shape (axes,)
            The displacement (w tau); `InputError` where the scene has no such disc.

        Examples
        --------
        >>> from lcp_piles import nt60, solve
        >>> solve(nt60(2)).displacement((1, 1))
        (0, -2/3)
        """
        dimension = self.scene.dimension
        first = self.scene.disc_index(disc) * dimension
        return tuple(_readable(self.displacements[first + axis]) for axis in range(dimension))

    def state(self, a: DiscId, b: DiscId | str) -> ContactState:
        """The state of the contact between a and b.

        Parameters
        ----------
        a, b : int, str or tuple
            The ids of two discs, or of one and the name of a support.

        Returns
        -------
        {"closed", "open", "osculatory"}
            The state; an osculatory contact just touches. `InputError` where the scene has no such
            contact.

        Examples
        --------
        >>> from lcp_piles import nt30, solve
        >>> solve(nt30(2)).state((2, 2), (2, 3))
        'open'
        """
        return self.states[self.contact_index(a, b)]

    def count(self, state: ContactState) -> int:
        """How many contacts are in a state.

        Parameters
        ----------
        state : {"closed", "open", "osculatory"}
            The state.

        Returns
        -------
        int
            How many.
        """
        return self.states.count(state)

    def largest_force(self) -> tuple[Contact, Surd | float]:
        """A contact with the largest force, and the force: the first of several.

        Returns
        -------
        contact : Contact
            The contact.
        force : Surd or float
            Its force (w).

        Examples
        --------
        >>> from lcp_piles import nt30, solve
        >>> solve(nt30(2)).largest_force()
        (Contact((2, 2), 'floor', ('0', '1')), Surd('3/2'))
        """
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
        rows += made(self.record)
        return page(self.scene, rows, self.states, self.force_array)


def made(record: Record) -> list[tuple[str, str]]:
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
