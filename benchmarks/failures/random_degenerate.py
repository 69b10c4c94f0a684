"""Random degenerate problems of known solution: how often each method names a state wrongly.

    python -m benchmarks.failures.random_degenerate [COUNT]

COUNT (1,000) problems: half of them LCPs and three tenths scenes in which 30 % of the pairs are
both zero, two tenths scenes that cannot stand, many of them by a hair. The truth is how they were
made (`lcp_piles.problems`); whether a contact without force and gap may open in some
other solution is asked of scipy's linear programming. A wrong state is a contact, or a component
of w, whose sign is not the known one; a false claim is a problem said to be solved, unstable
or infeasible that is not, or with forces that are wrong by more than 1e-6 of the largest (1e-3 in
float32). For floating point the sign has a threshold of 1e-9 of the largest (1e-4 in float32);
FIRE and Gauss-Seidel are run to residuals well below it, of 1e-12 and 1e-11.
"""

from __future__ import annotations

import sys
from collections import Counter

import numpy as np
from scipy.optimize import linprog

from benchmarks.failures.float_runs import whole
from lcp_piles import Scene, Solution, contact_system, lemke, solve, verify, z_algorithm
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lemke
from lcp_piles.methods.gauss_seidel import gauss_seidel
from lcp_piles.methods.newton import newton
from lcp_piles.problems import SceneCase, degenerate, random_collapse, random_scene

_SHAPES = [(8, 3, 0), (12, 4, 0), (12, 4, 2), (16, 6, 3), (12, 12, 1)]
_THRESHOLD, _FORCE_ERROR = 1e-9, 1e-6
_LEMKE = ((np.float64, _THRESHOLD, _FORCE_ERROR), (np.float32, 1e-4, 1e-3))


def count_lcps(count: int) -> Counter[tuple[str, str]]:
    """Counts (method, what) over LCPs: runs, unsolved, wrong states and false claims."""
    counts: Counter[tuple[str, str]] = Counter()
    for seed in range(count):
        case = degenerate(seed, *_SHAPES[seed % len(_SHAPES)])
        exact = lemke(case.M, case.q)
        wrong = sum((a > 0) != (b > 0) for a, b in zip(exact.w, case.w, strict=False))
        counts.update(_entry("exact Lemke", exact.status == "solved", wrong, exact.w != case.w))
        M, q = case.floats()
        w = np.array(case.w, dtype=float)
        for kind, threshold, error in _LEMKE:
            found = float_lemke(M, q, dtype=kind)
            wrong = int(((found.w > threshold * np.abs(found.w).max()) != (w > 0)).sum())
            false = bool(np.abs(found.w - w).max() > error * w.max(initial=1.0))
            name = f"{np.dtype(kind).name} Lemke"
            said = found.converged or found.status == "ray"  # the problem is known to be solvable
            counts.update(_entry(name, found.converged, wrong, said and false))
            counts[name, "false rays"] += found.status == "ray"
    return counts


def count_scenes(count: int) -> Counter[tuple[str, str]]:
    """The same over scenes, for the exact methods and the floating-point ones."""
    counts: Counter[tuple[str, str]] = Counter()
    for seed in range(count):
        case = random_scene(seed)
        truth = true_states(case)
        forces = np.array(case.forces, dtype=float)
        outcomes: list[tuple[str, Solution | None]] = [
            ("exact, proved", solve(case.scene)),
            ("exact, Lemke", solve(case.scene, "lemke")),
            ("exact, Z", z_algorithm(case.scene).solution),
            ("float64 Newton", solve(case.scene, "newton")),
        ]
        system = contact_system(case.scene)
        for name, run in (
            ("float64 FIRE", fire(system, tolerance=1e-12, max_iterations=8000)),
            ("float64 Gauss-Seidel", gauss_seidel(system, tolerance=1e-11, max_sweeps=4000)),
        ):
            found = whole(system, run.U, run.forces, run.gaps, _THRESHOLD)
            outcomes.append((name, found if run.converged else None))
        for name, solution in outcomes:
            if solution is None or solution.status != "solved":
                collapse = solution is not None and solution.status == "unstable"
                counts.update(_entry(name, False, 0, collapse))
                continue
            wrong = sum(a != b for a, b in zip(solution.states, truth, strict=True))
            error = float(np.abs(solution.force_array - forces).max())
            false = error > _FORCE_ERROR * max(forces.max(), 1.0)
            if solution.exact:
                same = all(a == b for a, b in zip(solution.forces or (), case.forces, strict=True))
                false = not same or not verify(case.scene, solution).ok
            counts.update(_entry(name, True, wrong, false))
    return counts


def count_collapses(count: int) -> Counter[tuple[str, str]]:
    """Over scenes that cannot stand: "unsolved" counts those not proved to be unstable."""
    counts: Counter[tuple[str, str]] = Counter()
    for seed in range(count):
        scene = random_collapse(seed)
        system = contact_system(scene)
        for name, solution in (
            ("collapse, proved", solve(scene)),
            ("collapse, exact Lemke", solve(scene, "lemke")),
        ):
            proved = solution.status == "unstable" and verify(scene, solution).ok
            counts.update(_entry(name, proved, 0, not proved))
        for name, claimed in (
            ("collapse, Newton", newton(system).converged),
            ("collapse, FIRE", fire(system, max_iterations=2000).converged),
            ("collapse, Gauss-Seidel", gauss_seidel(system, max_sweeps=500).converged),
        ):
            counts.update(_entry(name, not claimed, 0, claimed))
    return counts


def true_states(case: SceneCase) -> list[str]:
    """closed, open or osculatory: forces and gaps as drawn, and what another solution may open.

    A contact without either is open where a motion opens it that leaves the closed contacts at
    rest and closes no other one in doubt: maximise the sum of s, 0 <= s <= 1, s <= (B m) there.
    """
    B = _motions_to_gaps(case.scene)
    f = np.array(case.forces, dtype=float)
    g = np.array(case.gaps, dtype=float)
    doubt = np.flatnonzero((f == 0) & (g == 0))
    states = [
        "closed" if x > 0 else "open" if y > 0 else "osculatory" for x, y in zip(f, g, strict=True)
    ]
    if not len(doubt):
        return states
    n, k = B.shape[1], len(doubt)
    closed = B[f > 0]
    answer = linprog(
        np.append(np.zeros(n), -np.ones(k)),
        A_ub=np.hstack([-B[doubt], np.eye(k)]),
        b_ub=np.zeros(k),
        A_eq=np.hstack([closed, np.zeros((len(closed), k))]),
        b_eq=np.zeros(len(closed)),
        bounds=[(None, None)] * n + [(0, 1)] * k,
    )
    for i, s in zip(doubt.tolist(), answer.x[n:], strict=True):
        if s > 0.5:  # it is 1 or 0: any motion that opens may be made longer
            states[i] = "open"
    return states


def _motions_to_gaps(scene: Scene) -> np.ndarray:
    """The gap rates of motions of free discs, from the scene alone."""
    a, b = scene.ends
    B = np.zeros((len(scene.contacts), len(scene.discs), scene.dimension))
    for k, contact in enumerate(scene.contacts):
        n = [float(x) for x in contact.normal]
        B[k, a[k]] += n
        if b[k] >= 0:
            B[k, b[k]] -= n
    free = np.array([h is None for disc in scene.discs for h in disc.held])
    return B.reshape(len(B), -1)[:, free]


def _entry(name: str, solved: bool, wrong: int, false: bool) -> dict[tuple[str, str], int]:
    return {
        (name, "runs"): 1,
        (name, "unsolved"): int(not solved),
        (name, "wrong states"): wrong if solved else 0,
        (name, "false claims"): int(false),
    }


def main() -> None:
    total = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    counts = count_lcps(total * 5 // 10)
    counts.update(count_scenes(total * 3 // 10))
    counts.update(count_collapses(total * 2 // 10))
    columns = ("runs", "unsolved", "wrong states", "false claims", "false rays")
    print(f"{'':24s}" + "".join(f"{c:>14s}" for c in columns))
    for name in dict.fromkeys(name for name, _ in counts):
        print(f"{name:24s}" + "".join(f"{counts[name, c]:14d}" for c in columns))


if __name__ == "__main__":
    main()
