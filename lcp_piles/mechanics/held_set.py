"""The pile with every contact held as it is: closed and bilateral, or open.

One sparse exact solve of its `equations` then gives everything: Lemke's columns, the Z algorithm,
displacements, the pieces of a continuation and the proof of a guessed contact set are all this.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import fmpz

from ..linear.elimination import pivots, product
from ..linear.kernel import kernel
from ..linear.rearrangement import rows_of, transposed
from ..numbers.vectors import ExactVector, Mask
from .contradiction import contradiction
from .equations import Cause, Equations, Response
from .motions import Motions, free_motions, work_sign
from .state import State
from .system import ContactSystem


@dataclass(frozen=True, eq=False, repr=False)
class HeldSet:
    """A contact system with the contacts of `free.closed` bilateral and all others open.

    `free` are the motions that leave the closed contacts at rest; the displacements taken are those
    without the pinned freedoms. Only B and the compliances of `system` count, so one held set
    serves all gaps and loads of the same contacts, and every answer checks the work of its load on
    the free motions. Rigid contacts that depend on other rigid ones are refused; see
    `independent_rigid`. Use `held_set` to make one.
    """

    system: ContactSystem
    free: Motions
    progress: Callable[[str], None] | None = None

    def __repr__(self) -> str:
        return f"<HeldSet {self.closed.sum()} of {self.system} closed, {len(self.free)} motions>"

    def __reduce__(self) -> tuple[type[HeldSet], tuple[ContactSystem, Motions]]:
        # Without the factors and without who is told of progress: neither can go elsewhere.
        return HeldSet, (self.system, self.free)

    @property
    def closed(self) -> Mask:
        """Which contacts are closed and bilateral."""
        return self.free.closed

    @cached_property
    def equations(self) -> Equations:
        """The linear equations, with their exact solver."""
        return Equations(self.system, self.closed, self.free.pinned, self.progress)

    def state(
        self,
        gap: ExactVector,
        load: ExactVector,
        z: ExactVector | None = None,
        likely: fmpz | None = None,
    ) -> State:
        """The state under initial gaps o and a load p, of one entry a contact and a freedom.

        z holds the gaps of the closed contacts and the forces of the open, all zero by default.
        `likely` is a denominator that the displacements may have, which only saves time. Raises
        `CollapseError` where the load, with the forces of the open contacts, does work on a
        free motion: then no forces of the closed contacts balance it.

        >>> from lcp_piles import contact_system, nt60
        >>> half = contact_system(nt60(2))
        >>> state = held_set(half, np.ones(half.contacts, dtype=bool)).state(half.gap, half.load)
        >>> [str(x) for x in state.displacements], [str(x) for x in state.forces]
        (['-2/3'], ['1'])
        """
        zero = fmpz(0)
        nothing = ExactVector({1: [zero] * self.system.contacts}, fmpz(1))
        vectors = (z or nothing, gap, load)
        common = fmpz(1)
        for vector in vectors:
            common = common.lcm(vector.denominator)
        wide = [common // vector.denominator for vector in vectors]
        radicands = sorted({r for vector in vectors for r in vector.numerators})
        closed = self.closed.tolist()
        own = {r: gap.numerators.get(r, nothing.numerators[1]) for r in radicands}
        given = {r: vectors[0].numerators.get(r, nothing.numerators[1]) for r in radicands}
        causes: dict[int, Cause] = {}
        for r in radicands:
            weights = load.numerators.get(r)
            stretch, push = {}, {}
            for k, (x, o, c) in enumerate(zip(given[r], own[r], closed, strict=True)):
                if not c:
                    if x != 0:
                        push[k] = x * wide[0]
                elif x != 0 or o != 0:
                    stretch[k] = x * wide[0] - o * wide[1]
            acting = weights is not None and any(weights)
            if stretch or push or acting:  # a part that is zero is not worth a column of the solve
                loads = [x * wide[2] for x in weights] if weights and acting else None
                causes[r] = Cause(stretch, push, loads)
        responses = dict.fromkeys(radicands, self._rest) | self._respond([causes], likely)[0]
        den = fmpz(1)
        for response in responses.values():
            den = den.lcm(response.denominator)
        U, gaps, forces = {}, {}, {}
        for r, response in responses.items():
            up = den // response.denominator
            U[r] = [x * up for x in response.U] if up != 1 else response.U
            forces[r] = [x * up for x in response.forces] if up != 1 else response.forces
            # A closed contact has the gap z, an open one the response and o.
            at_z, at_o = den * wide[0], den * wide[1]
            columns = zip(closed, given[r], own[r], response.gaps, strict=True)
            gaps[r] = [
                (x * at_z if x != 0 else zero) if c else g * up + o * at_o if o != 0 else g * up
                for c, x, o, g in columns
            ]
        bottom = den * common
        return State(*(ExactVector(v, bottom) for v in (U, gaps, forces)))

    @cached_property
    def _rest(self) -> Response:
        """The response to nothing."""
        zero = fmpz(0)
        gaps = [zero] * self.system.contacts
        return Response([zero] * self.system.dof, gaps, gaps, fmpz(1))

    def columns(self, contacts: Sequence[int]) -> list[tuple[list[fmpz], fmpz]]:
        """How each contact acts on all: forces of closed, gaps of open ones, over one integer.

        The cause is a gap of one on a closed contact, or a force of one on an open one.
        """
        unit = fmpz(1)
        closed = self.closed.tolist()
        causes = [Cause({k: unit}, {}) if closed[k] else Cause({}, {k: unit}) for k in contacts]
        found = self._respond([{1: cause} for cause in causes])
        return [
            (
                [f if c else g for g, f, c in zip(each.gaps, each.forces, closed, strict=True)],
                each.denominator,
            )
            for each in (responses[1] for responses in found)
        ]

    def _respond(
        self, parts: Sequence[Mapping[int, Cause]], likely: fmpz | None = None
    ) -> list[dict[int, Response]]:
        """The responses to causes in parts, one for each radicand; all in one exact solve."""
        if len(self.free):
            for causes in parts:
                loads = {r: self.equations.unbalanced(cause) for r, cause in causes.items()}
                self.free.check(ExactVector(loads, fmpz(1)))
        every = [cause for causes in parts for cause in causes.values()]
        found = iter(self.equations.respond(every, likely))
        return [{r: next(found) for r in causes} for causes in parts]


def held_set(
    system: ContactSystem,
    closed: Mask,
    progress: Callable[[str], None] | None = None,
) -> HeldSet:
    """The held set of these closed contacts; `progress` is told of long exact solves."""
    return HeldSet(system, free_motions(system, closed), progress)


def completed(held: HeldSet, contacts: Sequence[int]) -> HeldSet:
    """The held set with more contacts closed, so that no motion is free that these would resist.

    Of `contacts` the first ones that serve are taken. With N a basis of the motions, those are the
    rows of B N that are independent of the rows before.
    """
    system, free = held.system, held.free
    if not (len(free) and len(contacts)):
        return held
    chosen = pivots(product(rows_of(system.B, list(contacts)), free.basis)).rows
    if not chosen:
        return held
    closed = held.closed.copy()
    closed[[contacts[k] for k in chosen]] = True
    if len(chosen) == len(free):
        return HeldSet(system, Motions(system, closed, [], []), held.progress)
    return held_set(system, closed, held.progress)


def independent_rigid(system: ContactSystem, closed: Mask) -> Mask:
    """A closed set without the rigid contacts that depend on other rigid ones of it.

    A dependent one cannot be held closed by an unknown force of its own. One-sided contacts go
    before bilateral ones, and these only where they say no more than those that stay: raises
    `ContradictionError` where their gaps disagree (`notes/formulation.md`, 6).
    """
    hard = np.flatnonzero(closed & system.rigid)
    if not len(hard):
        return closed
    kept = closed.copy()
    kept[hard] = False
    tied = hard[system.bilateral[hard]]
    stresses, dependent = kernel(transposed(rows_of(system.B, tied)))
    gap = system.gap.take(tied, np.ones(len(tied), dtype=np.int64))
    for stress in stresses:
        sign = work_sign(gap, stress)
        if sign:
            whole = [fmpz(0)] * system.contacts
            for k, x in zip(tied.tolist(), stress, strict=True):
                whole[k] = -sign * x
            raise contradiction(system, whole)
    tied = np.delete(tied, dependent)
    rows = np.append(tied, hard[~system.bilateral[hard]])
    kept[rows[pivots(rows_of(system.B, rows)).rows]] = True
    kept[tied] = True
    return kept
