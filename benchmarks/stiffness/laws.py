"""Hooke's and Hertz' law: the forces on the floor, and LAMMPS with Hertzian discs."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.stiffness.piles import case, molecular, nonlinear
from lcp_piles import HERTZ, HOOKE, deform, nt30, solve

_SOFT = 1e-3
_TINY = 1e-8
"""A tau at which the rigid limit of either law is reached to seven digits."""


def laws(ax: Any) -> None:
    """The floor under NT30 of 10 layers with both laws, in the rigid limit and at tau = 1e-3."""
    scene = nt30(10)
    solution = solve(scene)
    assert solution.status == "solved"
    floor = [k for k, c in enumerate(scene.contacts) if c.b == "floor"]
    x = [float(scene.disc(scene.contacts[k].a).position[0]) for k in floor]
    for k, law in enumerate((HOOKE, HERTZ)):
        for tau, dashes in ((_TINY, "o-"), (_SOFT, ".:")):
            found = deform(solution, tau, law)
            assert found.converged
            print(law.name, tau, found.forces[floor][: len(floor) // 2].round(4))
            label = f"{law.name.capitalize()}, " + (
                r"$\tau \to 0$" if tau == _TINY else rf"$\tau$ = {tau:g}"
            )
            ax.plot(x, found.forces[floor], dashes, color=f"C{k}", ms=3, lw=1, label=label)
    ax.set_xlabel("x (disc radii)")
    ax.set_ylabel("force on the floor ($w$)")
    ax.legend()


def hertz_table() -> list[str]:
    """Piles of Hertzian discs against LAMMPS, in lines of Markdown."""
    lines = [
        "| pile | tau | largest force (w) | off those of Hooke's law | LAMMPS differs by (w) |",
        "|---|---|---|---|---|",
    ]
    for name in ("NT30 6", "NT30 6, push 20", "NT60 5", "TBS 8"):
        which = case(name)
        for tau in (1e-2, 1e-3, 1e-4):
            found = deform(which.first, tau, HERTZ)
            assert found.converged
            other = molecular(which.rigid.scene, tau, 1e-10, hertz=True)
            apart = np.abs(found.forces - nonlinear(which, tau)).max()
            row = [name, f"{tau:.0e}", f"{found.forces.max():.4f}", f"{apart:.3f}"]
            lines.append(
                "| " + " | ".join([*row, f"{np.abs(other - found.forces).max():.0e}"]) + " |"
            )
    return lines
