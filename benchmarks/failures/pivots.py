"""Figures of the failures: cycles, false rays and exponentially many pivots."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from lcp_piles import lemke, solve, z_algorithm, z_lcp
from lcp_piles.methods.float_lemke import float_lemke
from lcp_piles.problems import degenerate, fathi, grain_scene, kostreva, murty
from lcp_piles.problems.lcp_problems import GRAIN_C, GRAIN_Q


def cycle(ax: Any) -> None:
    """The basic variables on Kostreva's problem, pivot by pivot, without a rule for ties."""
    case = kostreva()
    counts = range(1, 25)
    bases = [float_lemke(*case.floats(), max_pivots=k).basis for k in counts]
    period = next(p for p in range(1, 12) if (bases[10] == bases[10 + p]).all())
    print(f"  the bases repeat every {period} pivots")
    ax.imshow(np.array(bases).T, aspect="auto", cmap="Greys", vmax=1.6)
    ax.set(xlabel="pivots", ylabel="basic variables (dark)")
    ax.set_xticks(range(4, 24, 5), [str(k) for k in range(5, 25, 5)])
    ax.set_yticks(range(7), ["w1", "w2", "w3", "z1", "z2", "z3", "z0"])


def grain(ax: Any) -> None:
    """The displacements of a disc between springs and three walls, step by step of the Z iteration.

    With the closed walls A, u (I + C_A^T C_A) = C_A^T q_A.
    """
    run = z_algorithm(grain_scene().scene, arithmetic="float64")
    C, q = np.array(GRAIN_C, dtype=float), np.array(GRAIN_Q, dtype=float)
    points = []
    for step in run.trace:
        A = [k for k in range(3) if k + 2 not in step.Z]  # contacts 0 and 1 are the springs
        points.append(np.linalg.solve(np.eye(2) + C[A].T @ C[A], C[A].T @ q[A]))
    sets = [[k - 1 for k in range(2, 5) if k not in step.Z] for step in run.trace]
    print(f"  closed walls {sets}: {run.status}")
    ends = np.array([-2.6, 4.6])
    for k, (c, gap) in enumerate(zip(C, q, strict=True)):  # beyond c . u = q wall k + 1 pushes
        line = (gap - c[0] * ends) / c[1]
        ax.plot(ends, line, "0.6", lw=0.8, label="three walls" if k == 0 else None)
    for place, after in pairwise(points):
        arrow = {"arrowstyle": "->", "color": "C1", "shrinkA": 2, "shrinkB": 2}
        ax.annotate("", after, place, arrowprops=arrow)
    ax.plot(*np.transpose(points), "o", color="C1", ms=4, label="Z iteration")
    offsets = [(8, 5), (-8, 11), (8, 0), (8, -11)]  # the first and the last point nearly coincide
    for place, closed, offset in zip(points, sets[:-1], offsets, strict=False):
        name = "closed: " + (", ".join(map(str, closed)) or "none")
        ax.annotate(name, place, xytext=offset, textcoords="offset points")
    for method, mark in (("proved", "k+"), ("newton", "kx")):
        found = solve(grain_scene().scene, method).displacement_array.ravel()
        print(f"  {method}: {found}")
        ax.plot(*found, mark, ms=7, label="exact" if method == "proved" else "Newton, line search")
    ax.set(xlabel=r"$u_x$ ($w\tau$)", ylabel=r"$u_y$ ($w\tau$)")
    ax.set(xlim=ends, ylim=(-2.5, 5))
    ax.legend()


def rays(ax: Any) -> None:
    """Degenerate problems on which Lemke in floats fails, against the spread of their entries."""
    decades = range(6)
    count = 40
    cases = {d: [degenerate(seed, 12, 4, d) for seed in range(count)] for d in decades}
    for kind in (np.float64, np.float32):
        false, wrong = [], []
        for d in decades:
            runs = [float_lemke(*case.floats(), dtype=kind) for case in cases[d]]
            false.append(sum(run.status == "ray" for run in runs))
            wrong.append(
                sum(
                    bool(
                        run.converged and np.abs(run.w - np.array(case.w, dtype=float)).max() > 0.5
                    )
                    for run, case in zip(runs, cases[d], strict=True)
                )
            )
        name = np.dtype(kind).name
        print(f"  {name}: false rays {false}, wrong but called solved {wrong}")
        (line,) = ax.plot(decades, false, "o-", ms=3, label=f"{name}, false ray")
        ax.plot(decades, wrong, "s--", ms=3, color=line.get_color(), label=f"{name}, false answer")
    exact = sum(lemke(case.M, case.q).w != case.w for d in decades for case in cases[d])
    print(f"  exact: {exact} wrong of {count * len(decades)}")
    ax.axhline(0, color="k", lw=1, label="exact")
    ax.set(xlabel="decades of scale up and down", ylabel=f"failures of {count}")
    ax.legend()


def pivots(ax: Any) -> None:
    """Pivots of Lemke's method and steps of the Z iteration on Murty's and Fathi's problems."""
    sizes = range(2, 11)
    steps = {}
    for family, style in ((murty, "o-"), (fathi, "s--")):
        cases = [family(n) for n in sizes]
        name = family.__name__.title()
        counts = [lemke(case.M, case.q).pivots for case in cases]
        steps[name] = [len(z_lcp(case.M, case.q).trace) for case in cases]
        print(f"  {name}: Lemke {counts}, Z iteration {steps[name]}")
        ax.plot(sizes, counts, style, ms=3, label=f"Lemke, {name}")
    assert steps["Murty"] == steps["Fathi"]
    ax.plot(sizes, steps["Murty"], "^-", ms=3, label="Z iteration, both")
    ax.set(yscale="log", xlabel="order n of the problem", ylabel="pivots, or systems solved")
    ax.legend()
