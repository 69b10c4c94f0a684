"""Ours and other solvers on published problems, judged exactly: prints tables for `notes/lcp.md`.

    python -m benchmarks.lcp.peers

A cell is the median time of some runs after a first one, or what went wrong: "wrong" is an answer
whose exact error, in brackets, is above `judge.GOOD`; behind "none" stands how a solver says that
it has none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from statistics import median
from time import perf_counter
from typing import Any

from tqdm import tqdm

from benchmarks.lcp.judge import GOOD, NoAnswerError, game_error, lcp_error, qp_error
from benchmarks.lcp.public_problems import PublicLCP, games, lcps, quadratic_programmes
from benchmarks.lcp.solvers import GAME_SOLVERS, LCP_SOLVERS, QP_SOLVERS, Solver, quietly

_RUNS, _LONG = 5, 1.0


def cell(solver: Solver, problem: Any, error: Callable[[Any, Any], Fraction]) -> str:
    """What comes of one solver on one problem."""
    if not solver.present():
        return "not installed"
    times = []
    try:
        for _ in range(_RUNS + 1):
            start = perf_counter()
            answer = quietly(solver.solve, problem)
            times.append(perf_counter() - start)
            if len(times) > 1 and times[-1] > _LONG:  # the first may compile
                break
        worst = error(problem, answer)
    except NoAnswerError as none:
        if isinstance(problem, PublicLCP) and not problem.solvable:
            return f"right ({none})"
        return f"**none** ({none})"
    if worst > GOOD:
        return f"**wrong** ({float(worst):.0e})"
    return f"{1000 * median(times[1:] or times):.2g} ms" + ("" if worst else ", exact")


def table(
    solvers: Sequence[Solver], problems: Sequence[Any], error: Callable[[Any, Any], Fraction]
) -> list[str]:
    """A table of Markdown, and how many each solver missed."""
    rows, missed = [], [0] * len(solvers)
    for problem in tqdm(problems):
        cells = [cell(solver, problem, error) for solver in solvers]
        missed = [n + c.startswith("**") for n, c in zip(missed, cells, strict=True)]
        rows.append(f"| {problem.name} | {' | '.join(cells)} |")
    head = f"| | {' | '.join(s.name for s in solvers)} |"
    present = [s.present() for s in solvers]
    counts = [str(n) if there else "" for n, there in zip(missed, present, strict=True)]
    return [
        head,
        "|---" * (len(solvers) + 1) + "|",
        *rows,
        f"| missed, of {len(problems)} | {' | '.join(counts)} |",
    ]


def main() -> None:
    """Print all tables."""
    for lines in (
        table(LCP_SOLVERS, lcps(), lcp_error),
        table(GAME_SOLVERS, games(), lambda game, mixes: game_error(game, *mixes)),
        table(QP_SOLVERS, quadratic_programmes(), qp_error),
    ):
        print("\n".join(lines), end="\n\n", flush=True)


if __name__ == "__main__":
    main()
