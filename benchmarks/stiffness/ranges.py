"""Up to which tau the rigid network holds, and what happens beyond."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.comparison.molecular import settle
from benchmarks.stiffness.piles import case
from lcp_piles import deform, first_order, pile, solve

SIZES = {"nt30": range(2, 21), "nt60": range(2, 31), "tbs": range(1, 31)}


def ranges(ax: Any) -> None:
    """The tau at which a contact first changes, against the number of layers."""
    for k, (kind, sizes) in enumerate(SIZES.items()):
        points: dict[str, list[tuple[int, float]]] = {"stable": [], "saddle": []}
        for layers in sizes:
            solution = solve(pile(kind, layers))
            assert solution.status == "solved"
            found = first_order(solution)
            if found.status == "found" and found.range[0] is not None:
                points[found.stability.verdict].append((layers, float(found.range[0])))
        both = sorted(points["stable"] + points["saddle"])
        ax.semilogy(*zip(*both, strict=True), "-", color=f"C{k}", lw=0.5)
        for verdict, marker in (("stable", "o"), ("saddle", "x")):
            if points[verdict]:
                label = f"{kind.upper()}, {verdict}"
                ax.semilogy(
                    *zip(*points[verdict], strict=True), marker, color=f"C{k}", ms=3.5, label=label
                )
        print(kind, [(n, f"{t:.2e}") for n, t in both])
    ax.set_xlabel("layers")
    ax.set_ylabel(r"$\tau$ at which a contact first changes")
    ax.legend()


def beyond(ax: Any) -> None:
    """NT30 6: a gap closes, and forces leave their straight lines."""
    which = case("NT30 6")
    first, rigid = which.first, which.rigid
    limit, changing = first.range
    assert limit is not None
    closing = rigid.contact_index(changing[0].a, changing[0].b)
    taus = np.linspace(0, 3e-3, 61)[1:]
    piles = [deform(first, tau) for tau in taus]
    # Of the other forces the one that the first order misses most in the end.
    missed = np.abs(piles[-1].forces - rigid.force_array - taus[-1] * first.force_array)
    missed[[rigid.contact_index(c.a, c.b) for c in changing]] = 0
    other = int(np.argmax(missed))
    for k, colour in ((closing, "C0"), (other, "C1")):
        name = rigid.scene.contacts[k].name.removeprefix("contact ")
        change = np.array([p.forces[k] for p in piles]) - rigid.force_array[k]
        ax.plot(taus, change, color=colour, label=f"force {name}")
        ax.plot(taus, taus * first.force_array[k], "--", color=colour, lw=0.8)
    gaps = np.maximum([p.gaps[closing] for p in piles], 0)
    ax.plot(taus, gaps, color="C2", label=r"gap of the first ($w\tau$)")
    line = first.start_gaps.array()[closing] + taus * first.gaps.array()[closing]
    ax.plot(taus, np.maximum(line, 0), "--", color="C2", lw=0.8)
    ax.axvline(float(limit), color="0.6", lw=0.7)
    ax.set_xlabel(r"$\tau$ (disc radii a disc weight)")
    ax.set_ylabel(r"change of a force ($w$)")
    ax.legend()


def fold(ax: Any) -> None:
    """NT30 10: softer and softer discs, until there is no equilibrium left near the pile."""
    solution = solve(pile("nt30", 10))
    assert solution.status == "solved"
    first = first_order(solution)
    assert first.status == "found"
    scene = solution.scene
    end = deform(first, 1e-2).tau
    taus = end * (1 - np.logspace(0, -3, 25)[1:])
    found = [deform(first, float(tau)) for tau in taus]
    ax.plot(taus, [pile.lowest[0] for pile in found], "C0.-", lw=1, ms=3)
    ax.set_ylim(0)
    ax.set_xlabel(r"$\tau$ (disc radii a disc weight)")
    ax.set_ylabel(r"least eigenvalue ($1/\tau$)", color="C0")
    far = ax.twinx()
    far.semilogy(taus, [np.abs(p.displacements).max() * p.tau for p in found], "C1-", lw=1)
    places = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    marks = [end * x for x in (0.3, 0.5, 0.7, 0.9, 0.97, 1.03, 1.1, 1.3, 1.6)]
    moved = [float(np.abs(settle(scene, tau, 1e-9)[0] - places).max()) for tau in marks]
    print(
        f"the branch ends at tau = {end:.5f}",
        [f"{t:.2e}: {m:.3g}" for t, m in zip(marks, moved, strict=True)],
    )
    far.semilogy(marks, moved, "C1s", ms=4, mfc="none")
    far.set_ylabel("farthest disc (radii)", color="C1")
