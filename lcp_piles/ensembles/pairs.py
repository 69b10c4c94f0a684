"""Pairs of contacts by their distance, for the correlation of their forces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numbers.vectors import FloatArray, IntArray
from ..scenes.scene import Scene

REACH = 12
"""Steps of distance: to the nearest whole number of R, below this.

On a lattice many distances are whole numbers, which must not fall between two steps by rounding.
"""


@dataclass(frozen=True, eq=False)
class Pairs:
    """Pairs of contacts nearer than the last step: their numbers, and the step of their distance.

    `distances` is the mean distance (R) in each step, NaN where a step has none, `counts` how many
    pairs there are.
    """

    first: IntArray
    second: IntArray
    step: IntArray
    distances: FloatArray
    counts: IntArray

    def products(self, forces: FloatArray) -> FloatArray:
        """The sum of products of two forces over the pairs of every step; a row for each sample."""
        found = [
            np.bincount(self.step, row[self.first] * row[self.second], REACH) for row in forces
        ]
        return np.array(found, dtype=np.float64).reshape(len(forces), REACH)


def near_pairs(scene: Scene) -> Pairs:
    """The pairs of contacts of a scene, by the distance of their contact points."""
    from scipy.spatial import KDTree  # slow to import

    points = contact_points(scene)
    found = KDTree(points).query_pairs(REACH - 0.5, output_type="ndarray")
    found = found[np.lexsort((found[:, 1], found[:, 0]))]
    first, second = found[:, 0].astype(np.int64), found[:, 1].astype(np.int64)
    apart = np.linalg.norm(points[first] - points[second], axis=1)
    step = np.minimum(np.rint(apart).astype(np.int64), REACH - 1)
    counts = np.bincount(step, minlength=REACH)
    with np.errstate(invalid="ignore"):
        distances = np.bincount(step, apart, REACH) / counts
    return Pairs(first, second, step, distances, counts)


def contact_points(scene: Scene) -> FloatArray:
    """Where the contacts of a scene are (R), in floats: on the surface of their first disc."""
    centre = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    radius = np.array([float(disc.radius) for disc in scene.discs])
    normals, which = scene.normals
    normal = np.array([[float(x) for x in n] for n in normals]).reshape(-1, scene.dimension)
    a, _ = scene.ends
    points: FloatArray = centre[a] - radius[a, None] * normal[which]
    return points
