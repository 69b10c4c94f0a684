"""What statistics see of a sample: numbers whose means over the samples say all that is asked.

Each is a column under a name; sums of columns over samples, plain or weighted, are all that is
kept, so memory does not grow with the samples and every error bar comes the same way (`tally`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..fields.base_pressure import base_map, base_row
from ..fields.stress import stress_map
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.scene import Scene
from .force_distribution import force_columns
from .pairs import Pairs, near_pairs

Columns = Mapping[str, FloatArray]
"""Under every name an array (samples, numbers)."""
_PLANE = 2


@dataclass(frozen=True)
class Observed:
    """Samples as they are read: forces (samples, contacts) in w, and what else was found."""

    forces: FloatArray
    mechanisms: IntArray
    verdicts: Sequence[str]
    roads: Sequence[str]


@dataclass(frozen=True, eq=False)
class Observables:
    """The maps of a scene, from forces to what statistics are made of.

    `base` is the x of the discs of the base row (R), `base_normal` gives their normal forces (w),
    `stress` pi sigma of all discs (w/R). In a scene that is not plane there are none of these.
    """

    scene: Scene
    freedoms: int
    base: FloatArray
    base_normal: csr_array
    stress: csr_array
    pairs: Pairs


def observables(scene: Scene) -> Observables:
    """What is observed of the samples of a scene."""
    none = csr_array((0, len(scene.contacts)))
    base, normal, stress = np.empty(0), none, none
    if scene.dimension == _PLANE:
        base = np.array([float(scene.disc(id).position[0]) for id in base_row(scene)])
        normal, stress = base_map(scene), stress_map(scene)
    freedoms = sum(held is None for disc in scene.discs for held in disc.held)
    return Observables(scene, freedoms, base, normal, stress, near_pairs(scene))


def columns(of: Observables, seen: Observed) -> Columns:
    """The columns of some samples."""
    f = seen.forces
    loaded = f != 0
    count = loaded.sum(axis=1)
    normal = f @ of.base_normal.T
    tensors = f @ of.stress.T
    depths = central_dip(of.base, normal)
    scalars = {
        "closed": count,
        "mechanisms": seen.mechanisms,
        "saddle": [verdict == "saddle" for verdict in seen.verdicts],
        "stable": [verdict == "stable" for verdict in seen.verdicts],
        "dip": depths > 0,
        "dip depth": depths,
        "exact": [road == "exact" for road in seen.roads],
    }
    return {
        **{name: np.array(x, dtype=np.float64)[:, None] for name, x in scalars.items()},
        "normal": normal,
        "normal squared": normal**2,
        "loaded": loaded.astype(np.float64),
        "force": f,
        "force squared": f**2,
        "pairs": of.pairs.products(f),
        "stress": tensors,
        "stress squared": tensors**2,
        **force_columns(f),
    }


def central_dip(x: FloatArray, normal: FloatArray) -> FloatArray:
    """How far the middle of pressure profiles lies below what is highest on both sides (w).

    The middle is the mean over the disc on the axis x = 0, or the two next to it, and the depth
    what it lacks of the lower of the two highest forces to the left and to the right; it is
    negative where there is no dip. In a profile that is smooth and symmetric this is the depth of
    its `dip`; in one of a disordered pile, where neighbours differ by chance, it does not ask that
    the two discs next to the axis have equal forces. NaN where the base has no disc on each side.
    """
    nothing = np.full(len(normal), np.nan)
    if not len(x):
        return nothing
    least = np.abs(x).min()
    middle = np.abs(x) == least
    left, right = ~middle & (x < 0), ~middle & (x > 0)
    if not (left.any() and right.any()):
        return nothing
    rims = np.minimum(normal[:, left].max(axis=1), normal[:, right].max(axis=1))
    depth: FloatArray = rims - normal[:, middle].mean(axis=1)
    return depth
