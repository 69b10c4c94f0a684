"""The error of the rigid limit and of the first order against tau, with LAMMPS on top."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.stiffness.piles import PILES, SADDLES, case, molecular, nonlinear

TAUS = np.logspace(-7, -1, 25)
MD_TAUS = (1e-5, 1e-4, 1e-3, 1e-2)
PANELS = (*PILES, "TSS 3", "NT30 7")
STOP = 1e-11
"""Unbalanced force (w) at which LAMMPS stops, here also about its error."""
_BAR = (1e-3, 1e-4)
"""The tau at which a simulation is asked to be so near (w) to the first order."""


def errors_table() -> list[str]:
    """Ratios a decade and the distances to LAMMPS, in lines of Markdown."""
    lines = [
        "| pile | largest force | max \\|f1\\| | no change below tau | tau | rigid limit off by | "
        "ratio | first order off by | ratio | of the largest force | LAMMPS less nonlinear | "
        "LAMMPS less first order |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for name in (*PILES, *SADDLES):
        which = case(name)
        limit, _ = which.first.range
        before = None
        for tau in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
            forces = nonlinear(which, tau)
            now = which.errors(forces, tau)
            ratios = [x / y for x, y in zip(before, now, strict=True)] if before else []
            shown = [f"{x:.2f}" for x in ratios] or ["", ""]
            dynamics = ["", ""]
            if name in PILES and tau in MD_TAUS:
                found = molecular(which.rigid.scene, tau, STOP)
                off = np.abs(found - forces).max(), which.errors(found, tau)[1]
                dynamics = [f"{x:.1e}" for x in off]
            head = ["", "", "", ""]
            if before is None:
                head = [
                    name,
                    f"{which.largest:.4f}",
                    f"{np.abs(which.first.force_array).max():.4f}",
                    f"{float(limit):.2e}" if limit is not None else "any",
                ]
            row = [*head, f"{tau:.0e}", f"{now[0]:.2e}", shown[0], f"{now[1]:.2e}", shown[1]]
            row += [f"{now[1] / which.largest:.1e}", *dynamics]
            lines.append("| " + " | ".join(row) + " |")
            before = now
    return lines


def errors(figure: Any) -> None:
    """Error against tau, a panel a pile: slope 1 for the rigid limit, 2 for the first order."""
    axes = figure.subplots(2, 4, sharex=True, sharey=True).ravel()
    for ax, name in zip(axes, PANELS, strict=True):
        which = case(name)
        found = np.array([which.errors(nonlinear(which, tau), tau) for tau in TAUS])
        points = np.array(
            [which.errors(molecular(which.rigid.scene, tau, STOP), tau) for tau in MD_TAUS]
        )
        for column, colour, marker in ((0, "C1", "o"), (1, "C0", "s")):
            ax.loglog(TAUS, np.maximum(found[:, column], 1e-16), color=colour, lw=1.2)
            ax.loglog(MD_TAUS, points[:, column], marker, color=colour, ms=4, mfc="none")
        ax.plot([_BAR[0], _BAR[0], TAUS[0]], [1e-16, _BAR[1], _BAR[1]], ":", color="0.5", lw=0.8)
        limit, _ = which.first.range
        if limit is not None and float(limit) < TAUS[-1]:
            ax.axvline(float(limit), color="0.8", lw=3, zorder=0)
        ax.set_title(f"{name} (saddle)" if name in SADDLES else name, size=8)
        ax.set_xlim(TAUS[0], TAUS[-1])
        ax.set_ylim(1e-15, 30)
        ax.set_xticks([1e-7, 1e-5, 1e-3, 1e-1])
    first = axes[0]
    first.text(1.3e-7, 8e-3, "rigid limit,\nslope 1", color="C1", fontsize=7, va="bottom")
    first.text(2.5e-6, 3e-10, "first order,\nslope 2", color="C0", fontsize=7, va="top")
    axes[1].plot([], [], "ko", ms=4, mfc="none", label="LAMMPS, off the rigid limit")
    axes[1].plot([], [], "ks", ms=4, mfc="none", label="LAMMPS, off the first order")
    axes[1].plot([], [], ":", color="0.5", lw=0.8, label=r"$10^{-4}\,w$ at $\tau = 10^{-3}$")
    axes[1].plot([], [], color="0.8", lw=3, label="a contact changes here")
    figure.legend(*axes[1].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    figure.supxlabel(r"$\tau$ (disc radii a disc weight)", size=8)
    figure.supylabel("largest error of a force ($w$)", size=8)
