"""Speed against accuracy: run what is missing, draw the charts, write the report.

    python -m benchmarks.comparison [--quick] [--fresh] [--out DIR]
                                    [--only METHOD[,METHOD...]] [--report]

Rows go to methods.csv and z_against_lemke.csv of DIR (benchmarks/comparison/results, or build/quick
with --quick); what is there already is not run again, unless --fresh. The full run writes its
charts to notes/figures and the report to notes/benchmarks.md, the quick one both to DIR. --report
runs nothing.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

_ROOT = Path(__file__).parents[2]
_ONE = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_NOT_OURS = ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE")


def main() -> None:
    """Parse, run, draw, report."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.comparison", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="three small scenes, two minutes")
    parser.add_argument("--fresh", action="store_true", help="forget rows and references")
    parser.add_argument("--report", action="store_true", help="only charts and report")
    parser.add_argument("--out", type=Path, help="folder of the rows")
    parser.add_argument("--only", default="", help="these methods only")
    words = parser.parse_args()
    out = words.out or _ROOT / ("build/quick" if words.quick else "benchmarks/comparison/results")
    if not words.report:
        _run(words, out)
    from benchmarks.comparison.charts import draw
    from benchmarks.comparison.report import write

    figures = out if words.quick or words.out else _ROOT / "notes" / "figures"
    page = out / "benchmarks.md" if words.quick or words.out else _ROOT / "notes" / "benchmarks.md"
    drawn = draw(out, figures)
    write(out, page, figures, drawn)
    print(f"report: {page}")


def _run(words: argparse.Namespace, out: Path) -> None:
    from benchmarks.comparison.run import FULL, QUICK, SOME, compare
    from benchmarks.comparison.z_against_lemke import study

    if words.fresh:
        for name in ("methods.csv", "z_against_lemke.csv"):
            (out / name).unlink(missing_ok=True)
        for kept in (out / "references").glob("*.npz"):
            kept.unlink()
    only = tuple(name for name in words.only.split(",") if name)
    compare(QUICK if words.quick else FULL, out, 12, only)
    if not words.quick:
        for scene, methods in SOME:
            chosen = tuple(name for name in methods if not only or name in only)
            if chosen:
                compare((scene,), out, 120, chosen, limited=False)
    study(out, words.quick, 20)


if __name__ == "__main__":
    # Threads and kernels are settled before numpy is loaded: start again where they are not.
    if any(os.environ.get(name) != "1" for name in _ONE) or any(n in os.environ for n in _NOT_OURS):
        own = {k: v for k, v in os.environ.items() if k not in _NOT_OURS}
        os.execve(
            sys.executable,
            [sys.executable, "-m", "benchmarks.comparison", *sys.argv[1:]],
            own | dict.fromkeys(_ONE, "1"),
        )
    main()
