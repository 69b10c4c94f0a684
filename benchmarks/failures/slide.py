"""Discs that really move: damped molecular dynamics of a pile, from its exact equilibrium on.

Nothing is linearised: discs a distance d apart push with (2 - d)/tau where they overlap, the floor
of compliance c with its overlap over c tau, the weight is 1, velocities are damped. Whether the
pile stays where the exact solution puts it, or slides off, is what the stability verdict foretells.

    python -m benchmarks.failures.slide            prints how far some piles get
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lcp_piles import Scene, Solution, nt30, solve, tss
from lcp_piles.numbers.vectors import FloatArray

_DAMPING = 0.5
_KICK = 1e-3


@dataclass(frozen=True)
class Slide:
    """Times, and the farthest that any disc is from the linearised equilibrium, in units of tau."""

    times: FloatArray
    distance: FloatArray


def slide(solution: Solution, tau: float, *, duration: float = 60.0, samples: int = 120) -> Slide:
    """Let the discs go from lattice + tau u, kicked by 1e-3 tau in random directions (fixed seed).

    One unit of time is that in which a disc of mass 1 falls half a radius.
    """
    scene = solution.scene
    place = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    free = np.array([[h is None for h in disc.held] for disc in scene.discs])
    start = place + tau * solution.displacement_array
    load = np.array([[float(p) for p in disc.load] for disc in scene.discs])
    soft = next(float(c.compliance) for c in scene.contacts if c.b == "floor")
    first, second = np.triu_indices(len(place), 1)
    x = start + free * _KICK * tau * np.random.default_rng(0).standard_normal(start.shape)
    v = np.zeros_like(x)
    step = 0.25 * tau**0.5
    steps = int(duration / step)
    every = max(steps // samples, 1)
    times, distance = [], []
    for k in range(steps + 1):
        if k % every == 0:
            times.append(k * step)
            distance.append(float(np.abs(x - start).max()) / tau)
        if k % 25 == 0:  # which discs may touch before this is asked again
            near = ((x[first] - x[second]) ** 2).sum(axis=1) < 2.2**2
            a, b = first[near], second[near]
        force = load - _DAMPING * v
        apart = x[a] - x[b]
        d = np.sqrt((apart**2).sum(axis=1))
        push = (np.maximum(2 - d, 0) / (tau * d))[:, None] * apart
        for axis in (0, 1):
            force[:, axis] += np.bincount(a, push[:, axis], len(x))
            force[:, axis] -= np.bincount(b, push[:, axis], len(x))
        force[:, 1] += np.maximum(-x[:, 1], 0) / (tau * soft)
        v = (v + step * force) * free
        x = x + step * v
    return Slide(np.array(times), np.array(distance))


PILES: dict[str, tuple[Scene, float]] = {
    "NT30, 6 layers": (nt30(6), 1e-4),
    "TSS, 4 layers": (tss(4), 1e-4),
    "TSS, 6 layers": (tss(6), 1e-4),
    "NT30, 6 layers, pushed by 200": (nt30(6, push=200), 1e-6),
}


def main() -> None:
    for name, (scene, tau) in PILES.items():
        solution = solve(scene)
        run = slide(solution, tau)
        verdict = solution.stability.verdict if solution.stability else "?"
        print(
            f"{name:32s} tau {tau:.0e}  verdict {verdict:8s}"
            f"  at first {run.distance[0]:.1e} tau, at the end {run.distance[-1]:.1e} tau"
        )


if __name__ == "__main__":
    main()
