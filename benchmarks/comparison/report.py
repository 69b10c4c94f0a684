"""notes/benchmarks.md out of the rows: no number stands there that the CSV does not hold."""

from __future__ import annotations

from collections.abc import Sequence
from os.path import relpath
from pathlib import Path

from benchmarks.comparison import csv_rows
from benchmarks.comparison.bars import bars
from benchmarks.comparison.csv_rows import Row
from benchmarks.comparison.report_tables import (
    claims_table,
    fastest_table,
    growth_table,
    lost_table,
    ratios_table,
    states_table,
    table,
    z_table,
)
from benchmarks.comparison.table import Point, points

_CAPTIONS = {
    "work_precision.png": "Work and precision: error of the forces against time, a curve for every "
    "method over its tolerances (tau for LAMMPS), in the colour of its group and named where it "
    "ends; exact methods lie on the line at the bottom. The broad line is the frontier: no method "
    "is both faster and closer.",
    "speed_and_accuracy.png": "One of these scenes by itself.",
    "scaling.png": "Time and memory against size, for the fastest setting within 1e-6.",
    "wrong_states.png": "Contacts named wrongly as loaded or not, by the threshold put to the "
    "forces, at each method's most exact setting. Exact methods take signs and no threshold.",
    "profile.png": "Performance profiles (Dolan and More) at fixed errors: share of scenes on "
    "which a method is within a factor of the best. Methods that serve less than 60 % of the "
    "scenes are left out, but for LAMMPS, dense FLINT and cold Lemke.",
    "z_against_lemke.png": "The paper's Z algorithm against Lemke's method, both exact.",
}
_VERDICT = {True: "met", False: "**missed**"}


def write(folder: Path, page: Path, figures: Path, drawn: Sequence[str]) -> None:
    """Write the report of a folder of rows."""
    rows = csv_rows.read(folder / "methods.csv")
    found = points(rows)
    z = csv_rows.read(folder / "z_against_lemke.csv")
    parts = [_head(rows)]
    for name in drawn:
        parts.append(f"{_CAPTIONS[name]}\n\n![{name[:-4]}]({relpath(figures / name, page.parent)})")
    parts += [_bars(found), fastest_table(found), ratios_table(found), growth_table(found)]
    parts += [states_table(found), claims_table(rows, found), lost_table(found), z_table(z)]
    parts.append(_how(rows))
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text("\n\n".join(part for part in parts if part) + "\n")


def _head(rows: list[Row]) -> str:
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    machines = sorted({row["machine"] for row in rows})
    commits = sorted({row["commit"] for row in rows})
    return f"""# Speed against accuracy

Made by `python -m benchmarks.comparison` from its rows ({len(rows)} of them,
{len(scenes)} scenes); no number here was typed. The reference is the exact solution, so errors are
errors of the forces themselves, over the largest force of the scene; no solver's own word on its
accuracy is used.

Every method runs in a process of its own on one thread, warmed up on a small scene. A time is the
median of up to fifteen runs (least and most are in the rows), from the scene to the forces of all
contacts. What is quick has three turns, round and round with all other methods on the scene, so
that a slow moment of the machine is shared. Every method but LAMMPS, ours and the peers alike, is
given the contact system of the symmetric half where the scene is symmetric, and the time to make
it is in all of them; "solver only" is without it. `discs=1` means nearly equal discs: random radii,
no symmetry.

Machine: {"; ".join(machines)}. Commit: {", ".join(commits)}."""


def _bars(found: list[Point]) -> str:
    parts = ["## The bars"]
    for clock, words in (("solver_seconds", "of the solvers only"), ("seconds", "from the scene")):
        lines = [
            (b.what, b.scene, b.against, f"{b.ratio:.2f}", b.asked, _VERDICT[b.met])
            for b in bars(found, clock)  # type: ignore[arg-type]
        ]
        head = ("bar", "scene", f"{words}", "ratio", "asked", "verdict")
        parts.append(f"With times {words}:\n\n" + table(head, lines))
    ours = [p for p in found if p.ours and p.group in ("exact", "proof")]
    false = sum(p.claim_true is False for p in ours)
    wrong = sum(p.group == "exact" and p.error > 0 for p in ours)
    parts.append(
        f"Of {len(ours)} answers of our exact and proving methods here {false} claims were false "
        f"and {wrong} exact answers differed from the reference by any digit. (The catalogue of "
        "failures and the random problems are tests, not rows of this table.)"
    )
    return "\n\n".join(parts)


def _how(rows: list[Row]) -> str:
    versions = max((row["versions"] for row in rows), key=len, default="")
    return f"""## Again

    pip install -e '.[peers,md]'
    python -m benchmarks.comparison            # goes on where it stopped; --fresh starts again
    python -m benchmarks.comparison --quick    # three small scenes, under two minutes
    python -m benchmarks.comparison --report   # charts and this page from the rows that are there

A method whose package is missing says which extra to install, and the rest goes on. A run that
takes too long is ended (12 s, a minute or two on the largest), written as a
timeout, and not tried on larger scenes of its kind. Rows: `benchmarks/comparison/results/*.csv`.

What to know before reading: `nnls` solves the equivalent least distance programme on a dense basis
of self-stresses; Lemke's method of QuantEcon, lemkelcp and Drake get a dense matrix made by numpy,
in their time; lemkelcp was written for Python 2 and is given a `range` that it can change; PIQP's
and HiGHS' further tolerances follow the one asked for; LAMMPS' floor is `wall/harmonic` since its
granular wall is not applied while it minimises, its starting (some milliseconds) is in its time,
and it relaxes the whole pile, having no halves. Its "tau to 0" is the straight line through tau
and tau / 2.

Versions: {versions}."""
