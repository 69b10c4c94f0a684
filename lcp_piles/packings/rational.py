"""A rational scene near a packing: normals turned a little, to where all components are rational.

Seen from the far end of the last axis, the unit vector (v, z), z >= 0, is the point w = v / (1 + z)
of a plane (stereographic projection), and for rational w

    n = (2 w, 1 - |w|^2) / (1 + |w|^2)

is a rational unit vector: in the plane, a Pythagorean triple. Lengths on the sphere are at most
twice those of w, so w within half an angle moves n by no more than that angle. Each component of w
becomes the fraction of least denominator near it, found by continued fractions.
"""

from __future__ import annotations

from fractions import Fraction

from ..errors import InputError
from ..numbers.double_double import DoubleDouble
from ..numbers.exact import ZERO, floats_exactly, surd
from ..numbers.simplest import simplest_between
from ..scenes.scene import Contact, Disc, Scene
from .check import number
from .packing import Packing

_LEAST, _MOST = 1e-24, 1e-3
"""Angles: normals are known to 2^-100, and a scene allows its normals a hundredth."""


def rational_scene(packing: Packing, angle: float = 1e-9) -> Scene:
    """The scene whose normals are rational and near those of a packing.

    Positions, radii, loads and stiffnesses are the floats, exactly; gaps are the floats nearest to
    them. Units are those of the packing: compliances are lengths a force.

    Parameters
    ----------
    packing : Packing
        The packing.
    angle : float, default 1e-9
        The most that a normal is turned (radians). The smaller it is, the longer the numbers of the
        solution.

    Returns
    -------
    Scene
        The scene, for every exact method.

    Raises
    ------
    InputError
        For an angle out of range.

    Examples
    --------
    >>> from lcp_piles import packing
    >>> scene = rational_scene(packing([(0, 1.0), (1, 2.73)], 1, held=[True, False]), 0.001)
    >>> [str(x) for x in scene.contacts[0].normal]
    ['-451/901', '-780/901']
    """
    angle = number(angle, "the angle")
    if not _LEAST <= angle <= _MOST:
        raise InputError("the angle", angle, f"a number of radians from {_LEAST} to {_MOST}")
    geometry, dimension = packing.geometry, packing.dimension
    if geometry is None:
        count = len(packing.ids)
        centres, radii = [[ZERO] * dimension] * count, [Fraction(1)] * count
    else:
        centres, radii = floats_exactly(geometry.centres), floats_exactly(geometry.radii)
    loads, gaps, stiffness = map(
        floats_exactly, (packing.loads, packing.gaps.high, packing.stiffness)
    )
    discs = []
    for k, id in enumerate(packing.ids):
        held = tuple(ZERO if h else None for h in packing.held[k].tolist())
        discs.append(Disc(id, tuple(centres[k]), tuple(loads[k]), held, radii[k]))
    contacts = []
    for k, gap in enumerate(gaps):
        normal = tuple(map(surd, unit_vector(packing.normals[k], angle)))
        contacts.append(Contact(*packing.contact_ends(k), normal, 1 / stiffness[k], gap))
    real = geometry is not None and geometry.period is None
    return Scene(tuple(discs), tuple(contacts), packing.supports, real)


def unit_vector(normal: DoubleDouble, angle: float) -> tuple[Fraction, ...]:
    """A rational unit vector within an angle of one in double-double, of two or three components.

    >>> unit_vector(DoubleDouble.of([0.6, 0.8]), 1e-6)
    (Fraction(3, 5), Fraction(4, 5))
    """
    words = zip(normal.high.tolist(), normal.low.tolist(), strict=True)
    components = [Fraction(high) + Fraction(low) for high, low in words]
    # What is exactly zero stays so: it makes the discs slide along that axis without resistance.
    *side, last = (x for x in components if x)
    sign = -1 if last < 0 else 1
    # A component of w may be off by its share of half the angle, a little less for rounding.
    room = Fraction(angle) / (3 if len(side) == 2 else 2) * Fraction(2**20 - 1, 2**20)
    w = [simplest_between(x - room, x + room) for x in (v / (1 + sign * last) for v in side)]
    square = sum((x * x for x in w), Fraction(0))
    along = [*(2 * x / (1 + square) for x in w), sign * (1 - square) / (1 + square)]
    return tuple(along.pop(0) if x else x for x in components)
