"""Figures of the failures: forces, stiffnesses and loads that floats cannot hold together."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from benchmarks.failures.float_runs import RELAXED, in_floats, loaded_stiffness, whole
from lcp_piles import contact_system, nt30, solve, surd, tbs
from lcp_piles.methods.fire import fire
from lcp_piles.methods.float_lemke import float_lcp, float_lemke
from lcp_piles.methods.newton import newton
from lcp_piles.problems import APEX_LIMIT, side_load, stiff_every_other


def tiny_pushes(ax: Any) -> None:
    """Error of the change of the forces that a tiny push makes."""
    exponents = range(25)
    rest, one = solve(nt30(4)), solve(nt30(4, push=1))
    assert rest.states == one.states
    share = one.force_array - rest.force_array
    for method in RELAXED:
        still = in_floats(rest.scene, method)[0].force_array
        errors = []
        for k in exponents:
            pushed = in_floats(nt30(4, push=Fraction(1, 10**k)), method)[0].force_array
            errors.append(np.abs((pushed - still) * 10.0**k - share).max() / np.abs(share).max())
        print(f"  {method}, push 1, 0.1, ...: " + " ".join(f"{x:.0e}" for x in errors))
        ax.plot([10.0**-k for k in exponents], errors, "o-", ms=3, label=method)
    ax.axhline(1, color="k", lw=0.5)
    ax.set(
        xscale="log",
        yscale="log",
        xlabel=r"push ($w\tau$)",
        ylabel="relative error of the change",
    )
    ax.legend()


def pushes(ax: Any) -> None:
    """Error of the least force against the push."""
    exponents = range(0, 31, 2)
    for method in RELAXED:
        errors = []
        for e in exponents:
            scene = nt30(4, push=10**e)
            exact = solve(scene).force_array
            floats, claimed = in_floats(scene, method)
            least = np.argmin(np.where(exact > 0, exact, np.inf))
            error = abs(floats.force_array[least] - exact[least]) / exact[least]
            errors.append(max(error, 1e-17) if claimed else np.nan)
        print(f"  {method}, push 1, 100, ...: " + " ".join(f"{x:.0e}" for x in errors))
        ax.plot([10.0**e for e in exponents], errors, "o-", ms=3, label=method)
    ax.axhline(1, color="k", lw=0.5)
    ax.set(
        xscale="log",
        yscale="log",
        xlabel=r"push ($w\tau$)",
        ylabel="relative error of least force",
    )
    ax.legend(title="where it says that it converged", title_fontsize=7, loc="lower right")


def stiffness(ax: Any) -> None:
    """Error of the forces against the ratio of stiffnesses; crosses are not converged."""
    decades = range(16)
    at = np.array([10.0**k for k in decades])
    scenes = [stiff_every_other("nt30", 3, k) for k in decades]
    truths = [solve(scene).force_array for scene in scenes]
    for method in RELAXED:
        runs = [in_floats(scene, method) for scene in scenes]
        errors = np.array(
            [
                np.abs(floats.force_array - truth).max() + 1e-17
                for (floats, _), truth in zip(runs, truths, strict=True)
            ]
        )
        claims = np.array([claimed for _, claimed in runs])
        print(
            f"  {method}: converged "
            + "".join("y" if claimed else "-" for claimed in claims)
            + ", errors "
            + " ".join(f"{x:.0e}" for x in errors)
        )
        (line,) = ax.plot(at, errors, label=method)
        ax.plot(at[~claims], errors[~claims], "x", color=line.get_color())
    ax.plot([], [], "xk", label="says that it did not converge")
    ax.set(xscale="log", yscale="log", xlabel="stiffness ratio")
    ax.set_ylabel("largest force error (w)")
    ax.legend()


def condition(ax: Any) -> None:
    """Condition number of the loaded contacts and digits lost, against the size."""
    layers = [5, 10, 20, 40]
    columns: dict[str, list[float]] = {
        "condition number": [],
        "force error, Lemke in float32": [],
        "force error, Lemke in float64": [],
    }
    for n in layers:
        system = contact_system(tbs(n))
        run = newton(system)
        values = np.linalg.eigvalsh(loaded_stiffness(system, run.closed))
        exact = solve(tbs(n)).force_array
        M, q = float_lcp(system)
        row = [values[-1] / values[0]]
        for kind in (np.float32, np.float64):
            w = float_lemke(M, q, dtype=kind).w.astype(float)
            forces = whole(system, run.U, w, run.gaps).force_array
            row.append(np.abs(forces - exact).max() / exact.max())
        for column, number in zip(columns.values(), row, strict=True):
            column.append(number)
    for name, column in columns.items():
        slope = np.polyfit(np.log(layers), np.log(column), 1)[0]
        print(f"  {name}: " + " ".join(f"{x:.1e}" for x in column) + f", grows as N^{slope:.1f}")
        ax.plot(layers, column, "o-", ms=3, label=name)
    ax.set(xscale="log", yscale="log", xlabel="layers of TBS", ylim=(1e-16, 1e5))
    ax.set_ylabel("ratio, or error over the largest force")
    ax.set_xticks(layers, map(str, layers), minor=False)
    ax.minorticks_off()
    ax.legend(loc="center", bbox_to_anchor=(0.5, 0.66))


def collapse(ax: Any) -> None:
    """What is left unbalanced by Newton's method beside the load that NT60 can just carry."""
    ks = range(1, 19)
    at = np.array([10.0**-k for k in ks])
    for sign, what in ((-1, "stands"), (1, "falls")):
        scenes = [side_load(3, APEX_LIMIT + surd(Fraction(sign, 10**k))) for k in ks]
        print(f"  {what}: exact { ({solve(scene).status for scene in scenes}) }, converged")
        for method, run in RELAXED.items():
            runs = [run(contact_system(scene)) for scene in scenes]
            print(f"    {''.join('y' if run.converged else '-' for run in runs)} {method}")
            if method == "Newton":
                left = np.array([max(run.residual, 1e-18) for run in runs])
                claimed = np.array([run.converged for run in runs])
        (line,) = ax.plot(at, left, label=f"{what} (proved)")
        ax.plot(at[claimed], left[claimed], "o", ms=4, color=line.get_color())
    ax.plot([], [], "ok", ms=4, label="Newton says that it converged")
    ax.set(
        xscale="log",
        yscale="log",
        xlabel="distance from the exact limit (w)",
        ylabel="unbalanced / largest force",
    )
    ax.legend()


def published_floor(ax: Any) -> None:
    """The largest displacement along FIRE on a floor of compliance 1 and of -1/2."""
    counts = np.unique(np.geomspace(1, 2000, 40).astype(int))
    for c in ("1", "-1/2"):
        system = contact_system(nt30(6, floor_compliance=c))
        runs = [fire(system, max_iterations=int(n)) for n in counts]
        last = runs[-1]
        print(
            f"  floor {c}: converged {last.converged} after {last.steps},"
            f" displaced by {np.abs(last.U).max():.1e}"
        )
        done = [run.steps for run in runs]
        ax.plot(done, [np.abs(run.U).max() for run in runs], label=f"floor compliance {c}")
        ax.plot(last.steps, np.abs(last.U).max(), "o" if last.converged else "x", color="k")
    ax.plot([], [], "ok", label="converged")
    ax.plot([], [], "xk", label="given up")
    ax.set(xscale="log", yscale="log", xlabel="iterations of FIRE")
    ax.set_ylabel(r"largest displacement ($w\tau$)")
    ax.legend()
