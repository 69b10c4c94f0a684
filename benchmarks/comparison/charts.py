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
from benchmarks.comparison.methods import METHODS
from benchmarks.comparison.run import FULL, PANELS
from benchmarks.comparison.scenes import family, layers
from benchmarks.comparison.table import Point, exponent, fastest, of, points

_SHARE = 0.6
_ALWAYS = ("lammps, tau to 0", "FLINT dense", "lemke")
_NINE = min(THRESHOLDS, key=lambda t: abs(t / 1e-9 - 1))
LEVELS = (1e-3, 1e-6, 1e-9, 0.0)
_COLOURS = {
    "proved": "#08306b", "float start": "#2171b5", "lemke": "#6baed6", "lemke alone": "#9ecae1",
    "z": "#00838f", "continuation": "#80cbc4", "FLINT dense": "#7f7f7f",
    "Fractions": "#b0b0b0", "gmpy2": "#d0d0d0", "contacts": "#6a1b9a", "newton": "#c2185b",
    "lemke-float64": "#e91e63", "lemke-float32": "#f8bbd0",
    "z-float64": "#ab47bc", "z-float32": "#e1bee7", "gauss-seidel": "#ff8f00", "fire": "#ffd54f",
    "nnls": "#5d4037", "quantecon": "#a1887f", "lemkelcp": "#d7ccc8", "drake": "#8d6e63",
    "daqp": "#1b5e20", "quadprog": "#66bb6a", "clarabel": "#d32f2f", "piqp": "#f4511e",
    "osqp": "#9e9d24", "proxqp": "#43a047", "highs": "#26a69a", "lammps": "#212121",
    "lammps, tau to 0": "#757575",
}  # fmt: skip
_MARKS = {"exact": "s", "proof": "D", "float": "o", "peer": "^", "md": "*"}
GROUP = {m.name: m.group for m in METHODS}


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


def _style(name: str) -> dict[str, Any]:
    return {"color": _COLOURS[name], "marker": _MARKS[GROUP[name]], "markersize": 5, "lw": 1.2}


def _legend(figure: Any, axes: Any, columns: int = 8) -> None:
    seen: dict[str, Any] = {}
    for axis in np.ravel(axes):
        for line, label in zip(*axis.get_legend_handles_labels(), strict=True):
            seen.setdefault(label, line)
    names = [m.name for m in METHODS if m.name in seen]
    figure.legend(
        [seen[n] for n in names], names, loc="lower center", ncol=columns, fontsize=9, frameon=False
    )


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
    figure, axes = plt.subplots(2, len(kinds), figsize=(7.5 * len(kinds), 10.5), squeeze=False)
    for column, kind in enumerate(kinds):
        for name, curve in curves(found, kind).items():
            sizes = [p.dof for p in curve]
            axes[0, column].plot(sizes, [p.seconds for p in curve], label=name, **_style(name))
            axes[1, column].plot(sizes, [p.megabytes for p in curve], label=name, **_style(name))
            slope = growth(curve)
            if slope is not None:
                at = (sizes[-1], curve[-1].seconds)
                axes[0, column].annotate(f" {slope:.1f}", at, fontsize=8, color=_COLOURS[name])
        for axis in axes[:, column]:
            axis.set(xscale="log", yscale="log", xlabel="degrees of freedom solved for")
            axis.grid(alpha=0.25, which="both")
        axes[0, column].set_title(f"{kind}: time for an error below 1e-6, with exponents")
        axes[1, column].set_title(f"{kind}: peak memory of the process")
        axes[0, column].set_ylabel("seconds, from scene to forces")
        axes[1, column].set_ylabel("MB")
    _legend(figure, axes)
    figure.tight_layout(rect=(0, 0.09, 1, 1))
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
    figure, axes = plt.subplots(1, len(scenes) + 1, figsize=(4.6 * (len(scenes) + 1), 6.2))
    for axis, scene in zip(axes, scenes, strict=False):
        for m in floats:
            answer = most_exact(found, scene, m.name)
            if answer is not None:
                axis.plot(THRESHOLDS, answer.wrong_loaded, label=m.name, **_style(m.name))
        axis.set(xscale="log", xlabel="threshold / largest force")
        axis.invert_xaxis()
        axis.set_title(f"{scene}: contacts named wrongly", fontsize=10)
    axes[0].set_ylabel("loaded or not, wrong (most exact setting)")
    last, at = axes[-1], THRESHOLDS.index(_NINE)
    sizes = sorted({p.scene for p in found if family(p.scene) == "tbs"}, key=layers)
    for m in floats:
        kept = [p for s in sizes if (p := most_exact(found, s, m.name)) is not None]
        wrong = [p.wrong_loaded[at] for p in kept]
        if kept:
            last.plot([p.dof for p in kept], wrong, label=m.name, **_style(m.name))
    last.set(xscale="log", xlabel="degrees of freedom")
    last.set_title(f"tbs: wrong at the threshold {_NINE:g}", fontsize=10)
    for axis in axes:
        axis.set_yscale("symlog", linthresh=1)
        axis.set_ylim(bottom=-0.2)
        axis.grid(alpha=0.25)
    _legend(figure, axes)
    figure.tight_layout(rect=(0, 0.16, 1, 1))
    return figure


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
    figure, axes = plt.subplots(2, 2, figsize=(14, 11.5), sharey=True)
    for axis, level in zip(axes.ravel(), LEVELS, strict=True):
        for name, ratios in profile(found, level).items():
            if np.isfinite(ratios).mean() < _SHARE and name not in _ALWAYS:
                continue
            x = np.sort(ratios)
            y = np.arange(1, len(x) + 1) / len(x)
            keep = np.isfinite(x)
            x, y = np.append(x[keep], 1000.0), np.append(y[keep], y[keep][-1])
            style = _style(name) | {"markersize": 3, "lw": 1.6}
            axis.step(x, y, where="post", label=name, **style)
        axis.set(xscale="log", xlim=(0.95, 1000), ylim=(0, 1.03))
        axis.set_xlabel("time over the best, at most")
        axis.set_title("exact" if level == 0 else f"error at most {level:g}")
        axis.grid(alpha=0.25)
    for axis in axes[:, 0]:
        axis.set_ylabel("share of all scenes")
    _legend(figure, axes)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    return figure
