"""Random small scenes, rigid contacts among them, and what linear programmes say of them.

Patches of the triangular lattice with floor, walls and a ceiling; gaps, loads, compliances, held
discs and bilateral contacts are random. Half of the scenes are mirror-symmetric, so that the half
and the whole can be compared. The data are small numbers, for which a linear programme in floating
point is to be trusted: it says which of three things a scene is, without the package's help.
"""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np
from helpers import float_matrix
from scipy.optimize import linprog

from lcp_piles import Contact, Disc, Scene, Surd, surd

ROOT = surd("sqrt(3)")
ZERO = surd(0)
NORMALS = {  # of a contact whose disc b is that many half steps right and rows up of disc a
    (2, 0): (surd(-1), ZERO),
    (1, 1): (surd("-1/2"), -ROOT / 2),
    (-1, 1): (surd("1/2"), -ROOT / 2),
}
SUPPORTS = {
    "floor": (ZERO, surd(1)),
    "ceiling": (ZERO, surd(-1)),
    "left wall": (surd(1), ZERO),
    "right wall": (surd(-1), ZERO),
    "left slope": (surd("1/2"), ROOT / 2),
    "right slope": (surd("-1/2"), ROOT / 2),
}
OTHER_SIDE = {
    "left wall": "right wall",
    "right wall": "left wall",
    "left slope": "right slope",
    "right slope": "left slope",
}  # of the mirror
_Place = tuple[int, int]


def custom(discs: list[Disc], contacts: list[Contact]) -> Scene:
    """A scene of its own."""
    supports = {contact.b: None for contact in contacts if isinstance(contact.b, str)}
    return Scene(tuple(discs), tuple(contacts), tuple(supports))


def random_scene(seed: int) -> Scene:
    """A small scene of at most eight discs; the same one for the same seed."""
    random = Random(seed)
    symmetric = random.random() < 0.5
    rigid = random.choice([0.0, 0.3, 0.7, 1.0])
    still = random.random() < 0.3  # without gaps
    places = _places(random, symmetric)
    image = {p: (-p[0], p[1]) if symmetric else p for p in places}

    discs = {}
    for p in places:
        load, held = _load(random), _held(random)
        if image[p] in discs:
            load, held = (_reflected(each) for each in discs[image[p]])
        elif symmetric and image[p] == p:
            load, held = (ZERO, load[1]), (None if held[0] is None else ZERO, held[1])
        discs[p] = load, held

    lowest = min(row for _, row in places)
    laws: dict[str, tuple[Fraction, Surd, bool] | None] = {}  # one for a contact and its image
    contacts = []
    for a, b, normal in _touching(places):
        if isinstance(b, str):
            chance = 0.6 if b == "floor" and a[1] == lowest else 0.08
            pair, other = (a, b), (image[a], OTHER_SIDE.get(b, b) if symmetric else b)
        else:
            chance = 0.85
            pair, other = sorted((a, b)), sorted((image[a], image[b]))
        law = _law(random, rigid, still) if random.random() < chance else None
        law = laws.setdefault(min(str(pair), str(other)), law)
        if law is None:
            continue
        compliance, gap, bilateral = law
        if not isinstance(b, str) and random.random() < 0.3:
            a, b, normal = b, a, tuple(-x for x in normal)
        contacts.append(Contact(a, b, normal, compliance, gap, bilateral))
    return custom([Disc(p, (surd(p[0]), ROOT * p[1]), *discs[p]) for p in places], contacts)


def _touching(places: list[_Place]) -> list[tuple[_Place, _Place | str, tuple[Surd, ...]]]:
    """Every contact that the patch may have: its ends and its normal."""
    found: list[tuple[_Place, _Place | str, tuple[Surd, ...]]] = []
    for a in places:
        for (right, up), normal in NORMALS.items():
            b = (a[0] + right, a[1] + up)
            if b in places:
                found.append((a, b, normal))
        found += [(a, name, normal) for name, normal in SUPPORTS.items()]
    return found


def _places(random: Random, symmetric: bool) -> list[_Place]:
    """Lattice points (half steps, rows); the patch is its own image where asked for."""
    patch = [(x, row) for row in range(3) for x in range(-4, 5) if (x + row) % 2]
    chosen = {random.choice(patch)}
    for _ in range(random.randrange(8)):
        x, row = random.choice(sorted(chosen))
        near = [(x + i, row + j) for i, j in [(2, 0), (-2, 0), (1, 1), (-1, 1), (1, -1), (-1, -1)]]
        chosen |= {p for p in [random.choice(near)] if p in patch}
    if symmetric:
        chosen |= {(-x, row) for x, row in chosen}
    return sorted(chosen)


def _reflected(vector: tuple[Surd | None, ...]) -> tuple[Surd | None, ...]:
    return (None if vector[0] is None else -vector[0], vector[1])


def _number(random: Random) -> Surd:
    number = surd(Fraction(random.randint(-6, 6), random.choice([1, 2, 3, 5])))
    return number + random.choice([0, 0, 0, 1, -1, Fraction(2, 3)]) * ROOT


def _load(random: Random) -> tuple[Surd, Surd]:
    kind = random.random()
    if kind < 0.6:
        return ZERO, surd(-1)
    return (ZERO, ZERO) if kind < 0.8 else (_number(random), _number(random))


def _held(random: Random) -> tuple[Surd | None, Surd | None]:
    kind = random.random()
    if kind < 0.6:
        return None, None
    if kind < 0.8:
        return ZERO, ZERO
    shift = random.choice([ZERO, ZERO, _number(random)])
    return random.choice([(shift, None), (None, shift), (shift, surd(random.randint(-1, 1)))])


def _law(random: Random, rigid: float, still: bool) -> tuple[Fraction, Surd, bool]:
    """Compliance, gap, and whether the contact is held closed."""
    hard = random.random() < rigid
    compliance = Fraction(0) if hard else random.choice([Fraction(1), Fraction(1, 2), Fraction(3)])
    gap = ZERO if still or random.random() < 0.4 else _number(random)
    return compliance, gap, random.random() < 0.15


def truth(scene: Scene) -> str:
    """What two linear programmes say: "contradictory", "unstable" or "solved".

    The first asks for displacements that leave no rigid contact overlapping, the second for forces
    that balance the load without pulling; where both exist there is a solution (formulation notes).
    """
    B, o, p = float_matrix(scene)
    rigid = np.array([c.compliance == 0 for c in scene.contacts], dtype=bool)
    tied = np.array([c.bilateral for c in scene.contacts], dtype=bool)
    if not _fits(B[rigid], o[rigid], tied[rigid]):
        return "contradictory"
    return "solved" if _balanced(B.T, -p, tied) else "unstable"


def _balanced(A: np.ndarray, b: np.ndarray, tied: np.ndarray) -> bool:
    """Whether A f = b for some f that is non-negative where it is not tied."""
    rows, columns = A.shape
    if not rows:
        return True
    # The least sum of what is left unbalanced.
    programme = linprog(
        np.append(np.zeros(columns), np.ones(2 * rows)),
        A_eq=np.hstack([A, np.eye(rows), -np.eye(rows)]),
        b_eq=b,
        bounds=[(None if t else 0, None) for t in tied] + [(0, None)] * (2 * rows),
    )
    assert programme.status == 0
    assert not 1e-9 < programme.fun < 1e-4
    return programme.fun < 1e-6


def _fits(B: np.ndarray, o: np.ndarray, tied: np.ndarray) -> bool:
    """Whether B u + o >= 0 for some u, with equality where tied."""
    rows, columns = B.shape
    if not rows:
        return True
    # The least sum of overlaps, and of gaps where tied: B u + o = g + s - r.
    bounds = [(None, None)] * columns + [(0, 0 if t else None) for t in tied]
    programme = linprog(
        np.append(np.zeros(columns + rows), np.ones(2 * rows)),
        A_eq=np.hstack([B, -np.eye(rows), -np.eye(rows), np.eye(rows)]),
        b_eq=-o,
        bounds=bounds + [(0, None)] * (2 * rows),
    )
    assert programme.status == 0
    assert not 1e-9 < programme.fun < 1e-4
    return programme.fun < 1e-6
