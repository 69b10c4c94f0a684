"""Whether what a certificate claims is true, by the package and not by the checker.

The solver, exact linear programming and the identities of `solution` judge: the checker shares no
line with them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from lcp_piles import Scene, Surd, force_bounds, linear_program, pile, solve, surd
from lcp_piles.files.hex_vectors import read_vector
from lcp_piles.files.scene_json import read_lone_scene
from lcp_piles.friction.equations import friction_problem
from lcp_piles.numbers.exact import ONE, ZERO
from lcp_piles.numbers.vectors import ExactVector, combination
from lcp_piles.programs.linear_program import minimise
from lcp_piles.solution.identities import gaps_of, identity_faults
from lcp_piles.solution.solution import states_of
from tests.certified import Entry


def is_true(entry: Entry, words: list[str]) -> bool:
    """Whether the claim of a certificate is true, and the checker's words say no more."""
    return JUDGES[entry["claim"]](entry, words)


def scene_of(entry: Entry) -> Scene:
    """The scene of a certificate; discs that are written out get some place."""
    if "kind" in entry:
        return pile(**entry)
    discs = [{"position": ["0"] * len(disc["load"]), **disc} for disc in entry["discs"]]
    return read_lone_scene({**entry, "discs": discs, "geometric": False})


def words_of(solved: Any) -> list[str]:
    """What the checker should say of a solution whose claims are true."""
    loaded = sum(x != 0 for x in solved.forces.signs())
    stability = solved.stability
    words = [
        f"the forces solve the scene, on {loaded} contacts of {len(solved.forces)}",
        f"motions that leave the contacts with forces at rest: {stability.mechanisms}",
    ]
    if not solved.scene.definite:
        return [*words, "a compliance is negative: no word on other solutions and on stability"]
    idle = sum(
        state == "osculatory" and not contact.bilateral
        for state, contact in zip(solved.states, solved.scene.contacts, strict=True)
    )
    several = solved.gap_unique.count(False)
    return [
        *words,
        f"open in some solution: {solved.count('open')} contacts; just touching in all: {idle}",
        "no other forces solve it" if solved.forces_unique else "other forces solve it too",
        f"motions that leave at rest all that touch: {stability.free}; they change {several} gaps",
        f"the equilibrium is {stability.verdict}",
    ]


def _solves(scene: Scene, u: ExactVector, f: ExactVector) -> bool:
    g = gaps_of(scene, u, f)
    return not any(identity_faults(scene, u, f, g, states_of(f, g)))


def _state(scene: Scene, entry: Entry) -> tuple[ExactVector, ExactVector]:
    places = len(scene.discs) * scene.dimension
    f = read_vector(entry["f"], len(scene.contacts), "f")
    return read_vector(entry["u"], places, "u"), f


def _forces(entry: Entry, words: list[str]) -> bool:
    scene = scene_of(entry["scene"])
    return _solves(scene, *_state(scene, entry)) and words_of(solve(scene)) == words


def _collapse(entry: Entry, _: list[str]) -> bool:
    return solve(scene_of(entry["scene"])).status == "unstable"


def _bounds(entry: Entry, _: list[str]) -> bool:
    scene = scene_of(entry["scene"])
    for bound in entry["bounds"]:
        contacts = [scene.contacts[int(k)] for k in bound["weights"]]
        pairs = [(surd(n), surd(t)) for n, t in bound["weights"].values()]
        what = {(c.a, c.b): pair for c, pair in zip(contacts, pairs, strict=True)}
        found = force_bounds(scene, entry["friction"], what, entry["rough"])
        value = getattr(found, bound["end"]).value
        claimed = surd(bound["value"]) if "ray" not in bound else None
        if value != claimed:
            return False
    return True


def _critical(entry: Entry, _: list[str]) -> bool:
    scene = scene_of(entry["scene"])

    def stands(mu: str) -> bool:
        problem = friction_problem(scene, mu, entry["rough"])
        nothing = [ZERO] * len(problem.constraints.columns)
        return minimise(problem.constraints, nothing).status == "optimal"

    return stands(entry["upper"]) and ("lower" not in entry or not stands(entry["lower"]))


def _path(entry: Entry, _: list[str]) -> bool:
    first, last = scene_of(entry["scene"]), scene_of(entry["towards"])
    points = [(surd(p["t"]), *_state(first, p)) for p in entry["points"]]
    if "direction" in entry:
        t, u, f = points[-1]
        v, h = _state(first, entry["direction"])
        far = surd(1000)
        moved = (combination([(ONE, a), (far, b)]) for a, b in ((u, v), (f, h)))
        points.append((t + far, *moved))
    half = surd("1/2")
    middle = [
        tuple(
            half * (a + b) if isinstance(a, Surd) else combination([(half, a), (half, b)])
            for a, b in zip(one, two, strict=True)
        )
        for one, two in pairwise(points)
    ]
    ordered = all(one[0] <= two[0] for one, two in pairwise(points))
    return ordered and all(
        _solves(_between(first, last, t), u, f) for t, u, f in [*points, *middle]
    )


def _between(first: Scene, last: Scene, t: Surd) -> Scene:
    """The scene with gaps, loads and held displacements t of the way from one to the other."""

    def mixed(a: Any, b: Any) -> Any:
        return None if a is None else a + (b - a) * t

    discs = [
        replace(
            one,
            load=tuple(map(mixed, one.load, two.load)),
            held=tuple(map(mixed, one.held, two.held)),
        )
        for one, two in zip(first.discs, last.discs, strict=True)
    ]
    contacts = [
        replace(one, gap=mixed(one.gap, two.gap))
        for one, two in zip(first.contacts, last.contacts, strict=True)
    ]
    return replace(first, discs=tuple(discs), contacts=tuple(contacts))


def _lcp(entry: Entry, words: list[str]) -> bool:
    size = entry["size"]
    q = list(read_vector(entry["q"], size, "q"))
    rows, columns = (
        [int(x, 16) for x in entry[name].split(" ") if x] for name in ("rows", "columns")
    )
    M = [[Fraction(0)] * size for _ in range(size)]
    values = read_vector(entry["M"], len(rows), "M")
    for i, j, x in zip(rows, columns, values, strict=True):
        M[i][j] = x.rational()
    if "z" not in entry:  # no z, s >= 0 have M z - s = -q
        rows = [[*row, *(-int(i == k) for k in range(size))] for i, row in enumerate(M)]
        return linear_program([0] * 2 * size, rows, [-x for x in q]).status == "infeasible"
    z = list(read_vector(entry["z"], size, "z"))
    w = [
        sum((surd(x) * y for x, y in zip(row, z, strict=True)), b)
        for row, b in zip(M, q, strict=True)
    ]
    return all(a >= 0 and b >= 0 and not a * b for a, b in zip(z, w, strict=True)) and bool(words)


JUDGES: dict[str, Callable[[Entry, list[str]], bool]] = {
    "forces": _forces,
    "collapse": _collapse,
    "bounds": _bounds,
    "critical friction": _critical,
    "path": _path,
    "lcp": _lcp,
}
