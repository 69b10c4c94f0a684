"""States of the contacts in first loading, as floating point finds them. Nothing here is a proof.

With the largest tangential forces b fixed, forces minimise a convex energy (Tresca's law), which
Newton steps with a line search do; then b = mu f_n, again and again, more carefully where that does
not settle (Necas, Jarusek and Haslinger 1980, "On the solution of the variational inequality to the
Signorini problem with small friction", Boll. Un. Mat. Ital. B 17). From each of these points plain
active-set steps, in which slipping contacts keep f_t = +-mu f_n, are tried: near the solution they
end in a few, elsewhere they may go round.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from ..linear.factors import sparse_factors
from ..numbers.vectors import FloatArray, IntArray
from .equations import contact_actions
from .loading import LoadingProblem, State, prescribed, tangent

_ROUNDS = 200
_NEWTON = 60
_ACTIVE = 30
_SOFT = 1e-9  # stiffness that holds what nothing holds
_LEAST_STEP = 1e-10
_ENOUGH = 1e-4  # of the fall of energy that the slope promises
_CAREFUL, _SLOWEST = 0.7, 0.05
_TIE = 1e-7
OPEN, STICK, UP, DOWN = range(4)


class _Springs:
    """The scene in floating point."""

    def __init__(self, problem: LoadingProblem) -> None:
        scene, rows = problem.forces.scene, problem.forces.rows
        parts = [
            (k, i, float(normal), float(tangential))
            for k, actions in enumerate(contact_actions(scene, rows))
            for i, normal, tangential in actions
        ]
        places = ([k for k, *_ in parts], [i for _, i, *_ in parts])
        shape = (len(scene.contacts), len(rows))
        self.N, self.T = (
            csr_array(coo_array(([part[side] for part in parts], places), shape=shape))
            for side in (2, 3)
        )
        self.gap = np.array([float(c.gap + prescribed(scene, c, c.normal)) for c in scene.contacts])
        self.slide = np.array([float(prescribed(scene, c, tangent(c))) for c in scene.contacts])
        self.k_n = np.array([1 / float(c.compliance) for c in scene.contacts])
        self.k_t = self.k_n * float(problem.ratio)
        self.smooth = np.array([len(choice) == 2 for choice in problem.choices])
        self.mu = np.where(self.smooth, 0.0, float(problem.forces.mu))
        self.load = np.array(
            [float(scene.discs[d].load[axis]) if axis < 2 else 0.0 for d, axis in rows]
        )
        self.soft = _SOFT * diags_array(np.full(shape[1], self.k_n.max(initial=1.0)))

    def motion(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """What springs would bear at u: along normals (pull negative), and along tangents."""
        return -self.k_n * (self.N @ u + self.gap), -self.k_t * (self.T @ u + self.slide)

    def energy(self, u: FloatArray, limit: FloatArray) -> float:
        """The convex energy with given largest tangential forces."""
        f, s = self.motion(u)
        held = np.minimum(np.abs(s), limit)
        springs = np.maximum(f, 0) ** 2 / self.k_n + held * (2 * np.abs(s) - held) / self.k_t
        return float(springs.sum() / 2 - self.load @ u)

    def step(self, f: FloatArray, s: FloatArray, stuck: FloatArray) -> FloatArray:
        """The Newton step for forces that are out of balance."""
        out = self.load + self.N.T @ f + self.T.T @ s
        return self.solved(np.where(f > 0, self.k_n, 0), stuck, 0 * f, out)

    def solved(
        self, closed: FloatArray, stuck: FloatArray, slipping: FloatArray, right: FloatArray
    ) -> FloatArray:
        """Motions under a load, springs being there along normals, tangents, and across both."""
        K = self.N.T @ diags_array(closed) @ self.N + self.T.T @ diags_array(stuck) @ self.T
        K = K + self.T.T @ diags_array(slipping) @ self.N + self.soft
        u: FloatArray = sparse_factors(K).solve(right)
        return u

    def states(self, u: FloatArray, tie: float = 0.0) -> IntArray:
        """The state of every contact at u; within `tie` of two, the more bound one."""
        f, s = self.motion(u)
        sticks = (np.abs(s) <= self.mu * f + tie) & ~self.smooth
        slips = np.where(self.smooth, STICK, np.where(s > 0, UP, DOWN))
        return np.where(f <= -tie, OPEN, np.where(sticks, STICK, slips))


def proposals(problem: LoadingProblem) -> Iterator[tuple[State, ...]]:
    """States that may be those of first loading, the likeliest first, none twice."""
    seen: set[bytes] = set()
    for states in _guesses(_Springs(problem)):
        key = states.tobytes()
        if key not in seen:
            seen.add(key)
            yield tuple(
                _NAMES[len(choice) == 2][state]
                for state, choice in zip(states.tolist(), problem.choices, strict=True)
            )


_NAMES: dict[bool, tuple[State, ...]] = {
    False: ("open", "stick", "slip+", "slip-"),
    True: ("open", "closed"),
}


def _guesses(springs: _Springs) -> Iterator[IntArray]:
    u = springs.solved(springs.k_n, springs.k_t, 0 * springs.k_n, springs.load)
    limit = np.zeros(len(springs.mu))
    share, change = 1.0, np.inf
    for _ in range(_ROUNDS):
        u = _least_energy(springs, u, limit)
        settled = _active_set(springs, springs.states(u))
        if settled is not None:
            yield settled
        wanted = springs.mu * np.maximum(springs.motion(u)[0], 0)
        last, change = change, float(np.abs(wanted - limit).max(initial=0.0))
        if change < _TIE:
            break
        if change > 0.9 * last:
            share = max(_CAREFUL * share, _SLOWEST)
        limit = limit + share * (wanted - limit)
    yield from (springs.states(u, tie) for tie in (_TIE, -_TIE))


def _least_energy(springs: _Springs, u: FloatArray, limit: FloatArray) -> FloatArray:
    """Newton's method with a line search for given largest tangential forces."""
    energy = springs.energy(u, limit)
    for _ in range(_NEWTON):
        f, s = springs.motion(u)
        f, stuck = np.maximum(f, 0), np.where(np.abs(s) < limit, springs.k_t, 0)
        s = np.clip(s, -limit, limit)
        step = springs.step(f, s, stuck)
        fall = float((springs.load + springs.N.T @ f + springs.T.T @ s) @ step)
        length = 1.0
        while length > _LEAST_STEP:
            lower = springs.energy(u + length * step, limit)
            if lower <= energy - _ENOUGH * length * fall:
                break
            length /= 2
        else:
            break
        u, energy = u + length * step, lower
    return u


def _active_set(springs: _Springs, states: IntArray) -> IntArray | None:
    """States that their own solution confirms, from some others; None where steps go round."""
    seen: set[bytes] = set()
    while len(seen) < _ACTIVE and states.tobytes() not in seen:
        seen.add(states.tobytes())
        closed = np.where(states == OPEN, 0, springs.k_n)
        stuck = np.where((states == STICK) & ~springs.smooth, springs.k_t, 0)
        side = np.where(states == UP, 1, np.where(states == DOWN, -1, 0))
        slipping = side * springs.mu * closed
        right = springs.load - springs.N.T @ (closed * springs.gap)
        right = right - springs.T.T @ (slipping * springs.gap + stuck * springs.slide)
        new = springs.states(springs.solved(closed, stuck, slipping, right))
        if np.array_equal(new, states):
            return states
        states = new
    return None
