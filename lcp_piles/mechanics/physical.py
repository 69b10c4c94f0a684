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
from .contact_rows import differences, joined_rows, own_normals


def unit_rows(scene: Scene, parts: Reduction, scales: FloatArray) -> csr_array:
    """The B of a part of a scene, every entry rounded once where it is not a sum.

    `scales` are the u/U of the axes. (A freedom that moves discs along several has entries that
    are rounded a few times.)
    """
    normals, _ = scene.normals
    table = np.array([[float(x) for x in normal] for normal in normals], dtype=np.float64)
    table = table.reshape(-1, scene.dimension)
    joined = joined_rows(scene, parts, table)
    if joined is not None:
        return joined
    rows = own_normals(scene, parts, csr_array(table))
    spread = parts.spread.tocoo()
    ratio = scales[spread.row % scene.dimension] / scales[parts.axis[spread.col]]
    moves = csr_array((spread.data * ratio, (spread.row, spread.col)), shape=spread.shape)
    return csr_array(rows @ (differences(scene, parts) @ moves))


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
