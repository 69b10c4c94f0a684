"""Where saddles slide to: by the steepest path, and by LAMMPS from the same start."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.patches import Circle

from benchmarks.comparison.molecular import settle
from lcp_piles import Deformed, Slide, deform, first_order, pile, slide, solve
from lcp_piles.deformation.nonlinear import eigenpairs
from lcp_piles.deformation.shape import hessian, strained
from lcp_piles.deformation.watch import crowd_of, watched
from lcp_piles.numbers.vectors import FloatArray
from lcp_piles.scenes.symmetry import mirror

SLIDES = (
    ("nt60", 3, 1e-3),
    ("nt60", 9, 1e-4),
    ("nt30", 7, 1e-4),
    ("nt30", 8, 1e-4),
    ("nt30", 9, 1e-4),
    ("nt30", 12, 1e-4),
    ("nt30", 13, 1e-4),
    ("tss", 3, 1e-3),
    ("tss", 4, 1e-3),
    ("tss", 5, 1e-3),
    ("tss", 6, 1e-3),
    ("tss", 8, 1e-3),
    ("tss", 10, 1e-3),
)
_KICK = 1e-3
_ARROW = 3.0
"""Length of the longest arrow (radii)."""
_STOP, _STEPS = 1e-8, 1_000_000
_KICKS = 6
_NEGATIVE = 1e-7


def top(kind: str, layers: int, tau: float) -> Deformed:
    """The saddle at tau; where there is none, the rigid limit, which is not at rest."""
    solution = solve(pile(kind, layers))
    assert solution.status == "solved"
    found = first_order(solution)
    return deform(found if found.status == "found" else solution, tau)


def molecular(way: Slide) -> FloatArray:
    """Where LAMMPS ends from the start of a slide (displacements in w tau)."""
    start = way.start
    places = positions(start)
    kicked = places + start.tau * (start.displacements + _KICK * way.direction)
    end, _ = settle(start.scene, start.tau, _STOP, start=kicked, steps=_STEPS)
    return np.asarray((end - places) / start.tau)


def rested(way: Slide) -> tuple[FloatArray, list[float]]:
    """Where LAMMPS ends if it is kicked on along the least eigenvalue while that is negative.

    And those eigenvalues (over tau) at the states where it had stopped.
    """
    start, places = way.start, positions(way.start)
    crowd = crowd_of(start.scene)
    end, stops = molecular(way), []
    for _ in range(_KICKS):
        flat = end.ravel()
        state = strained(watched(crowd, flat, start.tau), flat, start.tau, start.law)
        values, vectors = eigenpairs(hessian(state), 1)
        if values[0] >= -_NEGATIVE:
            break
        stops.append(float(values[0]) / start.tau)
        kick = np.zeros(len(flat))
        kick[crowd.shape.free] = vectors[:, 0]
        kicked = places + start.tau * (flat + kick / np.abs(kick).max()).reshape(places.shape)
        found, _ = settle(start.scene, start.tau, _STOP, start=kicked, steps=_STEPS)
        end = (found - places) / start.tau
    return end, stops


def positions(start: Deformed) -> FloatArray:
    """The lattice points of a pile."""
    return np.array([[float(x) for x in disc.position] for disc in start.scene.discs])


def slides_table() -> list[str]:
    """Every slide, along each negative eigenvalue and both ways, in lines of Markdown."""
    lines = [
        "| pile | tau | start | eigenvalue / tau | motion | distance (radii) | in tau | "
        "energy lost (w tau) | asymmetry (radii) | LAMMPS | its eigenvalues there / tau | "
        "LAMMPS kicked on |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for kind, layers, tau in SLIDES:
        start = top(kind, layers, tau)
        for mode in np.flatnonzero(start.lowest < 0).tolist():
            ways = [slide(start, mode, sign, kick=_KICK) for sign in (1, -1)]
            if ways[0].is_odd:  # the other way is the mirror image
                ways = ways[:1]
            for way in ways:
                row = [
                    f"{kind.upper()} {layers}",
                    f"{tau:.0e}",
                    "saddle" if start.converged else "rigid limit",
                    f"{start.lowest[mode] / tau:.3f}",
                    "odd" if way.is_odd else "even",
                    f"{way.distance:.3g}",
                    f"{way.distance / tau:.4g}",
                    f"{way.drop:.4g}",
                    f"{way.asymmetry:.3g}",
                    against(way, molecular(way)),
                ]
                end, stops = rested(way)
                row += [", ".join(f"{x:.2g}" for x in stops), against(way, end) if stops else ""]
                lines.append("| " + " | ".join(row) + " |")
                print(lines[-1], flush=True)
    return lines


def against(way: Slide, other: FloatArray) -> str:
    """How another end compares with that of a slide, in words."""
    tau = way.start.tau
    symmetry = mirror(way.start.scene)
    assert symmetry is not None
    image = other[symmetry.discs]
    image[:, 0] *= -1
    for name, end in (("same", other), ("mirror image", image)):
        off = float(np.abs(end - way.displacements).max()) * tau
        if off < 1e-3 * way.distance + 1e-9:
            return f"{name} ({off:.0e})"
    moved = float(np.abs(other - way.start.displacements).max()) * tau
    return f"elsewhere, {moved:.3g} radii away"


def leaning(figure: Any) -> None:
    """NT30 7 leans by some tau until a gap closes; TSS of 3 and 6 layers rearrange."""
    axes = figure.subplots(2, 2, gridspec_kw={"height_ratios": [1, 1.2]})
    for ax, layers in zip(axes[0], (7, 8), strict=True):
        start = top("nt30", layers, 1e-4)
        way = slide(start)
        places = positions(start)
        _discs(ax, places)
        moves = (way.displacements - start.displacements) * _ARROW / way.distance * start.tau
        ax.quiver(
            *places.T, *moves.T, angles="xy", scale_units="xy", scale=1, color="C3", width=3e-3
        )
        word = "odd" if way.is_odd else "even"
        ax.set_title(rf"NT30 {layers}, {word}: {way.distance / start.tau:.1f} $w\tau$", size=8)
    for ax, layers in zip(axes[1], (3, 6), strict=True):
        start = top("tss", layers, 1e-3)
        way = slide(start)
        places = positions(start)
        _discs(ax, places)
        end = places + start.tau * way.displacements
        for disc, centre in zip(start.scene.discs, end, strict=True):
            colour = "0.3" if disc.fixed else "C3"
            ax.add_patch(Circle(tuple(centre), 1, fill=False, ec=colour, lw=0.8))
        shape = way.state.shape
        joined = (way.state.forces > 1e-9) & (shape.b >= 0)
        for i, j in zip(shape.a[joined], shape.b[joined], strict=True):
            ax.plot(*end[[i, j]].T, color="C0", lw=0.8)
        ax.set_title(f"TSS {layers}: {way.distance:.2f} radii", size=8)
    for ax in axes.ravel():
        ax.set_aspect("equal")
        ax.autoscale_view()
        ax.axis("off")


def _discs(ax: Any, places: FloatArray) -> None:
    for centre in places:
        ax.add_patch(Circle(tuple(centre), 1, fc="0.85", ec="white", lw=0.3))
    ax.axhline(-1, color="0.6", lw=0.8)
