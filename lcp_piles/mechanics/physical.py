"""A part of a scene in floating point and in physical units: forces in w, lengths in w tau.

    g_k = (B u)_k + o_k + C_k x_k,      B^T x + p = 0,

with u the displacements of the part's freedoms, the rows of B unit normals (twice their part across
the axis for a contact that is its own mirror image), and x_k the force times the number v_k of
contacts that contact k stands for, so that C_k = c_k / v_k. The rows are of one size whatever
numbers stand in the normals, unlike those of the integer matrix, which are scaled to be whole.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from ..numbers.exact import Surd, surd
from ..numbers.vectors import ExactVector, FloatArray, IntArray
from ..scenes.scene import Scene
from ..scenes.symmetry import Reduction
from .gauge import contact_rows


def unit_rows(scene: Scene, parts: Reduction) -> csr_array:
    """The B of a part of a scene, every entry rounded once where it is not a sum."""
    normals, _ = scene.normals
    table = np.array([[float(x) for x in normal] for normal in normals], dtype=np.float64)
    rows = contact_rows(scene, table.reshape(-1, scene.dimension))
    return csr_array(rows[parts.representative] @ spread_matrix(parts))


def spread_matrix(parts: Reduction) -> csr_array:
    """How the freedoms of the whole move with those of a part: entries 1 and -1."""
    keep = np.flatnonzero(parts.sign)
    places = (keep, parts.freedom[keep])
    return csr_array((parts.sign[keep], places), shape=(len(parts.sign), parts.size))


def axis_of_freedom(parts: Reduction, dimension: int) -> IntArray:
    """The axis along which each freedom of a part moves its discs."""
    keep = np.flatnonzero(parts.sign)
    axis = np.zeros(parts.size, dtype=np.int64)
    axis[parts.freedom[keep]] = keep % dimension
    return axis


def float_compliances(scene: Scene, parts: Reduction) -> FloatArray:
    """The C = c / v of a part's contacts, infinite beyond the range of floats."""
    value: dict[int, float] = {}  # few different ones on many contacts
    found = np.empty(len(parts.representative))
    for k, whole in enumerate(parts.representative.tolist()):
        c = scene.contacts[whole].compliance
        if id(c) not in value:
            value[id(c)] = float(surd(c))
        found[k] = value[id(c)]
    return found / parts.weight


def in_units(vector: ExactVector, factors: tuple[Surd, ...], factor_of: IntArray) -> FloatArray:
    """The entries of a vector times their factors, in floats."""
    return ExactVector(vector.numerators, vector.denominator, factors, factor_of).array()
