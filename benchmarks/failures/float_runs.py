"""Floating-point methods run on a scene, and contact states read from what they find."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from lcp_piles import Scene, Solution, contact_system
from lcp_piles.mechanics.system import ContactSystem
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lcp, float_lemke
from lcp_piles.methods.float_state import FloatState, float_solution
from lcp_piles.methods.gauss_seidel import gauss_seidel
from lcp_piles.methods.newton import newton
from lcp_piles.solution.record import make_record

RELAXED: dict[str, Callable[[ContactSystem], Any]] = {
    "Newton": newton,
    "FIRE": lambda system: fire(system, tolerance=1e-11, max_iterations=20_000),
    "Gauss-Seidel": lambda system: gauss_seidel(system, tolerance=1e-10, max_sweeps=5000),
}
"""Methods that find displacements, with a tolerance that they reach on ordinary piles."""


def in_floats(scene: Scene, method: str) -> tuple[Solution, bool]:
    """All that a method of `RELAXED`, or "Lemke", computed for a scene, and whether it converged.

    The states are not to be used: `misread` reads them, at any threshold.
    """
    system = contact_system(scene)
    if method == "Lemke":
        B, C, o, _ = system.floats()
        run = float_lemke(*float_lcp(system))
        U = np.linalg.lstsq(B.toarray(), run.z - o - C * run.w, rcond=None)[0]
        return whole(system, U, run.w, run.z), run.converged
    run = RELAXED[method](system)
    return whole(system, run.U, run.forces, run.gaps), run.converged


def whole(
    system: ContactSystem,
    U: np.ndarray,
    forces: np.ndarray,
    gaps: np.ndarray,
    threshold: float = 0.0,
) -> Solution:
    """Displacements, forces and gaps in floats as a solution of the whole scene."""
    state = FloatState(U, forces, gaps, forces > 0, 0, 0.0, True)
    return float_solution(system, state, make_record(system, "", "", 0, ""), threshold)


def loaded_stiffness(system: ContactSystem, closed: np.ndarray) -> np.ndarray:
    """B^T C^-1 B of the contacts in the mask `closed`, dense."""
    B, C, _, _ = system.floats()
    rows = B.toarray()[closed]
    return rows.T @ (rows / C[closed][:, None])


def misread(solution: Solution, truth: tuple[str, ...], threshold: float) -> int:
    """How many contacts are named wrongly by a threshold relative to the largest force or length.

    Closed where the force is above it, else open where the gap is, else osculatory.
    """
    f, g = np.abs(solution.force_array), solution.gap_array
    length = max(np.abs(solution.displacement_array).max(), g.max())
    pairs = zip(f > threshold * f.max(), g > threshold * length, truth, strict=True)
    return sum(("closed" if x else "open" if y else "osculatory") != name for x, y, name in pairs)


THRESHOLDS = tuple(10.0 ** (-k / 2) for k in range(41))
"""From 1 down to 1e-20, two a decade."""
ABOVE_ROUNDING = tuple(t for t in THRESHOLDS if t > 1e-16)
"""Below, a threshold reads rounding, and may be right by luck."""
