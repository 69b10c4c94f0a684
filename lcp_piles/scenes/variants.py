"""Variants of a scene: another load on a disc, contacts that cannot open.

Vacancies are `Scene.without`. All of these are scenes of their own, with no origin.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..errors import InputError
from ..numbers.exact import Exact
from .conversion import numbers_of
from .names import DiscId, end_name
from .scene import Scene


def loaded(scene: Scene, disc: DiscId, force: Sequence[Exact]) -> Scene:
    """The scene with a force on a disc beside what it bears already.

    Parameters
    ----------
    scene : Scene
        Any scene.
    disc : int, str or tuple
        The id of the disc.
    force : sequence of exact numbers
        The force (w), one entry an axis.

    Returns
    -------
    Scene
        The variant, which has no origin.

    Raises
    ------
    InputError
        Where the scene has no such disc, or the force has not one exact number an axis.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> loaded(nt60(2), (1, 1), (0, -5)).disc((1, 1)).load[1]
    Surd('-6')
    """
    old = scene.discs[scene.disc_index(disc)]
    numbers = numbers_of(force, f"the force on disc {end_name(old.id)}")
    if len(numbers) != scene.dimension:
        raise InputError(
            f"the force on disc {end_name(old.id)}", force, f"{scene.dimension} components"
        )
    load = tuple(x + y for x, y in zip(old.load, numbers, strict=True))
    new = replace(old, load=load)
    return replace(scene, discs=tuple(new if d is old else d for d in scene.discs))


def bilateral(scene: Scene) -> Scene:
    """The scene with every contact held closed: the linear network that bears tension too.

    Parameters
    ----------
    scene : Scene
        Any scene.

    Returns
    -------
    Scene
        The variant, which has no origin.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> all(contact.bilateral for contact in bilateral(nt60(3)).contacts)
    True
    """
    return replace(scene, contacts=tuple(replace(c, bilateral=True) for c in scene.contacts))
