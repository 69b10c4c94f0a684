"""From a contact system to its LCP, and from a solution of the LCP back to a state of the pile.

Closed contacts enter with their gap as z and their force as w. With E = C^-1, eliminating the
freedoms U gives

    w = q + M z,   q = -E (B U_0 + o),   M = E - E B K^-1 B^T E,   K = B^T E B,

q being the forces with every contact bilateral; M is symmetric and positive semidefinite where
C > 0. A contact that starts open enters the other way round, its force as z and its gap as w;
rigid contacts that depend on other rigid ones do. M, a principal pivot of the symmetric one, is
then positive semidefinite still, though no longer symmetric.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import lcm

import numpy as np
from flint import fmpz

from ..errors import SolveError
from ..linear.integer_product import times
from ..linear.rearrangement import rows_of
from ..numbers.floats import Bounded
from ..numbers.vectors import ExactVector, IntArray, Mask
from ..pivoting.lcp import LCP, IntegerColumn
from .held_set import HeldSet, held_set, independent_rigid
from .motions import Motions
from .near_columns import NearColumns, near_columns
from .state import State
from .system import ContactSystem


@dataclass(frozen=True, eq=False, repr=False)
class ContactLCP:
    """The LCP of a contact system, and what leads back from its z and w.

    `base` holds the contacts as they start, and `start` is its state: the solution, where q is
    nowhere negative. Bilateral contacts are eliminated with the freedoms.
    """

    base: HeldSet
    start: State
    problem: LCP
    matrix: ContactMatrix

    def __repr__(self) -> str:
        return f"<ContactLCP of {len(self.problem)} variables, {self.base}>"

    @property
    def contacts(self) -> IntArray:
        """The system's contacts in the order of the LCP's variables, without bilateral ones."""
        return self.matrix.contacts

    def state(self, z: ExactVector) -> State:
        """Displacements, gaps and multipliers of all contacts of the system from the LCP's z."""
        system = self.base.system
        return self.base.state(system.gap, system.load, self.matrix.spread(z))

    def motion(self, y: Sequence[Fraction]) -> list[fmpz]:
        """The motion that a certificate y of the LCP drives, in integers."""
        return self._response(y).displacements.numerators[1]

    def stress(self, y: Sequence[Fraction]) -> list[fmpz]:
        """The multipliers of all contacts that a certificate y of the LCP drives, in integers."""
        return self._response(y).forces.numerators[1]

    def _response(self, y: Sequence[Fraction]) -> State:
        den = lcm(*(x.denominator for x in y))
        return self.matrix.response(ExactVector({1: [fmpz(int(x * den)) for x in y]}, fmpz(1)))


@dataclass(frozen=True, eq=False)
class ContactMatrix:
    """The matrix M of the LCP around a held set: columns and products by exact solves.

    M is symmetric but for the signs of its blocks between contacts that start closed and such that
    start open (`notes/formulation.md`, 4), which gives the products with M^T.
    """

    base: HeldSet

    @cached_property
    def contacts(self) -> IntArray:
        """The system's contacts in the order of the LCP's variables, without bilateral ones."""
        return np.flatnonzero(~self.base.system.bilateral)

    def column(self, j: int) -> IntegerColumn:
        """Column j: integers over one denominator."""
        return self.columns([j])[0]

    def columns(self, wanted: Sequence[int]) -> list[IntegerColumn]:
        """Some columns, all in one exact solve."""
        places = self.contacts.tolist()
        found = self.base.columns([places[j] for j in wanted])
        return [([entries[k] for k in places], den) for entries, den in found]

    @cached_property
    def _near(self) -> NearColumns | None:
        return near_columns(self.base)

    def near(self, wanted: Sequence[int]) -> Bounded:
        """Some columns in floats with bounds of their errors, a row for each."""
        if self._near is None:
            exact = [ExactVector({1: x}, den).bounded() for x, den in self.columns(wanted)]
            return Bounded(np.array([x.middle for x in exact]), np.array([x.radius for x in exact]))
        found = self._near.of(self.contacts[list(wanted)].tolist())
        return Bounded(found.middle[:, self.contacts], found.radius[:, self.contacts])

    def basic(self, basis: Sequence[int]) -> ExactVector:
        """The z of a basis under the gaps and loads of the system, in one exact solve.

        It is that of the base with the contacts of the basis held the other way round.
        """
        system, base = self.base.system, self.base
        turned = self.contacts[list(basis)]
        closed = base.closed.copy()
        closed[turned] = ~closed[turned]
        # A motion that no contact notices is left free by any set, and a basis leaves no other.
        free = Motions(system, closed, base.free.basis, base.free.pinned)
        state = HeldSet(system, free, base.progress).state(system.gap, system.load)
        numerators = {}
        for r, gaps in state.gaps.numerators.items():
            z = [fmpz(0)] * len(self.contacts)
            for j, k in zip(basis, turned.tolist(), strict=True):
                z[j] = gaps[k] if base.closed[k] else state.forces.numerators[r][k]
            numerators[r] = z
        return ExactVector(numerators, state.gaps.denominator)

    def times(self, z: ExactVector) -> ExactVector:
        """M z, in one exact solve."""
        return self.read(self.response(z))

    def response(self, z: ExactVector) -> State:
        """The state that gaps of closed and forces of open contacts alone bring about."""
        system = self.base.system
        gap, load = (
            ExactVector({1: [fmpz(0)] * n}, fmpz(1)) for n in (system.contacts, system.dof)
        )
        return self.base.state(gap, load, self.spread(z))

    def transpose_times(self, y: ExactVector) -> ExactVector:
        """M^T y = S M S y with S = 1 on contacts that start closed and -1 on the others."""
        signs = np.where(self.base.closed[self.contacts], 1, -1)
        order = np.arange(len(signs))
        return self.times(y.take(order, signs)).take(order, signs)

    def read(self, state: State) -> ExactVector:
        """The w of a state: forces of contacts that start closed, gaps of such that start open."""
        closed = self.base.closed
        numerators = {
            r: [(forces if closed[k] else state.gaps.numerators[r])[k] for k in self.contacts]
            for r, forces in state.forces.numerators.items()
        }
        return ExactVector(numerators, state.forces.denominator)

    def spread(self, z: ExactVector) -> ExactVector:
        """Numbers of the LCP's variables as numbers of all contacts, zero for bilateral ones."""
        place = np.zeros(self.base.system.contacts, dtype=np.int64)
        place[self.contacts] = np.arange(len(self.contacts))
        return z.take(place, (~self.base.system.bilateral).astype(np.int64))


def contact_lcp(
    system: ContactSystem,
    closed: Mask | None = None,
    progress: Callable[[str], None] | None = None,
) -> ContactLCP:
    """The LCP of a contact system.

    Rigid contacts that depend on other rigid ones start open whatever `closed` says.

    Parameters
    ----------
    system : ContactSystem
        That of a scene (`contact_system`).
    closed : array of bool, shape (contacts,), optional
        The contacts that enter with their gap as z, all of them by default. A smaller set has to
        leave no motion free that the others would notice.
    progress : callable, optional
        Called with a line of text now and then.

    Returns
    -------
    ContactLCP
        Its `problem` is an `LCP`.

    Raises
    ------
    CollapseError
        Where a load moves the pile freely.
    ContradictionError
        Where rigid contacts that are held closed contradict each other.
    SolveError
        Where `closed` leaves a motion free that another contact would notice.

    Examples
    --------
    >>> from lcp_piles import contact_system, lemke, nt60
    >>> reduced = contact_lcp(contact_system(nt60(3)))
    >>> len(reduced.problem), lemke(reduced.problem).status
    (6, 'solved')
    """
    if closed is None:
        closed = np.ones(system.contacts, dtype=bool)
    closed = independent_rigid(system, closed | system.bilateral)
    return lcp_from(held_set(system, closed, progress))


def lcp_from(base: HeldSet) -> ContactLCP:
    """The LCP of the contact system of a held set whose contacts start as they are held.

    Bilateral contacts that it leaves open have to depend on others (`independent_rigid`).
    """
    system = base.system
    others = rows_of(system.B, ~base.closed)
    if any(x != 0 for motion in base.free.basis for x in times(others, motion)):
        raise SolveError(
            "the contacts that start closed leave a motion free that changes the gap of another "
            "contact: start that one closed too"
        )
    start = base.state(system.gap, system.load)
    matrix = ContactMatrix(base)
    problem = replace(lcp_around(matrix, start), basic=matrix.basic)
    return ContactLCP(base, start, problem, matrix)


def lcp_around(matrix: ContactMatrix, state: State) -> LCP:
    """The LCP whose q is a state of the held set of its matrix."""
    return LCP(
        matrix.read(state),
        matrix.column,
        matrix.times,
        matrix.transpose_times,
        near=matrix.near,
    )
