"""Readings of the stress in the pile that continuum models of sand piles speak about.

The paper compares its piles with two of them (Sec. Results; Wittmer, Cates and Claudin, J. Phys. I
France 7 (1997) 39):

* FPA, fixed principal axis: the major principal axis points the same way everywhere in one half of
  the pile, buried discs keep the direction that they had at the surface.
* IFE, incipient failure everywhere: the material is about to yield at every point, so that
  (s1 - s2)/(s1 + s2) = sin(phi) is the same everywhere, s1 >= s2 the principal pressures.

Both say that something is constant, so what is measured here is how far it is from constant.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..numbers.vectors import FloatArray
from ..scenes.names import end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .disc_contacts import disc_contacts
from .field import Cell, Column, DiscScalars, Field, Table
from .stress import Stress, stress

BoolArray = np.ndarray[Any, np.dtype[np.bool_]]


@dataclass(frozen=True, slots=True)
class Spread:
    """A mean and the deviation from it over `count` discs; NaN where there is no disc."""

    mean: float
    deviation: float
    count: int


@dataclass(frozen=True, eq=False)
class Continuum:
    """The stress of every disc as the continuum models read it, and how uniform it is.

    Arrays, one entry a disc of the `scene`: `x` and `depth` below the apex's centre (disc radii);
    `angle` of the major principal axis in degrees from the x axis, in (-90, 90], of discs left of
    x = 0 as their mirror image would show it (NaN for isotropic stress); `sin_phi` =
    (s1 - s2)/(s1 + s2), in [0, 1] where no contact pulls (NaN for no stress). `base`, `surface` and
    `inner` part the movable discs: `base` are those that a support or a held disc may touch, of the
    others `inner` have a neighbour at every upper site and `surface` have not.

    Summaries: `inner_axis` and `surface_axis` are the spread of the angle over the inner and the
    surface discs off the axis x = 0, in degrees; `yielding` is that of sin(phi) over the inner
    discs. Under FPA both axes have the same mean and no deviation; under IFE `yielding` has no
    deviation. The base is left out: its stress is that of the floor and the corner stones.
    """

    scene: Scene
    x: FloatArray
    depth: FloatArray
    angle: FloatArray
    sin_phi: FloatArray
    base: BoolArray
    surface: BoolArray
    inner: BoolArray
    inner_axis: Spread
    surface_axis: Spread
    yielding: Spread


def continuum(found: Stress) -> Continuum:
    """The continuum readings of the stress of a pile that stands around the axis x = 0.

    How far the pile is from a fixed principal axis (FPA) and from incipient failure everywhere
    (IFE), models in which the angle of the principal axis, or sin(phi), is constant.

    Parameters
    ----------
    found : Stress
        The stress of its discs (`stress`).

    Returns
    -------
    Continuum
        Angles (degrees) and sin(phi) of every disc, and their means and deviations.

    References
    ----------
    Oron and Herrmann (1997), Sec. Results. Wittmer, Cates and Claudin, J. Phys. I France 7 (1997)
    39.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> from lcp_piles.fields.stress import stress
    >>> readings = continuum(stress(solve(nt60(6, floor_compliance=0))))
    >>> readings.inner_axis.count, readings.surface_axis.count
    (4, 6)
    """
    scene = found.scene
    place = np.array([[float(p) for p in disc.position] for disc in scene.discs])
    x, depth = place[:, 0], place[:, 1].max() - place[:, 1]
    angle = np.where(x < 0, -found.angle, found.angle)
    angle = np.where(angle == -90, 90.0, angle)
    with np.errstate(invalid="ignore"):
        sin_phi = found.deviator / found.pressure
    movable = np.array([not disc.fixed for disc in scene.discs])
    touching, buried = supported_discs(scene), buried_discs(scene)
    base = movable & touching
    surface, inner = movable & ~touching & ~buried, movable & ~touching & buried
    return Continuum(
        scene,
        x,
        depth,
        angle,
        sin_phi,
        base,
        surface,
        inner,
        axis_spread(angle[inner & (x != 0)]),
        axis_spread(angle[surface & (x != 0)]),
        _spread(sin_phi[inner]),
    )


def supported_discs(scene: Scene) -> BoolArray:
    """Which discs have a contact with a support or with a disc held along some axis."""
    a, b = scene.ends
    held = np.array([disc.held != (None, None) for disc in scene.discs])
    carried = held.copy()
    carried[a[(b < 0) | held[b]]] = True
    carried[b[(b >= 0) & held[a]]] = True
    return carried


def buried_discs(scene: Scene) -> BoolArray:
    """Which discs have a neighbour at every upper site of the lattice, shape (discs,).

    The upper sites are all directions with a positive y that any disc-disc contact of the scene
    has. On a tilted pile the flank discs (i, 1) and (i, i) miss some, on NT30 the outer two discs
    of each row.
    """
    normals, which = scene.normals
    between_discs = {normals[k] for k in which[scene.ends[1] >= 0].tolist()}
    sites = {n if n[1] > 0 else tuple(-x for x in n) for n in between_discs if n[1]}
    return np.array(
        [sites <= {c.direction for c in disc_contacts(scene, disc.id)} for disc in scene.discs]
    )


def axis_spread(angles: FloatArray) -> Spread:
    """Mean direction and deviation of axes (angles in degrees, of period 180), NaN left out.

    The mean is half the argument of the mean of exp(2i angle), and the deviation the root mean
    square of sin(angle - mean) radians, in degrees: zero for parallel axes, the standard deviation
    for nearly parallel ones, and at most sqrt(1/2) radians, 40.5 degrees, for axes without a common
    direction (the angular deviation of axial data; Batschelet, Circular Statistics in Biology).

    >>> round(axis_spread(np.array([80.0, -60.0])).mean, 6)
    -80.0
    """
    known = angles[~np.isnan(angles)]
    if not known.size:
        return Spread(np.nan, np.nan, 0)
    axes = np.radians(known)
    mean = np.angle(np.exp(2j * axes).mean()) / 2
    deviation = np.sqrt((np.sin(axes - mean) ** 2).mean())
    return Spread(float(np.degrees(mean)), float(np.degrees(deviation)), known.size)


def _spread(values: FloatArray) -> Spread:
    known = values[~np.isnan(values)]
    if not known.size:
        return Spread(np.nan, np.nan, 0)
    return Spread(float(known.mean()), float(known.std()), known.size)


def _of_solution(solution: Solution) -> Continuum:
    return continuum(stress(solution))


def _table(found: Continuum) -> Table:
    facts: list[tuple[str, Cell]] = []
    for what, spread in (
        ("angle of the inner discs, degrees", found.inner_axis),
        ("angle of the surface discs, degrees", found.surface_axis),
        ("sin(phi) of the inner discs", found.yielding),
    ):
        if spread.count:
            text = f"{spread.mean:.6g} +- {spread.deviation:.2g} over {spread.count} discs"
            facts.append((what, text))
    parts = {"base": found.base, "surface": found.surface, "inner": found.inner}
    columns = ("disc", "part", "x", "depth", "angle_degrees", "sin_phi")
    rows: list[list[Cell]] = []
    for k, disc in enumerate(found.scene.discs):
        for part, members in parts.items():
            if members[k]:
                numbers = (found.x[k], found.depth[k], found.angle[k], found.sin_phi[k])
                rows.append([end_name(disc.id), part, *map(float, numbers)])
    return Table(tuple(map(Column, columns)), rows, facts)


def _shape(found: Continuum) -> DiscScalars:
    within = found.base | found.surface | found.inner
    label = r"$\sin\phi = (s_1 - s_2)/(s_1 + s_2)$"
    return DiscScalars(found.scene, np.where(within, found.sin_phi, np.nan), label)


FIELD = Field(
    "continuum",
    "what continuum models speak of: the major principal axis, and sin(phi)",
    _of_solution,
    _table,
    _shape,
)
