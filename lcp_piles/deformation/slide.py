"""Down from a saddle: the path on which energy falls steepest, to the equilibrium where it ends.

Discs without inertia in a viscous medium move along the unbalanced forces, du/ds = F(u). Implicit
Euler steps, (1/h + K) du = F with the Hessian K, follow that path; in the end, as h grows, they are
Newton's steps to a minimum of the energy. Discs may meet whom they come across on the way, not only
the contacts of the scene (`watch`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array, diags_array

from ..errors import InputError
from ..linear.banded import band_order, cholesky, lower_band
from ..linear.threads import one_thread
from ..numbers.vectors import FloatArray
from ..scenes.symmetry import mirror
from .laws import Law
from .nonlinear import Deformed, eigenpairs
from .shape import Strained, hessian, strained
from .watch import NEAR, Crowd, crowd_of, watched

_LONGEST = 0.05
"""The longest step of a disc (radii)."""
_GROWTH = 2.0
"""What the unbalanced force may grow by in a step: more is taken for a contact jumped over."""
_TOLERANCE = 1e-10
_NOT_NEGATIVE = -1e-9
_STILL = 1e-3
"""A disc that is nearer to a saddle than this part of a kick does not leave it by itself."""
_ROUNDING = 1e-12
_MOST_STEPS = 20_000
_SHORTEST = 1e-14
_BEYOND = 10.0
"""A disc that has gone farther than the pile is large, and by so many radii, falls for ever."""


@dataclass(frozen=True, eq=False, repr=False)
class Slide:
    """A way down from a saddle, in floating point.

    Attributes
    ----------
    start : Deformed
        Where it began.
    direction : array of float, shape (discs, axes)
        The motion along which that was left; its largest entry is 1 or -1.
    displacements : array of float, shape (discs, axes)
        Those at the end (w tau).
    state : Strained
        All that follows from them.
    settled : bool
        Whether the end is an equilibrium without negative eigenvalues; else a disc falls for ever
        or the steps ran out.
    distances : array of float, shape (steps,)
        Those of the farthest disc from the start, along the path (radii).
    energies : array of float, shape (steps,)
        The energies along the path (w times w tau).

    Examples
    --------
    >>> from lcp_piles import deform, first_order, nt30, slide, solve
    >>> leaning = slide(deform(first_order(solve(nt30(7))), 1e-4))
    >>> leaning.drop > 0, len(leaning.energies) == len(leaning.distances)
    (True, True)
    """

    start: Deformed
    direction: FloatArray
    displacements: FloatArray
    state: Strained
    settled: bool
    distances: FloatArray
    energies: FloatArray

    @property
    def distance(self) -> float:
        """How far the farthest disc has gone (radii)."""
        return float(self.distances[-1])

    @property
    def drop(self) -> float:
        """The energy lost on the way (w times w tau)."""
        return float(self.start.energy - self.energies[-1])

    @property
    def forces(self) -> FloatArray:
        """The forces (w) at the contacts of the scene; others may have been made."""
        return self.state.forces[: len(self.start.scene.contacts)]

    @cached_property
    def lowest(self) -> FloatArray:
        """The smallest eigenvalues of the Hessian at the end (1/tau), at most six."""
        return eigenpairs(hessian(self.state), 6)[0]

    @cached_property
    def asymmetry(self) -> float | None:
        """How far a disc is at most from where the mirror image of the end has it (radii).

        None for a scene that is not its own mirror image.
        """
        return _asymmetry(self, self.displacements * self.start.tau)

    @cached_property
    def is_odd(self) -> bool | None:
        """Whether the motion along which the start was left breaks the mirror symmetry."""
        odd = _asymmetry(self, self.direction)
        return None if odd is None else odd > 0.5

    def __repr__(self) -> str:
        how = "settled" if self.settled else "not settled"
        return f"<Slide at tau {self.start.tau:g}: {self.distance:.3g} radii, {how}>"


@one_thread()
def slide(start: Deformed, mode: int = 0, sign: int = 1, *, kick: float = 1e-3) -> Slide:
    """The steepest way down from a pile that does not stay where it is.

    Saddles on the way are left by a kick too. Discs have to be equal, of radius 1 and of one
    compliance. Floating point; the end is one minimum of many, that of the steepest path.

    Parameters
    ----------
    start : Deformed
        A saddle, or any other state that is not at rest.
    mode : int, default 0
        Along which of the Hessian's eigenvectors to leave, 0 for that of the smallest eigenvalue.
    sign : {1, -1}, default 1
        Which way along it.
    kick : float, default 1e-3
        How far the farthest disc is moved at first (w tau).

    Returns
    -------
    Slide
        The path and its end; `settled` says whether that is a minimum.

    Raises
    ------
    InputError
        For a mode that is not there, another sign, and discs that differ.

    Examples
    --------
    >>> from lcp_piles import deform, first_order, nt30, solve
    >>> leaning = slide(deform(first_order(solve(nt30(7))), 1e-4))
    >>> leaning.settled, leaning.is_odd, round(leaning.distance / 1e-4, 1)
    (True, True, 3.2)
    """
    if sign not in (1, -1):
        raise InputError("sign", sign, "1 or -1")
    crowd = crowd_of(start.scene)
    free = crowd.shape.free
    _, vectors = eigenpairs(hessian(start.state), mode + 1)
    if not 0 <= mode < vectors.shape[1]:
        raise InputError("mode", mode, f"a number from 0 to {vectors.shape[1] - 1}")
    direction = np.zeros(len(free))
    direction[free] = vectors[:, mode]
    direction *= sign / direction[np.argmax(np.abs(direction))]
    u, state, settled, path = _down(crowd, start, kick * direction)
    places = start.displacements.shape
    distances, energies = np.array(path).T
    return Slide(
        start, direction.reshape(places), u.reshape(places), state, settled, distances, energies
    )


def _down(
    crowd: Crowd, start: Deformed, kick: FloatArray
) -> tuple[FloatArray, Strained, bool, list[tuple[float, float]]]:
    """Displacements, state, whether it is at rest, and (distance, energy) along the path."""
    first = start.displacements.ravel()
    tau, law = start.tau, start.law
    looked = u = first + kick
    state = strained(watched(crowd, u, tau), u, tau, law)
    path = [(float(np.abs(kick).max(initial=0.0)) * tau, state.energy)]
    far = float(np.ptp(crowd.positions, axis=0).max()) + _BEYOND
    h = 1.0
    left = first
    for _ in range(_MOST_STEPS):
        K = hessian(state)
        if state.residual <= _TOLERANCE:
            values, vectors = eigenpairs(K, 1)
            if values[0] >= _NOT_NEGATIVE:
                return u, state, True, path
            if np.abs(state.unbalanced).max() < -values[0] * _STILL * np.abs(kick).max():
                # Another saddle, as on a symmetric path: it is left as the first one was, onward.
                motion = np.zeros(len(u))
                motion[crowd.shape.free] = vectors[:, 0]
                onward = np.abs(kick).max() / np.abs(motion).max()
                onward *= -1.0 if motion @ (u - left) < 0 else 1.0
                left, u = u, u + onward * motion
                state = strained(state.shape, u, tau, law)
                K = hessian(state)
        trial = None
        while trial is None and h >= _SHORTEST:
            trial = _step(K, state, u, h, law)
            h = h / 4 if trial is None else h * 2
        if trial is None:
            break
        u, state = trial
        distance = float(np.abs(u - first).max()) * tau
        path.append((distance, state.energy))
        if distance > far:
            break
        if float(np.abs(u - looked).max()) * tau > NEAR / 4:
            looked = u
            state = strained(watched(crowd, u, tau), u, tau, law)
    return u, state, False, path


def _step(
    K: csr_array, state: Strained, u: FloatArray, h: float, law: Law
) -> tuple[FloatArray, Strained] | None:
    """One Euler step of length h, None where it is too long for the path."""
    free = state.shape.free
    A = csr_array(K + diags_array(np.full(K.shape[0], 1 / h)))
    order = band_order(A)
    band = lower_band(A, order)
    factors = None if band is None else cholesky(band, order)
    if factors is None:  # more than the curvature of the way down allows
        return None
    move = factors.solve(state.unbalanced[free])
    if float(np.abs(move).max(initial=0.0)) * state.tau > _LONGEST:
        return None
    moved = u.copy()
    moved[free] += move
    there = strained(state.shape, moved, state.tau, law)
    downhill = there.energy <= state.energy + _ROUNDING * abs(state.energy)
    fair = np.linalg.norm(there.unbalanced) <= _GROWTH * np.linalg.norm(state.unbalanced)
    return (moved, there) if downhill and fair else None


def _asymmetry(found: Slide, moves: FloatArray) -> float | None:
    """The largest difference of a vector a disc from its mirror image."""
    image = mirror(found.start.scene)
    if image is None:
        return None
    mirrored = moves[image.discs].copy()
    mirrored[:, 0] *= -1
    return float(np.abs(moves - mirrored).max(initial=0.0))
