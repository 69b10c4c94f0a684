"""What every floating-point method ends with, and the solution of the whole scene from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..mechanics.system import ContactSystem
from ..numbers.vectors import FloatArray, Mask
from ..solution.record import Record
from ..solution.solution import ContactState, Solved


@dataclass(frozen=True, eq=False)
class FloatState:
    """Where a floating-point method stopped, in the physical units of `ContactSystem.floats`.

    `U` (w tau) has one entry a freedom; `forces` (w, times the number of contacts that one stands
    for), `gaps` (w tau) and the mask `closed` (the contacts that the method ended with as closed)
    one a contact. `steps` counts what the method counts: linear
    systems, sweeps, evaluations of all forces, pivots. `residual` is the method's measure of what
    is left, relative to the largest force or load; `converged` says that it is within the tolerance
    of the method.
    """

    U: FloatArray
    forces: FloatArray
    gaps: FloatArray
    closed: Mask
    steps: int
    residual: float
    converged: bool


def unbalanced(system: ContactSystem, forces: FloatArray) -> float:
    """The largest unbalanced force over the largest force or load of a contact system."""
    B, _, _, p = system.floats()
    largest = max(float(np.abs(x).max(initial=0.0)) for x in (forces, p)) or 1.0
    return float(np.abs(B.T @ forces + p).max(initial=0.0)) / largest


def float_solution(
    system: ContactSystem, state: FloatState, record: Record, resolution: float
) -> Solved:
    """The solution of the whole scene from a floating-point state of one part of it.

    Nothing is proved. A contact is called closed where its force is above `resolution` times the
    largest force, open where its gap is above `resolution` times the largest displacement or gap,
    and osculatory where neither; in a pile with mechanisms another solution may have other gaps.
    """
    contact = system.reduction.contact
    present = contact >= 0
    forces, gaps = state.forces.astype(np.float64), state.gaps.astype(np.float64)
    f = present * (forces / system.reduction.weight)[contact]
    g = present * gaps[contact]
    u = _displacements(system, state.U.astype(np.float64))
    loaded = np.abs(f) > resolution * np.abs(f).max(initial=0.0)
    apart = g > resolution * max(np.abs(u).max(initial=0.0), np.abs(g).max(initial=0.0))
    states: tuple[ContactState, ...] = tuple(
        "closed" if force else "open" if gap else "osculatory"
        for force, gap in zip(loaded.tolist(), apart.tolist(), strict=True)
    )
    return Solved(system.scene, record, f, g, u, states)


def _displacements(system: ContactSystem, U: FloatArray) -> FloatArray:
    """Displacements of every disc and axis of the whole scene, flat; held ones as prescribed."""
    reduction, scene = system.reduction, system.scene
    moved = np.append(U, 0.0)[reduction.freedom] * reduction.sign
    u: FloatArray = moved.reshape(-1, scene.dimension).astype(np.float64)
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            if held:
                u[k, axis] = float(held)
    return u.ravel()
