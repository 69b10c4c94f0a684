"""Pictures of friction: the interval of every contact force, and networks that friction admits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ..errors import InputError
from ..friction.equations import Network
from ..friction.force_bounds import ContactBounds
from ..numbers.exact import Surd
from ..scenes.scene import Scene
from .drawing import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    RED,
    between,
    contact_segments,
    disc_positions,
    draw_legend,
    draw_pile,
    draw_segments,
    frame,
    line_handle,
    mathtext,
    round_down,
    scene_title,
)

_PALE_BLUE, _PALE_RED = "#a9cbe8", "#f2b8b5"
_PIECES = ((0.26, 0.5, ORANGE), (0.5, 0.74, GREEN))
"""From where to where along a contact, and in which colour."""
_THINNEST = 0.4


def draw_bounds(
    bounds: ContactBounds,
    ax: Axes | None = None,
    *,
    inside: Mapping[str, Sequence[Surd]] | None = None,
    legend: bool = True,
) -> Axes:
    r"""The interval of every contact force: an inner line as wide as the least force, in an outer.

    The outer, pale line is as wide as the largest force; it is red, and a little wider than all
    others, where the force has no largest value. Contacts that carry no force in any network are
    left out. Forces `inside`, by name (two at most), are pieces as wide as they are, side by side
    in the middle of each contact. Raises `InputError` for a scene that is not plane, and for more.

    >>> from lcp_piles import contact_bounds, tbs
    >>> draw_bounds(contact_bounds(tbs(1), "1/5")).get_title()
    'TBS, $N = 1$, $\\mu = 1/5$'
    """
    scene = bounds.scene
    positions = disc_positions(scene)
    ax, unit = frame(positions, ax)
    segments = contact_segments(scene, positions)
    least = np.array([float(x) for x in bounds.least])
    free = np.array([x is None for x in bounds.largest])
    largest = np.array([0.0 if x is None else float(x) for x in bounds.largest])
    top = max(float(largest.max(initial=0.0)), float(least.max(initial=0.0))) or 1.0
    widest = between(0.75 * unit, 1.5, 14)
    handles: list[Artist] = []

    def outer(mask: np.ndarray, widths: np.ndarray, colour: str, label: str) -> None:
        if mask.any():
            chosen = np.maximum(widths[mask], _THINNEST).tolist()
            draw_segments(ax, segments[mask], label, chosen, colour)

    outer(free, np.full(len(free), 1.15 * widest), _PALE_RED, "no largest force")
    outer(~free & (largest > 0), widest * largest / top, _PALE_BLUE, "largest force")
    outer(least > 0, widest * least / top, BLACK, "least force")
    named = dict(inside or {})
    if len(named) > len(_PIECES):
        raise InputError("the number of networks inside", len(named), f"{len(_PIECES)} at most")
    for (name, forces), (start, end, colour) in zip(named.items(), _PIECES, strict=False):
        value = np.array([float(f) for f in forces])
        ways = segments[:, 1] - segments[:, 0]
        pieces = np.stack([segments[:, 0] + start * ways, segments[:, 0] + end * ways], axis=1)
        chosen = value > 0
        widths = np.maximum(widest * value[chosen] / top, _THINNEST).tolist()
        draw_segments(ax, pieces[chosen], name, widths, colour)
        handles.append(line_handle(f"{name}, same scale", colour, 3))
    shown = round_down(top)
    scale = max(widest * shown / top, _THINNEST)
    handles.append(line_handle(f"largest force, {shown:g} $w$", _PALE_BLUE, scale))
    handles.append(line_handle(f"least force, {shown:g} $w$", BLACK, scale))
    if free.any():
        handles.append(line_handle("no largest force", _PALE_RED, min(widest, 8)))
    handles += draw_pile(ax, scene, positions, unit)
    ax.set_title(_title(scene, bounds.mu, bool(bounds.rough)), fontsize=11)
    if legend:
        draw_legend(ax, handles)
    return ax


def draw_friction(
    scene: Scene,
    network: Network,
    mu: Surd,
    ax: Axes | None = None,
    *,
    rough: bool = False,
    legend: bool = True,
) -> Axes:
    """A network with friction: lines as wide as the normal forces, red where the contact slips.

    Black contacts are frictionless there (no tangential force), blue ones stick below Coulomb's
    limit, red ones are at the limit |f_t| = mu f_n. The title says whether the floor is `rough`.
    Raises `InputError` for a scene that is not plane.

    >>> from lcp_piles import force_bounds, surd, tbs
    >>> bounds = force_bounds(tbs(1), "1/5", {((1, 1), (3, 2)): 1})
    >>> ax = draw_friction(tbs(1), bounds.least.network, surd("1/5"))
    >>> sorted(line.get_label() for line in ax.collections)
    ['discs', 'slips']
    """
    positions = disc_positions(scene)
    ax, unit = frame(positions, ax)
    segments = contact_segments(scene, positions)
    normal = network.normal.array()
    loaded = np.array(network.normal.signs()) > 0
    sheared = np.array(network.tangential.signs()) != 0
    pairs = zip(network.normal, network.tangential, strict=True)
    limit = np.array([s != 0 and abs(s) == mu * f for f, s in pairs])
    top = float(normal.max(initial=0.0)) or 1.0
    widest = between(0.7 * unit, 0.8, 10)
    handles: list[Artist] = []
    for label, mask, colour in (
        ("no tangential force", loaded & ~sheared, BLACK),
        ("sticks", loaded & sheared & ~limit, BLUE),
        ("slips", loaded & limit, RED),
    ):
        if mask.any():
            widths = np.maximum(widest * normal[mask] / top, _THINNEST).tolist()
            draw_segments(ax, segments[mask], label, widths, colour, round_ends=True)
            handles.append(line_handle(label, colour, 2))
    shown = round_down(top)
    scale = max(widest * shown / top, _THINNEST)
    handles.append(line_handle(f"normal force {shown:g} $w$", BLACK, scale))
    handles += draw_pile(ax, scene, positions, unit)
    ax.set_title(_title(scene, mu, rough), fontsize=11)
    if legend:
        draw_legend(ax, handles)
    return ax


def _title(scene: Scene, mu: Surd, rough: bool = False) -> str:
    return f"{scene_title(scene)}, $\\mu = {mathtext(mu)}$" + ", rough floor" * rough
