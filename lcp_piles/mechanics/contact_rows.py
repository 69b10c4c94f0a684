"""The rows n . (u_a - u_b) of the contacts of a part of a scene, as a product of matrices.

One has the normals of the contacts for diagonal blocks, in integers or in floating point, and the
next gives u_a - u_b, axis by axis. The last, `Reduction.spread`, is how all discs move. Where a
disc moves with one freedom of the part an axis, as in all parts but "symmetric", the product is
written down at once (`joined_rows`).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from ..linear.integer_matrix import IntegerMatrix
from ..linear.rearrangement import diagonal_of_rows, rows_of
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.scene import Scene
from ..scenes.symmetry import Reduction


def own_normals(scene: Scene, parts: Reduction, table: IntegerMatrix) -> IntegerMatrix:
    """The normals of a part's contacts for diagonal blocks, from a row for each of the scene's.

    The rows of `table` stand for the different normals of the scene.
    """
    _, which = scene.normals
    return diagonal_of_rows(rows_of(table, which[parts.representative]))


def joined_rows(scene: Scene, parts: Reduction, table: IntArray | FloatArray) -> csr_array | None:
    """The whole product, in the dtype of `table`, a row for each of the scene's normals.

    None for the part "symmetric", and where nothing moves. No sum may leave the dtype: a row has at
    most two entries of the table at a place.
    """
    if not (len(parts.freedom) and parts.size):
        return None
    dimension = scene.dimension
    direction = scene.normals[1][parts.representative]
    count = len(direction)
    ends = np.array([end[parts.representative] for end in scene.ends])
    # A support does not move: its entries are zero, wherever they stand.
    flat = ends[:, :, None] * dimension + np.arange(dimension)
    signs = np.where(ends[:, :, None] >= 0, parts.sign[flat], 0) * np.array([1, -1])[:, None, None]
    values = (table[direction] * signs).transpose(1, 0, 2).ravel()
    columns = parts.freedom[flat].transpose(1, 0, 2).ravel()
    rows = np.repeat(np.arange(count), 2 * dimension)
    found = csr_array((values, (rows, columns)), shape=(count, parts.size))
    found.sum_duplicates()
    found.eliminate_zeros()
    return found


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
