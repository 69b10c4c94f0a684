"""The linear equations of a pile whose contacts are held closed or open, in integers.

With E_k = e / C_k for closed contacts and K = B^T E B over them, a state with gaps g on closed
contacts and forces lambda on open ones has

    K U = B^T E (g - o) + e (p + B_open^T lambda).

A rigid contact has no E: its force stays an unknown y = -e lambda beside U, and Hooke's law a row
of its own, d B_k U - n y = d (g - o) for a compliance n / d, which makes the matrix
A = [[K, B_X^T], [d B_X, -n]] over the set X of such contacts. Where the E of all contacts do not
fit the integers, all of them are treated so, with e = 1: then no common multiple is needed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from flint import fmpz

from ..errors import SolveError
from ..linear.integer_matrix import IntegerMatrix, diagonal, entries
from ..linear.integer_product import multiplied_rows, product, times
from ..linear.rearrangement import blocks, columns_of, rows_of, transposed
from ..linear.sparse_exact import ExactSolver, SingularError
from ..numbers.vectors import Mask
from .system import ContactSystem


@dataclass(frozen=True, eq=False)
class Cause:
    """What a pile answers to: g - o of closed contacts, forces of open ones, a load.

    Integers, those that are zero left out; `load` has one entry a freedom.
    """

    stretch: Mapping[int, fmpz]
    push: Mapping[int, fmpz]
    load: list[fmpz] | None = None


@dataclass(frozen=True, eq=False)
class Response:
    """What a cause brings about, integers over one denominator.

    U and lambda, and the g - o of open contacts, zero for closed ones.
    """

    U: list[fmpz]
    gaps: list[fmpz]
    forces: list[fmpz]
    denominator: fmpz


@dataclass(frozen=True, eq=False)
class Equations:
    """The equations of a contact system with the contacts of `closed` bilateral, others open.

    The freedoms of `pinned` are kept at zero. `progress` is called with a line of text now and
    then while a system is solved.
    """

    system: ContactSystem
    closed: Mask
    pinned: Sequence[int]
    progress: Callable[[str], None] | None = None

    @cached_property
    def scale(self) -> int:
        """The e of E_k = e / C_k."""
        return 1 if self.system.stiffness is None else self.system.stiffness[1]

    @cached_property
    def E(self) -> list[int]:
        """The stiffness of every contact: 0 for open ones and for those of `explicit`."""
        if self.system.stiffness is None:
            return [0] * self.system.contacts
        stiffness: list[int] = np.where(self.closed, self.system.stiffness[0], 0).tolist()
        return stiffness

    @cached_property
    def explicit(self) -> list[int]:
        """The set X: closed contacts whose force is an unknown of its own."""
        own = self.closed if self.system.stiffness is None else self.closed & self.system.rigid
        contacts: list[int] = np.flatnonzero(own).tolist()
        return contacts

    @cached_property
    def solver(self) -> ExactSolver:
        """The exact solver of the matrix A on the freedoms that are not pinned."""
        return ExactSolver(self._matrix(), symmetric=not self.explicit, progress=self.progress)

    def respond(self, causes: Sequence[Cause], likely: fmpz | None = None) -> list[Response]:
        """The response to each cause; `likely` is a denominator that the U may have.

        Raises `SolveError` where A is singular; that its pinned freedoms leave no motion free is
        left to the caller.
        """
        try:
            solutions = self.solver.solve_many([self.right(cause) for cause in causes], likely)
        except SingularError as error:
            raise SolveError(
                "the linear system of this contact set is singular, although it leaves no motion "
                "free: negative compliances cancel, or rigid contacts depend on each other"
            ) from error
        return [
            self._read(cause, *solution) for cause, solution in zip(causes, solutions, strict=True)
        ]

    def right(self, cause: Cause) -> list[fmpz]:
        """The right-hand side b of A x = b."""
        right = self.unbalanced(cause)
        for k, x in cause.stretch.items():
            if self.E[k]:
                weighted = x * self.E[k]
                for j, b in self.rows[k]:
                    right[j] += weighted * b
        zero = fmpz(0)
        free = [right[j] for j in self.free] if self.pinned else right
        compliance = self.system.compliance
        stretch = cause.stretch
        return free + [stretch.get(k, zero) * compliance[k].denominator for k in self.explicit]

    def unbalanced(self, cause: Cause) -> list[fmpz]:
        """The load of a cause and of its open contacts on every freedom, times e."""
        e = self.scale
        total = [x * e for x in cause.load] if cause.load else [fmpz(0)] * self.system.dof
        for k, x in cause.push.items():
            for j, b in self.rows[k]:
                total[j] += x * e * b
        return total

    def _read(self, cause: Cause, solution: list[fmpz], den: fmpz) -> Response:
        system, stretch = self.system, cause.stretch
        e = self.scale
        free = len(self.free)
        U = solution[:free]
        if self.pinned:
            spread = [fmpz(0)] * system.dof
            for j, x in zip(self.free, U, strict=True):
                spread[j] = x
            U = spread
        strain = times(system.B, U)
        zero = fmpz(0)
        forces = [zero] * system.contacts
        gaps = [zero] * system.contacts
        extra = 1
        for k in cause.push:
            extra *= (system.compliance[k] * e).denominator
        for k, (x, c) in enumerate(zip(strain, self.closed.tolist(), strict=True)):
            if not c:
                gaps[k] = x * e * extra
            elif self.E[k]:
                pressed = stretch[k] * den - x if k in stretch else -x
                forces[k] = pressed * (self.E[k] * extra)
        for k, y in zip(self.explicit, solution[free:], strict=True):
            forces[k] = -y * extra
        for k, x in cause.push.items():
            forces[k] = x * (den * e * extra)
            gaps[k] += x * den * int(system.compliance[k] * e * extra)
        return Response([x * (e * extra) for x in U], gaps, forces, den * (e * extra))

    def _matrix(self) -> IntegerMatrix:
        B = columns_of(self.system.B, self.free) if self.pinned else self.system.B
        K = product(transposed(B), multiplied_rows(B, self.E))
        if not self.explicit:
            return K
        B_X = rows_of(B, self.explicit)
        laws = [self.system.compliance[k] for k in self.explicit]
        stretched = product(diagonal([c.denominator for c in laws]), B_X)
        shortened = diagonal([-c.numerator for c in laws])
        return blocks([[K, transposed(B_X)], [stretched, shortened]])

    @cached_property
    def free(self) -> list[int]:
        """The freedoms that are not pinned: the first unknowns of A x = b."""
        return sorted(set(range(self.system.dof)) - set(self.pinned))

    @cached_property
    def rows(self) -> list[list[tuple[int, int | fmpz]]]:
        """The entries (freedom, integer) of every row of B."""
        B = self.system.B
        ends, indices, data = B.indptr.tolist(), B.indices.tolist(), entries(B)
        return [list(zip(indices[a:b], data[a:b], strict=True)) for a, b in pairwise(ends)]
