"""The rows n . (u_a - u_b) of the contacts of a part of a scene, as a product of matrices.

One has the normals of the contacts for diagonal blocks, in integers or in floating point, and the
next gives u_a - u_b, axis by axis. The last, `Reduction.spread`, is how all discs move.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from ..linear.integer_matrix import IntegerMatrix
from ..linear.rearrangement import diagonal_of_rows, rows_of
from ..scenes.scene import Scene
from ..scenes.symmetry import Reduction


def own_normals(scene: Scene, parts: Reduction, table: IntegerMatrix) -> IntegerMatrix:
    """The normals of a part's contacts for diagonal blocks, from a row for each of the scene's.

    The rows of `table` stand for the different normals of the scene.
    """
    _, which = scene.normals
    return diagonal_of_rows(rows_of(table, which[parts.representative]))


def differences(scene: Scene, parts: Reduction) -> csr_array:
    """u_a - u_b of a part's contacts from the motions of all discs, entries 1 and -1.

    A row for each contact and axis, a column for each disc and axis of the whole scene.
    """
    dimension = scene.dimension
    axes = np.arange(dimension)
    rows, columns, signs = [], [], []
    for ends, side in zip(scene.ends, (1, -1), strict=True):
        disc = ends[parts.representative]
        row, axis = (x.ravel() for x in np.meshgrid(np.flatnonzero(disc >= 0), axes, indexing="ij"))
        rows.append(row * dimension + axis)
        columns.append(disc[row] * dimension + axis)
        signs.append(np.full(len(row), side, dtype=np.int64))
    shape = (len(parts.representative) * dimension, len(scene.discs) * dimension)
    places = (np.concatenate(rows), np.concatenate(columns))
    return csr_array((np.concatenate(signs), places), shape=shape)
