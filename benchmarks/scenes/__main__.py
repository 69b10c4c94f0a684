"""The tables and figures of `notes/scenes.md`.

    python -m benchmarks.scenes [NAME ...]

Computes everything anew, prints tables in Markdown and writes notes/figures/scenes-NAME.png; all
names by default. The names are those of the functions below.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from itertools import product
from pathlib import Path
from random import Random

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from scipy.optimize import linprog
from tqdm import tqdm

from lcp_piles import (
    Scene,
    base_load,
    bilateral,
    contact_system,
    nt30,
    pile,
    point_load,
    silo,
    slab,
    solve,
    tbs,
)
from lcp_piles.pictures import draw_base_map

FOLDER = Path(__file__).parents[2] / "notes" / "figures"
COLOURS = ("#1f6fb4", "#c8102e", "#2e8b57", "#1a1a1a")  # told apart by colour-blind eyes
MARKS = ("o", "s", "^", "D")
TRIALS = 120


def table(head: Iterable[object], rows: Iterable[Iterable[object]]) -> None:
    """A table in Markdown on standard output."""
    names = list(head)
    print("| " + " | ".join(map(str, names)) + " |")
    print("|" + " --- |" * len(names))
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |")
    print()


def silos(ax: Axes) -> None:
    """The load on the base against the height, between bumpy walls and smooth ones."""
    heights = (1, 2, 4, 6, 10, 15, 20, 30, 40, 60)
    rows = []
    widths = (4, 6, 8, 10)
    kinds = list(product(("untilted", "tilted"), ("smooth", "bumpy")))
    for (orientation, floor), colour, mark in zip(kinds, COLOURS, MARKS, strict=True):
        loads = []
        for height in tqdm(heights, desc="silos", leave=False):
            scene = silo(6, height, "bumpy", floor, orientation)
            loads.append(_on_floor(scene, height) / 6)
        label = f"{orientation}, {floor} floor"
        ax.plot(heights, loads, color=colour, marker=mark, ms=3, label=label)
        deep = [_on_floor(silo(w, 40 * w, "bumpy", floor, orientation), 40 * w) / w for w in widths]
        rows.append([orientation, floor, *(f"{load:.4f}" for load in deep)])
    weight = [sum(not d.fixed for d in silo(6, h).discs) / 6 for h in heights]
    ax.plot(heights, weight, color="#9a9a9a", ls="--", label="smooth walls (untilted): the weight")
    ax.set(xlabel="rows of discs", ylabel="load on the base  ($w$ a column)", ylim=(0, 8))
    ax.set_title("Silos of width 6 between bumpy walls", fontsize=9)
    ax.legend()
    table(["lattice", "floor", *(f"width {w}" for w in widths)], rows)


def _on_floor(scene: Scene, height: int) -> float:
    """What the floor of a silo bears, without what its bumpy walls bear."""
    solution = solve(scene, "newton")
    held = {d.id for d in scene.discs if d.fixed}
    return float(
        sum(p.load for p in base_load(solution) if p.disc not in held or p.disc[0] > height)
    )


def loads(ax: Axes) -> None:
    """The response of a slab to a load on top, while contacts bear tension and when they do not."""
    scene, top = slab(13, 5), (1, 7)
    unilateral, linear = point_load(scene, top), point_load(bilateral(scene), top)
    x = [float(p) for p in unilateral.positions]
    curves = [(linear, 1, "bilateral, any load")]
    curves += [(unilateral, force, f"unilateral, {force} $w$") for force in ("1/2", 3, 100)]
    colours = (COLOURS[3], *COLOURS[:3])
    for (load, force, label), colour, mark in zip(curves, colours, MARKS, strict=True):
        shares = [float(share) for share in load.response(force)]
        ax.plot(x, shares, color=colour, marker=mark, ms=3, label=label)
    ax.set(xlabel="$x$  ($R$)", ylabel="response of the base, share of the load")
    ax.set_ylim(-0.01, 0.27)
    ax.set_title("A load on top of a slab of 5 rows", fontsize=9)
    ax.legend()
    rows = []
    for width, height in ((7, 3), (10, 4), (13, 5), (14, 6)):
        top = (1, (width + height % 2) // 2)
        found = point_load(slab(width, height), top)
        moves = ", ".join(
            f"{float(split.load):.4f} ({' '.join(f'{float(x):+g}' for x in split.after)})"
            for split in found.splits
        )
        rows.append([f"{width} x {height}", len(found.path.breakpoints), moves])
    table(["slab", "breakpoints", "loads (w) from which the largest response is at x"], rows)


def vacancies(ax: Axes) -> None:
    """How often a pile stands with discs taken out at random, or each single one in turn.

    Whether forces balance the load is asked of HiGHS; what stands is then solved exactly.
    """
    rows = []
    piles = (("NT30 10", nt30(10)), ("TBS 20", tbs(20)))
    for (name, scene), colour, mark in zip(piles, COLOURS[:2], MARKS[:2], strict=True):
        free = [disc.id for disc in scene.discs if not disc.fixed]
        random = Random(1)
        shares, stands = [], []
        for count in (1, 2, 3, 5, 7, 10):
            samples = [random.sample(free, count) for _ in range(TRIALS)]
            if count == 1:
                samples = [[id] for id in free]
            left = [scene.without(gone) for gone in samples]
            standing = [s for s in tqdm(left, desc=name, leave=False) if _balances(s)]
            solved = [solve(s) for s in standing]
            assert all(s.status == "solved" for s in solved)
            stable = sum(bool(s.stability and s.stability.stable) for s in solved)
            shares.append(100 * count / len(free))
            stands.append(len(standing) / len(left))
            found = (f"{len(standing)} of {len(left)}", stable)
            rows.append([name, count, f"{shares[-1]:.1f} %", *found])
        ax.plot(shares, stands, color=colour, marker=mark, ms=4, label=name)
    ax.set(xlabel="vacancies, per cent of the discs", ylabel="share of piles in balance")
    ax.set_ylim(0, 1)
    ax.set_title("Piles with discs taken out at random", fontsize=9)
    ax.legend()
    table(["pile", "vacancies", "fraction", "in balance", "of these stable"], rows)


def _balances(scene: Scene) -> bool:
    """Whether some forces that push balance the load, in floating point."""
    B, _, _, p = contact_system(scene, "whole").floats()
    return bool(linprog(np.zeros(B.shape[0]), A_eq=B.T, b_eq=-p).status == 0)


def dips(ax: Axes) -> None:
    """What the middle of the base of piles of spheres bears, against the most of any place."""
    colours = iter(COLOURS)
    for kind in ("tetrahedron", "pyramid"):
        for base in ("held", "edges"):
            rows, ratios, sizes = [], [], range(1 if base == "held" else 3, 21)
            for layers in tqdm(sizes, desc=f"{kind}, {base}", leave=False):
                solution = solve(pile(kind, layers, base=base))
                places = base_load(solution)
                far = [sum(float(x) ** 2 for x in place.across) for place in places]
                middle = min(range(len(places)), key=far.__getitem__)
                most = max(places, key=lambda place: place.load)
                square = sum(float(x) ** 2 for x in most.across)
                dip = most.load > places[middle].load
                ratio = float(places[middle].load) / float(most.load)
                ratios.append(ratio)
                rows.append(
                    [
                        layers,
                        f"{float(places[middle].load):.4f}",
                        f"{float(most.load):.4f}",
                        f"{square**0.5:.2f}" if dip else "",
                        f"{1 - ratio:.3f}" if dip else "none",
                        solution.stability.verdict,
                        solution.stability.mechanisms,
                    ]
                )
            print(f"{kind}, base: {base}")
            head = ["N", "middle (w)", "largest (w)", "at distance (R)", "dip"]
            table([*head, "verdict", "mechanisms"], rows)
            ax.plot(sizes, ratios, color=next(colours), marker="o", ms=3, label=f"{kind}, {base}")
    ax.set(xlabel="layers", ylabel="load in the middle / largest load", ylim=(0.6, 1.02))
    ax.xaxis.set_major_locator(mpl.ticker.MaxNLocator(integer=True))
    ax.set_title("Is there a dip under piles of spheres?", fontsize=9)
    ax.legend()


def base(ax: Axes) -> None:
    """What every place under a tetrahedral pile with a dip bears."""
    draw_base_map(solve(pile("tetrahedron", 16, base="edges")), ax)
    ax.set_title("Tetrahedron, 16 layers, smooth floor with held edges", fontsize=9)


def main() -> None:
    mpl.use("Agg")
    plt.rcParams.update({"font.size": 8, "legend.fontsize": 7, "legend.frameon": False})
    FOLDER.mkdir(parents=True, exist_ok=True)
    for draw in (silos, loads, vacancies, dips, base):
        if sys.argv[1:] and draw.__name__ not in sys.argv[1:]:
            continue
        figure, ax = plt.subplots(figsize=(4.6, 3.1), layout="constrained")
        draw(ax)
        figure.savefig(FOLDER / f"scenes-{draw.__name__}.png", dpi=110)
        plt.close(figure)


if __name__ == "__main__":
    main()
