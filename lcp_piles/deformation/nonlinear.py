"""The whole nonlinear pile at a given compliance tau: exact geometry, Newton, continuation in tau.

Newton's method looks for balance, not for least energy, so it finds saddles as well: a step is
shortened until the unbalanced forces fall. Where that does not lead on, tau is raised in smaller
steps from the rigid limit, each from the straight line through the last two. Everything is floating
point, in displacements of units w tau (`shape`), so that a tau of 1e-12 is no harder than 1e-2.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from ..errors import InputError, SolveError
from ..linear.banded import band_order, lower_band
from ..linear.factors import sparse_factors
from ..linear.threads import one_thread
from ..numbers.vectors import FloatArray
from ..scenes.scene import Scene
from ..solution.solution import Solved
from .correction import FirstOrder
from .laws import HOOKE, Law
from .shape import Shape, Strained, hessian, shape_of, strained

_TOLERANCE = 1e-11
"""Unbalanced force over the largest one that counts as none; rounding leaves some 1e-13."""
_MOST_STEPS = 60
_SHORTEST = 2.0**-12
_LEAST_RISE = 2.0**-14
"""The smallest part of tau by which continuation goes on."""


@dataclass(frozen=True, eq=False, repr=False)
class Deformed:
    """A pile of round discs of compliance tau in balance, in floating point.

    Vectors follow the scene's order.

    Attributes
    ----------
    scene : Scene
        The scene.
    tau : float
        The compliance (disc radii a disc weight).
    law : Law
        The law of its contacts.
    state : Strained
        All that follows from the displacements.
    displacements : array of float, shape (discs, axes)
        The displacements (w tau).
    steps : int
        How many linear systems were solved.
    converged : bool
        Where it is false nothing is claimed: the state is the last one that balanced, or the start.

    Examples
    --------
    >>> from lcp_piles import deform, nt60, solve
    >>> deform(solve(nt60(2)), 1e-3).displacements.shape
    (3, 2)
    """

    scene: Scene
    tau: float
    law: Law
    state: Strained
    displacements: FloatArray
    steps: int
    converged: bool

    @property
    def forces(self) -> FloatArray:
        """All forces (w)."""
        return self.state.forces[: len(self.scene.contacts)]

    @property
    def gaps(self) -> FloatArray:
        """All gaps (w tau)."""
        return self.state.gaps[: len(self.scene.contacts)]

    @property
    def energy(self) -> float:
        """The energy (w times w tau)."""
        return self.state.energy

    @property
    def residual(self) -> float:
        """The largest unbalanced force over the largest force or load."""
        return self.state.residual

    @cached_property
    def lowest(self) -> FloatArray:
        """The smallest eigenvalues of the Hessian of the energy, at most six, in units of 1/tau.

        A contact of compliance 1 has stiffness 1 in these units. Negative ones are directions in
        which the pile slides off: none makes the equilibrium stable, some make it a saddle.
        """
        return eigenpairs(hessian(self.state), 6)[0]

    def __repr__(self) -> str:
        ok = f"residual {self.residual:.1e}" if self.converged else "not converged"
        return f"<Deformed {len(self.scene.discs)} discs, tau {self.tau:g}, {self.law.name}: {ok}>"


@one_thread()
def deform(start: Solved | FirstOrder, tau: float, law: Law = HOOKE) -> Deformed:
    """The equilibrium at tau that is continued from the rigid limit.

    Saddles are found as well as minima. Where only the squares of displacements are beyond the
    range of floats, nothing converges.

    Parameters
    ----------
    start : Solved or FirstOrder
        A solution of the scene, exact or not, or its first order, which starts nearer and from the
        right displacements where the rigid limit leaves them open.
    tau : float
        The compliance (disc radii a disc weight), positive.
    law : Law, default HOOKE
        The law of the contacts.

    Returns
    -------
    Deformed
        The pile; `converged` says whether it is in balance.

    Raises
    ------
    InputError
        For rigid contacts, a scene that is not geometric, a tau that is not positive, and bilateral
        contacts under another law than Hooke's.
    SolveError
        Where displacements are beyond the range of floats.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> soft = deform(solve(nt60(2)), 1e-3)
    >>> soft.converged, round(float(soft.forces[0]), 6)
    (True, 0.577406)
    """
    if not (isinstance(tau, float | int) and 0 < tau <= sys.float_info.max):
        raise InputError("tau", tau, "a positive number, in disc radii a disc weight")
    rigid = start.rigid if isinstance(start, FirstOrder) else start
    scene = rigid.scene
    shape = shape_of(scene)
    if law.exponent != 1 and any(c.bilateral for c in scene.contacts):
        raise InputError("the law", law.name, "hooke for bilateral contacts, which may pull")
    if isinstance(start, FirstOrder):
        u = start.start.array()
        slope = start.displacements.array()
    else:
        u = rigid.displacement_array.ravel()
        slope = np.zeros_like(u)
    if not (np.isfinite(u).all() and np.isfinite(slope).all()):
        raise SolveError("displacements are beyond the range of floats: only exact methods serve")
    with np.errstate(all="ignore"):  # what overflows does not balance
        return _from_rigid(shape, u, slope, float(tau), law)


def _from_rigid(shape: Shape, u: FloatArray, slope: FloatArray, tau: float, law: Law) -> Deformed:
    """The pile at tau from the displacements u of the rigid limit with Hooke's law."""
    steps = 0
    if law.exponent != HOOKE.exponent:
        # The rigid limit of another law has other forces: it is reached through laws between.
        slope = np.zeros_like(u)
        for exponent in np.linspace(HOOKE.exponent, law.exponent, 6)[1:]:
            found = _balance(shape, u, tau * _LEAST_RISE, Law("between", float(exponent)))
            u, steps = found.u, steps + found.steps
    return _continued(shape, u, slope, tau, law, steps)


@dataclass(frozen=True, eq=False)
class _Balance:
    u: FloatArray
    state: Strained
    steps: int
    converged: bool


def _continued(
    shape: Shape, u: FloatArray, slope: FloatArray, tau: float, law: Law, steps: int
) -> Deformed:
    """From u at tau = 0 to tau, in one step or in as many as it takes."""
    reached, rise = 0.0, tau
    found = None
    while reached < tau and rise >= _LEAST_RISE * tau:
        target = min(reached + rise, tau)
        trial = _balance(shape, u + (target - reached) * slope, target, law)
        steps += trial.steps
        if trial.converged:
            slope = (trial.u - u) / (target - reached)
            u, reached, found = trial.u, target, trial
            rise *= 2
        else:
            rise /= 4
    if found is None:
        found = _Balance(u, strained(shape, u, tau, law), steps, False)
    scene = shape.scene
    places = found.u.reshape(-1, scene.dimension)
    return Deformed(scene, found.state.tau, law, found.state, places, steps, reached == tau)


def _balance(shape: Shape, u: FloatArray, tau: float, law: Law) -> _Balance:
    """Newton's method for balance from u, steps shortened until the unbalanced forces fall."""
    u = np.where(shape.free, u, shape.held)
    state = strained(shape, u, tau, law)
    for steps in range(_MOST_STEPS):
        if state.residual == 0:
            return _Balance(u, state, steps, True)
        finite = np.isfinite(state.residual)
        step = newton_step(hessian(state), state.unbalanced[shape.free]) if finite else None
        if step is None:
            return _Balance(u, state, steps, False)
        before = float(np.linalg.norm(state.unbalanced))
        t, trial, moved = 1.0, state, u
        while t >= _SHORTEST:
            moved = u.copy()
            moved[shape.free] += t * step
            trial = strained(shape, moved, tau, law)
            if float(np.linalg.norm(trial.unbalanced)) <= (1 - t / 10) * before:
                break
            t /= 2
        if t < _SHORTEST:  # what is left is rounding, or Newton's method is stuck
            return _Balance(u, state, steps, state.residual <= _TOLERANCE)
        u, state = moved, trial
    return _Balance(u, state, _MOST_STEPS, state.residual <= _TOLERANCE)


def newton_step(K: csr_array, force: FloatArray) -> FloatArray | None:
    """K^-1 force; None where K is singular to rounding."""
    if not len(force):
        return force
    try:
        step: FloatArray = sparse_factors(K, symmetric=True).solve(force)
    except RuntimeError:
        return None
    return step if np.isfinite(step).all() else None


def eigenpairs(K: csr_array, count: int) -> tuple[FloatArray, FloatArray]:
    """The smallest eigenvalues of a sparse symmetric matrix, and their vectors as columns."""
    from scipy.linalg import eig_banded

    size = K.shape[0]
    count = min(count, size)
    if not count:
        return np.empty(0), np.empty((size, 0))
    order = band_order(K)
    band = lower_band(K, order)
    if band is None:
        raise InputError("the number of freedoms", size, "one whose band fits the memory")
    values, vectors = eig_banded(band, lower=True, select="i", select_range=(0, count - 1))
    spread = np.empty_like(vectors)
    spread[order] = vectors
    return values, spread
