"""What the first order in tau is, once it is known, and what may be read off it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from ..numbers.exact import ONE, Exact, Surd, surd
from ..numbers.vectors import ExactVector, FloatArray, combination
from ..scenes.names import DiscId
from ..scenes.scene import Contact
from ..solution.partition import Partition
from ..solution.solution import Solved
from ..solution.stability import Stability, stability

if TYPE_CHECKING:
    import sympy

_NEAR = 1e-9
"""Quotients of floats nearer than this to the least are compared exactly; their error is 1e-14."""
_SAFE = 1e150
"""Floats below this, and above one over it, have quotients in range."""


@dataclass(frozen=True, eq=False, repr=False)
class FirstOrder:
    """A pile of compliance tau to first order: f0 + tau f1, u0 + tau u1, g0 + tau g1.

    Changes are those for a tau of one disc radius a disc weight. Vectors are exact and in the
    scene's order.

    Attributes
    ----------
    rigid : Solved
        The solution at tau = 0; f0 are its forces.
    start : ExactVector, shape (discs * axes,)
        u0 (w tau): that of `rigid`, but where it leaves them undetermined (`selected`) the one that
        the deformable pile takes.
    start_gaps : ExactVector, shape (contacts,)
        g0 (w tau), likewise.
    forces : ExactVector, shape (contacts,)
        f1 (w).
    displacements : ExactVector, shape (discs * axes,)
        u1 (w tau).
    gaps : ExactVector, shape (contacts,)
        g1 (w tau).
    loose : tuple of int
        The contacts whose gap g1 the first order leaves undetermined.
    rest : Partition
        The states of contacts at tau = 0.
    strained : Partition
        The states of contacts for small tau.

    Examples
    --------
    >>> from lcp_piles import first_order, nt60, solve
    >>> [str(x) for x in first_order(solve(nt60(2))).forces]
    ['1/18', '1/18']
    """

    rigid: Solved
    start: ExactVector
    start_gaps: ExactVector
    forces: ExactVector
    displacements: ExactVector
    gaps: ExactVector
    loose: tuple[int, ...]
    rest: Partition
    strained: Partition
    status: ClassVar[Literal["found"]] = "found"

    def force(self, a: DiscId, b: DiscId | str, tau: Exact | None = None) -> sympy.Expr:
        """The change f1 of a force, or the force f0 + tau f1 at a tau.

        Parameters
        ----------
        a, b : int, str or tuple
            The ids of two discs, or of one and the name of a support.
        tau : exact number, optional
            The compliance (disc radii a disc weight), such as "1/1000".

        Returns
        -------
        sympy number
            f1 without a tau, else the force (w).

        Examples
        --------
        >>> from lcp_piles import first_order, nt60, solve
        >>> soft = first_order(solve(nt60(2)))
        >>> soft.force((2, 1), (1, 1)), soft.force((2, 1), (1, 1), "1/100")
        (1/18, 1/1800 + sqrt(3)/3)
        """
        k = self.rigid.contact_index(a, b)
        value = self.forces[k]
        return (value if tau is None else self._f0[k] + surd(tau) * value).sympy()

    def forces_at(self, tau: Exact) -> ExactVector:
        """All forces f0 + tau f1 at a tau, exactly.

        Parameters
        ----------
        tau : exact number
            The compliance (disc radii a disc weight).

        Returns
        -------
        ExactVector, shape (contacts,)
            The forces (w).
        """
        return combination([(ONE, self._f0), (surd(tau), self.forces)])

    @cached_property
    def stability(self) -> Stability:
        """The exact verdict for small tau.

        It differs from the rigid one where contacts that just touch hold mechanisms at tau = 0 and
        open at order tau.
        """
        return _verdict(self.strained)

    @cached_property
    def selected(self) -> bool:
        """Whether the rigid limit leaves u0 undetermined, so that balance at order tau decides."""
        same = self.rest is self.strained
        return bool((self.stability if same else _verdict(self.rest)).free)

    @cached_property
    def force_array(self) -> FloatArray:
        """All f1 as floats, in the order of `scene.contacts`."""
        return self.forces.array()

    @cached_property
    def displacement_array(self) -> FloatArray:
        """All u1 as floats, of shape (discs, axes)."""
        return self.displacements.array().reshape(-1, self.rigid.scene.dimension)

    @cached_property
    def range(self) -> tuple[Surd | None, tuple[Contact, ...]]:
        """The tau at which to first order a contact first changes, and which do.

        (None, ()) where none does. A force that falls reaches zero, or a gap that shrinks closes.
        Contacts that the rigid pile leaves osculatory change at tau = 0 and are not counted, nor
        are bilateral and `loose` ones.
        """
        scene = self.rigid.scene
        states = np.array(self.rigid.states)
        bilateral = np.array([c.bilateral for c in scene.contacts], dtype=bool)
        open_ = states == "open"
        open_[list(self.loose)] = False
        candidates: list[tuple[float, int, ExactVector, ExactVector]] = []
        for which, value, rate in (
            ((states == "closed") & ~bilateral, self._f0, self.forces),
            (open_, self.start_gaps, self.gaps),
        ):
            falling = np.flatnonzero(which & (np.array(rate.signs()) < 0))
            taus = _quotients(-value.array()[falling], rate.array()[falling])
            pairs = zip(taus.tolist(), falling.tolist(), strict=True)
            candidates += [(t, k, value, rate) for t, k in pairs]
        if not candidates:
            return None, ()
        least = min((t for t, *_ in candidates if t), default=0.0) * (1 + _NEAR)
        exact = [(-v[k] / rate[k], k) for t, k, v, rate in candidates if t <= least]
        first = min(t for t, _ in exact)
        return first, tuple(scene.contacts[k] for t, k in exact if t == first)

    @cached_property
    def _f0(self) -> ExactVector:
        forces: Any = self.rigid.forces
        plain: ExactVector = forces.plain()
        return plain

    def __repr__(self) -> str:
        largest = np.abs(self.force_array).max(initial=0.0)
        how = ", u0 selected" if self.selected else ""
        return (
            f"<FirstOrder of {self.rigid!r}: |f1| up to {largest:.6g} w{how}; "
            f"{self.stability.verdict} for small tau>"
        )


def _quotients(above: FloatArray, below: FloatArray) -> FloatArray:
    """The quotients of positive numbers, 0 where floats do not say them to their last digits."""
    sizes = np.abs([above, below])
    safe = ((sizes > 1 / _SAFE) & (sizes < _SAFE)).all(axis=0)
    return np.where(safe, above, 0.0) / np.where(safe, below, 1.0)


def _verdict(states: Partition) -> Stability:
    verdict, _ = stability(states.mechanisms.system, states)
    return verdict


@dataclass(frozen=True, eq=False, repr=False)
class NoFirstOrder:
    """The proof that no equilibrium of a slightly deformable pile keeps the rigid network.

    Balance along the free motions of `rigid` asks for the displacements `start`, the only ones up
    to motions that do not matter, and there some open contacts would overlap. What real pile there
    is near by has some of them loaded.

    Attributes
    ----------
    rigid : Solved
        The solution at tau = 0.
    start : ExactVector, shape (discs * axes,)
        The displacements that balance asks for (w tau).
    start_gaps : ExactVector, shape (contacts,)
        The gaps there (w tau).
    overlapping : tuple of Contact
        The contacts, open in the rigid limit, whose gaps would be negative.

    Examples
    --------
    >>> from lcp_piles import first_order, solve, tss
    >>> [contact.name for contact in first_order(solve(tss(4))).overlapping]
    ['contact (1,1)-(3,2)']
    """

    rigid: Solved
    start: ExactVector
    start_gaps: ExactVector
    overlapping: tuple[Contact, ...]
    status: ClassVar[Literal["none"]] = "none"

    def __repr__(self) -> str:
        return f"<NoFirstOrder of {self.rigid!r}: {len(self.overlapping)} contacts would overlap>"
