"""Pictures of fields: tensors, numbers and vectors on discs, and profiles along the base.

`draw_field` draws any field by the shape of its data; each shape has one drawer. As everywhere in
`pictures`, a function draws on the Axes that it is given, or on those of a new figure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import assert_never

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from ..errors import InputError
from ..fields.field import DiscScalars, DiscTensors, DiscVectors, Profile, Shape
from ..numbers.vectors import FloatArray
from .drawing import (
    BLACK,
    BLUE,
    GREEN,
    RED,
    between,
    disc_positions,
    disc_radii,
    draw_arrows,
    draw_discs,
    draw_legend,
    draw_pile,
    draw_segments,
    drawable,
    frame,
    line_handle,
    page,
    round_down,
    scene_title,
)

_CURVES = ((BLACK, "-", "o"), (RED, "--", "s"), (BLUE, "-.", "^"), (GREEN, ":", "D"))
_MARKS = ((RED, "v", RED), (BLUE, "o", "none"))


def draw_field(shape: Shape, ax: Axes | None = None) -> Axes:
    """Draw what a field has to show, by the shape of its data.

    >>> from lcp_piles import FIELDS, nt60, solve
    >>> fabric = FIELDS["fabric"]
    >>> draw_field(fabric.shape(fabric.compute(solve(nt60(3))))).get_title()
    'NT60, $N = 3$'
    """
    match shape:
        case DiscTensors():
            return _draw_tensors(shape, ax)
        case DiscScalars():
            return _draw_scalars(shape, ax)
        case DiscVectors():
            return _draw_vectors(shape, ax)
        case Profile():
            return _draw_marked_profile(shape, ax)
        case _:
            assert_never(shape)


def draw_stress_axes(
    positions: ArrayLike, tensors: ArrayLike, ax: Axes | None = None, *, log: bool = False
) -> Axes:
    """The principal axes of a stress tensor at each disc, as a cross of two segments.

    Shapes: `positions` (n, 2) in R, `tensors` (n, 2, 2) symmetric, in w/R. A segment lies along an
    eigenvector and is as long as its eigenvalue s, or as log(1 + |s| R/w) if `log`; the longest
    is one disc diameter. Compression (s < 0: forces on the disc point inwards) is black, tension
    red.

    Raises `InputError` for other shapes and for tensors that are not finite and symmetric.
    Source: Oron and Herrmann, section 4; the sign is that of their sum of F_a r_b.

    >>> ax = draw_stress_axes([[0, 0]], [[[-2, 0], [0, -1]]])
    >>> [line.get_label() for line in ax.collections]
    ['discs', 'compression']
    """
    where = np.asarray(positions, dtype=np.float64)
    stress = np.asarray(tensors, dtype=np.float64)
    if where.ndim != 2 or where.shape[1] != 2 or not len(where):
        raise InputError("the shape of the positions", where.shape, "(n, 2) with n > 0")
    if stress.shape != (len(where), 2, 2):
        raise InputError("the shape of the tensors", stress.shape, f"({len(where)}, 2, 2)")
    if not np.isfinite(stress).all():
        raise InputError("a stress", "not finite", "finite numbers")
    transposed = stress.transpose(0, 2, 1)
    # Tensors come rounded to floats: only more than rounding is a fault.
    if not np.allclose(stress, transposed, rtol=0, atol=1e-9 * float(abs(stress).max())):
        raise InputError("a stress tensor", "not symmetric", "symmetric tensors")
    looks = (("compression", -1, BLACK), ("tension", 1, RED))
    return _draw_crosses(
        where, np.ones(len(where)), (stress + transposed) / 2, looks, "$w/R$", ax, log
    )


def _draw_crosses(
    where: FloatArray,
    radii: FloatArray,
    tensors: FloatArray,
    looks: Sequence[tuple[str, int, str]],
    unit_name: str,
    ax: Axes | None,
    log: bool = False,
) -> Axes:
    """A cross of principal axes at each place; `looks` are (label, sign, colour)."""
    values, vectors = np.linalg.eigh(tensors)
    length = np.log1p(abs(values)) if log else abs(values)
    half = length / (length.max(initial=0.0) or 1.0)
    along = vectors.transpose(0, 2, 1) * half[:, :, None]  # disc, axis, component
    segments = np.stack([where[:, None] - along, where[:, None] + along], axis=2)

    ax, unit = frame(where, ax, radii)
    draw_discs(ax, where, radii, unit)
    handles: list[Artist] = []
    for label, sign, colour in looks:
        mask = np.sign(values) == sign
        if mask.any():
            draw_segments(ax, segments[mask], label, between(0.07 * unit, 0.4, 1.4), colour)
            handles.append(line_handle(label, colour, 1.5))
    longest = float(abs(values).max(initial=0.0))
    label = f"longest axis: {longest:.3g} {unit_name}".rstrip()
    handles.append(Line2D([], [], linestyle="none", label=label + ", log scale" * log))
    draw_legend(ax, handles)
    if longest:
        _draw_scale(ax, longest, unit_name, unit, log)
    return ax


def _draw_scale(ax: Axes, longest: float, unit_name: str, unit: float, log: bool) -> None:
    """A bar as long as the axis of a round number, in the upper left corner."""
    shown = round_down(longest)
    share = np.log1p(shown) / np.log1p(longest) if log else shown / longest
    left, top = ax.get_xlim()[0] + 0.3, ax.get_ylim()[1] - 0.5
    bar = Line2D([left, left + 2 * share], [top, top], color=BLACK, linewidth=1.5)
    bar.set_label("_scale")
    ax.add_line(bar)
    size = between(0.8 * unit, 5, 9)
    ax.text(left, top - 0.4, f"{shown:g} {unit_name}".rstrip(), size=size, va="top")


def _draw_tensors(shape: DiscTensors, ax: Axes | None) -> Axes:
    known = ~np.isnan(drawable(shape.tensors, "a tensor").sum(axis=(1, 2)))
    colours = (RED, BLACK) if shape.usual > 0 else (BLACK, RED)
    looks = ((shape.negative, -1, colours[0]), (shape.positive, 1, colours[1]))
    where = disc_positions(shape.scene)
    tensors = np.where(known[:, None, None], shape.tensors, 0.0)
    unit = f"${shape.unit}$" if shape.unit else ""
    ax = _draw_crosses(where, disc_radii(shape.scene), tensors, looks, unit, ax)
    ax.set_title(scene_title(shape.scene), fontsize=11)
    return ax


def _draw_scalars(shape: DiscScalars, ax: Axes | None) -> Axes:
    """Every disc in the colour of its number, with the scale beside; white where there is none."""
    where = disc_positions(shape.scene)
    ax, unit = frame(where, ax, disc_radii(shape.scene))
    draw_pile(ax, shape.scene, where, unit)
    known = ~np.isnan(drawable(shape.values, "a value"))
    size = 2 * disc_radii(shape.scene)[known]
    discs = EllipseCollection(
        size,
        size,
        np.zeros(len(size)),
        units="xy",
        offsets=where[known],
        offset_transform=ax.transData,
        array=shape.values[known],
        cmap="viridis",
        edgecolors="none",
        zorder=1.5,
    )
    discs.set_label("values")
    ax.add_collection(discs, autolim=False)
    bar = page(ax).colorbar(discs, ax=ax, orientation="horizontal", shrink=0.6, pad=0.04)
    bar.set_label(shape.label)
    ax.set_title(scene_title(shape.scene), fontsize=11)
    return ax


def _draw_vectors(shape: DiscVectors, ax: Axes | None) -> Axes:
    """An arrow from each disc, the longest of 1.6 radii."""
    where = disc_positions(shape.scene)
    ax, unit = frame(where, ax, disc_radii(shape.scene))
    handles = draw_pile(ax, shape.scene, where, unit)
    longest = float(np.hypot(*drawable(shape.vectors, "a vector").T).max(initial=0.0))
    label = f"{shape.label}, the longest {longest:.3g} ${shape.unit}$"
    handles += draw_arrows(ax, where[shape.discs], shape.vectors, "vectors", label)
    draw_legend(ax, handles)
    ax.set_title(scene_title(shape.scene), fontsize=11)
    return ax


def _draw_marked_profile(shape: Profile, ax: Axes | None) -> Axes:
    ax = draw_profile(shape.x, shape.series, ax, ylabel=shape.ylabel)
    for (name, points), (colour, marker, inside) in zip(shape.marks.items(), _MARKS, strict=False):
        if points:
            x, y = zip(*points, strict=True)
            ax.plot(
                x,
                y,
                label=name,
                linestyle="none",
                marker=marker,
                markersize=9,
                markerfacecolor=inside,
                color=colour,
            )
    if len(ax.lines) > 1:
        ax.legend(frameon=False)
    return ax


def draw_profile(
    x: ArrayLike,
    series: Mapping[str, ArrayLike],
    ax: Axes | None = None,
    *,
    xlabel: str = "$x$  ($R$)",
    ylabel: str = "force on the base  ($w$)",
) -> Axes:
    """Named series against the position x on the base: a line with markers for each.

    Shapes: `x` (n,) in R, every series (n,) in w; with other labels it is any other curve. Raises
    `InputError` for no series and for lengths that differ.

    >>> ax = draw_profile([-2, 0, 2], {"normal": [1, 2, 1], "shear": [1, 0, -1]})
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['normal', 'shear']
    """
    where = drawable(x, "x")
    if where.ndim != 1 or not len(where):
        raise InputError("the shape of x", where.shape, "(n,) with n > 0")
    if not series:
        raise InputError("the number of series", 0, "at least one")
    curves = {name: drawable(values, name) for name, values in series.items()}
    for name, values in curves.items():
        if values.shape != where.shape:
            raise InputError(f"the shape of {name}", values.shape, f"{where.shape}, as x has")
    if ax is None:
        ax = Figure(figsize=(6, 3.8), layout="constrained").add_subplot()
    for k, (name, values) in enumerate(curves.items()):
        colour, style, marker = _CURVES[k % len(_CURVES)]
        ax.plot(
            where,
            values,
            label=name,
            color=colour,
            linestyle=style,
            linewidth=1.2,
            marker=marker,
            markersize=4,
        )
    if min(values.min() for values in curves.values()) >= 0:
        ax.set_ylim(bottom=0)
    ax.set_xlabel(xlabel)
    ax.set_ylabel(ylabel)
    ax.tick_params(direction="in", top=True, right=True)
    if len(curves) > 1:
        ax.legend(frameon=False)
    return ax
