"""Problems and scenes on which methods fail, each with what is known of its exact answer.

Every answer here comes from how the problem was made, from a closed form or from the paper, never
from the package's own solvers. At the end is what tests and figures share to run the
floating-point methods and to read contact states from what they find.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np

from lcp_piles import Scene, Solution, Surd, contact_system, nt30, nt60, pile, surd
from lcp_piles.mechanics.system import ContactSystem
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lcp, float_lemke
from lcp_piles.methods.float_state import FloatState, float_solution
from lcp_piles.methods.gauss_seidel import gauss_seidel
from lcp_piles.methods.newton import newton
from lcp_piles.scenes.names import DiscId
from lcp_piles.solution.record import make_record

Numbers = tuple[Fraction, ...]


@dataclass(frozen=True)
class LCPCase:
    """An LCP (M, q) and its solution; `z` may be one of several, `w` is unique."""

    name: str
    M: tuple[Numbers, ...]
    q: Numbers
    z: Numbers
    w: Numbers

    def floats(self) -> tuple[np.ndarray, np.ndarray]:
        return np.array(self.M, dtype=float), np.array(self.q, dtype=float)


def _case(name: str, M: list[list[Fraction]], z: list[Fraction], w: list[Fraction]) -> LCPCase:
    q = [
        b - sum((x * y for x, y in zip(row, z, strict=True)), Fraction(0))
        for row, b in zip(M, w, strict=True)
    ]
    return LCPCase(name, tuple(map(tuple, M)), tuple(q), tuple(z), tuple(w))


# --- linear complementarity problems ---


def kostreva() -> LCPCase:
    """Kostreva (1979), "Cycling in linear complementarity problems", Math. Program. 16.

    A P-matrix whose rows all tie at the start; z = (1, 1, 1)/3.
    """
    M = [[Fraction(x) for x in row] for row in ([1, 2, 0], [0, 1, 2], [2, 0, 1])]
    return _case("kostreva", M, [Fraction(1, 3)] * 3, [Fraction(0)] * 3)


def murty(n: int) -> LCPCase:
    """Murty (1978), "Computational complexity of complementary pivot methods": 2^n pivots.

    M is lower triangular, 1 on and 2 below the diagonal, q_i = -(2^n + ... + 2^(n - i + 1)) for
    i = 1..n; z = (2^n, 0, ..., 0).
    """
    M = [[Fraction(1 if i == j else 2 * (j < i)) for j in range(n)] for i in range(n)]
    z = [Fraction(2**n * (j == 0)) for j in range(n)]
    return _case(f"murty {n}", M, z, [Fraction(2 ** (n - i) * (i > 0)) for i in range(n)])


def fathi(n: int) -> LCPCase:
    """Fathi (1979), "Computational complexity of LCPs associated with positive definite matrices".

    M = L L^T with Murty's L. Fathi's q is -(1, ..., 1); here q_i = -1 + 4^-(i + 2), i = 1..n, so
    that no rows tie and every rule takes the 2^n pivots; z = (63/64, 0, ..., 0).
    """
    L = murty(n).M
    M = [[sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0)) for b in L] for a in L]
    z = [Fraction(63 * (j == 0), 64) for j in range(n)]
    w = [row[0] * z[0] - 1 + Fraction(1, 4 ** (i + 3)) for i, row in enumerate(M)]
    return _case(f"fathi {n}", M, z, w)


def degenerate(seed: int, size: int, rank: int, decades: int = 0) -> LCPCase:
    """A random positive semidefinite LCP in which 30 % of the pairs are both zero.

    M = D A A^T D with A (size, rank) of small fractions and D powers of ten from 10^-decades to
    10^decades; z and w are drawn, q follows. M being symmetric, w is unique, z may not be.
    """
    random = Random(seed)
    A = []
    for _ in range(size):
        scale = Fraction(10) ** random.randint(-decades, decades)
        A.append([scale * random.randint(-9, 9) / random.randint(1, 9) for _ in range(rank)])
    M = [[sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0)) for b in A] for a in A]
    z, w = [Fraction(0)] * size, [Fraction(0)] * size
    for i in range(size):
        kind = random.random()
        if kind >= 0.3:
            (z if kind < 0.65 else w)[i] = Fraction(random.randint(1, 9))
    return _case(f"degenerate {seed} {size} {rank} {decades}", M, z, w)


# --- scenes ---

LAST_BREAKPOINT = surd("667/6*sqrt(3)")
"""The last rearrangement of the NT30 pile of 6 layers on a floor of compliance 1 (formulation)."""


def near_breakpoint(k: int, side: int) -> Scene:
    """The 6-layer NT30 pile pushed to its last breakpoint plus side 10^-k (side -1, 0 or 1)."""
    return nt30(6, push=LAST_BREAKPOINT + Fraction(side, 10**k))


def beside(one: Scene, other: Scene) -> Scene:
    """Two scenes as one, the second far to the right: its first ids are shifted by 1000."""

    def moved(id: DiscId) -> DiscId:
        return (id[0] + 1000, *id[1:])

    discs = tuple(
        replace(d, id=moved(d.id), position=(d.position[0] + 1000, *d.position[1:]))
        for d in other.discs
    )
    contacts = tuple(
        replace(c, a=moved(c.a), b=c.b if isinstance(c.b, str) else moved(c.b))
        for c in other.contacts
    )
    return Scene(one.discs + discs, one.contacts + contacts)


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
    """A scene made from forces, gaps and displacements that were drawn first."""

    scene: Scene
    forces: tuple[Fraction, ...]
    gaps: tuple[Fraction, ...]


def random_scene(seed: int) -> SceneCase:
    """A small pile whose initial gaps and loads were chosen so that a drawn state is its solution.

    Of each contact force or gap or, with a chance of 30 %, neither is positive. Forces are unique;
    a gap of the drawn state is one of several where the closed contacts leave mechanisms.
    """
    random = Random(seed)
    kind = random.choice(["nt60", "nt30", "tss", "tbs"])
    scene = pile(kind, random.randint(2, 3 if kind == "nt30" else 4))
    zero = surd(0)
    u = {
        d.id: tuple(zero if h is not None else surd(random.randint(-5, 5)) for h in d.held)
        for d in scene.discs
    }
    loads = {d.id: [zero, zero] for d in scene.discs}
    contacts, forces, gaps = [], [], []
    for c in scene.contacts:
        chance = random.random()
        f = Fraction(random.randint(1, 9)) if 0.3 <= chance < 0.75 else Fraction(0)
        g = Fraction(random.randint(1, 9)) if chance >= 0.75 else Fraction(0)
        motion = list(u[c.a])
        loads[c.a] = [p - f * n for p, n in zip(loads[c.a], c.normal, strict=True)]
        if not isinstance(c.b, str):
            motion = [x - y for x, y in zip(motion, u[c.b], strict=True)]
            loads[c.b] = [p + f * n for p, n in zip(loads[c.b], c.normal, strict=True)]
        stretch = sum((n * x for n, x in zip(c.normal, motion, strict=True)), zero)
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
    kind = random.choice(["nt60", "nt30", "tss", "tbs"])
    scene = pile(kind, random.randint(2, 3 if kind == "nt30" else 4))
    zero = surd(0)
    still = (zero,) * scene.dimension
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
        if not isinstance(c.b, str):
            motion = tuple(x - y for x, y in zip(motion, u.get(c.b, still), strict=True))
        opening = sum((n * x for n, x in zip(c.normal, motion, strict=True)), zero)
        if opening < 0:
            continue
        contacts.append(c)
        f = 0 if opening > 0 else random.randint(0, 9)
        loads[c.a] = [p - f * n for p, n in zip(loads[c.a], c.normal, strict=True)]
        if not isinstance(c.b, str):
            loads[c.b] = [p + f * n for p, n in zip(loads[c.b], c.normal, strict=True)]
    discs = tuple(replace(d, load=tuple(loads[d.id])) for d in scene.discs)
    return Scene(discs, tuple(contacts))


# --- floating-point runs, and contact states read from them ---

RELAXED: dict[str, Callable[[ContactSystem], Any]] = {
    "Newton": newton,
    "FIRE": lambda system: fire(system, tolerance=1e-11, max_iterations=20_000),
    "Gauss-Seidel": lambda system: gauss_seidel(system, tolerance=1e-10, max_sweeps=5000),
}
"""Methods that find displacements, with a tolerance that they reach on ordinary piles."""


def in_floats(scene: Scene, method: str) -> tuple[Solution, bool]:
    """All that a method of `RELAXED`, or "Lemke", computed for a scene, and whether it converged.

    The states are not to be used: `misread` reads them, at any threshold.
    """
    system = contact_system(scene)
    if method == "Lemke":
        B, C, o, _ = system.floats()
        run = float_lemke(*float_lcp(system))
        U = np.linalg.lstsq(B.toarray(), run.z - o - C * run.w, rcond=None)[0]
        return whole(system, U, run.w, run.z), run.converged
    run = RELAXED[method](system)
    return whole(system, run.U, run.forces, run.gaps), run.converged


def whole(
    system: ContactSystem,
    U: np.ndarray,
    forces: np.ndarray,
    gaps: np.ndarray,
    threshold: float = 0.0,
) -> Solution:
    """Displacements, forces and gaps in floats as a solution of the whole scene."""
    state = FloatState(U, forces, gaps, forces > 0, 0, 0.0, True)
    return float_solution(system, state, make_record(system, "", "", 0, ""), threshold)


def loaded_stiffness(system: ContactSystem, closed: np.ndarray) -> np.ndarray:
    """B^T C^-1 B of the contacts in the mask `closed`, dense."""
    B, C, _, _ = system.floats()
    rows = B.toarray()[closed]
    return rows.T @ (rows / C[closed][:, None])


def misread(solution: Solution, truth: tuple[str, ...], threshold: float) -> int:
    """How many contacts are named wrongly by a threshold relative to the largest force or length.

    Closed where the force is above it, else open where the gap is, else osculatory.
    """
    f, g = np.abs(solution.force_array), solution.gap_array
    length = max(np.abs(solution.displacement_array).max(), g.max())
    pairs = zip(f > threshold * f.max(), g > threshold * length, truth, strict=True)
    return sum(("closed" if x else "open" if y else "osculatory") != name for x, y, name in pairs)


THRESHOLDS = tuple(10.0 ** (-k / 2) for k in range(41))
"""From 1 down to 1e-20, two a decade."""
ABOVE_ROUNDING = tuple(t for t in THRESHOLDS if t > 1e-16)
"""Below, a threshold reads rounding, and may be right by luck."""
