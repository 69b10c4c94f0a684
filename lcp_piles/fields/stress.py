"""The stress tensor of each disc, averaged over the disc.

sigma = (1/V) sum_k F^k r^k over all contact forces on the disc, F^k the force ON the disc, r^k its
point from the disc's centre, V = pi R^2 (the paper, Sec. Results). A contact pushes a disc along n
from the point -R n, and the disc on its other side along -n from R n: it adds -f n n^T / (pi R) to
both (a contact with a support to its one disc). Hence the sign of the paper's formula: compression
is NEGATIVE, and a disc under a pressure P from all sides has sigma = -P. Floor contacts and the
contacts of held discs are in; what holds a disc acts at its centre and adds nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import lcm
from typing import TYPE_CHECKING

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from ..numbers.exact import Surd
from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector, FloatArray
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution, Vector, as_floats
from .disc_contacts import Number, plane_forces
from .field import Cell, Column, DiscTensors, Field, Table

if TYPE_CHECKING:
    import sympy


@dataclass(frozen=True, eq=False)
class Stress:
    """The stress tensors of all discs of a scene, in w/R, compression negative.

    `times_pi` holds pi sigma, xx, xy and yy of one disc after the other (sigma is symmetric), and
    is exact for an exact solution. The arrays are floats.

    >>> from lcp_piles import nt60, solve
    >>> top = stress(solve(nt60(2)))
    >>> [[str(x) for x in row] for row in top.of((1, 1))], float(top.angle[0])
    ([['-1/6*sqrt(3)', '0'], ['0', '-1/2*sqrt(3)']], 90.0)
    """

    scene: Scene
    times_pi: Vector

    def of(self, disc: DiscId) -> tuple[tuple[Number, Number], tuple[Number, Number]]:
        """The tensor pi sigma of a disc as rows, `Surd` (floats for a floating-point solution)."""
        first = 3 * self.scene.disc_index(disc)
        xx, xy, yy = (self.times_pi[first + k] for k in range(3))
        return (xx, xy), (xy, yy)

    def sympy(self, disc: DiscId) -> sympy.Matrix:
        """The tensor sigma of a disc for sympy, with its 1/pi."""
        import sympy

        rows = [[x.sympy() if isinstance(x, Surd) else x for x in row] for row in self.of(disc)]
        return sympy.Matrix(rows) / sympy.pi

    @cached_property
    def array(self) -> FloatArray:
        """The tensors sigma of all discs as floats, shape (discs, 2, 2)."""
        xx, xy, yy = self._components
        return np.stack([xx, xy, xy, yy], axis=1).reshape(-1, 2, 2)

    @cached_property
    def pressure(self) -> FloatArray:
        """-trace/2 of every disc: positive under compression."""
        xx, _, yy = self._components
        pressure: FloatArray = -(xx + yy) / 2
        return pressure

    @cached_property
    def deviator(self) -> FloatArray:
        """Half the difference of the principal values of every disc, >= 0."""
        xx, xy, yy = self._components
        deviator: FloatArray = np.hypot((xx - yy) / 2, xy)
        return deviator

    @cached_property
    def principal(self) -> FloatArray:
        """Principal values of sigma, shape (discs, 2), the major one (most compressed) first."""
        mean, radius = -self.pressure, self.deviator
        return np.stack([mean - radius, mean + radius], axis=1)

    @cached_property
    def angle(self) -> FloatArray:
        """Angle of the major principal axis of every disc: degrees from the x axis, in (-90, 90].

        NaN where the two values are equal, so that there is no axis. Equal exact entries are equal
        floats, so an exact solution never gives an isotropic disc an axis out of rounding.
        """
        xx, xy, yy = self._components
        # Adding zero turns -0.0 into 0.0, which keeps a vertical axis at 90 and not at -90.
        angle = np.degrees(np.arctan2(-2 * xy + 0.0, yy - xx)) / 2
        return np.where((xx == yy) & (xy == 0), np.nan, angle)

    @cached_property
    def _components(self) -> FloatArray:
        return as_floats(self.times_pi).reshape(-1, 3).T / np.pi


def stress(solution: Solution) -> Stress:
    """The stress tensor of every disc of a solved scene of discs, the held ones too.

    It is averaged over the disc; compression is negative, as the paper's formula has it.

    Parameters
    ----------
    solution : Solved
        A solution of a scene of discs.

    Returns
    -------
    Stress
        The tensors, in w/R, exact for exact solutions.

    Raises
    ------
    InputError
        For a scene that is not plane; `NotSolvedError` where the solution has no forces.

    References
    ----------
    Oron and Herrmann (1997), Sec. Results.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> [[str(x) for x in row] for row in stress(solve(nt60(2))).of((1, 1))]
    [['-1/6*sqrt(3)', '0'], ['0', '-1/2*sqrt(3)']]
    """
    scene = solution.scene
    forces = plane_forces(solution)
    if isinstance(forces, ExactVector):
        return Stress(scene, _exact(scene, forces))
    return Stress(scene, stress_map(scene) @ forces)


def stress_map(scene: Scene) -> csr_array:
    """What forces, one a contact, make of the `times_pi` of a scene of discs, in floating point."""
    normals, which = scene.normals
    dyads = np.array([[float(x) for x in _dyad(n)] for n in normals]).reshape(-1, 3)[which]
    radii = np.array([float(disc.radius) for disc in scene.discs])
    entries = []
    for ends in scene.ends:
        contact = np.flatnonzero(ends >= 0)
        disc = ends[contact]
        for part in range(3):
            entries.append((-dyads[contact, part] / radii[disc], 3 * disc + part, contact))
    values, rows, columns = (np.concatenate(parts) for parts in zip(*entries, strict=True))
    shape = (3 * len(scene.discs), len(scene.contacts))
    return csr_array((values, (rows, columns)), shape=shape)


def _dyad(normal: tuple[Surd, ...]) -> tuple[Surd, Surd, Surd]:
    x, y = normal
    return x * x, x * y, y * y


def _exact(scene: Scene, forces: ExactVector) -> ExactVector:
    """-sum of f n n^T over the contacts of each disc, as integers over one denominator."""
    normals, which = scene.normals
    dyads = [_dyad(n) for n in normals]
    clear = lcm(*(x.denominator for dyad in dyads for part in dyad for _, x in part.terms))
    plain = forces.plain()
    entries = 3 * len(scene.discs)
    numerators: dict[int, list[fmpz]] = {1: [fmpz(0)] * entries}
    ends = list(zip(*(e.tolist() for e in scene.ends), which.tolist(), strict=True))
    for r, column in plain.numerators.items():
        # For each normal: component of the dyad, radicand and integer factor of the product.
        terms = [
            [
                (c, root, int(x * clear) * factor)
                for c, part in enumerate(dyad)
                for s, x in part.terms
                for factor, root in [root_product(r, s)]
            ]
            for dyad in dyads
        ]
        for root in {root for part in terms for _, root, _ in part}:
            numerators.setdefault(root, [fmpz(0)] * entries)
        for f, (a, b, n) in zip(column, ends, strict=True):
            if f != 0:
                for c, root, factor in terms[n]:
                    into, part = numerators[root], f * factor
                    into[3 * a + c] -= part
                    if b >= 0:
                        into[3 * b + c] -= part
    return _over_radii(scene, ExactVector(numerators, plain.denominator * clear))


def _over_radii(scene: Scene, sums: ExactVector) -> ExactVector:
    """Three numbers a disc over its radius: r / V is 1 / (pi R)."""
    radii = [disc.radius for disc in scene.discs]
    if all(radius == 1 for radius in radii):
        return sums
    clear = lcm(*(radius.numerator for radius in radii))
    up = [int(clear / radius) for radius in radii for _ in range(3)]
    numerators = {
        r: [x * k for x, k in zip(column, up, strict=True)] for r, column in sums.numerators.items()
    }
    return ExactVector(numerators, sums.denominator * clear)


def _table(found: Stress) -> Table:
    """The movable discs: what carries a held one acts at its centre and is not in its stress."""
    columns = (
        Column("disc"),
        *(Column(name, exact=True) for name in ("x", "y")),
        *(Column(f"pi_sigma_{part}", exact=True) for part in ("xx", "xy", "yy")),
        *(Column(name) for name in ("pressure", "deviator", "angle_degrees")),
    )
    derived = zip(
        found.pressure.tolist(), found.deviator.tolist(), found.angle.tolist(), strict=True
    )
    rows: list[list[Cell]] = []
    for disc, numbers in zip(found.scene.discs, derived, strict=True):
        if not disc.fixed:
            (xx, xy), (_, yy) = found.of(disc.id)
            rows.append([end_name(disc.id), *disc.position, xx, xy, yy, *numbers])
    return Table(columns, rows)


def stress_shape(found: Stress) -> DiscTensors:
    """The stress of the movable discs as something to draw."""
    fixed = np.array([disc.fixed for disc in found.scene.discs])
    tensors = np.where(fixed[:, None, None], np.nan, found.array)
    return DiscTensors(found.scene, tensors, "compression", "tension", -1, "w/R")


FIELD = Field(
    "stress",
    "of every movable disc, compression negative (w/R; pi sigma is exact)",
    stress,
    _table,
    stress_shape,
)
