"""Packings that several tests share, and their forces in 50 digits by a way of their own."""

from __future__ import annotations

from pathlib import Path

import mpmath
import numpy as np

from lcp_piles import Packing, packing

DATA = Path(__file__).parent / "data"
ROOT3 = 3**0.5


def settled(shift: float = 0.0, **changes: object) -> Packing:
    """The hundred discs of LAMMPS (`data/settle.py`), each moved at random by `shift`."""
    rows = np.loadtxt(DATA / "settled-100.dump", skiprows=9)
    ids, x, r, m = rows[:, 0].astype(int).tolist(), rows[:, 1:3], rows[:, 3], rows[:, 4]
    x = x + shift * np.random.default_rng(0).uniform(-1, 1, x.shape)
    box = {"floor": 0.0, "left": 0.0, "right": 9.0}
    return packing(
        x, r, **({"weights": m, "supports": box, "stiffness": 1e4, "ids": ids} | changes)
    )


def settled_forces() -> dict[frozenset[int], float]:
    """The forces between those discs that LAMMPS found, by pairs of ids."""
    rows = np.loadtxt(DATA / "settled-100-pairs.dump", skiprows=9)
    return {frozenset((int(a), int(b))): f for a, b, f in rows.tolist()}


def rough_lattice(
    columns: int, rows: int, noise: float, stiffness: float, seed: int = 0
) -> Packing:
    """Discs near the points of a triangular lattice in a box, all neighbours contacts."""
    rng = np.random.default_rng(seed)
    places = [
        (1 + 2 * i + j % 2, 1 + j * ROOT3) for j in range(rows) for i in range(columns - j % 2)
    ]
    x = np.array(places) + noise * rng.standard_normal((len(places), 2))
    box = {"floor": 0.0, "left": 0.0, "right": 2.0 * columns}
    return packing(x, 1, supports=box, stiffness=stiffness, tolerance=0.05)


def heap_places(axes: int, layers: int) -> np.ndarray:
    """A few close-packed layers, of discs in rows or of spheres."""
    if axes == 2:
        places = [(2 * i + j % 2, j * ROOT3) for j in range(layers) for i in range(3)]
    else:
        high = (8 / 3) ** 0.5
        places = [
            (2 * i + (j + k) % 2, ROOT3 * (j + k % 2 / 3), k * high)
            for k in range(layers)
            for j in range(2)
            for i in range(2)
        ]
    return np.array(places)


def squeezed(seed: int, shrink: float) -> Packing:
    """Weightless discs between two plates, in a period; some are smaller, and may rattle."""
    rng = np.random.default_rng(seed)
    x = np.array([(1 + 2 * i + j % 2, 1 + j * ROOT3) for j in range(6) for i in range(6)])
    r = np.where(rng.random(len(x)) < 0.12, shrink, 1.002)
    plates = {"floor": 0.0, "ceiling": 2 + 5 * ROOT3}
    return packing(
        x + 1e-3 * rng.standard_normal(x.shape),
        r,
        weights=0,
        supports=plates,
        period=12.0,
        stiffness=1e4,
        tolerance=0.06,
    )


@mpmath.workdps(50)
def true_forces(p: Packing, loaded: np.ndarray) -> list[mpmath.mpf]:
    """The forces of all contacts in 50 digits, if the loaded ones are the given set.

    From centres, radii and walls alone: the springs of the loaded contacts are solved in mpmath,
    and `AssertionError` says where a force is not positive or balance fails. Where the gaps of the
    others are not negative either, these are the forces of the packing, because those are unique.
    """
    x = [[mpmath.mpf(t) for t in row] for row in p.geometry.centres.tolist()]
    r = [mpmath.mpf(t) for t in p.geometry.radii.tolist()]
    number = {(int(k), i): n for n, (k, i) in enumerate(np.argwhere(~p.held).tolist())}
    size = len(number)
    rows, gaps = [], []
    for k in range(len(p.a)):
        a, b = int(p.a[k]), int(p.b[k])
        if b >= 0:
            line = [s - t for s, t in zip(x[a], x[b], strict=True)]
            line[0] -= mpmath.mpf(p.geometry.period or 0) * int(p.geometry.image[k])
            gap = mpmath.sqrt(sum(t * t for t in line)) - r[a] - r[b]
        else:
            wall = p.geometry.walls[p.supports[p.support[k]]]
            line = [mpmath.mpf(t) for t in wall.normal]
            there = zip(line, x[a], wall.point, strict=True)
            gap = sum(n * (s - mpmath.mpf(t)) for n, s, t in there)
            gap = gap / mpmath.sqrt(sum(t * t for t in line)) - r[a]
        length = mpmath.sqrt(sum(t * t for t in line))
        row = {}
        for end, sign in ((a, 1), (b, -1)):
            for i, t in enumerate(line):
                if end >= 0 and (end, i) in number:
                    row[number[end, i]] = sign * t / length
        rows.append(row)
        gaps.append(gap)
    E = [mpmath.mpf(k) for k in p.stiffness.tolist()]
    closed = np.flatnonzero(loaded).tolist()
    used = sorted({j for k in closed for j, n in rows[k].items() if n})
    place = {j: i for i, j in enumerate(used)}
    loads = [mpmath.mpf(t) for t in p.loads[~p.held].tolist()]
    K, right = mpmath.zeros(len(used)), mpmath.matrix(len(used), 1)
    for j in used:
        right[place[j]] = loads[j]
    for k in closed:
        terms = [(place[j], n) for j, n in rows[k].items() if n]
        for i, n in terms:
            right[i] -= n * E[k] * gaps[k]
            for j, m in terms:
                K[i, j] += n * E[k] * m
    u = mpmath.lu_solve(K, right) if used else []
    forces = [mpmath.mpf(0)] * len(rows)
    rest = [mpmath.mpf(t) for t in loads]
    for k in closed:
        strain = sum((n * u[place[j]] for j, n in rows[k].items() if n), gaps[k])
        forces[k] = -E[k] * strain
        assert forces[k] > 0
        for j, n in rows[k].items():
            rest[j] += n * forces[k]
    assert size == 0 or max(map(abs, rest)) < mpmath.mpf(10) ** -25
    for k in set(range(len(rows))) - set(closed):
        moved = sum((n * u[place[j]] for j, n in rows[k].items() if j in place), gaps[k])
        if all(j in place for j, n in rows[k].items() if n):
            assert moved > 0
    return forces
