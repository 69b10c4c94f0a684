"""The loads and initial gaps of one part of a scene, in the units of its contact system."""

from __future__ import annotations

import numpy as np

from ..numbers.exact import ZERO, Exact, Surd
from ..numbers.vectors import ExactVector, IntArray, exact_vector
from ..scenes.scene import Scene
from ..scenes.symmetry import Reduction


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


def gauged_gaps(
    scene: Scene, parts: Reduction, scales: list[Surd], factor_of: IntArray
) -> ExactVector:
    """The initial gap of every contact of the part; `scales[factor_of]` are gap over g."""
    values: list[Exact] = [ZERO] * len(parts.representative)
    for k, gap in initial_gaps(scene).items():
        r = int(parts.contact[k])
        if r >= 0 and int(parts.representative[r]) == k:
            values[r] = gap * scales[int(factor_of[r])]
    return exact_vector(values)


def gauged_loads(scene: Scene, parts: Reduction, factor: tuple[Surd, ...]) -> ExactVector:
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
        count = np.asarray(parts.spread[freedoms].sum(axis=0), dtype=np.int64)
        scaled = value[key] * factor[axis]
        multiples = {int(n): scaled * int(n) for n in np.unique(count)}
        for j in np.flatnonzero(count).tolist():
            more = multiples[int(count[j])]
            totals[j] = totals[j] + more if totals[j] else more
    return exact_vector(totals)
