"""FIRE relaxation of the linearised pile, in floating point.

Bitzek, Koskinen, Gaehler, Moseler and Gumbsch (2006), "Structural relaxation made simple", Phys.
Rev. Lett. 97, 170201: molecular dynamics that steers the velocity towards the force and stops dead
where the power v . F turns negative. It minimises the energy of module `newton`,

    E(U) = sum_k max(0, s_k)^2 / (2 C_k) - p . U,      s = -(B U + o),

with a unit mass for every freedom, and is what a molecular-dynamics code does to settle a pile,
without its nonlinear part.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csr_array

from ..errors import InputError
from ..mechanics.system import ContactSystem
from .float_state import FloatState
from .method import Method, Outcome, Progress, float_outcome

# The five constants of the paper.
_WAIT, _GROW, _SHRINK, _MIX, _MIX_FADE = 5, 1.1, 0.5, 0.1, 0.99


def fire(
    system: ContactSystem,
    *,
    tolerance: float = 1e-10,
    max_iterations: int = 100_000,
    dtype: Any = np.float64,
) -> FloatState:
    """Relax a contact system from the undisplaced pile until its forces balance.

    Steps are evaluations of all forces, the residual is the largest unbalanced force over the
    largest force or load; forces and gaps satisfy all other conditions by construction.

    Parameters: `tolerance` on the residual; `max_iterations`, each one evaluation of all forces;
    `dtype`, float64 or float32. The longest time step is 1/omega with omega^2 a bound of the
    stiffness, half of the limit of stability. Raises `InputError` for rigid contacts, whose time
    step would be zero.

    >>> from lcp_piles import contact_system, nt60
    >>> fire(contact_system(nt60(4)), tolerance=1e-8).converged
    True
    """
    sparse, C, o, p = (x.astype(dtype) for x in system.floats())
    if not C.all():
        raise InputError("a compliance", 0, "a compliance that is not zero", "FIRE needs springs")
    B, transposed = csr_array(sparse), csr_array(sparse.T)
    size = abs(B)
    bound = float((size.T @ (np.abs(1 / C) * (size @ np.ones(len(p))))).max(initial=1.0))
    longest = 1 / np.sqrt(bound)
    U, v = np.zeros(len(p), dtype=dtype), np.zeros(len(p), dtype=dtype)
    far = float(np.finfo(dtype).max) ** 0.25
    step, mix, downhill = longest / 10, _MIX, 0
    steps = 0
    while True:
        gaps = B @ U + o
        forces = np.where(system.bilateral | (gaps < 0), -gaps / C, 0).astype(dtype)
        pull = transposed @ forces + p
        largest = max(float(np.abs(x).max(initial=0.0)) for x in (forces, p)) or 1.0
        residual = float(np.abs(pull).max(initial=0.0)) / largest
        # An energy that falls for ever is left where a square would overflow, and is not converged.
        if residual <= tolerance or steps >= max_iterations or not largest < far:
            break
        steps += 1
        if float(v @ pull) > 0:
            downhill += 1
            if downhill > _WAIT:
                step, mix = min(step * _GROW, longest), mix * _MIX_FADE
        elif steps > 1:
            downhill, step, mix = 0, step * _SHRINK, _MIX
            v[:] = 0
        v += dtype(step) * pull
        speed, force = np.linalg.norm(v), np.linalg.norm(pull)
        v = ((1 - mix) * v + mix * (speed / force) * pull).astype(dtype)
        U += dtype(step) * v
    closed = system.bilateral | (gaps < 0)
    gaps = np.where(closed, 0, gaps)
    return FloatState(U, forces, gaps, closed, steps, residual, residual <= tolerance)


def run_fire(system: ContactSystem, progress: Progress | None = None) -> Outcome:
    """`fire` as a method of `solve`."""
    if system.rigid.any():
        return Outcome(0, "none: FIRE needs springs, and a contact is rigid")
    return float_outcome(fire(system))


FIRE = Method("fire", "FIRE relaxation, as molecular dynamics does it", "float64", run_fire, 1e-8)
