"""A solution in a notebook: a table of facts and a small picture, as HTML without a library.

The picture is an inline SVG in disc radii: discs as circles, grey where a motion is prescribed,
contacts as lines as wide as their forces, dashed where they are open. `pictures` draws the real
ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np

from ..numbers.vectors import FloatArray
from ..scenes.scene import Scene

MOST = 3000
"""Discs and contacts that are still drawn: about 200 kB of text."""
_PIXELS = 560, 420
_LOOKS = {
    "open": 'stroke="#c8102e" stroke-width=".06" stroke-dasharray=".24 .16"',
    "osculatory": 'stroke="#1f6fb4" stroke-width=".06" stroke-dasharray=".36 .12 .06 .12"',
}
_THINNEST, _WIDEST = 0.03, 0.7


def page(
    scene: Scene,
    rows: Sequence[tuple[str, str]],
    states: Sequence[str] = (),
    forces: FloatArray | None = None,
    motion: FloatArray | None = None,
) -> str:
    """The HTML of a table of (name, text), and of the scene's picture where it can be drawn.

    `states` and `forces` have one entry a contact, `motion` one a disc and axis, flat: discs are
    shown, in red, where it takes them.
    """
    table = "".join(
        f'<tr><th style="text-align:left">{escape(name)}</th>'
        f'<td style="text-align:left">{escape(text)}</td></tr>'
        for name, text in rows
    )
    return f"<table>{table}</table>{_picture(scene, states, forces, motion)}"


def _picture(
    scene: Scene, states: Sequence[str], forces: FloatArray | None, motion: FloatArray | None
) -> str:
    if scene.dimension != 2:
        return "<p>Only plane scenes are drawn.</p>"
    marks = len(scene.discs) + len(scene.contacts)
    if marks > MOST:
        return f"<p>{marks} discs and contacts: too many to draw here.</p>"
    places = np.array([[float(x), -float(y)] for x, y in (d.position for d in scene.discs)])
    moved = places
    if motion is not None:
        shift = motion.reshape(-1, 2) * [1, -1]
        moved = places + shift * (1.6 / (np.hypot(*shift.T).max(initial=0.0) or 1.0))
    every = np.concatenate([places, moved])
    low, size = every.min(axis=0) - 1.2, np.ptp(every, axis=0) + 2.4
    scale = min(_PIXELS[0] / size[0], _PIXELS[1] / size[1], 30)
    box = " ".join(_short(x) for x in (*low, *size))
    across, up = (size * scale).round().astype(int).tolist()
    body = [_discs(scene, places), *_contacts(scene, places, states, forces)]
    if motion is not None:
        body.append(_circles(moved, 'fill="none" stroke="#c8102e" stroke-width=".06"'))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{across}" height="{up}" '
        f'viewBox="{box}" style="background:#fff">{"".join(body)}</svg>'
    )


def _discs(scene: Scene, places: FloatArray) -> str:
    held = np.array([disc.held.count(None) < len(disc.held) for disc in scene.discs])
    rim = 'stroke="#9a9a9a" stroke-width=".05"'
    return _circles(places[~held], f'fill="#fff" {rim}') + _circles(
        places[held], f'fill="#c9c9c9" {rim}'
    )


def _circles(places: FloatArray, look: str) -> str:
    rings = "".join(f'<circle cx="{_short(x)}" cy="{_short(y)}" r="1"/>' for x, y in places)
    return f"<g {look}>{rings}</g>" if rings else ""


def _contacts(
    scene: Scene, places: FloatArray, states: Sequence[str], forces: FloatArray | None
) -> list[str]:
    """A path for all contacts of one look: one a state, and one a width of the closed ones."""
    a, b = scene.ends
    normals, which = scene.normals
    to_a = np.array([[float(x), -float(y)] for x, y in normals]).reshape(-1, 2)[which]
    other = np.where(b[:, None] >= 0, places[b], places[a] - to_a)  # the foot on a support
    largest = 0.0 if forces is None else float(np.abs(forces).max(initial=0.0))
    lines: dict[str, list[str]] = {}
    for k, (start, end) in enumerate(zip(places[a], other, strict=True)):
        look = 'stroke="#9a9a9a" stroke-width=".05"'
        if forces is not None and largest:
            width = max(_WIDEST * abs(float(forces[k])) / largest, _THINNEST)
            colour = "#c8102e" if forces[k] < 0 else "#1a1a1a"
            look = _LOOKS.get(states[k], f'stroke="{colour}" stroke-width="{width:.2f}"')
        line = "M" + " ".join(_short(x) for x in start) + "L" + " ".join(_short(x) for x in end)
        lines.setdefault(look, []).append(line)
    return [
        f'<path {look} fill="none" stroke-linecap="round" d="{"".join(pieces)}"/>'
        for look, pieces in lines.items()
    ]


def _short(x: float) -> str:
    return f"{x:.2f}".rstrip("0").rstrip(".")
