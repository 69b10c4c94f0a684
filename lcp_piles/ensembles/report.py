"""What an ensemble has found, as rows for people and as JSON for programs."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from ..disorder.distributions import name_of
from ..files.json_fields import Entry
from ..files.scene_json import scene_entry
from ..numbers.vectors import FloatArray
from .ensemble import Ensemble
from .force_distribution import EDGES, SMALL, TAIL
from .statistics import Fit, Statistics
from .tally import Estimate


def fits(found: Statistics) -> dict[str, Fit]:
    """The fits to both ends of P(x), by what is fitted."""
    return {
        f"alpha: P ~ x^alpha below {SMALL:g}": found.small_forces,
        f"beta: P ~ exp(-beta x) above {TAIL:.3g}": found.exponential_tail,
        f"gamma: P ~ exp(-gamma x^2) above {TAIL:.3g}": found.normal_tail,
    }


def rows(ensemble: Ensemble) -> list[tuple[str, str]]:
    """Facts for people: names, and numbers with their confidence bands."""
    manifest = ensemble.manifest
    lines = [
        (
            "disorder",
            f"{name_of(manifest.disorder)}, amplitude {manifest.disorder.amplitude} w tau, "
            f"seed {manifest.seed}",
        ),
        ("samples", f"{ensemble.samples}, {ensemble.failed} failed"),
    ]
    found = ensemble.statistics
    if found is None:
        return lines
    share = float(found.tally.means()["exact"][0])
    lines.append(("proved", f"all; {share:.2%} of them by exact arithmetic"))
    lines.append(("forces within", f"{found.largest_error:.2g} w"))
    lines += [(name, str(estimate)) for name, estimate in found.numbers.items()]
    for name, fit in fits(found).items():
        if np.isfinite(fit.parameter.value):
            goodness = f"distance {fit.distance:.3g}, p = {fit.p_value:.2g}"
            lines.append((name, f"{fit.parameter}; {goodness}"))
    return lines


def report_json(ensemble: Ensemble) -> str:
    """All statistics of an ensemble as JSON: values, and bands as pairs."""
    manifest = ensemble.manifest
    content: Entry = {
        "scene": scene_entry(manifest.scene),
        "distribution": name_of(manifest.disorder),
        "amplitude": str(manifest.disorder.amplitude),
        "seed": manifest.seed,
        "samples": ensemble.samples,
        "failed": ensemble.failed,
    }
    found = ensemble.statistics
    if found is not None:
        content |= {
            "largest_error": found.largest_error,
            "numbers": {name: _entry(estimate) for name, estimate in found.numbers.items()},
            "fits": {
                name.partition(":")[0]: _entry(fit.parameter)
                | {"distance": _number(fit.distance), "p": _number(fit.p_value)}
                for name, fit in fits(found).items()
            },
            "base": {
                "x": _list(found.observables.base),
                "normal": _entry(found.base_pressure),
                "spread": _entry(found.base_spread),
            },
            "contacts": {
                "closing": _entry(found.closing),
                "force": _entry(found.forces),
                "spread": _entry(found.force_spread),
            },
            "density": {"edges": _list(EDGES), **_entry(found.density)},
            "correlation": {
                "distance": _list(found.observables.pairs.distances),
                **_entry(found.correlation),
            },
            "stress_times_pi": {
                "mean": _entry(found.stress),
                "spread": _entry(found.stress_spread),
            },
        }
    return json.dumps(content, indent=1) + "\n"


def _entry(estimate: Estimate) -> dict[str, Any]:
    if estimate.value.ndim:
        return {"value": _list(estimate.value), "band": [_list(estimate.low), _list(estimate.high)]}
    return {
        "value": _number(float(estimate.value)),
        "band": [_number(float(estimate.low)), _number(float(estimate.high))],
    }


def _list(values: FloatArray) -> list[float | None]:
    return [_number(x) for x in values.tolist()]


def _number(x: float) -> float | None:
    """A float as JSON has it: what is none is null."""
    return x if np.isfinite(x) else None
