"""The error of the rigid limit and of the first order against tau, with LAMMPS on top."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.comparison.molecular import settle
from benchmarks.stiffness.piles import PILES, SADDLES, Case, case, nonlinear_errors

TAUS = np.logspace(-7, -1, 25)
MD_TAUS = (1e-5, 1e-4, 1e-3, 1e-2)
STOP = 1e-11
"""Unbalanced force (w) at which LAMMPS stops, here also about its error."""


def molecular_errors(which: Case, tau: float) -> tuple[float, float]:
    """The errors against LAMMPS at the same tau."""
    scene = which.rigid.scene
    places, _ = settle(scene, tau, STOP)
    a, b = scene.ends
    apart = np.linalg.norm(places[a] - places[np.maximum(b, 0)], axis=1) - 2
    gaps = np.where(b >= 0, apart, places[a, 1]) / tau
    return which.errors(np.maximum(-gaps, 0), tau)


def errors_table() -> list[str]:
    """Ratios a decade and the distance to LAMMPS, in lines of Markdown."""
    lines = [
        "| pile | largest force | max \\|f1\\| | no change below tau | tau | rigid limit off by | "
        "ratio | first order off by | ratio | LAMMPS less first order |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for name in (*PILES, *SADDLES):
        which = case(name)
        limit, _ = which.first.range
        before = None
        for tau in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
            now = nonlinear_errors(which, tau)
            ratios = [x / y for x, y in zip(before, now, strict=True)] if before else []
            shown = [f"{x:.2f}" for x in ratios] or ["", ""]
            molecular = ""
            if name in PILES and tau in MD_TAUS:
                molecular = f"{molecular_errors(which, tau)[1]:.1e}"
            head = ["", "", "", ""]
            if before is None:
                head = [
                    name,
                    f"{which.largest:.4f}",
                    f"{np.abs(which.first.force_array).max():.4f}",
                ]
                head.append(f"{float(limit):.2e}" if limit is not None else "any")
            row = [*head[:4], f"{tau:.0e}", f"{now[0]:.2e}", shown[0], f"{now[1]:.2e}", shown[1]]
            lines.append("| " + " | ".join([*row, molecular]) + " |")
            before = now
    return lines


def errors(ax: Any) -> None:
    """Error against tau: the rigid limit falls with slope 1, the first order with slope 2."""
    for k, name in enumerate((*PILES, "NT30 7", "TSS 3")):
        which = case(name)
        colour = f"C{k}"
        found = np.array([nonlinear_errors(which, tau) for tau in TAUS]) / which.largest
        dashes = "-" if name in PILES else "--"
        ax.loglog(TAUS, found[:, 0], dashes, color=colour, lw=1, label=name)
        ax.loglog(TAUS, np.maximum(found[:, 1], 1e-16), dashes, color=colour, lw=1)
        if name in PILES:
            points = np.array([molecular_errors(which, tau) for tau in MD_TAUS]) / which.largest
            for column, marker in ((0, "o"), (1, "s")):
                ax.loglog(MD_TAUS, points[:, column], marker, color=colour, ms=3.5, mfc="none")
        limit, _ = which.first.range
        if limit is not None and float(limit) < TAUS[-1]:
            at = np.array(nonlinear_errors(which, float(limit))) / which.largest
            ax.plot([float(limit)], [at[1]], "x", color=colour, ms=6)
    ax.set_xlabel(r"$\tau$ (disc radii a disc weight)")
    ax.set_ylabel("largest error / largest force")
    ax.set_ylim(1e-15, 3)
    ax.text(2e-7, 3e-5, "rigid limit", rotation=27, fontsize=7)
    ax.text(2e-7, 3e-12, "first order", rotation=45, fontsize=7)
    ax.plot([], [], "ks", ms=3.5, mfc="none", label="LAMMPS")
    ax.plot([], [], "kx", label="a contact changes")
    ax.legend(ncols=2, fontsize=6, loc="lower right")
