"""Numbers out of the rows: what charts and report both ask for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import exp, isnan, log
from typing import Literal

from benchmarks.comparison.csv_rows import Row

Clock = Literal["seconds", "solver_seconds"]
OURS = ("exact", "proof", "float")
BASELINES = ("FLINT dense", "Fractions", "gmpy2")


@dataclass(frozen=True)
class Point:
    """One answer: a method on a scene at a setting."""

    scene: str
    method: str
    group: str
    setting: str
    dof: int
    contacts: int
    part_contacts: int
    seconds: float
    solver_seconds: float
    megabytes: float
    error: float
    wrong: tuple[int | None, ...]
    wrong_loaded: tuple[int, ...]
    claimed: bool
    claim_true: bool | None
    facts: str

    @property
    def ours(self) -> bool:
        """Whether it is a method of this package, baselines apart."""
        return self.group in OURS and self.method not in BASELINES


def points(rows: Iterable[Row]) -> list[Point]:
    """The rows that have an answer, as numbers."""
    return [_point(row) for row in rows if row["status"] == "ok" and not _nothing(row)]


def _nothing(row: Row) -> bool:
    return row["relative"] == "" or isnan(float(row["relative"]))


def _point(row: Row) -> Point:
    return Point(
        row["scene"],
        row["method"],
        row["group"],
        row["setting"],
        int(row["dof"]),
        int(row["contacts"]),
        int(row["part_contacts"]),
        float(row["seconds"]),
        float(row["solver_seconds"]),
        float(row["MB"]),
        float(row["relative"]),
        tuple(None if w == "-" else int(w) for w in row["wrong"].split()),
        tuple(int(w) for w in row["wrong_loaded"].split()),
        row["claimed"] == "True",
        None if row["claim_true"] == "" else row["claim_true"] == "True",
        row["facts"],
    )


def fastest(found: Iterable[Point], error: float, clock: Clock = "seconds") -> Point | None:
    """The fastest of some answers that is within an error; 0 asks for the exact forces."""
    good = [p for p in found if p.error <= error and (error or p.group == "exact")]
    return min(good, key=lambda p: getattr(p, clock), default=None)


def best(
    found: list[Point], scene: str, error: float, groups: tuple[str, ...], clock: Clock
) -> Point | None:
    """The fastest answer of some groups on a scene within an error."""
    return fastest((p for p in found if p.scene == scene and p.group in groups), error, clock)


def of(found: list[Point], scene: str, method: str) -> list[Point]:
    """The answers of one method on one scene."""
    return [p for p in found if p.scene == scene and p.method == method]


def exponent(sizes: list[float], values: list[float]) -> float | None:
    """The slope of the straight line through log(value) over log(size); None below three sizes."""
    if len(sizes) < 3:
        return None
    x, y = [log(s) for s in sizes], [log(v) for v in values]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    top = sum((a - mx) * (b - my) for a, b in zip(x, y, strict=True))
    return top / sum((a - mx) ** 2 for a in x)


def geometric_mean(values: list[float]) -> float:
    """The geometric mean."""
    return exp(sum(map(log, values)) / len(values))
