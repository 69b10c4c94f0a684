"""The scenes of the comparison by name: "tbs 22", "nt30 6 push=20", "nt30 10 discs=1".

`discs=SEED` makes the discs nearly equal: every radius is off by a random exact amount of at most
5 w tau, which opens and overlaps the contacts at the start and breaks the mirror symmetry.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from random import Random

from lcp_piles import Scene, pile, surd


def build(name: str) -> Scene:
    """The scene of this name."""
    kind, layers, *options = name.split()
    given = dict(option.split("=") for option in options)
    seed = given.pop("discs", None)
    scene = pile(kind, int(layers), **given)
    return scene if seed is None else nearly_equal(scene, int(seed))


def nearly_equal(scene: Scene, seed: int) -> Scene:
    """The scene with radii that are off by random multiples of w tau / 200, at most 5 w tau."""
    random = Random(seed)
    excess = {disc.id: Fraction(random.randint(-1000, 1000), 200) for disc in scene.discs}
    contacts = tuple(
        replace(c, gap=c.gap - surd(excess[c.a] + excess.get(c.b, 0))) for c in scene.contacts
    )
    return Scene(scene.discs, contacts)


def family(name: str) -> str:
    """The name without its size: "nt30 push=20" of "nt30 6 push=20"."""
    kind, _, *options = name.split()
    return " ".join([kind, *options])


def layers(name: str) -> int:
    """The number of layers in a scene's name."""
    return int(name.split()[1])
