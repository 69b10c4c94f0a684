"""Figures of the failures: contact states misread, mechanisms, and what these mean."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.failures.float_runs import (
    ABOVE_ROUNDING,
    RELAXED,
    THRESHOLDS,
    in_floats,
    loaded_stiffness,
    misread,
)
from benchmarks.failures.slide import PILES, slide
from lcp_piles import contact_system, nt30, pile, solve, tbs, tss, z_algorithm
from lcp_piles.problems import beside, near_breakpoint


def thresholds(ax: Any) -> None:
    """Contacts misread against the threshold."""
    lines = {
        "NT30, 6 layers (easy), Newton": (nt30(6), "Newton"),
        "TBS, 60 layers, Newton": (tbs(60), "Newton"),
        "TSS, 9 layers (mechanisms), Newton": (tss(9), "Newton"),
        "TSS, 9 layers (mechanisms), Lemke": (tss(9), "Lemke"),
        "a tie beside a force of 7e-18, Newton": (
            beside(near_breakpoint(15, 0), near_breakpoint(15, -1)),
            "Newton",
        ),
    }
    styles = ["-", "-", "-", "--", "-."]
    for style, (name, (scene, method)) in zip(styles, lines.items(), strict=True):
        exact = solve(scene)
        floats, _ = in_floats(scene, method)
        wrong = [misread(floats, exact.states, t) for t in THRESHOLDS]
        right = [t for t, count in zip(THRESHOLDS, wrong, strict=True) if not count]
        least = exact.force_array[exact.force_array > 0].min()
        print(
            f"  {name}: at best {min(wrong)} wrong, at 1e-9 {misread(floats, exact.states, 1e-9)},"
            f" right up to {right[0] if right else 0:.0e}, least force {least:.1e},"
            f" {least / exact.force_array.max():.1e} of the largest"
        )
        ax.plot(THRESHOLDS, wrong, style, label=name)
    ax.set(xscale="log", yscale="symlog", xlabel="threshold", ylabel="contacts misread")
    ax.set_ylim(-0.2, 1e8)
    ax.set_yticks([0, 1, 10, 100, 1000, 10000], ["0", "1", "10", "100", "1000", "10000"])
    ax.legend(loc="upper left")


def stops(ax: Any) -> None:
    """Contacts misread in piles with mechanisms, at the best threshold and at the usual one."""
    layers = {"tss": range(3, 14), "nt30": (7, 8, 9, 11, 12), "nt60": (3, 9, 11)}
    piles = [(kind, n) for kind, each in layers.items() for n in each]
    methods = ("Lemke", "Gauss-Seidel", "FIRE", "Newton")
    names = [f"{name}, best" for name in ("Z in float64", *methods)] + ["Newton, 1e-9"]
    table = np.zeros((len(names), len(piles)), dtype=int)
    for column, (kind, n) in enumerate(piles):
        exact = solve(pile(kind, n))
        runs = [z_algorithm(exact.scene, arithmetic="float64").solution]
        runs += [in_floats(exact.scene, method)[0] for method in methods]
        for row, floats in enumerate(runs):
            table[row, column] = min(misread(floats, exact.states, t) for t in ABOVE_ROUNDING)
        table[-1, column] = misread(floats, exact.states, 1e-9)
    for name, counts in zip(names, table.tolist(), strict=True):
        wrong = [
            f"{kind} {n}: {count}" for (kind, n), count in zip(piles, counts, strict=True) if count
        ]
        print(f"  {name}: {', '.join(wrong) or 'none wrong'}")
    ax.imshow(table, aspect="auto", cmap="Oranges", vmin=0, vmax=4)
    for (i, j), count in np.ndenumerate(table):
        ax.text(j, i, count, ha="center", va="center", color="k" if count else "0.7")
    ax.set_yticks(range(len(names)), names)
    ax.set_xticks(range(len(piles)), [str(n) for _, n in piles])
    for kind in layers:
        columns = [j for j, (other, _) in enumerate(piles) if other == kind]
        ax.text(np.mean(columns), -0.65, kind.upper(), ha="center")
        ax.axvline(columns[-1] + 0.5, color="k", lw=0.8)
    ax.set(xlabel="layers")


def breakpoints(ax: Any) -> None:
    """Contacts misread at the usual threshold against the distance from a breakpoint."""
    ks = range(1, 17)
    truths = {k: solve(near_breakpoint(k, -1)).states for k in ks}
    for shift, method in enumerate(RELAXED):
        wrong = [misread(in_floats(near_breakpoint(k, -1), method)[0], truths[k], 1e-9) for k in ks]
        print(f"  {method}: {wrong}")
        ax.plot([10.0**-k for k in ks], [x + 0.03 * shift for x in wrong], "o-", ms=3, label=method)
    ax.axhline(0, color="k", lw=1, label="exact")
    ax.set(xscale="log", xlabel=r"push below the breakpoint ($w\tau$)", ylabel="contacts misread")
    ax.set_yticks([0, 1, 2])
    ax.legend()


def mechanisms(ax: Any) -> None:
    """Least eigenvalue of the stiffness of the loaded contacts, relative, against the size."""
    for kind, style in (("tss", "o-"), ("nt30", "s--"), ("nt60", "^:")):
        least, counted = [], []
        layers = range(2, 13)
        for n in layers:
            exact = solve(pile(kind, n))
            closed = np.array([s == "closed" for s in exact.states])
            values = np.linalg.eigvalsh(
                loaded_stiffness(contact_system(exact.scene, "whole"), closed)
            )
            least.append(max(abs(values[0]) / values[-1], 1e-18))
            assert exact.stability is not None
            counted.append(exact.stability.mechanisms)
        print(f"  {kind}, 2 to 12 layers: mechanisms {counted}")
        ax.plot(layers, least, style, ms=3, label=kind.upper())
    ax.axhspan(1e-19, 1e-14, color="0.9", zorder=0, label="rounding")
    ax.set(yscale="log", xlabel="layers", ylabel="least / largest eigenvalue", ylim=(1e-19, 1e3))
    ax.legend(loc="upper right", ncols=4)


def slides(ax: Any) -> None:
    """How far discs that really move get from the exact equilibrium."""
    for name, (scene, tau) in PILES.items():
        solution = solve(scene)
        run = slide(solution, tau)
        assert solution.stability is not None
        label = f"{name}: {solution.stability.verdict}"
        print(
            f"  {label}, tau {tau:.0e}: {run.distance[0]:.1e} to {run.distance[-1]:.1e} tau,"
            f" at most {run.distance.max():.1e}"
        )
        ax.plot(run.times, run.distance, label=label)
    ax.set(
        yscale="log",
        xlabel="time (that of falling half a radius)",
        ylabel=r"distance from equilibrium ($\tau$)",
    )
    ax.legend(loc="center right", bbox_to_anchor=(1, 0.64))
