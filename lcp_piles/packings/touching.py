"""Which discs touch: all pairs whose centres are within so much of the sum of their radii.

Discs are put in classes of radii within a factor of two, and each pair of classes is searched with
its own reach, so that a few large discs among many small ones do not make everything near.
"""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
from scipy.spatial import cKDTree

from ..errors import InputError
from ..numbers.floats import FloatArray
from ..numbers.vectors import IntArray

_CROWD = 400
"""Neighbours a disc, on the average, beyond which centres and radii cannot belong together."""


def touching_pairs(
    centres: FloatArray, radii: FloatArray, factor: float, period: float | None
) -> tuple[IntArray, IntArray, IntArray]:
    """(i, j, image) of discs i < j no farther apart than `factor` times the sum of their radii.

    In a packing of period L along x, disc i meets the image of j that is `image` periods to the
    right of j. Sorted by i, then j. Rounding decides for a pair just at the limit.

    >>> i, j, _ = touching_pairs(np.array([[0.0, 0], [2, 0], [4.5, 0]]), np.ones(3), 1.01, None)
    >>> i.tolist(), j.tolist()
    ([0], [1])
    """
    inside, box = centres, None
    if period is not None:
        inside = centres.copy()
        inside[:, 0] %= period
        inside[inside[:, 0] >= period, 0] = 0.0  # a tiny negative number, rounded
        box = [period] + [0.0] * (centres.shape[1] - 1)
    size = np.frexp(radii)[1]
    classes = [np.flatnonzero(size == s) for s in np.unique(size)]
    trees = [cKDTree(inside[members], boxsize=box) for members in classes]
    pairs = [np.empty((0, 2), dtype=np.int64)]
    room = _CROWD * len(radii)
    for one, other in combinations_with_replacement(range(len(classes)), 2):
        reach = factor * (radii[classes[one]].max() + radii[classes[other]].max())
        room -= int(trees[one].count_neighbors(trees[other], reach))
        if room < 0:
            raise InputError(
                "the number of neighbours of a disc",
                f"above {_CROWD}",
                "about six",
                "look at the units of centres, radii and tolerance",
            )
        near = trees[one].sparse_distance_matrix(trees[other], reach, output_type="ndarray")
        found = np.stack([classes[one][near["i"]], classes[other][near["j"]]], axis=1)
        pairs.append(found[found[:, 0] < found[:, 1]] if one == other else np.sort(found, axis=1))
    i, j = np.concatenate(pairs).T
    order = np.lexsort((j, i))
    i, j = i[order], j[order]
    image = np.zeros(len(i), dtype=np.int64)
    line = centres[i] - centres[j]
    if period is not None:
        image = np.rint(line[:, 0] / period).astype(np.int64)
        line[:, 0] -= image * period
    touch = np.sqrt((line * line).sum(axis=1)) <= factor * (radii[i] + radii[j])
    return i[touch], j[touch], image[touch]
