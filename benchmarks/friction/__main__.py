"""The tables and figures of `notes/friction.md`.

    python -m benchmarks.friction [NAME ...]

Computes everything anew, prints the tables and writes notes/figures/friction-NAME.png; all names
by default: critical, intervals, widths, base, dimensions, corners, closure.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from time import perf_counter

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from lcp_piles import (
    Scene,
    Surd,
    contact_bounds,
    critical_friction,
    extremes,
    first_loading,
    force_bounds,
    indeterminacy,
    pile,
    solve,
    surd,
)
from lcp_piles.friction.first_loading import UnresolvedError
from lcp_piles.friction.functionals import Functional, combined, force_on, weights
from lcp_piles.scenes.names import end_name

FOLDER = Path(__file__).parents[2] / "notes" / "figures"
COLOURS = {"nt60": "#0072b2", "nt30": "#d55e00", "tss": "#009e73", "tbs": "#cc79a7"}
SIZES = range(2, 11)
WIDTH = Fraction(1, 10**5)
CENTRE, NEXT = {((6, 8), "floor"): 1}, {((6, 6), "floor"): 1}
DIP = combined([(1, CENTRE), (-1, NEXT)])
SCALE = range(11)  # mu = k sqrt(3) / 20


def critical(ax: Axes) -> list[str]:
    """The least friction of discs and floor at which a pile stands by itself, by size."""
    lines = ["| N | " + " | ".join(k.upper() for k in ("nt60", "nt30", "tss")) + " |"]
    lines.append("|---|---|---|---|")
    found = {}
    for kind in ("nt60", "nt30", "tss"):
        for layers in SIZES:
            found[kind, layers] = critical_friction(pile(kind, layers), WIDTH)
        values = [float(found[kind, layers].upper) for layers in SIZES]
        ax.plot(SIZES, values, "o-", color=COLOURS[kind], label=kind.upper(), ms=4)
    ax.set(xlabel="layers $N$", ylabel=r"least friction $\mu$", xticks=list(SIZES))
    ax.legend()
    for layers in SIZES:
        cells = [f"{float(found[k, layers].upper):.5f}" for k in ("nt60", "nt30", "tss")]
        lines.append(f"| {layers} | " + " | ".join(cells) + " |")
    return lines


def intervals(ax: Axes) -> list[str]:
    """What balance leaves open of the dip of NT30 6, by friction, and what elasticity chooses."""
    scene = pile("nt30", 6)
    lines = ["| mu | least | largest | first loading |", "|---|---|---|---|"]
    mus, ends, loaded = [], [], []
    centre, side = (scene_index(scene, what) for what in (CENTRE, NEXT))
    for k in SCALE:
        mu = surd("sqrt(3)") * Fraction(k, 20)
        bounds = force_bounds(scene, mu, DIP)
        forces = first_loading(scene, mu).network.normal
        mus.append(float(mu))
        both = (bounds.least.value, bounds.largest.value)
        ends.append([np.nan if x is None else float(x) for x in both])
        loaded.append(float(forces[centre] - forces[side]))
        text = " | ".join("none" if np.isnan(x) else f"{x:.6f}" for x in ends[-1])
        lines.append(f"| {mu} | {text} | {loaded[-1]:.6f} |")
    low, high = np.array(ends).T
    ax.fill_between(mus, low, high, color="#a9cbe8", label="what balance admits")
    ax.plot(mus, loaded, "k.-", lw=1, label="first loading, springs alike")
    ax.axhline(0, color="0.6", lw=0.6)
    ax.set(xlabel=r"friction $\mu$ between discs", ylabel="$f(6,8) - f(6,6)$ in $w$")
    ax.legend()
    return lines


def scene_index(scene: Scene, what: dict[tuple[object, object], int]) -> int:
    (ends,) = what
    return next(k for k, c in enumerate(scene.contacts) if (c.a, c.b) == ends)


def widths(ax: Axes) -> list[str]:
    """Interval of every floor force of NT30 6, without friction and with it."""
    scene = pile("nt30", 6)
    floor = [k for k, c in enumerate(scene.contacts) if c.b == "floor"]
    places = [float(scene.disc(scene.contacts[k].a).position[0]) for k in floor]
    elastic = solve(scene).force_array
    for mu, colour, shift in (("0", "#0072b2", -0.25), ("1/10*sqrt(3)", "#d55e00", 0.25)):
        bounds = contact_bounds(scene, mu)
        low = [float(bounds.least[k]) for k in floor]
        high = [float(bounds.largest[k] or "nan") for k in floor]
        xs = np.array(places) + shift
        label = r"$\mu = 0$" if mu == "0" else r"$\mu = \sqrt{3}/10$"
        ax.vlines(xs, low, high, color=colour, lw=3, label=label)
    ax.plot(places, elastic[floor], "k.", label="elastic, without friction")
    ax.set(xlabel="place on the floor in $R$", ylabel="floor force in $w$")
    ax.margins(y=0.15)
    ax.legend(ncols=3, loc="upper center")
    return []


def base(axes: Sequence[Axes]) -> list[str]:
    """Interval of the force on the base under the apex against friction, for each pile."""
    lines = ["| pile | mu | least | largest | first loading |", "|---|---|---|---|---|"]
    for ax, kind in zip(axes, COLOURS, strict=True):
        scene = pile(kind, 6)
        last = max(disc.id[0] for disc in scene.discs)
        row = [disc for disc in scene.discs if disc.id[0] == last]
        middle = min(row, key=lambda disc: abs(float(disc.position[0])))
        what = {(middle.id, "floor"): 1} if scene.supports else force_on(scene, middle.id, 1)
        sign = 1 if scene.supports else -1  # what acts on a held disc points down
        mus, ends, loaded = [], [], []
        for k in SCALE:
            mu = surd("sqrt(3)") * Fraction(k, 20)
            bounds = force_bounds(scene, mu, combined([(sign, what)]))
            mus.append(float(mu))
            both = (bounds.least.value, bounds.largest.value)
            ends.append([np.nan if x is None else float(x) for x in both])
            loaded.append(_loaded(scene, mu, combined([(sign, what)])))
            low, high, own = (f"{x:.6f}".replace("nan", "none") for x in (*ends[-1], loaded[-1]))
            if k in (0, 2, 10):
                lines.append(f"| {kind.upper()} 6 | {mu} | {low} | {high} | {own} |")
        low, high = np.array(ends).T
        ax.fill_between(mus, low, high, color="#a9cbe8", label="what balance admits")
        ax.plot(mus, loaded, "k.-", lw=1, label="first loading")
        ax.set(xlabel=r"friction $\mu$ between discs", ylabel="force in $w$")
        ax.set_title(f"{kind.upper()} 6: on the base at disc {end_name(middle.id)}", fontsize=8)
        ax.set_ylim(bottom=0)
    axes[0].legend(loc="upper left")
    return lines


def _loaded(scene: Scene, mu: Surd, what: Functional) -> float:
    """The functional in first loading; nan where that is unresolved."""
    try:
        network = first_loading(scene, mu).network
    except UnresolvedError:
        return float("nan")
    pairs = weights(scene, what).items()
    return float(sum(n * network.normal[k] + t * network.tangential[k] for k, (n, t) in pairs))


def corners() -> list[str]:
    """The corners of the set of networks of tiny piles, and its volume."""
    lines = ["| pile, smooth floor | mu | dimension | corners | directions without end | volume |"]
    lines.append("|---|---|---|---|---|---|")
    for kind, layers, mu in (
        *(("tbs", 1, mu) for mu in ("0", "1/10*sqrt(3)", "1/5*sqrt(3)", "1/2*sqrt(3)")),
        ("tbs", 2, "0"),
        ("tbs", 2, "1/10*sqrt(3)"),
        *(("tss", 3, mu) for mu in ("0", "1/10*sqrt(3)", "1/5*sqrt(3)", "1/2*sqrt(3)")),
        ("nt30", 2, "0"),
        ("nt30", 2, "1/10*sqrt(3)"),
        ("nt60", 3, "0"),
        ("nt60", 3, "3/10"),
    ):
        found = extremes(pile(kind, layers), mu)
        size = "" if found.volume is None else str(found.volume)
        counts = f"{len(found.coordinates)} | {len(found.networks)} | {len(found.rays)}"
        lines.append(f"| {kind.upper()} {layers} | {mu} | {counts} | {size} |")
    return lines


def dimensions() -> list[str]:
    """How much is open: unknowns, rank and dimension."""
    lines = ["| pile | mu | components | rank | dimension |", "|---|---|---|---|---|"]
    for kind, layers in (("nt60", 6), ("nt30", 6), ("tss", 6), ("tbs", 6)):
        for mu in ("0", "1/10*sqrt(3)"):
            found = indeterminacy(pile(kind, layers), mu)
            counts = f"{found.unknowns} | {found.rank} | {found.dimension}"
            lines.append(f"| {kind.upper()} {layers} | {mu} | {counts} |")
    return lines


def closure() -> list[str]:
    """Unknowns less equations where f_t = mu f_n everywhere: a count, not a solution."""
    lines = ["| pile | contacts | equations | difference |", "|---|---|---|---|"]
    for kind, layers in (("nt30", 4), ("nt30", 6), ("nt60", 6), ("tss", 6), ("tbs", 4), ("tbs", 6)):
        scene = pile(kind, layers)
        equations = 3 * sum(not disc.fixed for disc in scene.discs)
        contacts = len(scene.contacts)
        numbers = f"{contacts} | {equations} | {contacts - equations}"
        lines.append(f"| {kind.upper()} {layers} | {numbers} |")
    return lines


PANELS: tuple[Callable[[Sequence[Axes]], list[str]], ...] = (base,)
FIGURES: tuple[Callable[[Axes], list[str]], ...] = (critical, intervals, widths)
TABLES: tuple[Callable[[], list[str]], ...] = (dimensions, corners, closure)


def main() -> None:
    """Draw and print what was asked for."""
    mpl.use("Agg")
    plt.rcParams.update({"font.size": 8, "legend.fontsize": 7, "legend.frameon": False})
    wanted = sys.argv[1:]
    for table in TABLES:
        if not wanted or table.__name__ in wanted:
            print("\n".join(["", *table()]), flush=True)
    for draw in FIGURES:
        if wanted and draw.__name__ not in wanted:
            continue
        start = perf_counter()
        figure, ax = plt.subplots(figsize=(5.2, 3.6), layout="constrained")
        print("\n".join(["", *draw(ax)]), flush=True)
        figure.savefig(FOLDER / f"friction-{draw.__name__}.png", dpi=110)
        plt.close(figure)
        print(f"{draw.__name__}: {perf_counter() - start:.1f} s", flush=True)
    for panels in PANELS:
        if wanted and panels.__name__ not in wanted:
            continue
        figure, axes = plt.subplots(2, 2, figsize=(7, 5.4), layout="constrained")
        print("\n".join(["", *panels(axes.ravel())]), flush=True)
        figure.savefig(FOLDER / f"friction-{panels.__name__}.png", dpi=110)


if __name__ == "__main__":
    main()
