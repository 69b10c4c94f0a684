"""The chart of the Z algorithm against Lemke's method, from the rows alone."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from benchmarks.comparison import csv_rows


def z_chart(rows: list[csv_rows.Row]) -> Any:
    """Work, time and endings of both, over sizes, random gaps and random starts."""
    if not rows:
        return None
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.8))
    colours = {"nt30": "#08306b", "nt60": "#00838f", "tss": "#c2185b", "tbs": "#ff8f00"}
    for kind, colour in colours.items():
        mine = [r for r in rows if r["study"] == "sizes" and r["scene"].startswith(kind)]
        mine = [r for r in mine if r["z_iterations"] and r["lemke_pivots"]]
        size = [int(r["contacts"]) for r in mine]
        systems = [int(r["z_iterations"]) + int(r["reintroductions"]) for r in mine]
        axes[0].plot(size, systems, "o-", color=colour, label=f"{kind}: systems of Z")
        pivots = [int(r["lemke_pivots"]) for r in mine]
        axes[0].plot(size, pivots, "s--", color=colour, label=f"{kind}: pivots of Lemke")
        ratio = [float(r["z_seconds"]) / float(r["lemke_seconds"]) for r in mine]
        axes[1].plot(size, ratio, "o-", color=colour, label=kind)
    axes[0].set(xscale="log", yscale="log", xlabel="contacts", title="perfect lattices: work")
    axes[1].set(xscale="log", yscale="log", xlabel="contacts", title="time of Z over that of Lemke")
    axes[1].axhline(1, color="k", lw=0.6)
    for axis in axes[:2]:
        axis.set_xticks([20, 50, 100, 200, 400], ["20", "50", "100", "200", "400"])
        axis.set_yticks(ticks := [0.3, 0.5, 1, 2, 4] if axis is axes[1] else [2, 5, 10, 20, 50])
        axis.set_yticklabels(map(str, ticks))
        axis.minorticks_off()
        axis.grid(alpha=0.25)
    axes[0].legend(fontsize=7, ncol=2)
    axes[1].legend(fontsize=8)
    studies = [(s, k) for s in ("sizes", "gaps", "starts") for k in colours]
    bottom = np.zeros(len(studies))
    for status, colour in (("solved", "#2171b5"), ("cycle", "#d32f2f"), ("other", "#9e9e9e")):
        share = [
            sum(_status(r) == status for r in rows if r["study"] == s and r["scene"].startswith(k))
            for s, k in studies
        ]
        axes[2].bar(range(len(studies)), share, bottom=bottom, color=colour, label=status)
        bottom += share
    axes[2].set_xticks(range(len(studies)), [f"{k}\n{s}" for s, k in studies], fontsize=7)
    axes[2].set(title="how the Z algorithm ended", ylabel="runs")
    axes[2].legend(fontsize=8)
    figure.tight_layout()
    return figure


def _status(row: csv_rows.Row) -> str:
    return row["z_status"] if row["z_status"] in ("solved", "cycle") else "other"
