"""The paper's figures of the pushed corner stones: the sequence, and the force under the apex."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..fields.base_pressure import base_pressure
from ..files.tables import csv_text
from ..numbers.exact import ZERO, Surd
from ..pictures.drawing import BLACK, RED
from ..pictures.field_pictures import draw_profile
from ..pictures.plotting import draw_network
from ..push.push_path import PushPath, force_curve, push_path
from ..scenes.names import DiscId
from ..scenes.parameters import FLOOR_COMPLIANCE
from ..solution.solution import Solution
from .figures_fields import STRESS_HEADER, draw_axes, stress_rows
from .figures_networks import CONTACT_HEADER, contact_rows
from .plate import PAPERS_FLOOR, PHYSICAL_FLOOR, Plate, both, floor_title

_NETWORK, _PRESSURE, _STRESS = 2.6, 1.9, 2.6  # widths of the columns in inches
_HEAD = 0.75  # inches above the first row
_ZOOM = 8  # of the whole range of pushes, the part that the second panel shows


def push_sequence_plate(layers: int, rearrangements: Sequence[int]) -> Plate:
    """Network, base pressure and stress axes of NT30 at some of the pushes of Table 1.

    A row for q = 0, for each number in `rearrangements` (1 is the first of the table), and for
    twice the last push, where nothing changes any more. On the paper's floor; widths and lengths
    are logarithmic as in the paper.
    """
    path = push_path("nt30", layers, floor_compliance=PAPERS_FLOOR)
    pushes = {"$q = 0$": ZERO}
    pushes |= {f"$q_{{{k}}}$": path.rearrangements[k - 1].push for k in rearrangements}
    last = path.rearrangements[-1].push
    pushes[f"$2\\,q_{{{len(path.rearrangements)}}}$"] = 2 * last
    line = _NETWORK * (2 * layers) / (6 * layers)
    height = (line + 0.33) * len(pushes) + _HEAD
    figure = Figure(figsize=(_NETWORK + _PRESSURE + _STRESS + 0.5, height))
    grid = figure.add_gridspec(
        len(pushes),
        3,
        width_ratios=(_NETWORK, _PRESSURE, _STRESS),
        left=0.01,
        right=0.99,
        bottom=0.45 / height,
        top=1 - _HEAD / height,
        wspace=0.16,
        hspace=0.4,
    )
    figure.suptitle(
        f"NT30, $N = {layers}$, {floor_title({FLOOR_COMPLIANCE.name: PAPERS_FLOOR})}; "
        "widths in (a) and lengths in (c) are logarithmic",
        fontsize=8,
        y=1 - 0.08 / height,
        va="top",
    )
    networks, stresses = [], []
    for row, (label, push) in enumerate(pushes.items()):
        solution = path.solution(push)
        axes = [figure.add_subplot(grid[row, column]) for column in range(3)]
        draw_network(solution, axes[0], log_width=True, legend=False)
        title = f"{label}, $-q = {float(push):.4g}\\,w\\tau$" if push else label
        axes[0].set_title(title, fontsize=7, pad=2)
        _draw_pressure(solution, axes[1])
        draw_axes(solution, axes[2], log=True)
        legend = axes[2].get_legend()
        if legend is not None:
            legend.remove()
        if row == 0:
            _head(axes)
        networks += [[push, float(push), *fields] for fields in contact_rows(solution)]
        stresses += [[push, float(push), *fields] for fields in stress_rows(solution)]
    axes[1].set_xlabel("$x$  ($R$)", fontsize=7, labelpad=1)
    head = ["push", "push_decimal"]
    return Plate(
        figure,
        {
            ".csv": csv_text([*head, *CONTACT_HEADER], networks),
            "-stress.csv": csv_text([*head, *STRESS_HEADER], stresses),
        },
    )


def _head(axes: Sequence[Axes]) -> None:
    """What the three columns are."""
    heads = ("(a) forces; dashed: open", "(b) on the floor", "(c) principal axes of stress")
    for ax, head in zip(axes, heads, strict=True):
        text = ax.text(0.5, 1.0, head + "\n", ha="center", va="bottom", fontsize=8)
        text.set(transform=ax.transAxes, linespacing=1.9)


def _draw_pressure(solution: Solution, ax: Axes) -> None:
    """The force on the floor, in the range of the paper's frames: x in +-14, 0 to 6 weights."""
    profile = base_pressure(solution)
    x, normal = zip(*((float(p.x), float(p.normal)) for p in profile), strict=True)
    draw_profile(x, {"normal": normal}, ax, xlabel="", ylabel="")
    ax.lines[-1].set(markersize=1.8, linewidth=0.9)
    ax.set_ylabel("force ($w$)", fontsize=6, labelpad=1)
    ax.set_xlim(min(x) - 1, max(x) + 1)
    ax.set_ylim(0, max(6, max(normal)))
    ax.tick_params(labelsize=6, pad=2)


def apex_pressure_plate(layers: int) -> Plate:
    """The force on the floor under the apex of NT30 against the push, rearrangements as dots.

    On the paper's floor and on a floor as soft as the discs; between the dots the force is exactly
    linear in the push. A second panel shows the first rearrangements, which would lie over one
    another in the whole. For an odd number of layers one disc stands under the apex, for an even
    one a pair with equal forces.
    """
    figure = Figure(figsize=(6.4, 7.0), layout="constrained")
    whole, first = figure.subplots(2, 1)
    rows: list[list[object]] = []
    curves = []
    for floor, colour, style in ((PAPERS_FLOOR, BLACK, "-"), (PHYSICAL_FLOOR, RED, "--")):
        path = push_path("nt30", layers, floor_compliance=floor)
        pushes, forces = under_apex(path)
        changes = {r.push for r in path.rearrangements}
        marked = np.array([p in changes for p in pushes])
        x, y = np.array(pushes, dtype=float), np.array(forces, dtype=float)
        label = floor_title({FLOOR_COMPLIANCE.name: floor})
        for ax, dots in ((whole, marked & (x > x[-1] / _ZOOM)), (first, marked)):
            ax.plot(x, y, label=label, color=colour, linestyle=style, linewidth=1.1)
            ax.plot(x[dots], y[dots], "o", label="_rearrangements", color=colour, markersize=3.5)
        curves.append((x, y))
        rows += [
            [floor, *both(p), *both(f), "yes" if m else "no"]
            for p, f, m in zip(pushes, forces, marked, strict=True)
        ]
    end = max(x[-1] for x, _ in curves) / _ZOOM
    seen = np.concatenate([y[x <= end] for x, y in curves])
    first.set(xlim=(0, end), ylim=(seen.min() - 0.1, seen.max() + 0.1))
    first.set_title("the first rearrangements", fontsize=10)
    for ax in (whole, first):
        ax.set_xlabel(r"push $-q$  ($w\tau$)")
        ax.set_ylabel("force on the floor under the apex  ($w$)")
        ax.tick_params(direction="in", top=True, right=True)
    whole.set_title(f"NT30, $N = {layers}$; dots: the network rearranges", fontsize=11)
    whole.legend(frameon=False)
    header = ["floor", "push", "push_decimal", "force", "force_decimal", "rearrangement"]
    return Plate(figure, {".csv": csv_text(header, rows)})


def under_apex(path: PushPath) -> tuple[list[Surd], list[Surd]]:
    """The corners of the exact broken line: pushes, and the floor force of a disc nearest x = 0."""
    scene = path.scene
    on_floor = [k for k, c in enumerate(scene.contacts) if c.b in scene.supports]

    def distance(k: int) -> Surd:
        disc: DiscId = scene.contacts[k].a
        return abs(scene.disc(disc).position[0])

    pushes, (forces,) = force_curve(path, [min(on_floor, key=distance)])
    return pushes, forces
