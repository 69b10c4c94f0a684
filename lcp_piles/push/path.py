"""A path of solutions along one parameter t: its pieces, and where one gives way to the next."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np

from ..errors import InputError
from ..mechanics.held_set import held_set
from ..mechanics.state import State, state_between
from ..mechanics.system import ContactSystem
from ..numbers.exact import Exact, Surd, surd
from ..numbers.vectors import ExactVector, Mask

End = Literal["reached", "asymptotic", "unstable", "overlap", "turned", "lost"]
END_IN_WORDS: dict[End, str] = {
    "reached": "it goes as far as was asked for",
    "asymptotic": "no further change however far it goes",
    "unstable": "no forces balance the loads beyond",
    "overlap": "rigid contacts would have to overlap beyond",
    "turned": "the path of this indefinite scene turns back here",
    "lost": "the path of this indefinite scene ends here, and nothing is proved about what follows",
}
"""How a path may end, and what that says."""


@dataclass(frozen=True, eq=False, repr=False)
class Segment:
    """A piece of the path, first <= t <= last (None: without end), with one contact set.

    `system` and `other` are the contact systems at t = 0 and t = 1. `loaded` marks the contacts of
    the system with a positive force inside the piece; `basis` those that are closed in the linear
    system that gives it: all loaded ones, and where the pile has mechanisms some without force
    that hold them.
    """

    system: ContactSystem
    other: ContactSystem
    first: Surd
    last: Surd | None
    loaded: Mask
    basis: Mask

    def __repr__(self) -> str:
        to = "" if self.last is None else f" to {float(self.last):.6g}"
        return f"<Segment from t = {float(self.first):.6g}{to}, {self.loaded.sum()} loaded>"

    def state(self, t: Exact) -> State:
        """Displacements, gaps and multipliers at a t of the piece, evaluated and not solved."""
        value = surd(t)
        if value < self.first or (self.last is not None and value > self.last):
            raise InputError("t", str(value), f"a number from {self.first} to {self.last}")
        return state_between(*self._ends, value)

    def forces(self, t: Exact) -> ExactVector:
        """The forces (w) of all contacts of the whole scene at a t of the piece."""
        return self.system.whole_forces(self.state(t).forces)

    def linear_force(self, contact: int) -> tuple[Surd, Surd]:
        """(a, b) with the force of a whole contact equal to a + b t on the piece (w)."""
        start, end = (vector[contact] for vector in self._end_forces)
        return start, end - start

    def linear_gap(self, contact: int) -> tuple[Surd, Surd]:
        """(a, b) with the gap of a whole contact equal to a + b t on the piece (w tau)."""
        start, end = (vector[contact] for vector in self._end_gaps)
        return start, end - start

    @cached_property
    def _ends(self) -> tuple[State, State]:
        """The states of this contact set, bilateral, at t = 0 and t = 1: they span the piece."""
        held = held_set(self.system, self.basis)
        start, end = (held.state(x.gap, x.load) for x in (self.system, self.other))
        return start, end

    @cached_property
    def _end_forces(self) -> list[ExactVector]:
        return [self.system.whole_forces(state.forces) for state in self._ends]

    @cached_property
    def _end_gaps(self) -> list[ExactVector]:
        return [self.system.whole_gaps(state.gaps) for state in self._ends]


@dataclass(frozen=True)
class Breakpoint:
    """A t at which the set of loaded contacts changes; whole contacts by their number."""

    t: Surd
    opens: tuple[int, ...]
    closes: tuple[int, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Path:
    """The solutions for t from 0 on: pieces, breakpoints between them, and how it ended.

    `end` is one of `END_IN_WORDS`. There is at least one piece: the point t = 0 where there is no
    other.
    """

    segments: tuple[Segment, ...]
    end: End
    pivots: int

    def __repr__(self) -> str:
        return f"<Path {self.summary}>"

    @property
    def summary(self) -> str:
        """Length and end in a few words."""
        last = self.segments[-1].last
        count = f"{len(self.segments)} piece{'s' * (len(self.segments) > 1)}"
        return f"{count}{'' if last is None else f' to t = {float(last):.6g}'}, {self.end}"

    @cached_property
    def breakpoints(self) -> tuple[Breakpoint, ...]:
        """The changes of the set of loaded contacts, in the order of the path."""
        found = []
        for before, after in pairwise(self.segments):
            opens = _whole(before.system, before.loaded & ~after.loaded)
            closes = _whole(before.system, after.loaded & ~before.loaded)
            if opens or closes:
                found.append(Breakpoint(after.first, opens, closes))
        return tuple(found)

    def segment(self, t: Exact) -> Segment:
        """The piece that holds t."""
        value = surd(t)
        for piece in self.segments:
            if piece.first <= value and (piece.last is None or value <= piece.last):
                return piece
        raise InputError("t", str(value), f"a number from 0 to {self.segments[-1].last}")


def _whole(system: ContactSystem, mask: Mask) -> tuple[int, ...]:
    """The numbers of the whole pile's contacts that a mask of the system stands for."""
    return tuple(np.flatnonzero(mask[system.reduction.contact]).tolist())
