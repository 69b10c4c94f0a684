"""One method on one scene, in a process of its own: a line of JSON for every setting.

    python -m benchmarks.worker METHOD SCENE REFERENCES SECONDS

The method is warmed up on a small scene of its family; then it runs until it has five times or a
second is over, at most. Times are from the scene to the forces; what it takes to the arrays of the
contact system, which every method needs, is told apart.
"""

from __future__ import annotations

import importlib
import json
import resource
import sys
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

_REPEATS = 5
_ENOUGH = 1.0


def main(name: str, scene_name: str, references: Path, seconds: float) -> None:
    """Run and print."""
    from benchmarks.judge import reference, verdict
    from benchmarks.methods import method
    from benchmarks.problem import FailedError, problem
    from benchmarks.scenes import build

    chosen = method(name)
    try:
        importlib.import_module(chosen.module)
        _warm_up(chosen, scene_name)
    except ImportError as error:
        extra = f"install the extra {chosen.extra}: pip install 'lcp-piles[{chosen.extra}]'"
        _say({"status": "missing", "reason": f"{error}; {extra}"})
        return
    base = _megabytes()
    scene = build(scene_name)
    given = problem(scene)
    truth = None
    begin = perf_counter()
    for setting in chosen.settings:
        if perf_counter() - begin > seconds:
            break
        times, setups = [], []
        try:
            while len(times) < _REPEATS and sum(times) + sum(setups) < _ENOUGH:
                scene = build(scene_name)
                start = perf_counter()
                given = problem(scene)
                ready = perf_counter()
                answer = chosen.run(given, setting)
                end = perf_counter()
                setups.append(ready - start)
                times.append(end - ready if chosen.from_scene else end - start)
        except (FailedError, AssertionError, ArithmeticError, RuntimeError, ValueError) as error:
            _say({"setting": setting, "status": "failed", "reason": str(error)[:200]})
            continue
        peak = _megabytes()
        truth = truth or reference(scene_name, references)
        setup = median(setups)
        own = [max(t - s, 0.0) for t, s in zip(times, setups, strict=True)]
        if chosen.group == "md":  # needs no contact system
            own = times
        _say(
            {
                "setting": setting,
                "status": "ok",
                "seconds": median(times),
                "least": min(times),
                "most": max(times),
                "solver_seconds": median(own),
                "setup_seconds": setup,
                "repeats": len(times),
                "MB": peak,
                "own_MB": peak - base,
                **verdict(chosen, setting, scene, answer, truth),
                "facts": json.dumps(answer.facts),
            }
        )


def _warm_up(chosen: Any, scene_name: str) -> None:
    from benchmarks.problem import FailedError, problem
    from benchmarks.scenes import build

    kind, _, *options = scene_name.split()
    given = problem(build(" ".join([kind, "3", *options])))
    try:
        chosen.run(given, chosen.settings[0])
    except FailedError:
        pass


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _say(row: dict[str, Any]) -> None:
    print("ROW " + json.dumps(row), flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]), float(sys.argv[4]))
