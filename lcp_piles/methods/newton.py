"""The globally convergent method: semismooth Newton on the energy of the pile, in floating point.

The displacements of a contact system (module `system`) with C > 0 minimise the convex function

    E(U) = sum_k max(0, s_k)^2 / (2 C_k) - p . U,      s = -(B U + o),

because its gradient is -(B^T lambda + p) with lambda_k = max(0, s_k) / C_k. Newton's method takes
the generalised Hessian B^T D B, D_k = 1/C_k on the contacts with s_k >= 0. With full steps it would
be the Z algorithm of the paper; what makes it converge from everywhere is the exact line search:
E along a line is piecewise quadratic, and its minimum is found by sorting the points where contacts
open and close. (Qi and Sun 1993, "A nonsmooth version of Newton's method".)

What makes it fast is a smoothed Hessian: with (x + sqrt(x^2 + width^2)) / 2 for max(0, x), x being
the force of a contact, one that is open but near counts by a share of its stiffness, as one that
will probably close (Chen and Harker 1993, "A non-interior-point continuation method for linear
complementarity problems"). The width falls with the residual to the power 3/2, so that the last
steps are those of Newton's method, and the energy and its gradient stay what they are. Without it
piles with mechanisms, TSS and large NT30, take three times the steps, and a mechanism ends against
the contacts that stop it; with it, it ends between them, so that their gaps are seen to be open.

Closed contacts that leave mechanisms make the Hessian singular all the same at the end: a tiny
stiffness on every freedom holds them.

Rigid contacts (C = 0) take the method of multipliers around it: lambda = max(0, lambda - r gap)
with a large r, which is an elastic contact of compliance 1/r that starts at the gap o - lambda / r.
Bilateral contacts have no max. Where a compliance is negative, the energy is no longer convex, a
line search means nothing, full steps are taken, and convergence is reported but not promised.

Nothing is shared with the pivoting method but the contact system, so each checks the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from ..linear.banded import Solve
from ..linear.stiffness import Stiffness, factor, filled_stiffness, stiffness
from ..linear.threads import one_thread
from ..mechanics.system import ContactSystem
from ..numbers.vectors import FloatArray, Mask
from .float_state import FloatState
from .method import Method, Outcome, Progress, float_outcome

_MAX_ITERATIONS = 500
_MAX_MULTIPLIER_STEPS = 20
_TOLERANCE = 1e-12
"""Unbalanced force, relative to the largest force or load, that counts as none."""
_COARSEST = 1e-9
"""The most that is taken as none where displacements are so large that rounding alone makes it."""
_RUNAWAY = 1e-6
"""Rounding of the overlaps, relative as above, at which the pile has plainly collapsed."""
_SOFT = 1e-11
"""Stiffness that holds every freedom, relative to the stiffest elastic contact."""
_RIGID = 1e4
"""The multiplier method's r, relative to the stiffest elastic contact."""
_SMOOTH = 1.0
"""The first width of the smoothed Hessian, relative to the largest force.

0.1 to 2 do as well, but for large initial gaps, where 1 to 2 take the fewest steps.
"""
_FLAT = 1e-13
"""Slope of the energy along a line, relative to the first one, that is rounding."""
_TINY = float(np.finfo(np.float64).tiny)
"""The least width: a residual that underflows leaves one still."""
_EPSILON = 8 * float(np.finfo(np.float64).eps)


def newton(system: ContactSystem) -> FloatState:
    """Forces and displacements of a contact system by semismooth Newton with exact line search.

    Deterministic, starts from the undisplaced pile. Steps are linear systems solved, the residual
    is the largest unbalanced force over the largest force or load. It has converged where that is
    below 1e-12, or below the rounding of the overlaps where displacements are so large that this
    is more (never above 1e-9): not for a scene that is unstable, which raises nothing, and perhaps
    not for one whose energy is not convex.

    >>> from lcp_piles import contact_system, nt60
    >>> result = newton(contact_system(nt60(4)))
    >>> result.converged, bool(result.residual < 1e-12)
    (True, True)
    """
    if not system.in_range():
        nothing, size = np.zeros(system.contacts), len(system.floats()[3])
        return FloatState(np.zeros(size), nothing, nothing, nothing > 0, 0, np.inf, False)
    return newton_on(*system.floats(), system.bilateral)


@np.errstate(over="ignore", invalid="ignore")
@one_thread()
def newton_on(
    B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray, bilateral: Mask
) -> FloatState:
    """As `newton`, for the floats of any problem with gaps B U + o + C f and balance B^T f + p."""
    rigid = C == 0
    stiffest = float(np.max(np.abs(1 / C[~rigid]), initial=0.0)) or 1.0
    E = np.where(rigid, _RIGID * stiffest, 1 / np.where(rigid, 1.0, C))
    energy = energy_of(B, E, p, bilateral, stiffest)
    multipliers = np.zeros(len(o))
    U = np.zeros(len(p))
    iterations = 0
    converged = False
    for _ in range(_MAX_MULTIPLIER_STEPS if rigid.any() else 1):
        inner = minimum(energy, o - multipliers / E, U)
        iterations += inner.steps
        if not inner.converged:
            break
        U = inner.U
        change = np.abs(inner.forces - multipliers)[rigid].max(initial=0.0)
        multipliers = np.where(rigid, inner.forces, 0.0)
        largest = np.abs(inner.forces).max(initial=0.0)
        if change <= _allowed(energy.rounding(U), largest):
            converged = True
            break
    gaps = np.where(inner.closed, 0.0, B @ inner.U + o)
    return FloatState(
        inner.U, inner.forces, gaps, inner.closed, iterations, inner.residual, converged
    )


def run_newton(system: ContactSystem, progress: Progress | None = None) -> Outcome:
    """`newton` as a method of `solve`.

    >>> from lcp_piles import nt60, solve
    >>> pile = solve(nt60(2), method="newton")
    >>> pile.status, round(pile.force((1, 1), (2, 2)), 12)
    ('solved', 0.57735026919)
    """
    return float_outcome(newton(system))


NEWTON = Method("newton", "semismooth Newton with exact line search", "float64", run_newton, 1e-9)


@dataclass(frozen=True, eq=False)
class Energy:
    """The data of E(U) but for the initial gaps, for many of which they may serve.

    `always` marks contacts without the max, `soft` regularises the Hessian.

    `reach` is |B|.
    """

    matrix: Stiffness
    E: FloatArray
    p: FloatArray
    always: Mask
    soft: float
    reach: csr_array | FloatArray

    def rounding(self, U: FloatArray) -> float:
        """The most that rounding of the overlaps at U makes of a force."""
        return float((np.abs(self.E) * (self.reach @ np.abs(U))).max(initial=0.0)) * _EPSILON

    def rounding_at_most(self, U: FloatArray) -> float:
        """No less than `rounding`, at once."""
        return self._stiffest_row * float(np.abs(U).max(initial=0.0)) * _EPSILON

    @cached_property
    def _stiffest_row(self) -> float:
        return float((np.abs(self.E) * self.reach.sum(axis=1)).max(initial=0.0))


def energy_of(B: csr_array, E: FloatArray, p: FloatArray, always: Mask, stiffest: float) -> Energy:
    """The energy of springs of stiffnesses E under loads p; `stiffest` is the largest elastic E."""
    matrix = filled_stiffness(B) or stiffness(B)
    return Energy(matrix, E, p, always, _SOFT * stiffest, abs(matrix.B))


def _allowed(rounding: float, largest: float) -> float:
    """The force that is taken as none beside the largest one."""
    return min(max(_TOLERANCE * largest, rounding), _COARSEST * largest)


def minimum(energy: Energy, o: FloatArray, U: FloatArray, enough: float = 0.0) -> FloatState:
    """The minimum of the energy with initial gaps o, from U; `gaps` are left to the caller.

    A residual of no more than `enough` ends it at once, for whoever wants the closed contacts only.
    """
    B, E, p = energy.matrix.B, energy.E, energy.p
    convex = bool((E > 0).all())
    # Without a load forces are to be compared with those of the gaps that the pile starts with.
    unit = np.abs(p).max(initial=0.0) or np.abs(E * o).max(initial=0.0) or 1.0
    solve: Solve | None = None
    factored = best = None
    result = FloatState(U, np.zeros_like(o), o, energy.always, 0, np.inf, False)
    for iterations in range(_MAX_ITERATIONS + 1):
        s = -(B @ U + o)
        if iterations and not np.isfinite(s).all():  # the energy falls for ever: a collapse
            break
        closed = energy.always | (s >= 0)
        forces = np.where(closed, E * s, 0.0)
        unbalanced = energy.matrix.transposed @ forces + p
        largest = max(np.abs(forces).max(initial=0.0), unit)
        residual = float(np.abs(unbalanced).max(initial=0.0) / largest)
        rounding = energy.rounding_at_most(U)
        if residual <= _COARSEST or not rounding <= _RUNAWAY * largest:
            rounding = energy.rounding(U)
        converged = residual * largest <= _allowed(rounding, largest)
        result = FloatState(U, forces, -s, closed, iterations, residual, converged)
        if residual <= enough:
            return result
        # Below the tolerance go on as long as it pays: a step with old factors costs little.
        if best is not None and residual > best.residual / 2:
            return min(best, result, key=lambda each: each.residual)
        if residual == 0 or rounding > _RUNAWAY * largest:
            return result
        if converged:
            best = result
        weights = _weights(energy, s, residual, largest) if convex else closed.astype(np.float64)
        if solve is None or (best is None and (weights != factored).any()):
            try:
                solve, factored = factor(energy.matrix, weights * E, energy.soft), weights
            except RuntimeError:  # singular to rounding, in spite of what `soft` adds
                break
        step = solve(unbalanced)
        searched = convex and best is None  # what is left at the end is rounding, not descent
        t = _line_search(energy, s, B @ step, float(unbalanced @ step)) if searched else 1.0
        with np.errstate(over="ignore", invalid="ignore"):
            U = U + t * step
    return best or result


def _weights(energy: Energy, s: FloatArray, residual: float, largest: float) -> FloatArray:
    """The share of its stiffness that each contact has in the smoothed Hessian.

    The derivative of (x + sqrt(x^2 + width^2)) / 2, which is smooth, in place of that of max(0, x),
    x = E s the force of the contact if it is closed.
    """
    width = max(_SMOOTH * min(residual, 1.0) ** 1.5 * largest, _TINY)
    x = energy.E * s
    return np.where(energy.always, 1.0, (1 + x / np.hypot(x, width)) / 2)


def _line_search(energy: Energy, s: FloatArray, rate: FloatArray, descent: float) -> float:
    """The t > 0 that minimises E(U + t d), exactly; infinite where E falls for ever.

    s - t rate are the overlaps along the line, E falls at first by `descent` = (B^T lambda + p) . d
    a unit (which is not summed up again here, because its terms cancel). Its derivative is a
    continuous, increasing, piecewise linear function of t with a kink where a contact opens
    (rate > 0) or closes (rate < 0); cumulated sums give all its pieces at once.
    """
    bend = energy.E * rate * rate
    acting = energy.always | (s > 0) | ((s == 0) & (rate < 0))
    with np.errstate(all="ignore"):
        times = s / rate
    moving = np.flatnonzero((times > 0) & (times < np.inf) & ~energy.always)
    moving = moving[np.argsort(times[moving])]
    times = times[moving]
    change = np.zeros((2, len(moving) + 1))  # of curvature and slope at every kink
    change[0, 1:] = np.copysign(bend[moving], -rate[moving])
    change[1, 1:] = -change[0, 1:] * times
    change[:, 0] = bend[acting].sum(), -descent
    curvatures, slopes = np.cumsum(change, axis=1)
    past = slopes[:-1] + curvatures[:-1] * times >= 0
    piece = int(np.argmax(past)) if past.any() else len(times)
    if curvatures[piece] <= 0:  # no contact is left that would resist
        level = -slopes[piece] <= _FLAT * descent and len(times) > 0
        return float(times[-1]) if level else float("inf")
    return float(-slopes[piece] / curvatures[piece])
