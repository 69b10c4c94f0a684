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
from math import gcd, lcm

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from ..errors import SolveError
from ..linear.kernel import kernel
from ..numbers.exact import ZERO, Exact, Surd, sqrt_of, surd
from ..numbers.vectors import ExactVector, FloatArray, IntArray, exact_vector
from ..scenes.scene import Scene
from ..scenes.symmetry import Mirror, Part, Reduction, mirror, reduction

MAX_ENTRY = 2**62
"""What integer matrices may hold: a bit is left for sums in int64."""


@dataclass(frozen=True, eq=False)
class ContactSystem:
    """B, C, o, p of one part of a scene, and the factors that lead back to its forces and gaps.

    Shapes: B (contacts, freedoms) integer; `compliance` and `gap` one entry a contact; `load` one
    entry a freedom; `bilateral` marks contacts held closed. `force_factor[factor_of]`,
    `gap_factor[factor_of]` and `displacement_factor[axis]` are the f/lambda, g/gap and u/U above.
    """

    scene: Scene
    symmetry: Mirror | None
    reduction: Reduction
    B: csr_array
    compliance: tuple[Fraction, ...]
    gap: ExactVector
    load: ExactVector
    bilateral: np.ndarray[tuple[int], np.dtype[np.bool_]]
    force_factor: tuple[Surd, ...]
    gap_factor: tuple[Surd, ...]
    factor_of: IntArray
    displacement_factor: tuple[Surd, ...]

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
        by_object = {id(c): c for c in self.compliance}
        number = {c: i for i, c in enumerate(dict.fromkeys(by_object.values()))}
        of_object = {key: number[c] for key, c in by_object.items()}
        which = [of_object[id(c)] for c in self.compliance]
        return list(number), np.array(which, dtype=np.int64)

    @property
    def rigid(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
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
            if scale > MAX_ENTRY:
                return None
        of_value = [int(scale / c) if c else 0 for c in values]
        reach = int(abs(self.B).max()) if self.B.nnz else 0
        largest = max(map(abs, of_value), default=0)
        if largest * reach * reach * max(self.contacts, 1) > MAX_ENTRY:
            return None
        return np.array(of_value, dtype=np.int64)[which], scale

    def motions(self, held: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> list[list[fmpz]]:
        """A basis of the motions that change the gap of none of these contacts, in integers.

        The bases of different sets are kept: do not write.
        """
        key = held.tobytes()
        if key not in self._motions:
            self._motions[key] = kernel(csr_array(self.B[held]))[0]
        return self._motions[key]

    @cached_property
    def _motions(self) -> dict[bytes, list[list[fmpz]]]:
        return {}

    @cached_property
    def odd(self) -> ContactSystem | None:
        """The antisymmetric half that completes an "even" system to the whole pile, else None."""
        if self.reduction.part != "even":
            return None
        return _system(self.scene, "odd", self.symmetry)

    def floats(self) -> tuple[csr_array, FloatArray, FloatArray, FloatArray]:
        """(B, C, o, p) in floating point, for any solver of sparse problems.

        The forces minimise 1/2 x^T diag(C) x + o^T x subject to B^T x = -p, x >= 0, and the
        multipliers of the equations are the displacements. The arrays are shared: do not write.
        """
        return self._floats

    @cached_property
    def _floats(self) -> tuple[csr_array, FloatArray, FloatArray, FloatArray]:
        values, which = self.compliances
        compliance = np.array([float(c) for c in values])[which]
        return self.B.astype(np.float64), compliance, self.gap.array(), self.load.array()

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
        free = freedoms.take(self.reduction.freedom, self.reduction.sign)
        dimension = self.scene.dimension
        axis = np.arange(len(self.reduction.freedom)) % dimension
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
    """The contact system of a scene, of its symmetric half where it has one unless told otherwise.

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
    return _system(scene, part, symmetry)


def _system(scene: Scene, part: Part, symmetry: Mirror | None) -> ContactSystem:
    parts = reduction(scene, part, symmetry)
    normals, which = scene.normals
    axes, classes = rational_gauge(normals, scene.dimension, _loaded_axes(scene))
    rows = _integer_rows(normals, axes, classes)
    B_whole = _assemble(scene, rows)
    keep = np.flatnonzero(parts.sign)
    R = csr_array(
        (parts.sign[keep], (keep, parts.freedom[keep])), shape=(len(parts.sign), parts.size)
    )
    B = csr_array(B_whole[parts.representative] @ R)
    B.sort_indices()
    B.eliminate_zeros()

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
    displacement_factor = tuple(sqrt_of(t) for t in axes)

    if part == "odd":  # gaps and loads that are their own mirror image have no part here
        gap = exact_vector([ZERO] * len(contacts))
        load = exact_vector([ZERO] * parts.size)
    else:
        gap = _gauged_gaps(scene, parts, [1 / f for f in gap_factor], factor_of)
        load = _gauged_loads(scene, parts, displacement_factor)
    return ContactSystem(
        scene,
        symmetry,
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


def rational_gauge(
    normals: tuple[tuple[Surd, ...], ...], dimension: int, first_axes: list[int]
) -> tuple[list[int], list[int]]:
    """Square-free t (an axis) and s (a normal) with sqrt(t_axis) n_axis / sqrt(s) rational.

    Axes in `first_axes` are given t = 1 where they can be, which keeps loads on them rational.
    Raises `SolveError` where no such scaling exists.
    """
    axes: list[int | None] = [None] * dimension
    classes: list[int | None] = [None] * len(normals)
    for start in [*first_axes, *range(dimension)]:
        if axes[start] is not None:
            continue
        axes[start] = 1
        changed = True
        while changed:
            changed = False
            for k, normal in enumerate(normals):
                for axis, component in enumerate(normal):
                    if not component:
                        continue
                    if len(component.terms) > 1:
                        raise SolveError(_no_gauge(normal))
                    radicand = component.terms[0][0]
                    t, s = axes[axis], classes[k]
                    if t is not None and s is None:
                        classes[k] = _square_free_product(radicand, t)
                        changed = True
                    elif t is None and s is not None:
                        axes[axis] = _square_free_product(radicand, s)
                        changed = True
                    elif t is not None and _square_free_product(radicand, t) != s:
                        raise SolveError(_no_gauge(normal))
    return [t or 1 for t in axes], [s or 1 for s in classes]


def _no_gauge(normal: tuple[Surd, ...]) -> str:
    shown = ", ".join(map(str, normal))
    return (
        f"no scaling of the axes by square roots makes the contact along ({shown}) rational "
        "together with the others: exact solving needs a scene with such a scaling"
    )


def _square_free_product(r: int, s: int) -> int:
    common = gcd(r, s)
    return (r // common) * (s // common)


def _loaded_axes(scene: Scene) -> list[int]:
    loaded = {a for disc in scene.discs for a, p in enumerate(disc.load) if p is not ZERO and p}
    return sorted(loaded, reverse=True)


def _integer_rows(
    normals: tuple[tuple[Surd, ...], ...], axes: list[int], classes: list[int]
) -> list[tuple[list[int], int]]:
    """For each normal the integers m sqrt(t) n / sqrt(s), and m."""
    rows = []
    for normal, s in zip(normals, classes, strict=True):
        scaled = [
            (n * sqrt_of(t) / sqrt_of(s)).rational() for n, t in zip(normal, axes, strict=True)
        ]
        m = lcm(*(x.denominator for x in scaled))
        rows.append(([int(x * m) for x in scaled], m))
    return rows


def _assemble(scene: Scene, rows: list[tuple[list[int], int]]) -> csr_array:
    """The integer B of the whole scene on all freedoms, held ones too."""
    a, b = scene.ends
    _, which = scene.normals
    dimension = scene.dimension
    table = np.array([row for row, _ in rows], dtype=np.int64).reshape(-1, dimension)[which]
    numbers = np.arange(len(a))
    data, i, j = [], [], []
    for axis in range(dimension):
        data += [table[:, axis], -table[b >= 0, axis]]
        i += [numbers, numbers[b >= 0]]
        j += [a * dimension + axis, b[b >= 0] * dimension + axis]
    shape = (len(a), len(scene.discs) * dimension)
    B = csr_array((np.concatenate(data), (np.concatenate(i), np.concatenate(j))), shape=shape)
    B.eliminate_zeros()
    return B


def initial_gaps(scene: Scene) -> dict[int, Surd]:
    """The o + n . (prescribed displacements) of every contact where it is not zero."""
    moved = {
        k: tuple(h or ZERO for h in disc.held)
        for k, disc in enumerate(scene.discs)
        if any(h is not None and h for h in disc.held)
    }
    gaps = {k: c.gap for k, c in enumerate(scene.contacts) if c.gap is not ZERO and c.gap}
    if moved:
        a, b = scene.ends
        touched = np.isin(a, list(moved)) | np.isin(b, list(moved))
        for k in np.flatnonzero(touched).tolist():
            for end, sign in ((int(a[k]), 1), (int(b[k]), -1)):
                shift = moved.get(end)
                if shift is not None:
                    normal = scene.contacts[k].normal
                    part = sum((n * h for n, h in zip(normal, shift, strict=True)), ZERO)
                    gaps[k] = gaps.get(k, ZERO) + sign * part
    return gaps


def _gauged_gaps(
    scene: Scene, parts: Reduction, scales: list[Surd], factor_of: IntArray
) -> ExactVector:
    values: list[Exact] = [ZERO] * len(parts.representative)
    for k, gap in initial_gaps(scene).items():
        r = int(parts.contact[k])
        if r >= 0 and int(parts.representative[r]) == k:
            values[r] = gap * scales[int(factor_of[r])]
    return exact_vector(values)


def _gauged_loads(scene: Scene, parts: Reduction, factor: tuple[Surd, ...]) -> ExactVector:
    """The load on every freedom of the part, summed over the freedoms it stands for."""
    dimension = scene.dimension
    # Few different loads on many discs: count how often each acts on a freedom, then add up.
    acting: dict[tuple[int, int], list[int]] = {}
    value: dict[int, Surd] = {}
    for k, disc in enumerate(scene.discs):
        for axis, p in enumerate(disc.load):
            if p is not ZERO and p:
                acting.setdefault((axis, id(p)), []).append(k * dimension + axis)
                value[id(p)] = p
    totals: list[Surd] = [ZERO] * parts.size
    for (axis, key), freedoms in acting.items():
        count = np.zeros(parts.size, dtype=np.int64)
        moving = np.array(freedoms)[parts.sign[freedoms] != 0]  # a part may have no freedom at all
        np.add.at(count, parts.freedom[moving], parts.sign[moving])
        scaled = value[key] * factor[axis]
        multiples = {int(n): scaled * int(n) for n in np.unique(count)}
        for j in np.flatnonzero(count).tolist():
            more = multiples[int(count[j])]
            totals[j] = totals[j] + more if totals[j] else more
    return exact_vector(totals)


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
