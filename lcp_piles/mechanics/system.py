"""The contact system of a scene: the mechanics as an integer matrix, without a surd inside.

For the freedoms U and the contacts of a scene, or of its mirror-symmetric half,

    gap_k = (B U)_k + o_k + C_k lambda_k,      B^T lambda + p = 0,

with B a sparse integer matrix and C, o, p exact. U, gap and lambda are the displacements, gaps and
forces of the scene up to one positive factor each, powers of a square root and small rationals
(the rational gauge):

    u_j = sqrt(t_j) U_j     g_k = sqrt(s_k) / m_k gap_k     f_k = sqrt(s_k) m_k / (v_k s_k) lambda_k

where v_k is the number of contacts that one of the half stands for. The square-free integers t
(one an axis) and s (one a direction of contact) are found so that sqrt(t_axis) n_axis / sqrt(s) is
rational, and m_k clears its denominators. With these C_k = c_k m_k^2 / (v_k s_k).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm

import numpy as np
from scipy.sparse import csr_array

from ..errors import SolveError
from ..linear.integer_matrix import LARGEST, IntegerMatrix, integer_matrix, largest_entry
from ..linear.integer_product import product
from ..numbers.exact import ZERO, Surd, sqrt_of, surd
from ..numbers.vectors import ExactVector, FloatArray, IntArray, Mask, distinct, exact_vector
from ..scenes.scene import Scene
from ..scenes.symmetry import Mirror, Part, Reduction, mirror, reduction
from .contact_rows import differences, joined_rows, own_normals
from .gauge import Gauge, gauge_of
from .loads_and_gaps import gauged_gaps, gauged_loads
from .physical import float_compliances, in_units, unit_rows


@dataclass(frozen=True, eq=False, repr=False)
class ContactSystem:
    """B, C, o, p of one part of a scene, and the factors that lead back to its forces and gaps.

    Shapes: B (contacts, freedoms) integer; `compliance` and `gap` one entry a contact; `load` one
    entry a freedom; `bilateral` marks contacts held closed. `force_factor[factor_of]`,
    `gap_factor[factor_of]` and `displacement_factor[axis]` are the f/lambda, g/gap and u/U above.
    """

    scene: Scene
    symmetry: Mirror | None
    gauge: Gauge
    reduction: Reduction
    B: IntegerMatrix
    compliance: tuple[Fraction, ...]
    gap: ExactVector
    load: ExactVector
    bilateral: Mask
    force_factor: tuple[Surd, ...]
    gap_factor: tuple[Surd, ...]
    factor_of: IntArray
    displacement_factor: tuple[Surd, ...]

    def __repr__(self) -> str:
        size = f"{self.dof} freedoms, {self.contacts} contacts"
        return f"<ContactSystem {self.reduction.part}, {size}>"

    @property
    def contacts(self) -> int:
        """Number of contacts of this part."""
        return int(self.B.shape[0])

    @property
    def dof(self) -> int:
        """Number of freedoms of this part."""
        return int(self.B.shape[1])

    @cached_property
    def compliances(self) -> tuple[list[Fraction], IntArray]:
        """The different compliances, and for every contact which of them it has."""
        return distinct(self.compliance)

    @property
    def rigid(self) -> Mask:
        """Which contacts have no compliance."""
        values, which = self.compliances
        return np.array([c == 0 for c in values], dtype=bool)[which]

    @cached_property
    def stiffness(self) -> tuple[IntArray, int] | None:
        """Integers E_k and the scale e > 0 with E_k = e / C_k; 0 for a rigid contact.

        None where B^T E B would not fit 62 bits, as for compliances of many different numerators.
        """
        values, which = self.compliances
        scale = 1
        for c in values:
            scale = lcm(scale, c.numerator or 1)
            if scale > LARGEST:
                return None
        of_value = [int(scale / c) if c else 0 for c in values]
        reach = largest_entry(self.B)
        largest = max(map(abs, of_value), default=0)
        if largest * reach * reach * max(self.contacts, 1) > LARGEST:
            return None
        return np.array(of_value, dtype=np.int64)[which], scale

    @cached_property
    def odd(self) -> ContactSystem | None:
        """The antisymmetric half that completes an "even" system to the whole pile, else None."""
        if self.reduction.part != "even":
            return None
        return _system(self.scene, "odd", self.symmetry, self.gauge)

    def floats(self) -> tuple[csr_array, FloatArray, FloatArray, FloatArray]:
        """(B, C, o, p) in floating point and physical units (module `physical`), for any solver.

        With x the forces (w) times the number of contacts that one of this part stands for, they
        minimise 1/2 x^T diag(C) x + o^T x subject to B^T x = -p, x >= 0, and the multipliers of the
        equations are the displacements (w tau). The arrays are shared: do not write. What is beyond
        the range of floats is infinite (`in_range`).
        """
        return self._floats

    def in_range(self, arithmetic: str = "float64") -> bool:
        """Whether all numbers of the system are within the range of floats of this kind."""
        limit = np.finfo(arithmetic).max
        return all((abs(vector) <= limit).all() for vector in self._floats[1:])

    @cached_property
    def _floats(self) -> tuple[csr_array, FloatArray, FloatArray, FloatArray]:
        parts = self.reduction
        return (
            unit_rows(self.scene, parts, self._scales),
            float_compliances(self.scene, parts),
            in_units(self.gap, self.gap_factor, self.factor_of),
            in_units(self.load, tuple(1 / f for f in self.displacement_factor), parts.axis),
        )

    @cached_property
    def freedom_scale(self) -> FloatArray:
        """The displacement (w tau) that U = 1 is, in floats, at every freedom."""
        return self._scales[self.reduction.axis]

    @property
    def _scales(self) -> FloatArray:
        """The u/U of every axis, in floats."""
        return np.array([float(f) for f in self.displacement_factor])

    def whole_forces(self, multipliers: ExactVector) -> ExactVector:
        """Forces of every contact of the whole scene (w) from the lambda of this part."""
        return self._whole(multipliers, self.force_factor)

    def whole_gaps(self, gaps: ExactVector) -> ExactVector:
        """Gaps of every contact of the whole scene (w tau) from the gaps of this part."""
        return self._whole(gaps, self.gap_factor)

    def whole_displacements(self, freedoms: ExactVector, prescribed: bool = True) -> ExactVector:
        """Displacements (w tau) of every disc and axis of the whole scene, flat.

        With `prescribed` false the held discs stay where they are (a motion, not a state).
        """
        free = freedoms.spread(self.reduction.spread)
        dimension = self.scene.dimension
        axis = np.arange(len(free)) % dimension
        free = ExactVector(free.numerators, free.denominator, self.displacement_factor, axis)
        moved = [
            (k * dimension + a, shift)
            for k, disc in enumerate(self.scene.discs)
            for a, shift in enumerate(disc.held)
            if shift
        ]
        if not (prescribed and moved):
            return free
        return _overwrite(free, moved)

    def _whole(self, values: ExactVector, factors: tuple[Surd, ...]) -> ExactVector:
        contact = self.reduction.contact
        spread = values.take(contact, (contact >= 0).astype(np.int64))
        return ExactVector(spread.numerators, spread.denominator, factors, self.factor_of[contact])


def contact_system(scene: Scene, part: Part | None = None) -> ContactSystem:
    """The contact system of a scene: B, C, o and p of the mechanics, as integers and exact numbers.

    Parameters
    ----------
    scene : Scene
        Any scene.
    part : {"whole", "even", "odd"}, optional
        The whole, or the symmetric or antisymmetric half; by default the symmetric half where the
        scene is its own mirror image, and the whole else.

    Returns
    -------
    ContactSystem
        The system, of `contacts` by `dof` freedoms.

    Raises
    ------
    SolveError
        Where a half is asked of a scene that has none, and where no scaling of the axes by square
        roots makes all normals rational.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> half, whole = contact_system(nt60(4)), contact_system(nt60(4), "whole")
    >>> (half.dof, half.contacts), (whole.dof, whole.contacts)
    ((8, 11), (16, 20))
    """
    symmetry = None if part == "whole" else mirror(scene)
    if part is None:
        part = "whole" if symmetry is None else "even"
    if part != "whole" and symmetry is None:
        raise SolveError(
            "the scene is not its own mirror image, so it has no halves: ask for whole"
        )
    return _system(scene, part, symmetry, gauge_of(scene))


def with_loads_of(system: ContactSystem, scene: Scene) -> ContactSystem:
    """The contact system of a scene that differs from another in gaps and loads only.

    Held displacements may differ too. Part and gauge are those of `system`, so that the numbers of
    the two can be compared.
    """
    return _system(scene, system.reduction.part, system.symmetry, system.gauge)


def _system(scene: Scene, part: Part, symmetry: Mirror | None, gauge: Gauge) -> ContactSystem:
    return system_of(scene, reduction(scene, part, symmetry), symmetry, gauge)


def system_of(
    scene: Scene, parts: Reduction, symmetry: Mirror | None, gauge: Gauge
) -> ContactSystem:
    """The contact system of the part of a scene that a reduction says."""
    _, which = scene.normals
    rows, classes = gauge.rows, gauge.classes
    B = _integer_rows(scene, parts, [row for row, _ in rows])

    # Contacts that share direction, weight and compliance share their factors.
    direction = which[parts.representative]
    contacts = [scene.contacts[k] for k in parts.representative.tolist()]
    keys: dict[tuple[int, int], int] = {}
    factor_of = np.empty(len(contacts), dtype=np.int64)
    compliance: list[Fraction] = []
    scaled: dict[tuple[int, int], Fraction] = {}
    for k, (n, v) in enumerate(zip(direction.tolist(), parts.weight.tolist(), strict=True)):
        factor_of[k] = keys.setdefault((n, v), len(keys))
        c = contacts[k].compliance
        key = (factor_of[k].item(), id(c))
        if key not in scaled:
            m = rows[n][1]
            scaled[key] = c * m * m / (v * classes[n])
        compliance.append(scaled[key])
    roots = [sqrt_of(s) for s in classes]
    force_factor = tuple(roots[n] * Fraction(rows[n][1], v * classes[n]) for n, v in keys)
    gap_factor = tuple(roots[n] * Fraction(1, rows[n][1]) for n, _ in keys)
    displacement_factor = tuple(sqrt_of(t) for t in gauge.axes)

    if parts.part == "odd":  # gaps and loads that are their own mirror image have no part here
        gap = exact_vector([ZERO] * len(contacts))
        load = exact_vector([ZERO] * parts.size)
    else:
        widened = [roots[n] * Fraction(rows[n][1], classes[n]) for n, _ in keys]
        gap = gauged_gaps(scene, parts, widened, factor_of)
        load = gauged_loads(scene, parts, displacement_factor)
    return ContactSystem(
        scene,
        symmetry,
        gauge,
        parts,
        B,
        tuple(compliance),
        gap,
        load,
        np.array([c.bilateral for c in contacts], dtype=bool),
        force_factor,
        gap_factor,
        factor_of,
        displacement_factor,
    )


def _integer_rows(scene: Scene, parts: Reduction, normals: list[list[int]]) -> IntegerMatrix:
    """The rows of B from an integer row for each of the scene's normals."""
    if all(abs(x) < LARGEST // 2 for row in normals for x in row):
        table = np.array(normals, dtype=np.int64).reshape(-1, scene.dimension)
        rows = joined_rows(scene, parts, table)
        if rows is not None:
            return rows
    moves = product(differences(scene, parts), parts.spread)
    return product(own_normals(scene, parts, integer_matrix(normals)), moves)


def _overwrite(vector: ExactVector, entries: list[tuple[int, Surd]]) -> ExactVector:
    """The vector with some entries replaced."""
    axis_of = vector.factor_of
    divided = [(i, surd(value) / vector.factor(i)) for i, value in entries]
    extra = exact_vector([value for _, value in divided])
    common = vector.denominator.lcm(extra.denominator)
    up, across = common // vector.denominator, common // extra.denominator
    numerators = {}
    size = len(vector)
    for r in sorted(set(vector.numerators) | set(extra.numerators)):
        column = vector.numerators.get(r)
        scaled = [x * up for x in column] if column else [common * 0] * size
        for at, (i, _) in enumerate(divided):
            scaled[i] = extra.numerators[r][at] * across if r in extra.numerators else common * 0
        numerators[r] = scaled
    return ExactVector(numerators, vector.denominator * up, vector.factors, axis_of)
