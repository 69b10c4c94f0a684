"""The paper's stress axes, base pressures and forces against the size of the pile (section 5)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from ..fields.base_pressure import BaseForce, base_pressure
from ..fields.letters import letter_directions, letter_force
from ..fields.stress import stress
from ..files.tables import csv_text
from ..pictures.drawing import GREY, RED, disc_positions, page, scene_title
from ..pictures.field_pictures import draw_profile, draw_stress_axes
from ..scenes.kinds import kind_named, pile
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from ..solve import solve
from .plate import Plate, both, floor_label, floor_title, floors, panel_title, stacked
from .size_dependence import SizeRecord, size_dependence

STRESS_HEADER = [
    *("disc", "x", "y", "pi_sigma_xx", "pi_sigma_xy", "pi_sigma_yy"),
    *("major_principal", "minor_principal", "angle_degrees"),
]


def stress_plate(kind: str, layers: int) -> Plate:
    """The principal axes of the stress on every disc that is free to move, on each floor."""
    found = [(floor_label(floor), solve(pile(kind, layers, **floor))) for floor in floors(kind)]
    axes = stacked([solution.scene for _, solution in found])
    rows = []
    for ax, (label, solution) in zip(axes, found, strict=True):
        draw_axes(solution, ax).set_title(panel_title(solution.scene), fontsize=11)
        rows += [[label, *row] for row in stress_rows(solution)]
    return Plate(page(axes[0]), {".csv": csv_text(["floor", *STRESS_HEADER], rows)})


def draw_axes(solution: Solution, ax: Axes, *, log: bool = False) -> Axes:
    """`draw_stress_axes` for the movable discs: what carries a held one acts at its centre."""
    free = np.array([not disc.fixed for disc in solution.scene.discs])
    positions = disc_positions(solution.scene)
    return draw_stress_axes(positions[free], stress(solution).array[free], ax, log=log)


def stress_rows(solution: Solution) -> list[list[object]]:
    """A row for each movable disc, with the columns of `STRESS_HEADER` (w/R, compression < 0)."""
    tensors = stress(solution)
    rows: list[list[object]] = []
    for k, disc in enumerate(solution.scene.discs):
        if not disc.fixed:
            (xx, xy), (_, yy) = tensors.of(disc.id)
            major, minor = tensors.principal[k].tolist()
            rows.append(
                [
                    end_name(disc.id),
                    *disc.position,
                    xx,
                    xy,
                    yy,
                    major,
                    minor,
                    float(tensors.angle[k]),
                ]
            )
    return rows


def tbs_pressure_plate(layers: int) -> Plate:
    """What row N of TBS puts on the fixed discs, normal and shear, and row N-1, normal only."""
    solution = solve(pile("tbs", layers))
    profile = base_pressure(solution)
    x = [float(p.x) for p in profile]
    shown = {
        f"normal, row {layers}": [float(p.normal) for p in profile],
        f"shear, row {layers}": [float(p.shear) for p in profile],
    }
    ax = draw_profile(x, shown)
    rows: list[list[object]] = [
        [layers, end_name(p.disc), *both(p.x), *both(p.normal), *both(p.shear)] for p in profile
    ]
    above = [_straight_down(solution, (layers - 1, j)) for j in range(1, layers)]
    rows += [
        [layers - 1, end_name(p.disc), *both(p.x), *both(p.normal), *both(p.shear)] for p in above
    ]
    ax.plot(
        [float(p.x) for p in above],
        [float(p.normal) for p in above],
        label=f"normal, row {layers - 1}",
        color="grey",
        linewidth=0.9,
        marker=".",
    )
    ax.legend(frameon=False)
    ax.set_title(scene_title(solution.scene), fontsize=11)
    header = ["row", "disc", "x", "x_decimal", "normal", "normal_decimal", "shear", "shear_decimal"]
    return Plate(page(ax), {".csv": csv_text(header, rows)})


def _straight_down(solution: Solution, disc: DiscId) -> BaseForce:
    """What a disc of row N-1 puts on the fixed disc below it: its contact e, vertical."""
    force = letter_force(solution, disc, "e")
    assert force is not None
    x = solution.scene.disc(disc).position[0]
    return BaseForce(disc, x, force, force * 0, False)


def pressure_plate(kind: str, sizes: Sequence[int]) -> Plate:
    """The force on a smooth floor under each disc, one panel a floor and one curve a size."""
    panels = floors(kind)
    figure = Figure(figsize=(6.4, 3.4 * len(panels)), layout="constrained")
    rows: list[list[object]] = []
    for k, floor in enumerate(panels):
        ax = figure.add_subplot(len(panels), 1, k + 1)
        for layers, (colour, style, marker) in zip(sizes, _LOOKS, strict=False):
            solution = solve(pile(kind, layers, **floor))
            profile = base_pressure(solution)
            draw_profile(
                [float(p.x) for p in profile],
                {f"$N = {layers}$": [float(p.normal) for p in profile]},
                ax,
                ylabel="force on the floor  ($w$)",
            )
            ax.lines[-1].set(color=colour, linestyle=style, marker=marker)
            rows += [
                [floor_label(floor), layers, end_name(p.disc), *both(p.x), *both(p.normal)]
                for p in profile
            ]
        ax.set_title(f"{kind_named(kind).title}, {floor_title(floor)}", fontsize=11)
        ax.legend(frameon=False)
    header = ["floor", "layers", "disc", "x", "x_decimal", "normal", "normal_decimal"]
    return Plate(figure, {".csv": csv_text(header, rows)})


_LOOKS = (("#1a1a1a", "-", "o"), (RED, "--", "s"))


def size_plate(kind: str, letters: str, sizes: Iterable[int]) -> Plate:
    """The forces on disc (2,1) against the number of layers, one panel a floor."""
    panels, wanted = floors(kind), tuple(sizes)
    figure = Figure(figsize=(7.6, 3.6 * len(panels)), layout="constrained")
    grid = figure.add_gridspec(len(panels), 2, width_ratios=(5, 1))
    rows: list[list[object]] = []
    for k, floor in enumerate(panels):
        ax = figure.add_subplot(grid[k, 0])
        records = list(size_dependence(kind, (2, 1), letters, wanted, method="proved", **floor))
        draw_profile(
            wanted,
            {letter: _forces(records, letter) for letter in letters},
            ax,
            xlabel="number of layers $N$",
            ylabel="force on disc (2,1)  ($w$)",
        )
        for line in ax.lines:
            line.set_markersize(2.5)
        legend = ax.get_legend()
        if legend is not None:
            legend.remove()
        _draw_letters(figure.add_subplot(grid[k, 1]), pile(kind, max(wanted), **floor), ax)
        title = kind_named(kind).title
        if floor:
            title += f", {floor_title(floor)}"
        ax.set_title(title, fontsize=11)
        rows += [
            [floor_label(floor), r.layers, r.letter, *both(r.force), r.state]
            for r in records
            if r.force is not None
        ]
    header = ["floor", "layers", "letter", "force", "force_decimal", "state"]
    return Plate(figure, {".csv": csv_text(header, rows)})


def _draw_letters(ax: Axes, scene: Scene, curves: Axes) -> None:
    """Disc (2,1) with its contacts, each with its letter and in the look of its curve."""
    directions = letter_directions(scene)
    ax.add_patch(Circle((0, 0), 1, facecolor="white", edgecolor=GREY))
    for curve in curves.lines:
        letter = str(curve.get_label())
        n = np.array([float(x) for x in directions[letter]])
        ax.plot([0, n[0]], [0, n[1]], color=curve.get_color(), linestyle=curve.get_linestyle())
        ax.plot(*n, marker=curve.get_marker(), color=curve.get_color(), markersize=5)
        x, y = (1.4 * n).tolist()
        ax.text(x, y, letter, color=curve.get_color(), ha="center", va="center")
    ax.set_title("disc (2,1)", fontsize=9)
    ax.set(xlim=(-1.8, 1.8), ylim=(-1.8, 1.8), aspect="equal")
    ax.set_axis_off()


def _forces(records: Iterable[SizeRecord], letter: str) -> list[float]:
    return [np.nan if r.force is None else float(r.force) for r in records if r.letter == letter]
