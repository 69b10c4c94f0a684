"""The ensembles of the study, one after the other: a row of numbers and the curves of each.

Rows and curves are written as soon as an ensemble is done, and those that are there are not made
again.
"""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lcp_piles import Ensemble, Uniform, ensemble, pile
from lcp_piles.ensembles.force_distribution import EDGES
from lcp_piles.ensembles.tally import Estimate

RESULTS = Path(__file__).parent / "results"
SAMPLES = 10_000
PILES = (
    ("nt30", 6), ("nt60", 8), ("tss", 8), ("tbs", 8),
    ("nt30", 10), ("nt60", 16), ("tss", 13), ("tbs", 16),
)  # fmt: skip
"""Kinds and layers: two sizes of each of the paper's piles, the small ones first."""
AMPLITUDES = ("0.01", "0.1", "1", "3", "10", "30", "100", "1000", "10000")
"""In w tau."""
_FITS = ("small_forces", "exponential_tail", "normal_tail")


@dataclass(frozen=True)
class Case:
    """An ensemble of the study."""

    kind: str
    layers: int
    amplitude: str

    @property
    def name(self) -> str:
        """What its rows and curves are found by."""
        return f"{self.kind} {self.layers} {self.amplitude}"


CASES = [Case(kind, layers, a) for kind, layers in PILES for a in AMPLITUDES]


def run(samples: int = SAMPLES, results: Path = RESULTS) -> None:
    """Make what is missing."""
    results.mkdir(exist_ok=True)
    done = {row["case"] for row in rows(results)}
    for case in CASES:
        if case.name not in done:
            scene = pile(case.kind, layers=case.layers)
            print(case.name, flush=True)
            found = ensemble(scene, Uniform(case.amplitude), samples, progress=True)
            _keep(results, case, found)


def rows(results: Path = RESULTS) -> list[dict[str, str]]:
    """The rows that there are."""
    path = results / "study.csv"
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def curves(results: Path = RESULTS) -> dict[str, Any]:
    """The curves that there are, by the names of their cases."""
    path = results / "curves.json"
    return dict(json.loads(path.read_text("utf-8"))) if path.exists() else {}


def _keep(results: Path, case: Case, found: Ensemble) -> None:
    all_curves = curves(results) | {case.name: _curves(found)}
    text = ",\n".join(f"{json.dumps(name)}: {json.dumps(c)}" for name, c in all_curves.items())
    (results / "curves.json").write_text("{\n" + text + "\n}\n", encoding="utf-8")
    row = _row(case, found)
    path = results / "study.csv"
    fresh = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(row), lineterminator="\n")
        if fresh:
            writer.writeheader()
        writer.writerow(row)


def _row(case: Case, found: Ensemble) -> dict[str, object]:
    statistics = found.statistics
    assert statistics is not None, "some samples did not fail"
    row: dict[str, object] = {
        "case": case.name,
        "kind": case.kind,
        "layers": case.layers,
        "amplitude": case.amplitude,
        "contacts": len(statistics.observables.scene.contacts),
        "freedoms": statistics.observables.freedoms,
        "samples": found.samples,
        "failed": found.failed,
        "share exact": f"{float(statistics.tally.means()['exact'][0]):.6g}",
        "largest error (w)": f"{statistics.largest_error:.3g}",
    }
    for name, estimate in statistics.numbers.items():
        row |= _told(name, estimate)
    for name in _FITS:
        fit = getattr(statistics, name)
        row |= _told(name, fit.parameter)
        row |= {f"{name}: distance": f"{fit.distance:.4g}", f"{name}: p": f"{fit.p_value:.3g}"}
    return row


def _told(name: str, estimate: Estimate) -> dict[str, str]:
    parts = (("", estimate.value), (": low", estimate.low), (": high", estimate.high))
    return {name + part: f"{float(value):.6g}" for part, value in parts}


def _curves(found: Ensemble) -> dict[str, Any]:
    statistics = found.statistics
    assert statistics is not None, "some samples did not fail"
    density = statistics.density
    seen = [i for i, value in enumerate(density.value.tolist()) if value > 0]
    middles = (EDGES[:-1] * EDGES[1:]) ** 0.5
    pressure, correlation = statistics.base_pressure, statistics.correlation
    return {
        "x": _rounded(statistics.observables.base),
        "pressure": _rounded(pressure.value),
        "pressure error": _rounded(pressure.error),
        "pressure spread": _rounded(statistics.base_spread.value),
        "f": _rounded(middles[seen]),
        "density": _rounded(density.value[seen]),
        "density error": _rounded(density.error[seen]),
        "distance": _rounded(statistics.observables.pairs.distances),
        "correlation": _rounded(correlation.value),
        "correlation error": _rounded(correlation.error),
    }


def _rounded(values: Any) -> list[float | None]:
    return [float(f"{x:.5g}") if x == x else None for x in values.tolist()]
