"""Initial gaps that keep a scene's numbers short: multiples of one step on the roots of its gauge.

The rational gauge of a scene (`mechanics.gauge`) has a square-free s for every direction of
contact, and gaps of the form q sqrt(s), q rational, leave one radicand one. So a drawn gap x
amplitude / UNIT (`draws`) is rounded to n sqrt(s) amplitude / UNIT with an integer n, which changes
it by less than sqrt(s) amplitude / UNIT.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import isqrt

import numpy as np

from ..mechanics.gauge import gauge_of
from ..numbers.exact import sqrt_of
from ..numbers.vectors import FloatArray, IntArray
from ..scenes.scene import Scene
from .draws import UNIT, Disorder, sample_words

_BITS = 30


@dataclass(frozen=True, eq=False)
class GapGrid:
    """The s of every contact, and floor(2^30 / sqrt(s))."""

    roots: IntArray
    inverses: IntArray


def gap_grid(scene: Scene) -> GapGrid:
    """The grid of a scene; `SolveError` where it has no rational gauge."""
    _, which = scene.normals
    classes = gauge_of(scene).classes
    inverses = [isqrt(2 ** (2 * _BITS) // s) for s in classes]
    return GapGrid(
        np.array(classes, dtype=np.int64)[which], np.array(inverses, dtype=np.int64)[which]
    )


def drawn_steps(scene: Scene, grid: GapGrid, disorder: Disorder, seed: int, k: int) -> IntArray:
    """The n of every contact in sample k: what is added to its gap, in sqrt(s) amplitude / UNIT."""
    x = disorder.draw(scene, sample_words(seed, k))  # less than 2^32
    steps: IntArray = (x * grid.inverses + 2 ** (_BITS - 1)) >> _BITS
    return steps


def step_floats(grid: GapGrid, steps: IntArray, amplitude: Fraction) -> FloatArray:
    """The gaps of these steps (w tau) in floats, within 4 u of themselves, u = 2^-53."""
    gaps: FloatArray = steps * (np.sqrt(grid.roots) * float(amplitude / UNIT))
    return gaps


def drawn(scene: Scene, disorder: Disorder, seed: int, k: int) -> Scene:
    """The scene with the random initial gaps of sample k added to its own, exactly.

    Sample k is the same on every machine, in any order, alone or among others.

    Parameters
    ----------
    scene : Scene
        The scene.
    disorder : Uniform, Normal or Radii
        The distribution of the gaps, or any with `amplitude` and `draw`.
    seed : int
        The seed of the ensemble, at least 0.
    k : int
        The number of the sample, at least 0.

    Returns
    -------
    Scene
        The variant, which has no origin.

    Raises
    ------
    InputError
        For a seed or number that is none.
    SolveError
        Where the scene has no rational gauge.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> from lcp_piles.disorder.draws import Uniform
    >>> from lcp_piles.disorder.gap_grid import drawn
    >>> solve(drawn(nt60(2), Uniform(10), seed=1, k=0)).status
    'solved'
    """
    grid = gap_grid(scene)
    steps = drawn_steps(scene, grid, disorder, seed, k)
    step = disorder.amplitude / UNIT
    contacts = tuple(
        replace(contact, gap=contact.gap + sqrt_of(s) * (step * n))
        for contact, s, n in zip(scene.contacts, grid.roots.tolist(), steps.tolist(), strict=True)
    )
    return replace(scene, contacts=contacts)
