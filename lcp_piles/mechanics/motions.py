"""Motions that a contact set leaves free, and the work of loads on them.

A motion is free where it changes the gap of no contact of the set. Nothing there resists a load, so
a load that does work on a free motion has no balance: the scene gives way along it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from flint import fmpz, fmpz_mat

from ..errors import SolveError
from ..linear.integer_product import times
from ..linear.kernel import kernel
from ..linear.rearrangement import rows_of
from ..numbers.exact import surd_sign
from ..numbers.vectors import ExactVector, Mask
from .system import ContactSystem


class CollapseError(SolveError):
    """A load does work on a motion that the closed contacts leave free: there is no balance.

    `motion` is that motion in integers, one for each freedom of the contact system, p . U > 0.
    """

    def __init__(self, motion: list[fmpz]) -> None:
        super().__init__("a motion that no closed contact resists is loaded")
        self.motion = motion


@dataclass(frozen=True, eq=False, repr=False)
class Motions:
    """A basis of the motions that change no gap of the contacts of `closed`, in integers.

    Motion k is not zero at the freedom `pinned[k]` and zero at the other pinned ones, so that
    keeping those at zero leaves no motion.
    """

    system: ContactSystem
    closed: Mask
    basis: list[list[fmpz]]
    pinned: list[int]

    def __repr__(self) -> str:
        return f"<Motions {len(self)} of {self.system}, {self.closed.sum()} closed>"

    def __len__(self) -> int:
        return len(self.basis)

    def work(self, load: ExactVector) -> list[int]:
        """Sign of the work that a load, one entry a freedom, does on every motion."""
        if not self.basis:
            return []
        table = fmpz_mat(self.basis)
        works = {1: [fmpz(0)] * len(self)}
        for r, column in load.numerators.items():
            works[r] = (table * fmpz_mat(len(column), 1, column)).entries()
        return ExactVector(works, load.denominator).signs()

    def check(self, load: ExactVector) -> None:
        """Raise `CollapseError` where the load does work on a motion."""
        for sign, motion in zip(self.work(load), self.basis, strict=True):
            if sign:
                raise CollapseError([sign * u for u in motion])


def free_motions(
    system: ContactSystem, closed: Mask, known: Iterable[Motions | None] = ()
) -> Motions:
    """The motions that a contact set leaves free: one of `known` where that is of the same set.

    >>> from lcp_piles import contact_system, tss
    >>> half = contact_system(tss(6))
    >>> loaded = np.ones(half.contacts, dtype=bool)
    >>> len(free_motions(half, loaded)), len(free_motions(half, ~loaded)) == half.dof
    (0, True)
    """
    for motions in known:
        if motions is None or motions.system is not system:
            continue
        if np.array_equal(motions.closed, closed):
            return motions
    return Motions(system, closed, *kernel(rows_of(system.B, closed)))


def resisted_by_none(system: ContactSystem, motion: list[fmpz]) -> bool:
    """Whether a motion closes no contact, and leaves alone those that are held closed."""
    rates = zip(times(system.B, motion), system.bilateral.tolist(), strict=True)
    return all(x == 0 if bilateral else x >= 0 for x, bilateral in rates)


def work_sign(load: ExactVector, motion: list[fmpz]) -> int:
    """Sign of the work that the load does on a motion."""
    return surd_sign(
        [
            (r, sum((p * u for p, u in zip(column, motion, strict=True) if u != 0), fmpz(0)), 1)
            for r, column in load.numerators.items()
        ]
    )
