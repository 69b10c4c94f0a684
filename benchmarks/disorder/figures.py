"""The figures of notes/disorder.md, from the rows and curves of the study."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.disorder.study import AMPLITUDES, PILES, curves, rows
from lcp_piles.pictures import save

_COLOURS = {"nt30": "#1b1b1b", "nt60": "#c1121f", "tss": "#2166ac", "tbs": "#2e8b57"}
_MARKERS = {"nt30": "o", "nt60": "s", "tss": "^", "tbs": "D"}
_LARGE = PILES[4:]
_KINDS = [kind for kind, _ in _LARGE]


def draw_all(folder: Path) -> None:
    """Draw all figures into a folder."""
    found = rows()
    for name, figure in (
        ("contacts", _contacts(found)),
        ("exponents", _exponents(found)),
        ("dip", _dip(found)),
        ("forces", _forces(curves())),
        ("base", _base(curves())),
    ):
        save(figure, folder / f"disorder-{name}.png")


def _contacts(found: list[dict[str, str]]) -> Figure:
    figure = Figure(figsize=(9.6, 7), layout="constrained")
    axes = figure.subplots(2, 2)
    panels = (
        ("contacts less freedoms", "freedoms", "(contacts with force $-$ freedoms) / freedoms"),
        ("self-stresses", "freedoms", "self-stresses / freedoms"),
        ("mechanisms", "freedoms", "mechanisms / freedoms"),
        ("share of saddles", "", "share of saddles"),
    )
    for ax, (name, over, label) in zip(axes.ravel(), panels, strict=True):
        _curves_of(ax, found, name, over)
        ax.set_ylabel(label)
        ax.axhline(0, color="grey", linewidth=0.6)
    axes[0, 0].legend(frameon=False, fontsize=8, ncols=2)
    return figure


def _exponents(found: list[dict[str, str]]) -> Figure:
    figure = Figure(figsize=(9.6, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    _curves_of(left, found, "small_forces")
    left.set_ylabel(r"$\alpha$ of small forces, $P \sim x^\alpha$")
    left.set_ylim(-1, 1)
    _curves_of(right, found, "exponential_tail")
    right.set_ylabel(r"$\beta$ of the tail, $P \sim e^{-\beta x}$")
    left.legend(frameon=False, fontsize=8, ncols=2)
    return figure


def _dip(found: list[dict[str, str]]) -> Figure:
    figure = Figure(figsize=(9.6, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    _curves_of(left, found, "dip of the mean (w)", kinds=("nt30", "nt60"))
    left.set_ylabel("depth of the dip of the mean pressure ($w$)")
    left.axhline(0, color="grey", linewidth=0.6)
    _curves_of(right, found, "share with a dip", kinds=("nt30", "nt60"))
    right.set_ylabel("share of samples with a dip")
    left.legend(frameon=False, fontsize=8)
    return figure


def _curves_of(
    ax: Axes, found: list[dict[str, str]], name: str, over: str = "", kinds: Any = _KINDS
) -> None:
    """A number against the amplitude, with its band, for each pile in two sizes."""
    for kind, layers in PILES:
        if kind not in kinds:
            continue
        mine = [r for r in found if (r["kind"], int(r["layers"])) == (kind, layers) and r[name]]
        if not mine:
            continue
        x = [float(r["amplitude"]) for r in mine]
        value, low, high = (
            [float(r[name + part]) / (float(r[over]) if over else 1.0) for r in mine]
            for part in ("", ": low", ": high")
        )
        large = (kind, layers) in _LARGE
        ax.errorbar(
            x,
            value,
            yerr=[
                [max(v - w, 0) for v, w in zip(value, low, strict=True)],
                [max(w - v, 0) for v, w in zip(value, high, strict=True)],
            ],
            color=_COLOURS[kind],
            marker=_MARKERS[kind],
            markersize=4,
            markerfacecolor=_COLOURS[kind] if large else "white",
            linestyle="-" if large else ":",
            linewidth=1,
            capsize=2,
            label=f"{kind.upper()} {layers}",
        )
    ax.set_xscale("log")
    ax.set_xlabel(r"amplitude of the gaps ($w\tau$)")
    ax.tick_params(direction="in", which="both", top=True, right=True)


def _forces(found: dict[str, Any]) -> Figure:
    def draw(ax: Axes, curve: dict[str, Any], **look: Any) -> None:
        ax.plot(curve["f"], curve["density"], **look)

    figure = _by_amplitude(found, draw)
    for ax in figure.axes:
        ax.set(xscale="log", yscale="log", xlim=(1e-4, 20), ylim=(1e-5, 50))
        ax.set(xlabel=r"$f/\langle f\rangle$", ylabel=r"$P(f/\langle f\rangle)$")
        ax.tick_params(direction="in", which="both", top=True, right=True)
    return figure


def _base(found: dict[str, Any]) -> Figure:
    def draw(ax: Axes, curve: dict[str, Any], **look: Any) -> None:
        ax.errorbar(curve["x"], curve["pressure"], yerr=curve["pressure error"], **look)

    figure = _by_amplitude(found, draw)
    for ax in figure.axes:
        ax.set_ylim(bottom=0)
        ax.set(xlabel="$x$  ($R$)", ylabel="mean normal force on the base  ($w$)")
        ax.tick_params(direction="in", top=True, right=True)
    return figure


def _by_amplitude(found: dict[str, Any], draw: Callable[..., None]) -> Figure:
    """A panel for each of the large piles, in it a curve for each amplitude."""
    figure = Figure(figsize=(9.6, 7.4), layout="constrained")
    for ax, (kind, layers) in zip(figure.subplots(2, 2).ravel(), _LARGE, strict=True):
        for amplitude, colour in _shades():
            curve = found.get(f"{kind} {layers} {amplitude}")
            if curve:
                draw(ax, curve, color=colour, linewidth=1, label=amplitude)
        ax.set_title(f"{kind.upper()} {layers}", fontsize=10)
    _legend(figure, ax)
    return figure


def _legend(figure: Figure, ax: Axes) -> None:
    handles, labels = ax.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside right center", frameon=False, fontsize=8,
        title="amplitude\n" r"($w\tau$)", title_fontsize=8,
    )  # fmt: skip


def _shades() -> list[tuple[str, Any]]:
    shades = colormaps["viridis"]
    return [(a, shades(0.9 * i / (len(AMPLITUDES) - 1))) for i, a in enumerate(AMPLITUDES)]
