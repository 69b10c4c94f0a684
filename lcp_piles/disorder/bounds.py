"""Rigorous bounds of forces and gaps of a closed set, without a digit more than floats have.

Displacements U near the true ones are integers of a fixed point in the gauge of the scene, the
drawn gaps too, so that B U + o comes out exactly however much of it cancels; only what the scene
itself has of initial gaps is added in floats. Rounded once or twice, these are the gaps g(U) of
the open contacts and the forces f(U) = -g(U) / C of the closed ones, and they leave r = B^T f + p
unbalanced. With K the springs of the closed set on the freedoms that are not pinned, mu > 0 below
its least eigenvalue, and all scaled by D, the true gaps are off by B_k K^-1 r. For a closed contact
K >= B_k^T B_k / C_k, so B_k K^-1 B_k^T <= C_k, and with the inequality of Cauchy and Schwarz

    |f - f(U)|_k <= |r| / sqrt(mu C_k),        |g - g(U)|_k <= |B_k| |r| / mu

for closed and open contacts. Rounding: floats of the exact B, C, o, p and factors are within 2 u of
them, u = 2^-53; a sum of m products in floating point is within m u (1 + 2^-20) of the sum of their
sizes; `_SPARE` units more cover the single operations. `UP` covers the rounding of the bounds
themselves, `LOST` what underflows.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import frexp

import numpy as np

from ..numbers.floats import LOST, UNIT, UP, Bounded
from ..numbers.vectors import FloatArray, IntArray, Mask
from .draws import UNIT as STEPS
from .family import Integers, Springs
from .pinned import PinnedSprings

_SPARE = 16
_ROUNDS = 6
_BITS = 60  # sums stay below 2^60, and below 2^61 whatever is added in later rounds


@dataclass(frozen=True, eq=False)
class FixedPoints:
    """Displacements U and drawn gaps o as integers: units of the gauge times `unit` (w tau)."""

    U: IntArray
    o: IntArray
    unit: float


def fixed_points(
    integers: Integers, steps: IntArray, amplitude: Fraction, U: FloatArray
) -> FixedPoints | None:
    """The drawn gaps exactly, and displacements U (w tau) rounded; None where they do not fit."""
    step = float(amplitude / STEPS) or 1.0
    moved = U / (integers.freedom * step)
    o = steps * integers.step
    largest = integers.row * float(np.abs(moved).max(initial=0.0)) + float(np.abs(o).max(initial=0))
    if not largest < 2.0**_BITS:
        return None
    shift = _BITS - frexp(max(largest, 1.0))[1]
    return FixedPoints(
        np.rint(np.ldexp(moved, shift)).astype(np.int64), o << shift, np.ldexp(step, -shift)
    )


@dataclass(frozen=True, eq=False)
class HeldState:
    """Forces of the closed contacts and gaps of the open ones, within bounds; others are 0."""

    forces: Bounded
    gaps: Bounded


def held_state(
    springs: Springs, pinned: PinnedSprings, closed: Mask, points: FixedPoints
) -> HeldState:
    """The state of a closed set near given displacements; pinned freedoms stay where these are."""
    integers, C, U = springs.integers, springs.C, points.U
    factor = integers.gap * points.unit
    back = springs.D / (integers.freedom * points.unit)
    rest, best = np.inf, None
    for _ in range(_ROUNDS):
        drawn = (integers.B @ U + points.o) * factor
        gaps = drawn + springs.gap
        slack = _SPARE * UNIT * (np.abs(drawn) + np.abs(springs.gap)) + LOST
        forces = np.where(closed, -gaps / C, 0.0)
        loose = np.where(closed, slack / C + _SPARE * UNIT * np.abs(forces), 0.0) * UP + LOST
        left = springs.transposed @ forces + springs.p
        terms = (springs.column_terms + _SPARE) * UNIT
        lost = springs.reach @ (loose + terms * np.abs(forces))
        lost += terms * np.abs(springs.p)
        left[pinned.pins] = 0.0
        lost[pinned.pins] = 0.0
        norm = float(np.linalg.norm(np.abs(left) + lost)) * UP + LOST
        if not norm < rest:
            break
        enough = norm > rest / 2
        rest, best = norm, (gaps, slack, forces, loose)
        more = np.rint(pinned.factors.solve(left) * back)
        if enough or not np.abs(more).max(initial=0.0) * integers.row < 2.0**_BITS / _ROUNDS:
            break
        U = U + more.astype(np.int64)
    if best is None:  # what is no number is no bound
        nothing = np.zeros(len(C))
        return HeldState(Bounded(nothing, nothing + np.inf), Bounded(nothing, nothing + np.inf))
    gaps, slack, forces, loose = best
    away = rest / np.sqrt(pinned.least * C)
    apart = springs.row_norm * (rest / pinned.least)
    return HeldState(
        Bounded(forces, np.where(closed, (loose + away) * UP, 0.0)),
        Bounded(np.where(closed, 0.0, gaps), np.where(closed, 0.0, (slack + apart) * UP)),
    )
