"""Run the comparison: every method on every scene of a plan, and write the rows."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from benchmarks.comparison import csv_rows
from benchmarks.comparison.judge import reference
from benchmarks.comparison.methods import METHODS, Method
from benchmarks.comparison.scenes import family
from benchmarks.comparison.worker import (
    Row,
    in_own_process,
    make_reference,
    one_method,
    pooled,
    spent,
)

PANELS = (
    "nt30 6",
    "nt30 20",
    "tss 13",
    "tss 40",
    "tbs 22",
    "tbs 100",
    "nt60 30",
    "nt30 10 discs=1",
)
SIZES = (
    "tbs 6",
    "tbs 13",
    "tbs 22",
    "tbs 40",
    "tbs 60",
    "tbs 100",
    "nt30 6",
    "nt30 10",
    "nt30 14",
    "nt30 20",
    "nt30 40",
)
PUSHED = ("nt30 6 push=20", "nt30 14 push=20")
SOME = (
    ("tbs 200", ("proved", "contacts", "newton", "piqp", "clarabel")),
    ("tss 60", ("proved", "contacts", "newton", "piqp", "clarabel")),
    ("nt60 60", ("proved", "contacts", "newton", "piqp", "clarabel")),
    ("tbs 45", ("proved", "float start", "FLINT dense")),
    ("tbs 60", ("FLINT dense",)),
    ("tbs 11", ("lemke", "lemke alone", "Fractions", "gmpy2")),
    ("nt30 8", ("lemke", "lemke alone", "Fractions", "gmpy2")),
)
"""Scenes for some methods only, whatever their limits: the bars ask for them, with more time."""
_LARGE, _PATIENCE = 5000, 60.0
_TURNS, _QUICK = 3, 4.0
"""Three turns for what took less than so many seconds in the first."""
FULL = tuple(dict.fromkeys((*SIZES, *PANELS, *PUSHED)))
QUICK = ("nt30 6", "tbs 13", "nt30 6 push=20")


def compare(
    scenes: tuple[str, ...],
    out: Path,
    seconds: float,
    only: tuple[str, ...] = (),
    limited: bool = True,
) -> None:
    """Fill the CSV with what is not in it yet, within the limits of the methods or without.

    A run may take `seconds`, a minute on large scenes; then it is ended. A method that ran out of
    time in a family is not tried on larger scenes of it.
    """
    path, references = out / "methods.csv", out / "references"
    rows = csv_rows.read(path)
    finished = csv_rows.done(rows)
    late = {(family(r["scene"]), r["method"]) for r in rows if r["status"] == "timeout"}
    where = csv_rows.surroundings()
    missing: set[str] = set()
    for name in scenes:
        _, reason = in_own_process(make_reference, name, references, seconds=600)
        if reason:
            raise RuntimeError(f"the reference of {name}: {reason}")
        truth = reference(name, references)
        patience = seconds if truth.contacts < _LARGE else max(seconds, _PATIENCE)
        chosen = [
            method
            for method in METHODS
            if not (only and method.name not in only)
            and (name, method.name) not in finished
            and method.name not in missing
            and not (limited and truth.contacts > method.limit)
            and method.fits(name)
            and (family(name), method.name) not in late
        ]
        turns: dict[str, list[list[Row]]] = {method.name: [] for method in chosen}
        for turn in range(_TURNS):
            for method in chosen:
                before = turns[method.name]
                if turn == 0 or (
                    all(r["status"] == "ok" for r in before[0]) and (spent(before[0]) < _QUICK)
                ):
                    before.append(_one(method, name, references, patience))
        for method in chosen:
            said = pooled(turns[method.name])
            for row in said:
                if row["status"] == "missing":
                    missing.add(method.name)
                    print(f"{method.name}: {row['reason']}", flush=True)
                if row["status"] == "timeout":
                    late.add((family(name), method.name))
            common = {
                "scene": name,
                "contacts": len(truth.forces),
                "part_contacts": truth.contacts,
                "dof": truth.dof,
                "mechanisms": truth.mechanisms,
                "method": method.name,
                "group": method.group,
                **where,
            }
            csv_rows.append(path, [common | row for row in said if row["status"] != "missing"])
        print(f"{name}: done", flush=True)


def _one(method: Method, name: str, references: Path, seconds: float) -> list[dict[str, Any]]:
    words = (method.name, name, references, seconds / 2)
    said, reason = in_own_process(one_method, *words, seconds=seconds)
    if reason:
        status = "timeout" if reason.startswith("ended after") else "failed"
        said.append({"status": status, "reason": reason})
    return said
