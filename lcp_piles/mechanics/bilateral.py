"""The pile with every contact held as it is: closed and bilateral, or open.

One sparse exact solve then gives everything. With E_k = e / C_k in integers for closed contacts and
K = B^T E B over them, a state with gaps g on closed contacts and forces lambda on open ones has

    K U = B^T E (g - o) + e (p + B_open^T lambda).

A rigid contact has no E: its force stays an unknown y = -e lambda / d beside U, and Hooke's law a
row of its own, d B_k U - n d y = d (g - o) for a compliance n / d, which makes the matrix
A = [[K, B_X^T d], [d B_X, -n d]] over the set X of such contacts. Where the E of all contacts do
not fit the integers, all of them are treated so, with e = 1: then no common multiple is needed.

Lemke's columns, the Z algorithm, displacements and the proof of a guessed contact set are all this.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from flint import fmpz
from scipy.sparse import block_array, csr_array, diags_array

from ..errors import SolveError
from ..linear.kernel import independent_rows, times
from ..linear.sparse_exact import ExactSolver, SingularError
from ..numbers.exact import surd_sign
from ..numbers.vectors import ExactVector
from .system import MAX_ENTRY, ContactSystem

Cause = tuple[Mapping[int, fmpz], Mapping[int, fmpz], list[fmpz] | None]
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]


class CollapseError(SolveError):
    """A load does work on a motion that the closed contacts leave free: there is no balance.

    `motion` is that motion in integers, one for each freedom of the contact system, p . U > 0.
    """

    def __init__(self, motion: list[fmpz]) -> None:
        super().__init__("a motion that no closed contact resists is loaded")
        self.motion = motion


@dataclass(frozen=True, eq=False)
class State:
    """Displacements U, gaps and multipliers lambda of a contact system, over one denominator."""

    displacements: ExactVector
    gaps: ExactVector
    forces: ExactVector


class BilateralPile:
    """A contact system with the contacts of `closed` bilateral and all others open.

    Motions that leave all closed contacts at rest are not determined: `pinned` lists freedoms that
    are kept at zero so that the rest is unique, and is empty where there is no such motion.
    Rigid contacts that depend on other rigid ones are refused; see `independent_rigid`.
    """

    def __init__(
        self, system: ContactSystem, closed: Mask, progress: Callable[[str], None] | None = None
    ) -> None:
        self.system = system
        self._progress = progress
        self.closed = closed
        held = np.flatnonzero(closed).tolist()
        if system.stiffness is None:
            self.scale, self.E, self.explicit = 1, [0] * system.contacts, held
        else:
            stiffness, self.scale = system.stiffness
            self.E = np.where(closed, stiffness, 0).tolist()
            self.explicit = np.flatnonzero(closed & system.rigid).tolist()
        self._set_pinned([])

    def state(self, z: ExactVector | None = None) -> State:
        """The state in which z holds the gaps of the closed contacts and the forces of the open.

        Without z, that is, with neither: the pile of bilateral contacts. Raises `CollapseError`
        where the load does work on a free motion.
        """
        system = self.system
        nothing = ExactVector({1: [fmpz(0)] * system.contacts}, fmpz(1))
        vectors = (z or nothing, system.gap, system.load)
        common = fmpz(1)
        for vector in vectors:
            common = common.lcm(vector.denominator)
        wide = [common // vector.denominator for vector in vectors]
        radicands = sorted({r for vector in vectors for r in vector.numerators})
        closed = self.closed.tolist()
        own = {r: system.gap.numerators.get(r, nothing.numerators[1]) for r in radicands}
        causes: list[Cause] = []
        for r in radicands:
            given = vectors[0].numerators.get(r, nothing.numerators[1])
            load = system.load.numerators.get(r)
            stretch, push = {}, {}
            for k, (x, o, c) in enumerate(zip(given, own[r], closed, strict=True)):
                if not c:
                    if x != 0:
                        push[k] = x * wide[0]
                elif x != 0 or o != 0:
                    stretch[k] = x * wide[0] - o * wide[1]
            causes.append((stretch, push, [x * wide[2] for x in load] if load else None))
        parts = self._respond(causes)
        den = fmpz(1)
        for _, _, _, d in parts:
            den = den.lcm(d)
        U, gaps, forces = {}, {}, {}
        for r, (u, g, f, d) in zip(radicands, parts, strict=True):
            up = den // d
            U[r], gaps[r], forces[r] = ([x * up for x in column] for column in (u, g, f))
            if r in system.gap.numerators:  # the response is g - o
                factor = den * wide[1]
                gaps[r] = [x + o * factor for x, o in zip(gaps[r], own[r], strict=True)]
        bottom = den * common
        return State(*(ExactVector(v, bottom) for v in (U, gaps, forces)))

    def right_sides(self) -> tuple[dict[int, tuple[list[fmpz], list[fmpz]]], fmpz]:
        """For each radicand (b, o), over one integer: A x = b gives U, and o are initial gaps.

        For a set where A is the stiffness matrix: no `explicit` contacts, nothing pinned.
        """
        system = self.system
        common = system.gap.denominator.lcm(system.load.denominator)
        up, across = common // system.gap.denominator, common // system.load.denominator
        zero = [fmpz(0)] * system.contacts
        sides = {}
        for r in sorted({*system.gap.numerators, *system.load.numerators}):
            own = [x * up for x in system.gap.numerators.get(r, zero)]
            load = system.load.numerators.get(r)
            stretch = {k: -x for k, x in enumerate(own) if x != 0 and self.closed[k]}
            right = self._right(stretch, {}, [x * across for x in load] if load else None)
            sides[r] = right, own
        return sides, common

    def columns(self, contacts: Sequence[int]) -> list[tuple[list[fmpz], fmpz]]:
        """How each contact acts on all: forces of closed, gaps of open ones, over one integer.

        The cause is a gap of one on a closed contact, or a force of one on an open one.
        """
        unit = fmpz(1)
        causes: list[Cause] = [
            ({k: unit}, {}, None) if self.closed[k] else ({}, {k: unit}, None) for k in contacts
        ]
        closed = self.closed.tolist()
        return [
            ([f if c else g for g, f, c in zip(gaps, forces, closed, strict=True)], den)
            for _, gaps, forces, den in self._respond(causes)
        ]

    def under(self, system: ContactSystem) -> BilateralPile:
        """The same contact set under the gaps and loads of another system of the same contacts."""
        other = copy(self)
        other.system = system
        return other

    def motion(self, rates: Mapping[int, fmpz]) -> list[fmpz]:
        """The motion with the given gap rates of closed and force rates of open contacts."""
        stretch = {k: x for k, x in rates.items() if self.closed[k]}
        push = {k: x for k, x in rates.items() if not self.closed[k]}
        return self._respond([(stretch, push, None)])[0][0]

    def _respond(
        self, causes: list[Cause]
    ) -> list[tuple[list[fmpz], list[fmpz], list[fmpz], fmpz]]:
        """(U, gaps - o, forces, denominator) for each (g - o of closed, force of open, load)."""
        rights = [self._right(*cause) for cause in causes]
        try:
            solutions = self.solver.solve_many(rights)
        except SingularError:
            if self.pinned:
                raise
            self._pin()
            rights = [self._right(*cause) for cause in causes]
            solutions = self.solver.solve_many(rights)
        return [
            self._read(stretch, push, *solution)
            for (stretch, push, _), solution in zip(causes, solutions, strict=True)
        ]

    def _right(
        self,
        stretch: Mapping[int, fmpz],
        push: Mapping[int, fmpz],
        load: list[fmpz] | None,
    ) -> list[fmpz]:
        system = self.system
        e = self.scale
        right = [x * e for x in load] if load else [fmpz(0)] * system.dof
        for k, x in stretch.items():
            if self.E[k]:
                for j, b in self._rows[k]:
                    right[j] += x * self.E[k] * b
        for k, x in push.items():
            for j, b in self._rows[k]:
                right[j] += x * e * b
        zero = fmpz(0)
        free = [right[j] for j in self._free] if self.pinned else right
        compliance = system.compliance
        return free + [stretch.get(k, zero) * compliance[k].denominator for k in self.explicit]

    def _read(
        self,
        stretch: Mapping[int, fmpz],
        push: Mapping[int, fmpz],
        solution: list[fmpz],
        den: fmpz,
    ) -> tuple[list[fmpz], list[fmpz], list[fmpz], fmpz]:
        system = self.system
        e = self.scale
        free = len(self._free)
        U = solution[:free]
        if self.pinned:
            spread = [fmpz(0)] * system.dof
            for j, x in zip(self._free, U, strict=True):
                spread[j] = x
            U = spread
        strain = times(system.B, U)
        zero = fmpz(0)
        forces = [zero] * system.contacts
        gaps = [zero] * system.contacts
        extra = 1
        for k in push:
            extra *= (system.compliance[k] * e).denominator
        for k, (x, c) in enumerate(zip(strain, self.closed.tolist(), strict=True)):
            if not c:
                gaps[k] = x * e * extra
            elif self.E[k]:
                forces[k] = (stretch.get(k, zero) * den - x) * (self.E[k] * extra)
                gaps[k] = stretch.get(k, zero) * (den * e * extra)
        for k, y in zip(self.explicit, solution[free:], strict=True):
            forces[k] = -y * (extra * system.compliance[k].denominator)
            gaps[k] = stretch.get(k, zero) * (den * e * extra)
        for k, x in push.items():
            forces[k] = x * (den * e * extra)
            gaps[k] += x * den * int(system.compliance[k] * e * extra)
        return [x * (e * extra) for x in U], gaps, forces, den * (e * extra)

    def _matrix(self) -> csr_array:
        B = self.system.B if not self.pinned else csr_array(self.system.B[:, self._free])
        K = B.T @ (_diagonal(self.E) @ B)
        if not self.explicit:
            return csr_array(K).astype(np.int64)
        c = [self.system.compliance[k] for k in self.explicit]
        if max(abs(x.numerator * x.denominator) for x in c) > MAX_ENTRY:
            raise SolveError(
                "the numerators and denominators of compliances are too long for the integer "
                "matrix: their product, with the gauge's factors, has to stay below 2^62"
            )
        B_X = _diagonal([x.denominator for x in c]) @ B[self.explicit]
        own = _diagonal([-x.numerator * x.denominator for x in c])
        return csr_array(block_array([[K, B_X.T], [B_X, own]])).astype(np.int64)

    def _pin(self) -> None:
        """Find the free motions; refuse them where they are loaded, pin them where they are not."""
        system = self.system
        motions, pinned = system.motions(self.closed)
        if not motions:
            raise SolveError(
                "the linear system of this contact set is singular, although it leaves no motion "
                "free: negative compliances cancel, or rigid contacts depend on each other"
            )
        for motion in motions:
            sign = work_sign(system.load, motion)
            if sign:
                raise CollapseError([sign * u for u in motion])
        self._set_pinned(pinned)

    def _set_pinned(self, pinned: list[int]) -> None:
        self.pinned = pinned
        self._free = sorted(set(range(self.system.dof)) - set(pinned))
        symmetric = not self.explicit
        self.solver = ExactSolver(self._matrix(), symmetric=symmetric, progress=self._progress)

    @cached_property
    def _rows(self) -> list[list[tuple[int, int]]]:
        B = self.system.B
        ends, indices, data = B.indptr.tolist(), B.indices.tolist(), B.data.tolist()
        return [list(zip(indices[a:b], data[a:b], strict=True)) for a, b in pairwise(ends)]


def _diagonal(entries: list[int]) -> Any:
    """A sparse diagonal matrix of integers (scipy would make floats of them)."""
    return diags_array(np.array(entries, dtype=np.int64), dtype=np.int64)


def independent_rigid(system: ContactSystem) -> Mask:
    """All contacts but the rigid ones that depend on other rigid ones, as a closed set.

    A dependent one cannot be held closed by an unknown force of its own; it starts open.
    """
    closed = np.ones(system.contacts, dtype=bool)
    rigid = np.flatnonzero(system.rigid).tolist()
    if rigid:
        independent = {rigid[i] for i in independent_rows(csr_array(system.B[rigid]))}
        closed[[k for k in rigid if k not in independent]] = False
    return closed


def work_sign(load: ExactVector, motion: list[fmpz]) -> int:
    """Sign of the work that the load does on a motion."""
    return surd_sign(
        [
            (r, sum((p * u for p, u in zip(column, motion, strict=True) if u != 0), fmpz(0)), 1)
            for r, column in load.numerators.items()
        ]
    )
