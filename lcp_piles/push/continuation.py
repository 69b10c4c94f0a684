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

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
from flint import fmpz

from ..errors import InputError, SolveError
from ..linear.threads import one_thread
from ..mechanics.contact_lcp import ContactMatrix, contact_lcp, lcp_around, lcp_from
from ..mechanics.held_set import held_set
from ..mechanics.motions import CollapseError, work_sign
from ..mechanics.state import State, state_between
from ..mechanics.system import ContactSystem, contact_system, with_loads_of
from ..methods.proved import float_guess
from ..methods.regular_set import regular_set
from ..numbers.exact import ONE, ZERO, Exact, Surd, sqrt_of, surd
from ..numbers.vectors import ExactVector, Mask, combination, content
from ..pivoting.direction import Direction
from ..pivoting.lcp import LCP, IntegerColumn
from ..pivoting.lemke import solved_table
from ..pivoting.tableau import Tableau
from ..scenes.scene import Contact, Disc, Scene
from .path import End, Path, Segment

_RENEW = 24


@one_thread()
def continuation(
    start: Scene,
    towards: Scene,
    *,
    until: Exact | None = None,
    progress: Callable[[str], None] | None = None,
) -> Path:
    """Follow the solution from `start` (t = 0) through `towards` (t = 1) and on.

    Parameters
    ----------
    start : Scene
        The scene of t = 0.
    towards : Scene
        That of t = 1, which differs in gaps, prescribed displacements and loads only.
    until : exact number, optional
        The last t wanted, at least 0; without it the path goes on to the last change.
    progress : callable, optional
        Called with a line of text now and then.

    Returns
    -------
    Path
        The pieces between its `breakpoints`, and how it ends.

    Raises
    ------
    InputError
        For scenes that differ in more, and a negative `until`.
    SolveError
        Where the start has no solution.

    Examples
    --------
    >>> from lcp_piles import nt30
    >>> path = continuation(nt30(2), nt30(2, push="sqrt(3)"))
    >>> [str(b.t) for b in path.breakpoints], path.end
    (['1/6'], 'asymptotic')
    """
    _check_same(start, towards)
    limit = None if until is None else surd(until)
    if limit is not None and limit < 0:
        raise InputError("until", str(limit), "a number of at least 0")
    system = contact_system(start)
    if contact_system(towards).reduction.part != system.reduction.part:
        system = contact_system(start, "whole")
    return _Walk(system, with_loads_of(system, towards)).path(limit, progress)


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
        self.columns, self.table = _start(system)

    def path(self, limit: Surd | None, progress: Callable[[str], None] | None) -> Path:
        """All pieces from t = 0 on."""
        if limit == ZERO:
            return Path((self._point(),), "reached", 0)
        try:
            self._aim(*self._ends())
        except CollapseError:  # at every t > 0 the load drives a motion that no contact resists
            return Path((self._point(),), "unstable", 0)
        segments: list[Segment] = []
        entering, pivots, since = self.table.z0, 0, 0
        how: End
        while True:
            table = self.table
            direction = table.direction(entering)
            rise = direction[table.z0]
            leaving = table.blocking(direction)
            if rise < 0:
                how = "turned"
                break
            if leaving is None and rise == 0:
                how = self._beyond(direction)
                break
            if leaving is None or (rise > 0 and table.sign(leaving) > 0):
                segments.append(self._segment(entering, direction))
            if leaving is None:
                how = "asymptotic"
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
                    how = "reached"
                    break
                self.t = t
                if since >= _RENEW:
                    self._found_anew(segments[-1].basis)
                    entering, since = self.table.z0, 0
        return Path(tuple(segments) or (self._point(),), how, pivots)

    def _ends(self) -> tuple[State, State]:
        """The states of the base under the gaps and loads at t = 0 and t = 1."""
        base = self.columns.matrix.base
        start, end = (base.state(x.gap, x.load) for x in (self.system, self.other))
        return start, end

    def _found_anew(self, closed: Mask) -> None:
        """A new tableau at the present t on a contact set that is right just before it."""
        self.columns = _Columns(ContactMatrix(held_set(self.system, closed)))
        start, end = self._ends()
        problem = self.columns.problem(state_between(start, end, self.t))
        self.table = Tableau(problem, [0] * len(problem))
        self._aim(start, end)

    def _aim(self, start: State, end: State) -> None:
        """Put the direction of the path, given by its states at 0 and 1, in place of the cover."""
        read = self.columns.matrix.read
        d, self._per_t = _direction(read(start), read(end))
        self.table.replace_cover(d)
        self._origin = self.t
        self._fetch_next(d)

    def _fetch_next(self, d: list[fmpz]) -> None:
        """Make the columns of the contacts that will reach zero first, if all goes straight on."""
        n = len(d)
        unit = fmpz(1) << max((int(x.bit_length()) for x in d), default=0)
        values, rates = self.table.vector(0, n).array(), ExactVector({1: d}, unit).array()
        falling = np.flatnonzero((rates < 0) & np.array(self.table.is_basic[:n], dtype=bool))
        ratios = values[falling] / -rates[falling]
        self.columns.fetch(falling[np.argsort(ratios)][:_RENEW].tolist())

    def _segment(self, entering: int | None, direction: Direction | None) -> Segment:
        """The piece ahead, its end not known yet."""
        table, n = self.table, self.table.size
        loaded, basis = self.system.bilateral.copy(), self.system.bilateral.copy()
        for i, k in enumerate(self.columns.matrix.contacts.tolist()):
            # w is the force of a contact that starts closed, z that of one that starts open.
            closed_start = bool(self.columns.matrix.base.closed[k])
            basis[k] = closed_start != (table.is_basic[n + i] or entering == n + i)
            force = i if closed_start else n + i
            loaded[k] = table.sign(force) > 0 or (
                direction is not None and direction.sign(force) > 0
            )
        return Segment(self.system, self.other, self.t, None, loaded, basis)

    def _point(self) -> Segment:
        """The piece that is only the present t = 0, where there is no way on."""
        return replace(self._segment(None, None), other=self.system, last=self.t)

    def _beyond(self, direction: Direction) -> End:
        """Why there is no solution just beyond the t of a ray (`notes/formulation.md`, 6)."""
        system, other, n = self.system, self.other, self.table.size
        dz = ExactVector({1: [direction[v] for v in range(n, 2 * n)]}, fmpz(1))
        ray = self.columns.matrix.response(dz)
        if _opens(system, ray.gaps) and self._grows(
            system.load, other.load, ray.displacements.numerators[1]
        ):
            return "unstable"  # a collapse: no contact resists the motion, and the load drives it
        pressing = [-x for x in ray.forces.numerators[1]]
        if _presses(system, ray.forces) and self._grows(system.gap, other.gap, pressing):
            return "overlap"  # forces of rigid contacts in balance, which press on a lack of room
        return "lost"

    def _grows(self, start: ExactVector, end: ExactVector, weights: list[fmpz]) -> bool:
        """Whether the sum of entries times weights is zero at the present t and rises with t."""
        here = combination([(ONE - self.t, start), (self.t, end)])
        return work_sign(here, weights) == 0 < work_sign(_change(start, end), weights)


class _Columns:
    """The columns of the LCP around a held set, several of which can be made ahead in one solve."""

    def __init__(self, matrix: ContactMatrix) -> None:
        self.matrix = matrix
        self._made: dict[int, IntegerColumn] = {}

    def problem(self, state: State) -> LCP:
        """The LCP around a state of the held set."""
        return replace(lcp_around(self.matrix, state), column=self._column)

    def fetch(self, wanted: Sequence[int]) -> None:
        """Make those of these columns that are not there yet."""
        missing = [j for j in wanted if j not in self._made]
        if missing:
            self._made.update(zip(missing, self.matrix.columns(missing), strict=True))

    def _column(self, j: int) -> IntegerColumn:
        self.fetch([j])
        return self._made[j]


def _start(system: ContactSystem) -> tuple[_Columns, Tableau]:
    """The solved tableau of a scene, from a floating-point guess of its contacts if that serves."""
    try:
        guess = regular_set(system, float_guess(system))
        for held in (guess.complete(), None):
            reduced = lcp_from(held) if held else contact_lcp(system)
            columns = _Columns(reduced.matrix)
            table = solved_table(columns.problem(reduced.start))
            if table is not None:
                return columns, table
    except CollapseError as error:
        raise SolveError("the scene cannot stand, so there is nothing to continue") from error
    raise SolveError("the scene at the start has no solution that Lemke's method finds")


def _direction(q: ExactVector, target: ExactVector) -> tuple[list[fmpz], Surd]:
    """(d, c) with target - q = c d and d in integers, so that z0 = c t.

    All of target - q has to be on one root: pivots are rational.
    """
    change = _change(q, target)
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


def _change(start: ExactVector, end: ExactVector) -> ExactVector:
    return combination([(ONE, end), (-ONE, start)])


def _opens(system: ContactSystem, gaps: ExactVector) -> bool:
    """Whether no gap falls, and none of a contact that is held closed changes."""
    bilateral = system.bilateral.tolist()
    return all(x == 0 if b else x >= 0 for x, b in zip(gaps.signs(), bilateral, strict=True))


def _presses(system: ContactSystem, forces: ExactVector) -> bool:
    """Whether the forces act at rigid contacts only, and pull at none that may open."""
    may = zip(forces.signs(), system.rigid.tolist(), system.bilateral.tolist(), strict=True)
    return all(x == 0 or (rigid and (x > 0 or b)) for x, rigid, b in may)


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
