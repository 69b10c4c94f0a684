"""What several tests share: checks and brute-force solvers that use none of the package's own.

The only thing taken from the package is its number type, `Surd`, which `test_exact` holds against
sympy.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import chain, combinations
from random import Random

import numpy as np
import pytest
from flint import fmpq, fmpq_mat
from hypothesis import strategies as st

from lcp_piles import Scene, Solution, Surd, pile, solve, surd
from lcp_piles.methods import proved
from lcp_piles.methods.regular_set import Guess

ZERO = surd(0)

# --- linear complementarity problems ---


def affine(
    M: Sequence[Sequence[Fraction]], z: Sequence[Surd | Fraction], q: Sequence[object]
) -> list[Surd]:
    """M z + q in Surds."""
    return [
        sum((surd(m) * surd(x) for m, x in zip(row, z, strict=True)), surd(right))
        for row, right in zip(M, q, strict=True)
    ]


def assert_solves(M: list[list[Fraction]], q: list[object], result: object) -> None:
    """The result is a solution of the LCP (M, q), exactly."""
    assert result.status == "solved"
    assert result.ray is None
    assert result.certificate is None
    w = affine(M, result.z, q)
    assert w == [surd(x) for x in result.w]
    assert all(x >= 0 for x in w)
    assert all(x >= 0 for x in result.z)
    assert all(surd(x) * y == 0 for x, y in zip(result.z, w, strict=True))


def assert_ray(
    M: list[list[Fraction]], q: list[object], result: object, d: list[Fraction] | None = None
) -> None:
    """The result is a secondary ray of w = q + M z + d z0: exactly, and for all steps along it."""
    assert result.status == ("ray" if result.certificate is None else "infeasible")
    assert result.z == ()
    assert result.w == ()
    cover = [Fraction(1)] * len(q) if d is None else d
    ray = result.ray
    foot_w = [x + surd(c) * ray.z0 for x, c in zip(affine(M, ray.z, q), cover, strict=True)]
    moves = affine(M, ray.dz, [c * ray.dz0 for c in cover])
    assert moves == [surd(x) for x in ray.dw]
    assert ray.z0 > 0  # or the foot would be a solution
    for vector in (ray.z, foot_w, ray.dz, ray.dw, [ray.dz0]):
        assert all(x >= 0 for x in vector)
    assert any(ray.dz)  # only the first ray of all, whose end Lemke starts from, moves z0 alone
    for one, other in ((ray.z, foot_w), (ray.z, ray.dw), (ray.dz, foot_w), (ray.dz, ray.dw)):
        assert all(surd(x) * surd(y) == 0 for x, y in zip(one, other, strict=True))


def assert_infeasible(M: list[list[Fraction]], q: list[object], y: Sequence[Fraction]) -> None:
    """y proves that no z >= 0 has M z + q >= 0 (Farkas)."""
    assert all(x >= 0 for x in y)
    for j in range(len(q)):
        assert sum(y[i] * Fraction(M[i][j]) for i in range(len(q))) <= 0
    assert sum((surd(x) * y_i for x, y_i in zip(q, y, strict=True)), ZERO) < 0


def subsets(n: int) -> Iterator[tuple[int, ...]]:
    return chain.from_iterable(combinations(range(n), k) for k in range(n + 1))


def brute_force(M: list[list[Fraction]], q: list[object]) -> list[tuple[list[Surd], list[Surd]]]:
    """(z, w) of every feasible one of the 2^n complementary bases."""
    n = len(q)
    found = []
    radicands = sorted({1} | {r for x in q for r, _ in surd(x).terms})
    parts = {r: [dict(surd(x).terms).get(r, Fraction(0)) for x in q] for r in radicands}
    for basic in subsets(n):
        size = len(basic)
        block = fmpq_mat(size, size, [fmpq_of(M[i][j]) for i in basic for j in basic])
        z = [ZERO] * n
        try:
            for r in radicands if basic else ():
                right = fmpq_mat(size, 1, [-fmpq_of(parts[r][i]) for i in basic])
                for i, x in zip(basic, block.solve(right).entries(), strict=True):
                    z[i] = z[i] + surd(x) * surd(f"sqrt({r})")
        except ZeroDivisionError:
            continue
        w = affine(M, z, q)
        if all(x >= 0 for x in z) and all(x >= 0 for x in w):
            found.append((z, w))
    return found


def matrix_of(A: list[list[int]]) -> list[list[int]]:
    """A A^T."""
    rows = np.array(A, dtype=object)
    return (rows @ rows.T).tolist()


@st.composite
def degenerate(draw: st.DrawFn, most: int = 4) -> tuple[list[list[int]], list[int]]:
    """M = A A^T of any rank and q full of ties: on the boundary between feasible and not."""
    n, rank = draw(st.integers(1, most)), draw(st.integers(0, 3))
    entry = st.integers(-2, 2)
    A = draw(st.lists(st.lists(entry, min_size=rank, max_size=rank), min_size=n, max_size=n))
    M = matrix_of(A) if rank else [[0] * n for _ in range(n)]
    if draw(st.booleans()):
        q = draw(st.lists(st.sampled_from([-1, -1, 0, 1]), min_size=n, max_size=n))
    else:  # a solution with many zeros in z and w, and scaled so that ratios tie
        z = draw(st.lists(st.sampled_from([0, 0, 1]), min_size=n, max_size=n))
        w = [0 if x else draw(st.sampled_from([0, 0, 1])) for x in z]
        q = (np.array(w, dtype=object) - np.array(M, dtype=object) @ z).tolist()
    return M, q


def fmpq_of(x: Fraction | int) -> fmpq:
    x = Fraction(x)
    return fmpq(x.numerator, x.denominator)


# --- scenes ---


def along(normal: Sequence[Surd], vector: Sequence[Surd]) -> Surd:
    return sum((n * x for n, x in zip(normal, vector, strict=True)), ZERO)


def assert_touching_are_contacts(scene: Scene) -> None:
    """By brute force over all pairs of discs of radius 1, in Surds.

    None overlap, those that touch are contacts except where both are held, and there are no others.
    """
    place = {disc.id: disc.position for disc in scene.discs}
    held = {disc.id for disc in scene.discs if disc.fixed}
    touching = set()
    for a, b in combinations(place, 2):
        square = sum(((x - y) * (x - y) for x, y in zip(place[a], place[b], strict=True)), ZERO)
        assert square >= 4
        if square == 4 and not (a in held and b in held):
            touching.add(frozenset((a, b)))
    among = [c for c in scene.contacts if not isinstance(c.b, str)]
    assert {frozenset((c.a, c.b)) for c in among} == touching
    assert len(among) == len(touching)


def equilibrium_faults(scene: Scene, solution: Solution) -> list[str]:
    """What is wrong with forces, gaps and displacements, disc by disc, in plain Surds."""
    faults = []
    axes = range(scene.dimension)
    numbers = list(solution.displacements)
    u = {
        disc.id: tuple(numbers[k * scene.dimension + axis] for axis in axes)
        for k, disc in enumerate(scene.discs)
    }
    rest = {disc.id: list(disc.load) for disc in scene.discs}
    for contact, f, g in zip(scene.contacts, solution.forces, solution.gaps, strict=True):
        there = u[contact.a]
        if not isinstance(contact.b, str):
            there = [x - y for x, y in zip(there, u[contact.b], strict=True)]
        if g != along(contact.normal, there) + contact.gap + contact.compliance * f:
            faults.append(f"{contact.a}-{contact.b} Hooke")
        if f * g != 0 or g < 0 or (f < 0 and not contact.bilateral):
            faults.append(f"{contact.a}-{contact.b} sign")
        for axis in axes:
            rest[contact.a][axis] += f * contact.normal[axis]
            if not isinstance(contact.b, str):
                rest[contact.b][axis] -= f * contact.normal[axis]
    for disc in scene.discs:
        for axis in axes:
            held = disc.held[axis]
            if held is None and rest[disc.id][axis] != 0:
                faults.append(f"{disc.id} axis {axis} balance")
            if held is not None and u[disc.id][axis] != held:
                faults.append(f"{disc.id} axis {axis} held")
    return faults


def float_matrix(scene: Scene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(B, o, p) of the whole scene over its free motions, from positions and normals as floats.

    gap = B u + o + c f, with the prescribed motions in o.
    """
    dimension = scene.dimension
    B = np.zeros((len(scene.contacts), len(scene.discs) * dimension))
    o = np.array([float(contact.gap) for contact in scene.contacts])
    number = {disc.id: k for k, disc in enumerate(scene.discs)}
    for k, contact in enumerate(scene.contacts):
        n = [float(x) for x in contact.normal]
        for end, sign in ((contact.a, 1), (contact.b, -1)):
            if not isinstance(end, str):
                first = number[end] * dimension
                B[k, first : first + dimension] += sign * np.array(n)
    held = [h for disc in scene.discs for h in disc.held]
    fixed = np.array([h is not None for h in held])
    o += B @ np.array([float(h or 0) for h in held])
    p = np.array([float(x) for disc in scene.discs for x in disc.load])
    return B[:, ~fixed], o, p[~fixed]


def nullity(A: np.ndarray) -> int:
    """Dimension of the kernel, by singular values."""
    return A.shape[1] - (int(np.linalg.matrix_rank(A, tol=1e-9)) if A.size else 0)


def with_gaps(scene: Scene, gaps: Sequence[Surd | Fraction | int]) -> Scene:
    """The scene with these initial gaps, as a scene of its own."""
    contacts = tuple(
        replace(contact, gap=surd(gap)) for contact, gap in zip(scene.contacts, gaps, strict=True)
    )
    return Scene(scene.discs, contacts)


def image_contacts(scene: Scene) -> list[int]:
    """For every contact the one that the mirror x -> -x makes of it, by where the discs are."""

    def place(end: object, sign: int) -> object:
        if isinstance(end, str):
            return end
        x, *others = scene.disc(end).position
        return (sign * x, *others)

    def ends(contact: object, sign: int) -> frozenset[object]:
        return frozenset((place(contact.a, sign), place(contact.b, sign)))

    at = {ends(contact, 1): k for k, contact in enumerate(scene.contacts)}
    return [at[ends(contact, -1)] for contact in scene.contacts]


def solved_from(scene: Scene, random: Random) -> Solution:
    """The solution when floating point proposes any contacts at all as closed."""

    def guess(system: object) -> Guess:
        closed = [random.random() < 0.7 for _ in range(system.contacts)]
        return Guess(np.array(closed, dtype=bool), np.array([random.random() for _ in closed]))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(proved, "float_guess", guess)
        return solve(scene, "proved")


small_fractions = st.fractions(min_value=-1, max_value=1, max_denominator=12)
pushes = st.builds(
    lambda a, b: surd(a) + surd(b) * surd("sqrt(3)"),
    st.fractions(min_value=-8, max_value=30, max_denominator=4),
    st.sampled_from([Fraction(0), Fraction(0), Fraction(-1), Fraction(7, 3), Fraction(31, 2)]),
)


@st.composite
def piles(draw: st.DrawFn, rigid: bool = True) -> Scene:
    """A small pile of any kind, with any push and any floor that the formulation promises."""
    kind = draw(st.sampled_from(["nt60", "nt30", "tss", "tbs"]))
    if kind == "tbs":
        return pile("tbs", draw(st.integers(1, 5)))
    return pile(
        kind,
        draw(st.integers(2, 4 if kind == "nt30" else 6)),
        push=draw(pushes),
        floor_compliance=draw(st.sampled_from([1, 0, "1/2", 3, "2/7"] if rigid else [1, "1/2"])),
        corner_stones=draw(st.sampled_from(["held", "resting"])),
    )


@st.composite
def rough_piles(draw: st.DrawFn, symmetric: bool = False) -> Scene:
    """A small pile whose contacts have random initial gaps, of discs that are nearly equal."""
    scene = draw(piles())
    n = len(scene.contacts)
    gaps = draw(st.lists(small_fractions, min_size=n, max_size=n))
    if symmetric:
        gaps = [gaps[min(k, image)] for k, image in enumerate(image_contacts(scene))]
    return with_gaps(scene, gaps)
