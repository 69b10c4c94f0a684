"""The charts of the comparison, from the rows alone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from benchmarks.comparison import csv_rows
from benchmarks.comparison.chart_of_precision import precision_chart
from benchmarks.comparison.chart_of_z import z_chart
from benchmarks.comparison.judge import THRESHOLDS
from benchmarks.comparison.looks import Label, finish, style
from benchmarks.comparison.methods import METHODS
from benchmarks.comparison.run import FULL, PANELS
from benchmarks.comparison.scenes import family, layers
from benchmarks.comparison.table import Point, exponent, fastest, of, points

_SHARE = 0.6
_ALWAYS = ("lammps, tau to 0", "FLINT dense", "lemke")
_NINE = min(THRESHOLDS, key=lambda t: abs(t / 1e-9 - 1))
LEVELS = (1e-3, 1e-6, 1e-9, 0.0)


def draw(folder: Path, figures: Path) -> tuple[str, ...]:
    """Draw every chart that the rows in a folder suffice for; the names of the files."""
    found = points(csv_rows.read(folder / "methods.csv"))
    rows = csv_rows.read(folder / "z_against_lemke.csv")
    figures.mkdir(parents=True, exist_ok=True)
    charts: tuple[tuple[str, Callable[[], Any]], ...] = (
        ("work_precision.png", lambda: _precision(found)),
        ("speed_and_accuracy.png", lambda: _one_precision(found)),
        ("scaling.png", lambda: _scaling(found)),
        ("wrong_states.png", lambda: _wrong_states(found)),
        ("profile.png", lambda: _profile(found)),
        ("z_against_lemke.png", lambda: z_chart(rows)),
    )
    drawn = []
    for name, make in charts:
        figure = make()
        if figure is not None:
            figure.savefig(figures / name, dpi=100)
            plt.close(figure)
            drawn.append(name)
    return tuple(drawn)


def _precision(found: list[Point]) -> Any:
    """All scenes that have a panel."""
    present = {p.scene for p in found}
    return precision_chart(found, [s for s in PANELS if s in present] or sorted(present))


def _one_precision(found: list[Point]) -> Any:
    """The scene of the README."""
    present = {p.scene for p in found}
    return precision_chart(found, [s for s in ("nt30 20",) if s in present])


def curves(found: list[Point], kind: str) -> dict[str, list[Point]]:
    """For every method its fastest answer within 1e-6 on each size of a family, by size."""
    scenes = sorted({p.scene for p in found if family(p.scene) == kind}, key=layers)
    curve = {}
    for m in METHODS:
        chosen = [fastest(of(found, s, m.name), 1e-6) for s in scenes]
        kept = [p for p in chosen if p is not None]
        if kept:
            curve[m.name] = kept
    return curve


def growth(curve: list[Point]) -> float | None:
    """The exponent of the time in the freedoms, over the sizes of 100 freedoms and more."""
    large = [p for p in curve if p.dof >= 100]
    return exponent([p.dof for p in large], [p.seconds for p in large])


def _scaling(found: list[Point]) -> Any:
    kinds = [k for k in ("tbs", "nt30") if any(len(c) > 1 for c in curves(found, k).values())]
    if not kinds:
        return None
    figure, axes = plt.subplots(2, len(kinds), figsize=(8 * len(kinds), 13), squeeze=False)
    named = []
    for column, kind in enumerate(kinds):
        times: list[Label] = []
        sizes: list[Label] = []
        for name, curve in curves(found, kind).items():
            dof, look = [p.dof for p in curve], style(name)
            axes[0, column].plot(dof, [p.seconds for p in curve], **look)
            axes[1, column].plot(dof, [p.megabytes for p in curve], **look)
            slope = growth(curve)
            known = name if slope is None else f"{name} {slope:.1f}"
            times.append((dof[-1], curve[-1].seconds, known, look["color"]))
            sizes.append((dof[-1], curve[-1].megabytes, name, look["color"]))
        for axis, labels in zip(axes[:, column], (times, sizes), strict=True):
            axis.set(xscale="log", yscale="log", xlabel="degrees of freedom solved for")
            axis.set_xlim(right=axis.get_xlim()[1] * 3)  # room for the names
            axis.grid(alpha=0.25)
            named.append((axis, labels))
        axes[0, column].set_title(f"{kind}: time for an error below 1e-6, with exponents")
        axes[1, column].set_title(f"{kind}: peak memory of the process")
        axes[0, column].set_ylabel("seconds, from scene to forces")
        axes[1, column].set_ylabel("MB")
        low, high = axes[1, column].get_ylim()
        ticks = [t for t in (50, 70, 100, 150, 200, 300, 500, 700) if low <= t <= high]
        axes[1, column].set_yticks(ticks, map(str, ticks))
        axes[1, column].minorticks_off()
    finish(figure, named)
    return figure


def most_exact(found: list[Point], scene: str, method: str) -> Point | None:
    """A method's answer with the least error on a scene."""
    return min(of(found, scene, method), key=lambda p: p.error, default=None)


def _wrong_states(found: list[Point]) -> Any:
    """Floating-point methods only: exact ones take signs, and no threshold."""
    floats = [m for m in METHODS if m.group != "exact"]
    present = {p.scene for p in found}
    scenes = [s for s in ("nt30 20", "tss 40", "tbs 100") if s in present] or sorted(present)[:2]
    if not scenes:
        return None
    figure, axes = plt.subplots(1, len(scenes) + 1, figsize=(4.8 * (len(scenes) + 1), 5.6))
    named = []
    for axis, scene in zip(axes, scenes, strict=False):
        labels: list[Label] = []
        for m in floats:
            answer = most_exact(found, scene, m.name)
            if answer is not None:
                labels += _wrong(axis, list(THRESHOLDS), answer.wrong_loaded, m.name)
        axis.set(xscale="log", xlabel="threshold / largest force")
        axis.set_xlim(axis.get_xlim()[1], axis.get_xlim()[0] / 1e3)  # falling; room for names
        axis.set_xticks([1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14])
        axis.set_title(f"{scene}: contacts named wrongly", fontsize=10)
        named.append((axis, labels))
    axes[0].set_ylabel("loaded or not, wrong (most exact setting)")
    last, at = axes[-1], THRESHOLDS.index(_NINE)
    sizes = sorted({p.scene for p in found if family(p.scene) == "tbs"}, key=layers)
    labels = []
    for m in floats:
        kept = [p for s in sizes if (p := most_exact(found, s, m.name)) is not None]
        if kept:
            wrong = [p.wrong_loaded[at] for p in kept]
            labels += _wrong(last, [p.dof for p in kept], wrong, m.name)
    last.set(xscale="log", xlabel="degrees of freedom")
    last.set_xlim(right=last.get_xlim()[1] * 5)
    last.set_title(f"tbs: wrong at the threshold {_NINE:g}", fontsize=10)
    named.append((last, labels))
    for axis in axes:
        axis.set_yscale("symlog", linthresh=1)
        high = 2 * axis.get_ylim()[1]
        axis.set_ylim(-0.4, high)
        ticks = [t for t in (0, 1, 10, 100, 1000) if t <= high]
        axis.set_yticks(ticks, map(str, ticks))
        axis.grid(alpha=0.25)
        axis.text(0.98, 0.02, "no name: none wrong at the end", fontsize=7.5, ha="right",
                  transform=axis.transAxes)  # fmt: skip
    finish(figure, named)
    return figure


def _wrong(axis: Any, x: Any, wrong: Any, name: str) -> list[Label]:
    """A curve, and its name if it does not end with nothing wrong, where all others end."""
    look = style(name)
    axis.plot(x, wrong, **look)
    return [(x[-1], wrong[-1], name, look["color"])] if wrong[-1] else []


def profile(found: list[Point], error: float) -> dict[str, list[float]]:
    """Dolan and More: for every method its time over the best on each scene (inf: failed)."""
    scenes = sorted({p.scene for p in found} & set(FULL))
    table: dict[str, list[float]] = {m.name: [] for m in METHODS}
    for scene in scenes:
        best = fastest((p for p in found if p.scene == scene), error)
        if best is None:
            continue
        for m in METHODS:
            own = fastest(of(found, scene, m.name), error)
            table[m.name].append(own.seconds / best.seconds if own else float("inf"))
    return {name: ratios for name, ratios in table.items() if np.isfinite(ratios).any()}


def _profile(found: list[Point]) -> Any:
    if not found:
        return None
    figure, axes = plt.subplots(2, 2, figsize=(16, 14), sharey=True)
    named = []
    for axis, level in zip(axes.ravel(), LEVELS, strict=True):
        labels: list[Label] = []
        for name, ratios in profile(found, level).items():
            if np.isfinite(ratios).mean() < _SHARE and name not in _ALWAYS:
                continue
            x = np.sort(ratios)
            y = np.arange(1, len(x) + 1) / len(x)
            keep = np.isfinite(x)
            x, y = x[keep], y[keep]
            look = style(name)
            labels.append((x[-1], y[-1], name, look["color"]))
            ends = np.append(x, 1000.0), np.append(y, y[-1])
            axis.step(*ends, where="post", **(look | {"markersize": 3}))
        axis.set(xscale="log", xlim=(0.95, 2500), ylim=(0, 1.12))
        axis.set_yticks([0, 0.2, 0.4, 0.6, 0.8, 1])
        axis.set_xlabel("time over the best, at most (named where it has solved all that it can)")
        axis.set_title("exact" if level == 0 else f"error at most {level:g}")
        axis.grid(alpha=0.25)
        named.append((axis, labels))
    for axis in axes[:, 0]:
        axis.set_ylabel("share of all scenes")
    finish(figure, named)
    return figure
