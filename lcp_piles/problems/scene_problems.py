"""Scenes with what is known of their answers: ties, near ties, scenes that just stand or fall.

Every answer comes from how the scene was made or from a closed form, never from a solver.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random

from ..numbers.exact import ONE, ZERO, Surd, surd
from ..scenes.kinds import pile
from ..scenes.names import DiscId
from ..scenes.nt30 import nt30
from ..scenes.nt60 import nt60
from ..scenes.scene import Contact, Disc, Scene
from .lcp_problems import GRAIN_C, GRAIN_Q, grain

LAST_BREAKPOINT = surd("667/6*sqrt(3)")
"""The last rearrangement of the NT30 pile of 6 layers on a floor of compliance 1 (formulation)."""


def near_breakpoint(k: int, side: int) -> Scene:
    """The 6-layer NT30 pile pushed to its last breakpoint plus side 10^-k (side -1, 0 or 1)."""
    return nt30(6, push=LAST_BREAKPOINT + Fraction(side, 10**k))


def beside(one: Scene, other: Scene) -> Scene:
    """Two scenes as one, the second far to the right: its ids begin with "right"."""

    def moved(id: DiscId) -> DiscId:
        return ("right", *(id if isinstance(id, tuple) else (id,)))

    discs = tuple(
        replace(d, id=moved(d.id), position=(d.position[0] + 1000, *d.position[1:]))
        for d in other.discs
    )
    contacts = tuple(
        replace(c, a=moved(c.a), b=c.b if c.b in other.supports else moved(c.b))
        for c in other.contacts
    )
    supports = dict.fromkeys(one.supports + other.supports)
    return Scene(one.discs + discs, one.contacts + contacts, tuple(supports))


def side_load(layers: int, load: Surd) -> Scene:
    """NT60 with a horizontal load on the apex.

    The apex rests on two discs along (+-1/2, sqrt(3)/2), so its two forces are 1/sqrt(3) +- load:
    beyond 1/sqrt(3) one would have to pull, and nothing holds the apex.
    """
    scene = nt60(layers)
    apex = scene.discs[0]
    return Scene((replace(apex, load=(load, apex.load[1])), *scene.discs[1:]), scene.contacts)


APEX_LIMIT = surd("1/3*sqrt(3)")


def stiff_every_other(kind: str, layers: int, decades: int) -> Scene:
    """A pile in which every other contact is 10^decades times as stiff as the rest."""
    scene = pile(kind, layers)
    contacts = tuple(
        replace(c, compliance=Fraction(1, 10**decades) if k % 2 else Fraction(1))
        for k, c in enumerate(scene.contacts)
    )
    return Scene(scene.discs, contacts)


@dataclass(frozen=True)
class SceneCase:
    """A scene with forces (w) and gaps (w tau) that solve it, one a contact."""

    scene: Scene
    forces: tuple[Surd | Fraction, ...]
    gaps: tuple[Surd | Fraction, ...]


_LARGEST = {"nt60": 4, "nt30": 3, "tss": 4, "tbs": 4}
"""Kinds of small random piles, and how many layers they have at most."""


def random_scene(seed: int) -> SceneCase:
    """A small pile whose initial gaps and loads were chosen so that a drawn state is its solution.

    Of each contact force or gap or, with a chance of 30 %, neither is positive. Forces are unique;
    a gap of the drawn state is one of several where the closed contacts leave mechanisms.
    """
    random = Random(seed)
    kind = random.choice(list(_LARGEST))
    scene = pile(kind, random.randint(2, _LARGEST[kind]))
    u = {
        d.id: tuple(ZERO if h is not None else surd(random.randint(-5, 5)) for h in d.held)
        for d in scene.discs
    }
    loads = {d.id: [ZERO, ZERO] for d in scene.discs}
    contacts: list[Contact] = []
    forces: list[Fraction] = []
    gaps: list[Fraction] = []
    for c in scene.contacts:
        chance = random.random()
        f = Fraction(random.randint(1, 9)) if 0.3 <= chance < 0.75 else Fraction(0)
        g = Fraction(random.randint(1, 9)) if chance >= 0.75 else Fraction(0)
        motion = list(u[c.a])
        loads[c.a] = [p - f * n for p, n in zip(loads[c.a], c.normal, strict=True)]
        if c.b not in scene.supports:
            motion = [x - y for x, y in zip(motion, u[c.b], strict=True)]
            loads[c.b] = [p + f * n for p, n in zip(loads[c.b], c.normal, strict=True)]
        stretch = sum((n * x for n, x in zip(c.normal, motion, strict=True)), ZERO)
        contacts.append(replace(c, gap=surd(g) - stretch - c.compliance * f))
        forces.append(f)
        gaps.append(g)
    discs = tuple(replace(d, load=tuple(loads[d.id])) for d in scene.discs)
    return SceneCase(Scene(discs, tuple(contacts)), tuple(forces), tuple(gaps))


def random_collapse(seed: int) -> Scene:
    """A small pile that cannot stand: discs move, no contact resists, and the load does work.

    Contacts that the drawn motion u would close are left out. Forces are drawn on those that it
    leaves at rest, and the load is what balances them plus 10^-k u with k = 0, 6 or 12, so that it
    does the work 10^-k |u|^2 and the pile is a hair from standing.
    """
    random = Random(seed)
    kind = random.choice(list(_LARGEST))
    scene = pile(kind, random.randint(2, _LARGEST[kind]))
    still = (ZERO,) * scene.dimension
    free = [d.id for d in scene.discs if d.held == (None, None)]
    u = {
        id: tuple(surd(random.choice([-2, -1, 1, 2])) for _ in still)
        for id in random.sample(free, min(len(free), random.randint(1, 2)))
    }
    share = Fraction(1, 10 ** random.choice([0, 6, 12]))
    loads = {d.id: [share * x for x in u.get(d.id, still)] for d in scene.discs}
    contacts = []
    for c in scene.contacts:
        motion = u.get(c.a, still)
        if c.b not in scene.supports:
            motion = tuple(x - y for x, y in zip(motion, u.get(c.b, still), strict=True))
        opening = sum((n * x for n, x in zip(c.normal, motion, strict=True)), ZERO)
        if opening < 0:
            continue
        contacts.append(c)
        f = 0 if opening > 0 else random.randint(0, 9)
        loads[c.a] = [p - f * n for p, n in zip(loads[c.a], c.normal, strict=True)]
        if c.b not in scene.supports:
            loads[c.b] = [p + f * n for p, n in zip(loads[c.b], c.normal, strict=True)]
    discs = tuple(replace(d, load=tuple(loads[d.id])) for d in scene.discs)
    return Scene(discs, tuple(contacts))


def grain_scene() -> SceneCase:
    """The problem `lcp_problems.grain` as a disc between two springs and three walls.

    With unit normals -c/|c| the compliance of a wall is 1/|c|^2 and its gap q/|c|. Contacts 0 and 1
    are the springs, 2 to 4 the walls; a wall's force is |c_i| f_i, its gap w_i/|c_i|.
    """
    axes = ((ONE, ZERO), (ZERO, ONE))
    springs = [
        Contact((1,), f"spring {name}", normal, bilateral=True)
        for name, normal in zip("xy", axes, strict=True)
    ]
    known = grain()
    walls: list[Contact] = []
    # The springs hold the disc at u = -sum c_i f_i, each with minus its component of u.
    forces = [
        sum((c[axis] * f for c, f in zip(GRAIN_C, known.z, strict=True)), ZERO) for axis in (0, 1)
    ]
    gaps = [ZERO, ZERO]
    for i, (c, q) in enumerate(zip(GRAIN_C, GRAIN_Q, strict=True)):
        square = sum(x * x for x in c)
        length = surd(f"sqrt({square})")
        normal = tuple(-x / length for x in c)
        walls.append(Contact((1,), f"wall {i + 1}", normal, Fraction(1, square), q / length))
        forces.append(length * known.z[i])
        gaps.append(known.w[i] / length)
    contacts = (*springs, *walls)
    disc = Disc((1,), (ZERO, ZERO), (ZERO, ZERO), (None, None))
    scene = Scene((disc,), contacts, tuple(str(contact.b) for contact in contacts))
    return SceneCase(scene, tuple(forces), tuple(gaps))
