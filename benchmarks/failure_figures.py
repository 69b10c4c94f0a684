"""The figures of `notes/stability.md`, and the numbers in them.

    python -m benchmarks.failure_figures [NAME ...]

Computes everything anew, prints the numbers and writes notes/figures/fails-NAME.png; all names by
default.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from scipy.sparse import diags_array

from benchmarks.slide import PILES, slide
from lcp_piles import Scene, Solution, contact_system, lemke, nt30, pile, solve, surd, tbs, tss
from lcp_piles.fire import fire
from lcp_piles.float_lemke import float_lcp, float_lemke
from lcp_piles.float_solution import float_solution
from lcp_piles.gauss_seidel import gauss_seidel
from lcp_piles.newton import newton
from lcp_piles.z_lcp import z_lcp
from tests.failure_cases import (
    APEX_LIMIT,
    THRESHOLDS,
    beside,
    degenerate,
    fathi,
    kostreva,
    misread,
    murty,
    near_breakpoint,
    side_load,
    stiff_every_other,
)

FOLDER = Path(__file__).parent.parent / "notes" / "figures"
_RUNS: dict[str, Callable[[Any], Any]] = {
    "Newton": newton,
    "FIRE": lambda system: fire(system, tolerance=1e-11, max_iterations=20_000),
    "Gauss-Seidel": lambda system: gauss_seidel(system, tolerance=1e-10, max_sweeps=5000),
}


def in_floats(scene: Scene, method: str) -> tuple[Solution, bool]:
    """All that a float method computed, for any threshold to read, and what it claims."""
    system = contact_system(scene)
    run = _RUNS[method](system)
    solution = float_solution(
        system,
        run.U,
        run.forces,
        run.gaps,
        method=method,
        arithmetic="float64",
        steps=0,
        tolerance=0.0,
        start=0.0,
    )
    return solution, run.converged


def thresholds(ax: Any) -> None:
    """Contacts misread against the threshold, for Newton's method."""
    scenes = {
        "NT30, 6 layers (easy)": nt30(6),
        "TBS, 60 layers": tbs(60),
        "TSS, 6 layers (mechanisms)": tss(6),
        "a tie beside a force of 7e-18": beside(near_breakpoint(15, 0), near_breakpoint(15, -1)),
    }
    for name, scene in scenes.items():
        truth = solve(scene).states
        floats, _ = in_floats(scene, "Newton")
        wrong = [misread(floats, truth, t) for t in THRESHOLDS]
        print(f"  {name}: at best {min(wrong)} wrong, at 1e-9 {misread(floats, truth, 1e-9)}")
        ax.plot(THRESHOLDS, wrong, label=name)
    ax.set(xscale="log", yscale="symlog", xlabel="threshold", ylabel="contacts misread")
    ax.set_ylim(bottom=-0.2)
    ax.legend()


def breakpoints(ax: Any) -> None:
    """Contacts misread at the usual threshold against the distance from a breakpoint."""
    ks = range(1, 17)
    for shift, method in enumerate(_RUNS):
        wrong = []
        for k in ks:
            scene = near_breakpoint(k, -1)
            wrong.append(misread(in_floats(scene, method)[0], solve(scene).states, 1e-9))
        print(f"  {method}: {wrong}")
        ax.plot([10.0**-k for k in ks], [x + 0.03 * shift for x in wrong], "o-", ms=3, label=method)
    ax.axhline(0, color="k", lw=1, label="exact")
    ax.set(xscale="log", xlabel="push below the breakpoint (w tau)", ylabel="contacts misread")
    ax.legend()


def pushes(ax: Any) -> None:
    """Error of the least force against the push."""
    exponents = range(0, 31, 2)
    for method in ("Newton", "FIRE"):
        errors = []
        for e in exponents:
            scene = nt30(4, push=10**e)
            exact = solve(scene).force_array
            floats, claimed = in_floats(scene, method)
            least = np.argmin(np.where(exact > 0, exact, np.inf))
            error = abs(floats.force_array[least] - exact[least]) / exact[least]
            errors.append(max(error, 1e-17) if claimed else np.nan)
        print(f"  {method}, push 1, 100, ...: " + " ".join(f"{x:.0e}" for x in errors))
        ax.plot(
            [10.0**e for e in exponents], errors, "o-", ms=3, label=f"{method}, where it claims"
        )
    ax.axhline(1, color="k", lw=0.5)
    ax.set(
        xscale="log", yscale="log", xlabel="push (w tau)", ylabel="relative error of least force"
    )
    ax.legend()


def stiffness(ax: Any) -> None:
    """Error of the forces against the ratio of stiffnesses; crosses are not converged."""
    decades = range(0, 16)
    for method in _RUNS:
        errors, claims = [], []
        for k in decades:
            scene = stiff_every_other("nt30", 3, k)
            floats, claimed = in_floats(scene, method)
            errors.append(np.abs(floats.force_array - solve(scene).force_array).max() + 1e-17)
            claims.append(claimed)
        print(
            f"  {method}: converged up to 1e{sum(claims) - 1}, errors "
            + " ".join(f"{x:.0e}" for x in errors)
        )
        at = np.array([10.0**k for k in decades])
        (line,) = ax.plot(at, errors, label=method)
        refused = ~np.array(claims)
        ax.plot(at[refused], np.array(errors)[refused], "x", color=line.get_color())
    ax.set(xscale="log", yscale="log", xlabel="stiffness ratio", ylabel="largest force error (w)")
    ax.legend()


def condition(ax: Any) -> None:
    """Condition number of the loaded contacts and digits lost, against the size."""
    layers = [5, 10, 20, 40]
    numbers: list[float] = []
    single: list[float] = []
    double: list[float] = []
    for n in layers:
        system = contact_system(tbs(n))
        B, C, _, _ = system.floats()
        run = newton(system)
        K = (B[run.closed].T @ diags_array(1 / C[run.closed]) @ B[run.closed]).toarray()
        values = np.linalg.eigvalsh(K)
        numbers.append(values[-1] / values[0])
        exact = solve(tbs(n)).force_array
        M, q = float_lcp(system)
        for errors, kind in ((single, np.float32), (double, np.float64)):
            w = float_lemke(M, q, dtype=kind).w
            floats = float_solution(
                system,
                run.U,
                w.astype(float),
                run.gaps,
                method="",
                arithmetic="float64",
                steps=0,
                tolerance=0.0,
                start=0.0,
            )
            errors.append(np.abs(floats.force_array - exact).max() / exact.max())
    for name, column in (
        ("condition number", numbers),
        ("error, Lemke in float32", single),
        ("error, Lemke in float64", double),
    ):
        slope = np.polyfit(np.log(layers), np.log(column), 1)[0]
        print(f"  {name}: " + " ".join(f"{x:.1e}" for x in column) + f", grows as N^{slope:.1f}")
        ax.plot(layers, column, "o-", ms=3, label=name)
    ax.set(xscale="log", yscale="log", xlabel="layers of TBS")
    ax.set_xticks(layers, map(str, layers), minor=False)
    ax.minorticks_off()
    ax.legend(loc="center right")


def rays(ax: Any) -> None:
    """Degenerate problems on which Lemke in floats fails, against the spread of their entries."""
    decades = range(0, 6)
    count = 40
    for kind in (np.float64, np.float32):
        false, wrong = [], []
        for d in decades:
            cases = [degenerate(seed, 12, 4, d) for seed in range(count)]
            runs = [float_lemke(*case.floats(), dtype=kind) for case in cases]
            false.append(sum(run.status == "ray" for run in runs))
            wrong.append(
                sum(
                    bool(
                        run.converged and np.abs(run.w - np.array(case.w, dtype=float)).max() > 0.5
                    )
                    for run, case in zip(runs, cases, strict=True)
                )
            )
        name = np.dtype(kind).name
        print(f"  {name}: false rays {false}, wrong but called solved {wrong}")
        (line,) = ax.plot(decades, false, "o-", ms=3, label=f"{name}, false ray")
        ax.plot(decades, wrong, "s--", ms=3, color=line.get_color(), label=f"{name}, false answer")
    exact = sum(
        lemke(case.M, case.q).w != case.w
        for d in decades
        for case in (degenerate(seed, 12, 4, d) for seed in range(count))
    )
    print(f"  exact: {exact} wrong of {count * len(decades)}")
    ax.axhline(0, color="k", lw=1, label="exact")
    ax.set(xlabel="decades of scale up and down", ylabel=f"failures of {count}")
    ax.legend()


def pivots(ax: Any) -> None:
    """Pivots of Lemke's method and steps of the Z iteration on Murty's and Fathi's problems."""
    sizes = range(2, 11)
    for family, style in ((murty, "o-"), (fathi, "s--")):
        cases = [family(n) for n in sizes]
        counts = [lemke(case.M, case.q).pivots for case in cases]
        print(f"  {family.__name__}: Lemke {counts}")
        ax.plot(sizes, counts, style, ms=3, label=f"Lemke, {family.__name__.title()}")
    steps = [len(z_lcp(case.M, case.q).trace) for case in cases]
    print(f"  Fathi: Z iteration {steps}")
    ax.plot(sizes, steps, "s-", ms=3, label="Z iteration, both")
    ax.set(yscale="log", xlabel="n", ylabel="steps")
    ax.legend()


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


def mechanisms(ax: Any) -> None:
    """Least eigenvalue of the stiffness of the loaded contacts, relative, against the size."""
    for kind in ("tss", "nt30", "nt60"):
        least, counted = [], []
        layers = range(2, 13)
        for n in layers:
            exact = solve(pile(kind, n))
            B, C, _, _ = contact_system(exact.scene, "whole").floats()
            closed = np.array([s == "closed" for s in exact.states])
            K = (B[closed].T @ diags_array(1 / C[closed]) @ B[closed]).toarray()
            values = np.linalg.eigvalsh(K)
            least.append(max(abs(values[0]) / values[-1], 1e-18))
            assert exact.stability is not None
            counted.append(exact.stability.mechanisms)
        print(f"  {kind}, 2 to 12 layers: mechanisms {counted}")
        ax.plot(layers, least, "o-", ms=3, label=kind.upper())
    ax.set(yscale="log", xlabel="layers", ylabel="least / largest eigenvalue")
    ax.legend(loc="center left")


def collapse(ax: Any) -> None:
    """What is left unbalanced by Newton's method beside the load that NT60 can just carry."""
    ks = range(1, 19)
    for sign, what in ((-1, "stands"), (1, "falls")):
        scenes = [side_load(3, APEX_LIMIT + surd(Fraction(sign, 10**k))) for k in ks]
        runs = [newton(contact_system(scene)) for scene in scenes]
        exact = [solve(scene).status for scene in scenes]
        print(
            f"  {what}: exact {set(exact)}, converged "
            + "".join("y" if run.converged else "-" for run in runs)
        )
        at = [10.0**-k for k in ks]
        left = [max(run.residual, 1e-18) for run in runs]
        (line,) = ax.plot(at, left, label=f"{what}, proved")
        claimed = np.array([run.converged for run in runs])
        ax.plot(
            np.array(at)[claimed],
            np.array(left)[claimed],
            "o",
            ms=4,
            color=line.get_color(),
            label="Newton: converged",
        )
    ax.set(
        xscale="log",
        yscale="log",
        xlabel="distance from the exact limit (w)",
        ylabel="unbalanced, relative",
    )
    ax.legend()


def published_floor(ax: Any) -> None:
    """The largest displacement along FIRE on a floor of compliance 1 and of -1/2."""
    counts = np.unique(np.geomspace(1, 2000, 40).astype(int))
    for c in ("1", "-1/2"):
        system = contact_system(nt30(6, floor_compliance=c))
        runs = [fire(system, max_iterations=int(n)) for n in counts]
        print(f"  floor {c}: converged {runs[-1].converged} after {runs[-1].iterations}")
        ax.plot(counts, [np.abs(run.U).max() for run in runs], label=f"floor compliance {c}")
    ax.set(xscale="log", yscale="log", xlabel="iterations of FIRE", ylabel="largest displacement")
    ax.legend()


def slides(ax: Any) -> None:
    """How far discs that really move get from the exact equilibrium."""
    for name, (scene, tau) in PILES.items():
        solution = solve(scene)
        run = slide(solution, tau)
        assert solution.stability is not None
        label = f"{name}: {solution.stability.verdict}"
        print(f"  {label}, tau {tau:.0e}: {run.distance[0]:.1e} to {run.distance[-1]:.1e} tau")
        ax.plot(run.times, run.distance, label=label)
    ax.set(yscale="log", xlabel="time", ylabel="distance (tau)")
    ax.legend()


FIGURES = (
    thresholds,
    breakpoints,
    pushes,
    stiffness,
    condition,
    rays,
    pivots,
    cycle,
    mechanisms,
    collapse,
    published_floor,
    slides,
)


def main() -> None:
    mpl.use("Agg")
    plt.rcParams.update({"font.size": 8, "legend.fontsize": 7, "legend.frameon": False})
    FOLDER.mkdir(parents=True, exist_ok=True)
    for draw in FIGURES:
        if sys.argv[1:] and draw.__name__ not in sys.argv[1:]:
            continue
        print(draw.__name__)
        figure, ax = plt.subplots(figsize=(4.6, 2.9), layout="constrained")
        draw(ax)
        figure.savefig(FOLDER / f"fails-{draw.__name__.replace('_', '-')}.png", dpi=110)
        plt.close(figure)


if __name__ == "__main__":
    main()
