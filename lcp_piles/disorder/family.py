"""What all samples of a disordered scene share, found once: one geometry, many initial gaps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from ..linear.kernel import SHOWN
from ..linear.springs import scaled_rows
from ..linear.stiffness import stiffness
from ..linear.threads import one_thread
from ..mechanics.contact_rows import differences
from ..mechanics.system import ContactSystem, contact_system
from ..methods.newton import Energy, energy_of, minimum
from ..numbers.floats import LOST, UP
from ..numbers.vectors import FloatArray, IntArray, Mask
from ..scenes.scene import Contact, Scene
from .gap_grid import GapGrid, gap_grid

_LARGEST = 2**62


@dataclass(frozen=True, eq=False)
class Integers:
    """A whole scene in its gauge, in words: B (contacts, freedoms) and the loads.

    `row` is the largest sum of sizes in a row of B. `loads` has a row for each radicand. `freedom`
    is the displacement (w tau) of one unit at every freedom and `gap` the gap of one unit at every
    contact, `step` the units that sqrt(s) is (`gap_grid`). `sliding` gives u_a - u_b of every
    contact, axis by axis, and `between` marks the contacts between discs.
    """

    B: csr_array
    row: int
    loads: IntArray
    freedom: FloatArray
    gap: FloatArray
    step: IntArray
    sliding: csr_array
    between: Mask


@dataclass(frozen=True, eq=False)
class Springs:
    """The elastic contacts of a whole scene in floats, with what the proof of a sample needs.

    Freedoms are scaled by `D`, powers of two that make the diagonal of D K D about one, K being
    the matrix of all springs: B (contacts, freedoms) and p (w) are scaled so, `reach` is |B|
    transposed and `row_norm` the norms of its rows. `entries` times stiffnesses is the band of
    D K D of any closed set, flat, freedoms in `order`; its eigenvalues are off by `rounding` at
    the most. `gap` are the initial gaps of the scene itself. `energy` is that of Newton's method,
    with freedoms as they are, and `start` the displacements without disorder.
    """

    integers: Integers
    D: FloatArray
    B: csr_array
    transposed: csr_array
    reach: csr_array
    row_norm: FloatArray
    column_terms: int
    C: FloatArray
    p: FloatArray
    gap: FloatArray
    bilateral: Mask
    order: IntArray
    entries: csc_array
    rounding: float
    energy: Energy
    start: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class PileFamily:
    """A scene, and what the proofs of all samples of its gaps have in common.

    Attributes
    ----------
    scene : Scene
        The scene.
    grid : GapGrid
        What its random gaps are multiples of.
    freedoms : int
        Those of the whole scene.
    springs : Springs or None
        None where floating point is of no use (rigid or negative compliances, numbers beyond the
        range of floats); samples take the exact road then.

    Examples
    --------
    >>> from lcp_piles import nt60, pile_family
    >>> pile_family(nt60(4)).freedoms
    16
    """

    scene: Scene
    grid: GapGrid
    freedoms: int
    springs: Springs | None

    def __repr__(self) -> str:
        return f"<PileFamily of {self.scene}, {self.freedoms} freedoms>"

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """The contacts of the scene, in the order of all arrays."""
        return self.scene.contacts


@one_thread()
def pile_family(scene: Scene) -> PileFamily:
    """What the samples of a scene share: build it once, then ask for many `proved_sample`.

    Parameters
    ----------
    scene : Scene
        The scene whose gaps will be random.

    Returns
    -------
    PileFamily
        What is shared.

    Raises
    ------
    SolveError
        Where the scene has no rational gauge.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> pile_family(nt60(4))
    <PileFamily of <Scene NT60, layers 4: 10 discs, 20 contacts>, 16 freedoms>
    """
    system = contact_system(scene, "whole")
    return PileFamily(scene, gap_grid(scene), system.dof, _springs(system))


def _springs(system: ContactSystem) -> Springs | None:
    """The springs of all contacts; None where a freedom has none, or what is too much for words."""
    B, C, o, p = system.floats()
    if not (system.in_range() and (C > LOST).all() and system.dof):
        return None
    integers, scaling = _integers(system), scaled_rows(B, C)
    if integers is None or scaling is None:
        return None
    D, _, rounding = scaling
    scaled = csr_array(B @ diags_array(D))
    matrix = stiffness(scaled)
    if matrix.entries is None:
        return None
    terms = int(np.bincount(scaled.indices).max(initial=0))
    energy = energy_of(B, 1 / C, p, system.bilateral, float((1 / C).max()))
    ordered = minimum(energy, o, np.zeros(system.dof))
    return Springs(
        integers,
        D,
        scaled,
        csr_array(scaled.T),
        csr_array(abs(scaled).T),
        np.sqrt(abs(scaled).power(2).sum(axis=1)) * UP + LOST,
        terms,
        C,
        p * D,
        o,
        system.bilateral,
        matrix.order,
        matrix.entries,
        rounding,
        energy,
        ordered.U if ordered.converged else np.zeros(system.dof),
    )


def _integers(system: ContactSystem) -> Integers | None:
    """The integers of the scene, None where products with them would not fit a word."""
    loads = list(system.load.numerators.values())
    largest = max((abs(int(x)) for row in loads for x in row), default=0)
    B, rows = system.B, system.gauge.rows
    if not isinstance(B, csr_array) or largest * system.dof * SHOWN > _LARGEST:
        return None
    row = int(abs(B).sum(axis=1).max())
    if row * SHOWN > _LARGEST or max(m for _, m in rows) > SHOWN:
        return None
    parts = system.reduction
    _, which = system.scene.normals
    return Integers(
        B,
        row,
        np.array([[int(x) for x in row] for row in loads], np.int64).reshape(-1, system.dof),
        system.freedom_scale,
        np.array([float(f) for f in system.gap_factor])[system.factor_of],
        np.array([m for _, m in rows], dtype=np.int64)[which[parts.representative]],
        csr_array(differences(system.scene, parts) @ parts.spread),
        system.scene.ends[1] >= 0,
    )
