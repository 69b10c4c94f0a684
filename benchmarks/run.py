"""Run the comparison: every method on every scene of a plan, and write the rows."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from benchmarks import results
from benchmarks.judge import reference
from benchmarks.methods import METHODS, Method
from benchmarks.scenes import family

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
LARGE = ("tbs 200",)
LARGE_METHODS = ("proved", "contacts", "newton", "piqp", "clarabel")
FULL = tuple(dict.fromkeys((*SIZES, *PANELS, *PUSHED)))
QUICK = ("nt30 6", "tbs 13", "nt30 6 push=20")
_ALONE = ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE")


def environment() -> dict[str, str]:
    """The children's: one thread, and the machine's own kernels."""
    own = {k: v for k, v in os.environ.items() if k not in _ALONE}
    one = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    return own | one


def compare(scenes: tuple[str, ...], out: Path, seconds: float, only: tuple[str, ...] = ()) -> None:
    """Fill the CSV with what is not in it yet. A run may take `seconds`, then it is ended.

    A method that ran out of time in a family is not tried on larger scenes of it.
    """
    path, references = out / "methods.csv", out / "references"
    rows = results.read(path)
    finished = results.done(rows)
    late = {(family(r["scene"]), r["method"]) for r in rows if r["status"] == "timeout"}
    where = results.surroundings()
    missing: set[str] = set()
    for name in scenes:
        truth = reference(name, references)
        for method in METHODS:
            if only and method.name not in only:
                continue
            if (name, method.name) in finished or method.name in missing:
                continue
            if truth.contacts > method.limit or not method.fits(name):
                continue
            if (family(name), method.name) in late:
                continue
            said = _one(method, name, references, seconds)
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
            results.append(path, [common | row for row in said if row["status"] != "missing"])
        print(f"{name}: done", flush=True)


def _one(method: Method, name: str, references: Path, seconds: float) -> list[dict[str, Any]]:
    words = [sys.executable, "-m", "benchmarks.worker", method.name, name, str(references)]
    words.append(str(seconds / 2))
    reason, timed_out = "", False
    try:
        done = subprocess.run(
            words, capture_output=True, text=True, timeout=seconds, env=environment(), check=False
        )
        text, lines = done.stdout, done.stderr.strip().splitlines()
        if done.returncode:
            reason = lines[-1] if lines else f"ended with {done.returncode}"
    except subprocess.TimeoutExpired as late:
        text = late.stdout.decode() if isinstance(late.stdout, bytes) else late.stdout or ""
        reason, timed_out = f"ended after {seconds:g} s", True
    said = [json.loads(line[4:]) for line in text.splitlines() if line.startswith("ROW ")]
    if timed_out:
        said.append({"status": "timeout", "reason": reason})
    elif reason:
        said.append({"status": "failed", "reason": reason})
    return said
