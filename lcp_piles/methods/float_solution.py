"""From floating-point arrays of a contact system to the solution of the whole scene."""

from __future__ import annotations

import numpy as np

from ..mechanics.system import ContactSystem
from ..numbers.exact import Surd
from ..numbers.vectors import FloatArray
from ..solution.record import make_record
from ..solution.solution import ContactState, Solved


def float_solution(
    system: ContactSystem,
    U: FloatArray,
    forces: FloatArray,
    gaps: FloatArray,
    *,
    method: str,
    arithmetic: str,
    steps: int,
    tolerance: float,
    start: float,
) -> Solved:
    """The solution of the whole scene from displacements, forces and gaps of one part of it.

    U has one entry a freedom, `forces` and `gaps` one a contact, in the units of the system.
    `arithmetic` is "float64" or "float32"; `steps` is how many linear systems were solved; `start`
    is the clock (`perf_counter`) at the beginning.

    Nothing is proved. A contact is called closed where its force is above `tolerance` times the
    largest force, open where its gap is above `tolerance` times the largest displacement or gap,
    and osculatory where neither; in a pile with mechanisms another solution may have other gaps.
    """
    contact = system.reduction.contact
    present = contact >= 0
    f = present * _floats(system.force_factor)[system.factor_of[contact]] * forces[contact]
    g = present * _floats(system.gap_factor)[system.factor_of[contact]] * gaps[contact]
    u = _displacements(system, U)
    loaded = np.abs(f) > tolerance * np.abs(f).max(initial=0.0)
    apart = g > tolerance * max(np.abs(u).max(initial=0.0), np.abs(g).max(initial=0.0))
    states: tuple[ContactState, ...] = tuple(
        "closed" if force else "open" if gap else "osculatory"
        for force, gap in zip(loaded.tolist(), apart.tolist(), strict=True)
    )
    record = make_record(system, method, arithmetic, steps, "none: floating point", start)
    return Solved(system.scene, record, f, g, u, states)


def _displacements(system: ContactSystem, U: FloatArray) -> FloatArray:
    """Displacements of every disc and axis of the whole scene, flat; held ones as prescribed."""
    reduction, scene = system.reduction, system.scene
    moved = np.append(U, 0.0)[reduction.freedom] * reduction.sign
    u = moved.reshape(-1, scene.dimension) * _floats(system.displacement_factor)
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            if held:
                u[k, axis] = float(held)
    return u.ravel()


def _floats(factors: tuple[Surd, ...]) -> FloatArray:
    return np.array([float(f) for f in factors], dtype=np.float64)
