"""Continuation: the solution as an exact function of one parameter of the scene.

Two scenes that differ in initial gaps, prescribed displacements or loads only span a line of
scenes, the first at t = 0 and the second at t = 1. Along it q is linear in t, so forces and gaps
are piecewise linear, and Lemke's scheme with t in the place of the covering variable goes through
all pieces: t rises until a basic variable reaches zero, its complement enters, and so on
(parametric principal pivoting; Cottle, Pang and Stone, section 4.5). Events at the same t and
contacts that only touch zero need no special case: the lexicographic rule orders them, and what
counts is the difference between the pieces on both sides.

For a positive semidefinite M the parameter never falls along the path. For an indefinite one (a
floor of negative compliance) it may, and the path then says that it turned back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np
from flint import fmpz

from ..errors import InputError, SolveError
from ..mechanics.bilateral import BilateralPile, CollapseError, Mask, State
from ..mechanics.contact_lcp import ContactLCP, contact_lcp, lcp_at
from ..mechanics.system import ContactSystem, contact_system
from ..methods.proved import float_guess, regular_set
from ..numbers.exact import ONE, ZERO, Exact, Surd, sqrt_of, surd
from ..numbers.vectors import ExactVector, combination, content
from ..pivoting.lemke import solved_table
from ..pivoting.tableau import Direction, Tableau
from ..scenes.scene import Contact, Disc, Scene

_RENEW = 24

End = Literal["asymptotic", "reached", "turned", "unstable"]


@dataclass(frozen=True, eq=False)
class Segment:
    """A piece of the path, first <= t <= last (None: without end), with one contact set.

    `loaded` marks the contacts of the system with a positive force inside the piece; `basis` those
    that are closed in the linear system that gives it: all loaded ones, and where the pile has
    mechanisms some without force that hold them.
    """

    system: ContactSystem
    other: ContactSystem
    first: Surd
    last: Surd | None
    loaded: Mask
    basis: Mask

    def state(self, t: Exact) -> State:
        """Displacements, gaps and multipliers at a t of the piece, evaluated and not solved."""
        value = surd(t)
        if value < self.first or (self.last is not None and value > self.last):
            raise InputError("t", str(value), f"a number from {self.first} to {self.last}")
        return state_between(*self._ends, value)

    def linear_force(self, contact: int) -> tuple[Surd, Surd]:
        """(a, b) with the force of a whole contact equal to a + b t on the piece (w)."""
        return self._linear(contact, self.system.whole_forces, "forces")

    def linear_gap(self, contact: int) -> tuple[Surd, Surd]:
        """(a, b) with the gap of a whole contact equal to a + b t on the piece (w tau)."""
        return self._linear(contact, self.system.whole_gaps, "gaps")

    def _linear(
        self, contact: int, spread: Callable[[ExactVector], ExactVector], name: str
    ) -> tuple[Surd, Surd]:
        start, end = (spread(getattr(state, name))[contact] for state in self._ends)
        return start, end - start

    @cached_property
    def _ends(self) -> tuple[State, State]:
        """The states of this contact set, bilateral, at t = 0 and t = 1: they span the piece."""
        base = BilateralPile(self.system, self.basis)
        return base.state(), base.under(self.other).state()


@dataclass(frozen=True)
class Breakpoint:
    """A t at which the set of loaded contacts changes; whole contacts by their number."""

    t: Surd
    opens: tuple[int, ...]
    closes: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Path:
    """The solutions for t from 0 on: pieces, breakpoints between them, and how it ended.

    `end` is "reached" (the t asked for), "asymptotic" (no further change however large t),
    "turned" (an indefinite scene whose path turns back there) or "unstable" (no forces balance the
    loads beyond).
    """

    segments: tuple[Segment, ...]
    breakpoints: tuple[Breakpoint, ...]
    end: End
    pivots: int

    def segment(self, t: Exact) -> Segment:
        """The piece that holds t."""
        value = surd(t)
        for piece in self.segments:
            if piece.first <= value and (piece.last is None or value <= piece.last):
                return piece
        raise InputError("t", str(value), f"a number from 0 to {self.segments[-1].last}")


def continuation(
    start: Scene,
    towards: Scene,
    *,
    until: Exact | None = None,
    progress: Callable[[str], None] | None = None,
) -> Path:
    """Follow the solution from `start` (t = 0) through `towards` (t = 1) and on.

    `until` is the last t wanted; without it the path goes on to the last change. Raises
    `InputError` for scenes that differ in more than gaps, prescribed displacements and loads, and
    `SolveError` where the start has no solution.

    >>> from lcp_piles import nt30
    >>> path = continuation(nt30(2), nt30(2, push="sqrt(3)"))
    >>> [str(b.t) for b in path.breakpoints], path.end
    (['1/6'], 'asymptotic')
    """
    _check_same(start, towards)
    limit = None if until is None else surd(until)
    if limit is not None and limit < 0:
        raise InputError("until", str(limit), "a number of at least 0")
    system, other = contact_system(start), contact_system(towards)
    if system.reduction.part != other.reduction.part:
        system, other = contact_system(start, "whole"), contact_system(towards, "whole")
    return _Walk(system, other).path(limit, progress)


class _Walk:
    """The pivots along a path, with the tableau that makes them.

    The tableau is founded anew on the contact set of the last piece once it has taken a number of
    pivots: what it keeps is an update of the base by one column a pivot, which is cheap while they
    are few. It is founded anew only where t has risen, so within the pivots at one t the
    lexicographic order stays the same and no basis repeats.
    """

    def __init__(self, system: ContactSystem, other: ContactSystem) -> None:
        self.system, self.other = system, other
        self.t = ZERO
        self.reduced, self.table = _start(system)
        base = self.reduced.base
        self._aim(self.reduced.start, base.under(other).state())

    def path(self, limit: Surd | None, progress: Callable[[str], None] | None) -> Path:
        """All pieces from t = 0 on."""
        segments: list[Segment] = []
        entering, pivots, since = self.table.z0, 0, 0
        end: End
        while True:
            table = self.table
            direction = table.direction(entering)
            rise = direction[table.z0]
            leaving = table.blocking(direction)
            if rise < 0:
                end = "turned"
                break
            if leaving is None and rise == 0:
                end = "unstable"
                break
            if leaving is None or (rise > 0 and table.sign(leaving) > 0):
                segments.append(self._segment(entering, direction))
            if leaving is None:
                end = "asymptotic"
                break
            table.pivot(entering, leaving, direction)
            pivots, since = pivots + 1, since + 1
            entering = table.complement(leaving)
            t = self._origin + table.vector(table.z0, table.z0 + 1)[0] / self._per_t
            if t > self.t:
                passed = limit is not None and t >= limit
                segments[-1] = replace(segments[-1], last=limit if passed else t)
                if progress:
                    progress(f"{len(segments)} pieces, t = {float(t):.6g}")
                if passed:
                    end = "reached"
                    break
                self.t = t
                if since >= _RENEW:
                    self._found_anew(segments[-1].basis)
                    entering, since = self.table.z0, 0
        return Path(tuple(segments), _breakpoints(segments), end, pivots)

    def _found_anew(self, closed: Mask) -> None:
        """A new tableau at the present t on a contact set that is right just before it."""
        base = BilateralPile(self.system, closed)
        start, end = base.state(), base.under(self.other).state()
        self.reduced = lcp_at(base, state_between(start, end, self.t))
        self.table = Tableau(self.reduced.problem, [0] * len(self.reduced.problem))
        self._aim(start, end)

    def _aim(self, start: State, end: State) -> None:
        """Put the direction of the path, given by its states at 0 and 1, in place of the cover."""
        base = self.reduced.base
        q, target = (lcp_at(base, state).problem.q for state in (start, end))
        d, self._per_t = _direction(q, target)
        self.table.replace_cover(d)
        self._origin = self.t
        self._fetch_next(d)

    def _fetch_next(self, d: list[fmpz]) -> None:
        """Make the columns of the contacts that will reach zero first, if all goes straight on."""
        n = len(d)
        unit = fmpz(1) << max((int(x.bit_length()) for x in d), default=0)
        values, rates = self.table.vector(0, n).array(), ExactVector({1: d}, unit).array()
        falling = np.flatnonzero((rates < 0) & np.array(self.table.is_basic[:n]))
        ratios = values[falling] / -rates[falling]
        self.reduced.fetch(falling[np.argsort(ratios)][:_RENEW].tolist())

    def _segment(self, entering: int, direction: Direction) -> Segment:
        """The piece ahead, its end not known yet."""
        table, n = self.table, self.table.size
        loaded, basis = self.system.bilateral.copy(), self.system.bilateral.copy()
        for i, k in enumerate(self.reduced.contacts.tolist()):
            # w is the force of a contact that starts closed, z that of one that starts open.
            closed_start = bool(self.reduced.base.closed[k])
            basis[k] = closed_start != (table.is_basic[n + i] or entering == n + i)
            force = i if closed_start else n + i
            loaded[k] = table.sign(force) > 0 or direction.sign(force) > 0
        return Segment(self.system, self.other, self.t, None, loaded, basis)


def _start(system: ContactSystem) -> tuple[ContactLCP, Tableau]:
    """The solved tableau of a scene, from a floating-point guess of its contacts if that serves."""
    try:
        guess = regular_set(system, float_guess(system))
        for closed in (guess.closed if guess else None, None):
            reduced = contact_lcp(system, closed)
            table = solved_table(reduced.problem)
            if table is not None:
                return reduced, table
    except CollapseError as error:
        raise SolveError("the scene cannot stand, so there is nothing to continue") from error
    raise SolveError("the scene at the start has no solution that Lemke's method finds")


def _breakpoints(segments: list[Segment]) -> tuple[Breakpoint, ...]:
    found = []
    for before, after in pairwise(segments):
        if (before.loaded != after.loaded).any():
            found.append(
                Breakpoint(
                    after.first,
                    _whole(before.system, before.loaded & ~after.loaded),
                    _whole(before.system, after.loaded & ~before.loaded),
                )
            )
    return tuple(found)


def _whole(system: ContactSystem, mask: Mask) -> tuple[int, ...]:
    """The numbers of the whole pile's contacts that a mask of the system stands for."""
    return tuple(np.flatnonzero(mask[system.reduction.contact]).tolist())


def _direction(q: ExactVector, target: ExactVector) -> tuple[list[fmpz], Surd]:
    """(d, c) with target - q = c d and d in integers, so that z0 = c t.

    All of target - q has to be on one root: pivots are rational.
    """
    change = combination([(ONE, target), (-ONE, q)])
    roots = [r for r, column in change.numerators.items() if any(x != 0 for x in column)]
    if len(roots) > 1:
        raise InputError(
            "the direction of the path",
            " and ".join(f"sqrt({r})" for r in roots),
            "a change of gaps and loads on one root",
            "continue one of them at a time",
        )
    if not roots:
        return [fmpz(0)] * len(q), ONE
    column = change.numerators[roots[0]]
    common = content(column, fmpz(0))
    scale = Fraction(int(common), int(change.denominator))
    return [x // common for x in column], sqrt_of(roots[0]) * scale


def state_between(start: State, end: State, t: Surd) -> State:
    """The state start + t (end - start)."""
    return State(
        _between(start.displacements, end.displacements, t),
        _between(start.gaps, end.gaps, t),
        _between(start.forces, end.forces, t),
    )


def _between(start: ExactVector, end: ExactVector, t: Surd) -> ExactVector:
    """The vector start + t (end - start)."""
    return combination([(ONE - t, start), (t, end)])


def _check_same(start: Scene, towards: Scene) -> None:
    """That two scenes differ in gaps, prescribed displacements and loads only."""

    def bare_disc(disc: Disc) -> Disc:
        held = tuple(None if h is None else ZERO for h in disc.held)
        return replace(disc, load=disc.load and (ZERO,) * len(disc.load), held=held)

    def bare_contact(contact: Contact) -> Contact:
        return replace(contact, gap=ZERO)

    same = tuple(map(bare_disc, start.discs)) == tuple(map(bare_disc, towards.discs)) and tuple(
        map(bare_contact, start.contacts)
    ) == tuple(map(bare_contact, towards.contacts))
    if not same:
        raise InputError(
            "the second scene",
            towards,
            "the discs and contacts of the first, with other gaps, held displacements or loads",
        )
