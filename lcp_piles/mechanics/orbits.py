"""The part of a contact system that keeps all symmetries of its scene, and states led back from it.

The forces of a definite scene are as symmetric as the scene, so one contact of every orbit of its
group stands for all of them, and a disc moves only where the symmetries that leave it in place let
it go: the freedoms are a basis of these motions, for one disc of every orbit. The group has to be
rational in the gauge, D^-1 T D for a map T and the D of the axes, so that all matrices stay
integer. A tetrahedral pile of 20 layers has 1,540 orbits of contacts where its mirror leaves 4,410.

What is found in this part is a state of the system that it was made from, and is judged there: the
mechanisms of the whole pile need not be symmetric.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

import numpy as np
from flint import fmpz, fmpz_mat
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from ..numbers.exact import Surd, sqrt_of
from ..numbers.vectors import ExactVector, IntArray
from ..scenes.scene import Scene
from ..scenes.symmetry import Reduction
from ..scenes.turns import Turn, turns
from .gauge import Gauge
from .state import State
from .system import ContactSystem, system_of

Element = tuple[tuple[Fraction, ...], ...]
"""A matrix of the group in the rational gauge."""
_Moves = list[list[tuple[int, int]]]
"""For every element of the group where it takes a vector: (axis, integer) where that is not 0."""


@dataclass(frozen=True, eq=False)
class SymmetricPart:
    """The symmetric `part` of a contact system `of`."""

    of: ContactSystem
    part: ContactSystem

    def state(self, found: State) -> State:
        """The state of the system that a state of its symmetric part is."""
        of, part = self.of, self.part
        contact = part.reduction.contact[of.reduction.representative]
        pairs = list(zip(part.factor_of[contact].tolist(), of.factor_of.tolist(), strict=True))
        return State(
            found.displacements.spread(self._spread),
            _scaled(found.gaps, contact, _ratios(pairs, part.gap_factor, of.gap_factor)),
            _scaled(found.forces, contact, _ratios(pairs, part.force_factor, of.force_factor)),
        )

    def motion(self, found: list[fmpz]) -> list[fmpz]:
        """The motion of the system that one of its symmetric part is, one entry a freedom."""
        return ExactVector({1: found}, fmpz(1)).spread(self._spread).numerators[1]

    @property
    def _spread(self) -> csr_array:
        """How the freedoms of the system move with those of the part."""
        moving = self.of.reduction.spread.tocoo()
        leaders = np.zeros(self.of.dof, dtype=np.int64)
        first = moving.data > 0
        leaders[moving.col[first][::-1]] = moving.row[first][::-1]
        return csr_array(self.part.reduction.spread[leaders])


def symmetric_part(system: ContactSystem) -> SymmetricPart | None:
    """The symmetric part of a system; None where the scene has no turns to keep.

    Rigid contacts with gaps may contradict each other, and negative compliances promise nothing
    about symmetry: such a scene is left as it is.

    >>> from lcp_piles import contact_system, tetrahedron
    >>> system = contact_system(tetrahedron(20))
    >>> system, symmetric_part(system).part
    (<ContactSystem even, 2365 freedoms, 4410 contacts>, \
<ContactSystem symmetric, 825 freedoms, 1540 contacts>)
    """
    scene = system.scene
    rigid = np.flatnonzero(system.rigid)
    gaps = system.gap.take(rigid, np.ones(len(rigid), dtype=np.int64))
    if not scene.definite or any(gaps.signs()):
        return None
    maps = turns(scene)
    if not maps:
        return None
    matrices = [_in_gauge(turn, system.gauge) for turn in maps]
    rational = [(turn, matrix) for turn, matrix in zip(maps, matrices, strict=True) if matrix]
    if len(rational) < len(maps):
        return None
    parts = _reduction(scene, maps, [matrix for _, matrix in rational])
    return SymmetricPart(system, system_of(scene, parts, system.symmetry, system.gauge))


def _in_gauge(turn: Turn, gauge: Gauge) -> Element | None:
    """D^-1 T D, or None where it is not rational."""
    roots = [sqrt_of(t) for t in gauge.axes]
    scaled = [
        [entry * roots[j] / roots[i] for j, entry in enumerate(row)]
        for i, row in enumerate(turn.matrix)
    ]
    if not all(entry.is_rational for row in scaled for entry in row):
        return None
    return tuple(tuple(entry.rational() for entry in row) for row in scaled)


def _reduction(scene: Scene, maps: tuple[Turn, ...], matrices: list[Element]) -> Reduction:
    """The reduction of the scene to what all maps leave alone."""
    spread, axis = _spread(scene, maps, matrices)
    count = len(scene.contacts)
    numbers = np.arange(count)
    one = np.concatenate([numbers for _ in maps])
    other = np.concatenate([turn.contacts for turn in maps])
    pairs = coo_array((np.ones(len(one)), (one, other)), shape=(count, count))
    _, label = connected_components(pairs, directed=False)
    _, representative, contact, weight = np.unique(
        label, return_index=True, return_inverse=True, return_counts=True
    )
    nothing = np.zeros(0, dtype=np.int64)
    return Reduction(
        "symmetric",
        spread.shape[1],
        nothing,
        nothing,
        contact.astype(np.int64),
        representative.astype(np.int64),
        weight.astype(np.int64),
        spread,
        axis,
    )


def _spread(
    scene: Scene, maps: tuple[Turn, ...], matrices: list[Element]
) -> tuple[csr_array, IntArray]:
    """The matrix from the freedoms of the symmetric part to those of the whole, and their axes."""
    images = [turn.discs.tolist() for turn in maps]
    group, table = _group(matrices)
    seen = [False] * len(scene.discs)
    known: dict[tuple[frozenset[tuple[int, int]], tuple[bool, ...]], list[_Moves]] = {}
    rows: list[int] = []
    columns: list[int] = []
    data: list[int] = []
    axis: list[int] = []
    for first, disc in enumerate(scene.discs):
        if seen[first]:
            continue
        orbit, stays = _orbit(first, images, table)
        for k in orbit:
            seen[k] = True
        free = tuple(h is None for h in disc.held)
        if (stays, free) not in known:
            known[stays, free] = [_moves(group, v) for v in _kept(group, stays, free)]
        for moves in known[stays, free]:
            for k, element in orbit.items():
                for a, x in moves[element]:
                    rows.append(3 * k + a)
                    columns.append(len(axis))
                    data.append(x)
            axis.append(moves[0][0][0])
    entries = np.array(data, dtype=np.int64)
    shape = (3 * len(scene.discs), len(axis))
    return csr_array((entries, (rows, columns)), shape=shape), np.array(axis, dtype=np.int64)


def _group(matrices: list[Element]) -> tuple[list[Element], list[list[int]]]:
    """All products of some matrices, 1 first, and which of them each matrix times each is."""
    one: Element = tuple(tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3))
    number = {one: 0}
    group = [one]
    table: list[list[int]] = [[] for _ in matrices]
    for element in group:  # which grows
        for row, matrix in zip(table, matrices, strict=True):
            product = _product(matrix, element)
            if product not in number:
                number[product] = len(group)
                group.append(product)
            row.append(number[product])
    return group, table


def _orbit(
    first: int, images: list[list[int]], table: list[list[int]]
) -> tuple[dict[int, int], frozenset[tuple[int, int]]]:
    """The discs that one goes to, each with an element of the group that leads there.

    And pairs of elements that lead to the same disc: with these G and H, the products H^-1 G
    generate what leaves the first disc in place (Schreier's lemma).
    """
    leads = {first: 0}
    stays: set[tuple[int, int]] = set()
    reached = [first]
    for k in reached:  # which grows
        for image, row in zip(images, table, strict=True):
            way = row[leads[k]]
            if image[k] not in leads:
                leads[image[k]] = way
                reached.append(image[k])
            elif leads[image[k]] != way:
                stays.add((way, leads[image[k]]))
    return leads, frozenset(stays)


def _kept(
    group: list[Element], stays: frozenset[tuple[int, int]], free: tuple[bool, ...]
) -> list[list[int]]:
    """A basis, in integers, of the vectors v with G v = H v for all pairs, zero where held."""
    table = [
        [x - y for x, y in zip(*rows, strict=True)]
        for g, h in sorted(stays)
        for rows in zip(group[g], group[h], strict=True)
    ]
    table += [[Fraction(int(a == b)) for b in range(3)] for a in range(3) if not free[a]]
    if not table:
        return [[int(a == b) for b in range(3)] for a in range(3)]
    whole = [int(x * lcm(*(y.denominator for y in row))) for row in table for x in row]
    null, rank = fmpz_mat(len(table), 3, whole).nullspace()
    vectors = [[int(null[i, j]) for i in range(3)] for j in range(rank)]
    return [[x // gcd(*vector) for x in vector] for vector in vectors]


def _moves(group: list[Element], vector: list[int]) -> _Moves:
    """The images of a vector under all elements, all times one number that makes them whole."""
    images = [
        [sum((m * x for m, x in zip(row, vector, strict=True)), Fraction(0)) for row in element]
        for element in group
    ]
    scale = lcm(*(x.denominator for image in images for x in image))
    return [[(a, int(x * scale)) for a, x in enumerate(image) if x] for image in images]


def _product(one: Element, other: Element) -> Element:
    return tuple(
        tuple(sum((row[k] * other[k][j] for k in range(3)), Fraction(0)) for j in range(3))
        for row in one
    )


def _ratios(
    pairs: list[tuple[int, int]], one: tuple[Surd, ...], other: tuple[Surd, ...]
) -> list[Fraction]:
    """one[i] / other[j] for every pair, all rational."""
    known = {(i, j): (one[i] / other[j]).rational() for i, j in set(pairs)}
    return [known[pair] for pair in pairs]


def _scaled(vector: ExactVector, indices: IntArray, ratios: list[Fraction]) -> ExactVector:
    """The vector of ratios[k] * vector[indices[k]]."""
    common = lcm(*(ratio.denominator for ratio in set(ratios)), 1)
    scales = [int(ratio * common) for ratio in ratios]
    numerators = {
        r: [
            column[i] if s == 1 else column[i] * s
            for i, s in zip(indices.tolist(), scales, strict=True)
        ]
        for r, column in vector.numerators.items()
    }
    return ExactVector(numerators, vector.denominator * common)
