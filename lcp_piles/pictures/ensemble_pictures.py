"""Pictures of the statistics of an ensemble, each with its confidence band."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from ..ensembles import force_distribution as ends
from ..ensembles.ensemble import Ensemble
from ..ensembles.statistics import Statistics
from ..errors import InputError
from ..fields.field import DiscTensors
from ..numbers.vectors import FloatArray
from ..scenes.scene import Scene
from .drawing import (
    BLACK,
    BLUE,
    RED,
    between,
    contact_segments,
    disc_positions,
    disc_radii,
    draw_pile,
    frame,
    page,
    scene_title,
)
from .field_pictures import draw_field

_BAND = 0.25
_PLANE = 2


def found_of(ensemble: Ensemble) -> Statistics:
    """The statistics of an ensemble; `InputError` where it has none."""
    if ensemble.statistics is None:
        raise InputError("the ensemble", ensemble, "one with samples and their forces")
    return ensemble.statistics


def ensemble_title(ensemble: Ensemble) -> str:
    """The scene, the disorder and the number of samples."""
    manifest = ensemble.manifest
    amplitude = manifest.disorder.amplitude
    return (
        f"{scene_title(manifest.scene)}: gaps of amplitude {amplitude} $w\\tau$, "
        f"{ensemble.samples:,} samples"
    )


def draw_mean_pressure(ensemble: Ensemble, ax: Axes | None = None) -> Axes:
    """The mean normal force on the base with its confidence band, and the spread of samples."""
    found = found_of(ensemble)
    x, mean = found.observables.base, found.base_pressure
    if not len(x):
        raise InputError("the scene", found.observables.scene, "a plane one, with a base row")
    spread = found.base_spread.value
    ax = ax or _curves()
    ax.fill_between(
        x,
        mean.value - spread,
        mean.value + spread,
        color=BLUE,
        alpha=0.15,
        linewidth=0,
        label="one standard deviation of a sample",
    )
    ax.fill_between(
        x,
        mean.low,
        mean.high,
        color=RED,
        alpha=0.5,
        linewidth=0,
        label="95 % band of the mean",
    )
    ax.plot(x, mean.value, color=BLACK, marker="o", markersize=3, linewidth=1.2, label="mean")
    ax.set_ylim(bottom=min(0.0, float((mean.value - spread).min())))
    _labels(ax, ensemble, "$x$  ($R$)", "normal force on the base  ($w$)")
    return ax


def draw_force_density(ensemble: Ensemble, axes: tuple[Axes, Axes] | None = None) -> Figure:
    """P(f / <f>) with its band and the fits: logarithmic upwards, and both ways."""
    found = found_of(ensemble)
    if axes is None:
        figure = Figure(figsize=(9.6, 4.0), layout="constrained")
        left, right = figure.subplots(1, 2)
    else:
        left, right = axes
        figure = page(left)
    middles = np.sqrt(ends.EDGES[:-1] * ends.EDGES[1:])
    density = found.density
    seen = density.value > 0
    for ax in (left, right):
        ax.fill_between(
            middles[seen],
            np.maximum(density.low[seen], 1e-12),
            density.high[seen],
            color=BLUE,
            alpha=_BAND,
            linewidth=0,
        )
        ax.plot(middles[seen], density.value[seen], color=BLUE, linewidth=1, label="samples")
        ax.set_yscale("log")
        ax.set_ylabel(r"$P(f/\langle f\rangle)$")
        ax.tick_params(direction="in", which="both", top=True, right=True)
    _draw_fits(found, left, right)
    left.set_xlim(0, float(middles[seen].max()) * 1.03)
    left.set_ylim(bottom=float(density.value[seen & (middles > 0.1)].min(initial=1.0)) / 2)
    right.set_xscale("log")
    right.set_ylim(bottom=float(density.value[seen].min()) / 5)
    for ax in (left, right):
        ax.set_xlabel(r"$f/\langle f\rangle$")
        ax.legend(frameon=False, fontsize=8)
    figure.suptitle(ensemble_title(ensemble), fontsize=11)
    return figure


def _draw_fits(found: Statistics, left: Axes, right: Axes) -> None:
    """The fitted tails on the left, the fitted power of small forces on the right."""
    histogram = found.tally.means()["histogram"]
    total = histogram.sum()
    tail = ends.EDGES[:-1] >= ends.TAIL * (1 - 1e-9)
    x = np.linspace(ends.TAIL, float(ends.EDGES[1:][histogram > 0].max()), 100)
    share = histogram[tail].sum() / total
    for fit, shape, name, colour, style in (
        (found.exponential_tail, _exponential, r"$e^{-\beta x}$, $\beta = $", RED, "-"),
        (found.normal_tail, _normal, r"$e^{-\gamma x^2}$, $\gamma = $", BLACK, "--"),
    ):
        value = float(fit.parameter.value)
        if np.isfinite(value):
            tail_of = share * shape(x, value)
            left.plot(x, tail_of, color=colour, linestyle=style, label=f"{name}{value:.3g}")
    alpha = float(found.small_forces.parameter.value)
    if np.isfinite(alpha):
        x = np.geomspace(ends.SMALL / 1e3, ends.SMALL, 50)
        small = histogram[ends.EDGES[1:] <= ends.SMALL * (1 + 1e-9)].sum() / total
        power = small * (1 + alpha) / ends.SMALL * (x / ends.SMALL) ** alpha
        right.plot(x, power, color=RED, label=rf"$x^\alpha$, $\alpha = ${alpha:.3g}")


def _exponential(x: FloatArray, beta: float) -> FloatArray:
    density: FloatArray = beta * np.exp(-beta * (x - ends.TAIL))
    return density


def _normal(x: FloatArray, gamma: float) -> FloatArray:
    from scipy.special import erfcx

    root = np.sqrt(gamma)
    norm = np.sqrt(np.pi) / (2 * root) * erfcx(root * ends.TAIL)
    density: FloatArray = np.exp(-gamma * (x * x - ends.TAIL**2)) / norm
    return density


def draw_closing_map(ensemble: Ensemble, ax: Axes | None = None) -> Axes:
    """The probability that each contact carries a force, on the pile."""
    found = found_of(ensemble)
    ax, scene, unit = _pile(found, ax)
    lines = LineCollection(
        list(contact_segments(scene, disc_positions(scene))),
        array=found.closing.value,
        cmap="viridis",
        linewidths=between(0.35 * unit, 1.0, 6.0),
        capstyle="round",
        zorder=3,
    )
    lines.set_clim(0, 1)
    lines.set_label("closing")
    ax.add_collection(lines, autolim=False)
    bar = page(ax).colorbar(lines, ax=ax, orientation="horizontal", shrink=0.6, pad=0.04)
    bar.set_label("share of samples in which the contact carries a force")
    ax.set_title(ensemble_title(ensemble), fontsize=10)
    return ax


def _pile(found: Statistics, ax: Axes | None) -> tuple[Axes, Scene, float]:
    scene = found.observables.scene
    positions = disc_positions(scene)
    ax, unit = frame(positions, ax, disc_radii(scene))
    draw_pile(ax, scene, positions, unit)
    return ax, scene, unit


def draw_mean_stress(ensemble: Ensemble, ax: Axes | None = None) -> Axes:
    """The mean stress of every movable disc."""
    found = found_of(ensemble)
    scene = found.observables.scene
    fixed = np.array([disc.fixed for disc in scene.discs])
    xx, xy, yy = found.stress.value.reshape(-1, 3).T / np.pi
    tensors = np.stack([xx, xy, xy, yy], axis=1).reshape(-1, 2, 2)
    tensors[fixed] = np.nan
    ax = draw_field(DiscTensors(scene, tensors, "compression", "tension", -1, "w/R"), ax)
    ax.set_title("mean stress, " + ensemble_title(ensemble), fontsize=10)
    return ax


def draw_correlation(ensemble: Ensemble, ax: Axes | None = None) -> Axes:
    """The correlation of the forces of two contacts against their distance."""
    found = found_of(ensemble)
    distance, value = found.observables.pairs.distances, found.correlation
    ax = ax or _curves()
    ax.axhline(0, color=BLACK, linewidth=0.6)
    known = np.isfinite(value.value)
    ax.fill_between(
        distance[known],
        value.low[known],
        value.high[known],
        color=RED,
        alpha=0.5,
        linewidth=0,
        label="95 % band",
    )
    ax.plot(
        distance[known],
        value.value[known],
        color=BLACK,
        marker="o",
        markersize=3,
        linewidth=1,
        label="correlation",
    )
    _labels(ax, ensemble, "distance of two contacts  ($R$)", "correlation of their forces")
    return ax


def pictures_of(ensemble: Ensemble) -> Iterator[tuple[str, Axes | Figure]]:
    """Every picture that there is of an ensemble, under a name for its file."""
    yield "force_density", draw_force_density(ensemble)
    yield "correlation", draw_correlation(ensemble)
    if ensemble.manifest.scene.dimension == _PLANE:
        yield "base_pressure", draw_mean_pressure(ensemble)
        yield "closing_map", draw_closing_map(ensemble)
        yield "mean_stress", draw_mean_stress(ensemble)


def _curves() -> Axes:
    return Figure(figsize=(6, 3.8), layout="constrained").add_subplot()


def _labels(ax: Axes, ensemble: Ensemble, x: str, y: str) -> None:
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.tick_params(direction="in", top=True, right=True)
    ax.legend(frameon=False, fontsize=8)
    ax.set_title(ensemble_title(ensemble), fontsize=10)
