"""From a guess in floating point to a held set, its state, and displacements along its mechanisms.

The contacts of a guess may leave mechanisms. Those that the load drives have to be held by more
contacts. The others are places of freedom: where the guess says that an open contact just touches,
that contact is held closed with them, and else the discs go where the guess has them. A shift v
along motions that leave all closed contacts at rest changes gaps of open contacts only, so the
state under the initial gaps o + B v has the same forces, and v more of displacement.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import frexp, ldexp

import numpy as np
from flint import fmpz

from ..linear.integer_product import times
from ..mechanics.held_set import HeldSet, completed, held_set, independent_rigid
from ..mechanics.motions import Motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem
from ..numbers.vectors import ExactVector, FloatArray, Mask
from ..solution.partition import shifted
from .method import Progress

_TOUCHING = 2.0**-28  # a gap, relative to the largest displacement, that is taken for none
_DIGITS = 32  # bits of displacements along mechanisms, from the largest displacement down


@dataclass(frozen=True, eq=False)
class Guess:
    """A contact set to start from; `distance` is small where an open contact nearly closes.

    `U` (w tau) are displacements that go with it, one a freedom, or None where nothing is known.
    """

    closed: Mask
    distance: FloatArray
    U: FloatArray | None = None


@dataclass(frozen=True, eq=False)
class RegularSet:
    """A held set that a guess leads to, and the displacements along what it leaves free.

    `idle` marks contacts of it that surely carry nothing, and `free` are the motions that the guess
    left free before they were added. `others` are the open contacts, the nearest first. `shift` are
    integers over `unit`, one a freedom: a motion that leaves the closed contacts at rest.
    """

    held: HeldSet
    idle: Mask
    free: Motions
    others: Sequence[int]
    shift: list[fmpz] | None
    unit: fmpz

    @property
    def gap(self) -> ExactVector:
        """The initial gaps, moved along by the shift."""
        system = self.held.system
        if self.shift is None:
            return system.gap
        return shifted(system.gap, times(system.B, self.shift), self.unit)

    def state(self) -> State:
        """The state of the set; `CollapseError` where the load drives a motion that is free."""
        state = self.held.state(self.gap, self.held.system.load)
        if self.shift is None:
            return state
        return replace(state, displacements=shifted(state.displacements, self.shift, self.unit))

    def complete(self) -> HeldSet:
        """The held set with more contacts closed, so that no motion is free that any resists."""
        return completed(self.held, self.others)


def regular_set(
    system: ContactSystem, guess: Guess, progress: Progress | None = None
) -> RegularSet:
    """The guess, completed where it leaves motions free.

    With N a basis of the motions and X the contacts added, balance along N reads
    (B_X N)^T lambda_X = -N^T p, with independent rows B_X N. So where the load does no work on the
    motions the added contacts are idle: they carry exactly nothing. Then only those are added that
    touch; else, or where no displacements are known, all that serve.
    """
    closed = independent_rigid(system, guess.closed | system.bilateral)
    proposed = held_set(system, closed, progress)
    free = proposed.free
    others = np.flatnonzero(~closed & ~system.bilateral)
    others = others[np.argsort(guess.distance[others], kind="stable")]
    driven = any(free.work(system.load))
    if driven or guess.U is None:
        held, U = completed(proposed, others.tolist()), None
    else:
        U = guess.U
        near = guess.distance[others] <= _TOUCHING * np.abs(U).max(initial=0.0)
        held = completed(proposed, others[near].tolist())
    idle = held.closed & ~closed & (not driven)
    shift, unit = (None, fmpz(1)) if U is None else _along(held.free, U)
    return RegularSet(held, idle, free, others[~held.closed[others]].tolist(), shift, unit)


def _along(free: Motions, U: FloatArray) -> tuple[list[fmpz] | None, fmpz]:
    """The mix of motions that brings the pinned freedoms near U, as integers over one."""
    if not len(free):
        return None, fmpz(1)
    U = U / free.system.freedom_scale
    bits = max(_DIGITS - frexp(float(np.abs(U).max()))[1], 0)
    spare = max(
        int(motion[j].bit_length()) for motion, j in zip(free.basis, free.pinned, strict=True)
    )
    total = [fmpz(0)] * len(U)
    for motion, j in zip(free.basis, free.pinned, strict=True):
        amount = (fmpz(round(ldexp(float(U[j]), bits))) << spare) // motion[j]
        if amount != 0:
            for i, x in enumerate(motion):
                if x != 0:
                    total[i] += amount * x
    return total, fmpz(1) << (bits + spare)
