"""The chart of speed against accuracy: methods in groups, every curve named where it ends.

The frontier joins the answers that none is both faster and closer than. What lies below the shaded
line no method in floating point reaches on any setting: there only exact arithmetic answers.
"""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from benchmarks.comparison.looks import GROUP, LOOKS, Label, finish
from benchmarks.comparison.methods import METHODS
from benchmarks.comparison.table import Point, of

EXACT = 3e-18
"""Where answers without error stand on the logarithmic axis."""
_FLOOR = 1e-17  # an error of a float answer that rounds to none


def precision_chart(found: list[Point], scenes: list[str], columns: int = 2) -> Any:
    """Error against time, a panel for every scene; None where there is none."""
    if not scenes:
        return None
    columns = min(columns, len(scenes))
    rows = -(-len(scenes) // columns)
    size = (7.2 * columns, 5.2 * rows + 0.8)
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False)
    named = [
        (axis, _panel(axis, found, scene))
        for axis, scene in zip(axes.ravel(), scenes, strict=False)
    ]
    for axis in axes.ravel()[len(scenes) :]:
        axis.axis("off")
    finish(figure, named, [Line2D([], [], color="#d9c36a", lw=3, label="frontier")])
    return figure


def _panel(axis: Any, found: list[Point], scene: str) -> list[Label]:
    """Curves and frontier of one scene; the names that they need."""
    answers = {m.name: kept for m in METHODS if (kept := of(found, scene, m.name))}
    drawn: list[tuple[float, float]] = []
    labels: list[Label] = []
    for name, kept in answers.items():
        colour, mark = LOOKS[GROUP[name]]
        exact = "exact" in GROUP[name]
        kept = sorted(kept, key=lambda p: p.seconds)
        errors = [EXACT if exact and p.error == 0 else max(p.error, _FLOOR) for p in kept]
        times = [p.seconds for p in kept]
        axis.plot(times, errors, color=colour, marker=mark, markersize=5, lw=1)
        drawn += zip(times, errors, strict=True)
        end = errors.index(min(errors))
        labels.append((times[end], errors[end], name, colour))
    front = frontier(drawn)
    axis.step(*zip(*front, strict=True), where="post", color="#d9c36a", lw=5, alpha=0.6, zorder=0)
    axis.axhspan(8e-19, _FLOOR / 1.5, color="#08306b", alpha=0.07)
    axis.set(xscale="log", yscale="log", ylim=(8e-19, 10))
    low, high = axis.get_xlim()
    axis.set_xlim(low, high * 6)  # room for the names
    axis.set_yticks([1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1, EXACT])
    axis.set_yticklabels(["1e-15", "1e-12", "1e-9", "1e-6", "1e-3", "1", "exact"])
    axis.minorticks_off()
    one = next(p for p in found if p.scene == scene)
    axis.set_title(f"{scene}: {one.contacts} contacts, {one.dof} freedoms", fontsize=11)
    axis.grid(alpha=0.25)
    axis.set_xlabel("seconds, from scene to forces")
    axis.set_ylabel("largest error / largest force")
    return labels


def frontier(drawn: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The (time, error) that no other is both faster and closer than, by time.

    >>> frontier([(3, 1), (1, 5), (2, 6), (4, 2)])
    [(1, 5), (3, 1)]
    """
    front: list[tuple[float, float]] = []
    for time, error in sorted(drawn):
        if not front or error < front[-1][1]:
            front.append((time, error))
    return front
