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
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

import numpy as np
from flint import fmpz

from ..errors import SolveError
from ..numbers.vectors import ExactVector, IntArray
from ..pivoting.lcp import LCP, IntegerColumn
from .bilateral import BilateralPile, Mask, State, independent_rigid
from .system import ContactSystem


@dataclass(frozen=True, eq=False)
class ContactLCP:
    """The LCP of a contact system, and what leads back from its z and w.

    `contacts` lists the system's contacts in the order of the LCP's variables; bilateral contacts
    are not among them, they are eliminated with the freedoms. `base` holds the contacts as they
    start, and `start` is its state: the solution, where q is nowhere negative. `fetch` makes
    columns of the LCP that will be wanted, all in one exact solve.
    """

    base: BilateralPile
    start: State
    problem: LCP
    contacts: IntArray
    fetch: Callable[[Sequence[int]], None]

    def state(self, z: ExactVector) -> State:
        """Displacements, gaps and multipliers of all contacts of the system from the LCP's z."""
        zero = fmpz(0)
        spread = {r: [zero] * self.base.system.contacts for r in z.numerators}
        for r, column in z.numerators.items():
            for k, x in zip(self.contacts.tolist(), column, strict=True):
                spread[r][k] = x
        return self.base.state(ExactVector(spread, z.denominator))

    def motion(self, y: Sequence[Fraction]) -> list[fmpz]:
        """The motion whose gap rates (of closed contacts) a certificate y of the LCP is."""
        den = lcm(*(x.denominator for x in y))
        pairs = zip(self.contacts.tolist(), y, strict=True)
        return self.base.motion({k: fmpz(int(x * den)) for k, x in pairs if x})


def contact_lcp(
    system: ContactSystem,
    closed: Mask | None = None,
    progress: Callable[[str], None] | None = None,
) -> ContactLCP:
    """The LCP of a contact system. Raises `CollapseError` where a load moves it freely.

    `closed` are the contacts that enter with their gap as z, all of them by default. A smaller set
    has to leave no mechanism, or its LCP is not that of the pile. `progress` is called with a line
    of text now and then.

    >>> from lcp_piles import contact_system, lemke, nt60
    >>> reduced = contact_lcp(contact_system(nt60(3)))
    >>> len(reduced.problem), lemke(reduced.problem).status
    (6, 'solved')
    """
    if closed is None:
        closed = independent_rigid(system)
    if np.any(system.bilateral & ~closed):
        raise SolveError("rigid contacts that are held closed constrain each other: remove some")
    base = BilateralPile(system, closed, progress)
    return lcp_at(base, base.state())


def lcp_at(base: BilateralPile, start: State) -> ContactLCP:
    """The LCP around a state of a contact set: q is the forces of closed and gaps of open ones."""
    contacts = np.flatnonzero(~base.system.bilateral)
    places = contacts.tolist()
    numerators = {
        r: [(start.forces if base.closed[k] else start.gaps).numerators[r][k] for k in places]
        for r in start.forces.numerators
    }
    q = ExactVector(numerators, start.forces.denominator)
    columns: dict[int, IntegerColumn] = {}

    def fetch(wanted: Sequence[int]) -> None:
        missing = [j for j in wanted if j not in columns]
        found = base.columns([places[j] for j in missing]) if missing else []
        for j, (entries, den) in zip(missing, found, strict=True):
            columns[j] = [entries[k] for k in places], den

    def column(j: int) -> IntegerColumn:
        fetch([j])
        return columns[j]

    return ContactLCP(base, start, LCP(q, column), contacts, fetch)
