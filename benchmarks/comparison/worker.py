"""One method on one scene, in a process of its own: a row for every setting.

The process is forked from one that has imported the package and has nothing else to do, so that a
run costs no more than itself. The method is warmed up on a small scene of its family; then it runs
up to five times in a turn. Times are from the scene to the forces;
what it takes to the arrays of the contact system, which every method needs, is told apart.
"""

from __future__ import annotations

import importlib
import json
import multiprocessing
import resource
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from statistics import median
from time import monotonic, perf_counter
from typing import Any

from benchmarks.comparison.judge import reference, verdict
from benchmarks.comparison.methods import Method, method
from benchmarks.comparison.problem import FailedError, problem
from benchmarks.comparison.scenes import build

_REPEATS = 5
_ENOUGH = 0.5
_LEAST = 3
_LONG = 3.0

Row = dict[str, Any]
Say = Callable[[Row], None]


def in_own_process(
    work: Callable[..., None], *arguments: Any, seconds: float
) -> tuple[list[Row], str]:
    """The rows that `work(*arguments, say)` says, and why it ended early ("" if it did not)."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    child = context.Process(target=work, args=(*arguments, there.send))
    child.start()
    there.close()
    rows: list[Row] = []
    reason, end = "", monotonic() + seconds
    while True:
        if not here.poll(max(0.0, end - monotonic())):
            child.kill()
            reason = f"ended after {seconds:g} s"
            break
        try:
            rows.append(here.recv())
        except EOFError:
            break
    child.join()
    if not reason and child.exitcode:
        reason = f"the process ended with {child.exitcode}"
    return rows, reason


def one_method(name: str, scene_name: str, references: Path, seconds: float, say: Say) -> None:
    """Say a row for every setting of a method, within about so many seconds."""
    chosen = method(name)
    try:
        importlib.import_module(chosen.module)
        _warm_up(chosen, scene_name)
    except ImportError as error:
        extra = f"install the extra {chosen.extra}: pip install 'lcp-piles[{chosen.extra}]'"
        say({"status": "missing", "reason": f"{error}; {extra}"})
        return
    base = _megabytes()
    begin = perf_counter()
    for setting in chosen.settings:
        if perf_counter() - begin > seconds:
            break
        times, setups = [], []
        try:
            while _again(times, setups):
                scene = build(scene_name)
                start = perf_counter()
                given = problem(scene)
                ready = perf_counter()
                answer = chosen.run(given, setting)
                end = perf_counter()
                setups.append(ready - start)
                times.append(end - ready if chosen.from_scene else end - start)
        except Exception as error:  # a peer may raise anything: its failure is a result
            reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
            say({"setting": setting, "status": "failed", "reason": reason[:200]})
            continue
        peak = _megabytes()
        needless = chosen.group == "md"  # molecular dynamics needs no contact system
        own = [t if needless else max(t - s, 0.0) for t, s in zip(times, setups, strict=True)]
        say(
            {
                "setting": setting,
                "status": "ok",
                "times": times,
                "own": own,
                "setups": setups,
                "MB": peak,
                "own_MB": peak - base,
                **verdict(chosen, setting, scene, answer, reference(scene_name, references)),
                "facts": json.dumps(answer.facts),
            }
        )


def pooled(turns: list[list[Row]]) -> list[Row]:
    """The rows of a method's first turn, with the medians of the times of all its turns."""
    rows = []
    for k, row in enumerate(turns[0]):
        if row["status"] != "ok":
            rows.append(row)
            continue
        same = [turn[k] for turn in turns if len(turn) > k and turn[k]["status"] == "ok"]
        times, own, setups = (
            [t for each in same for t in each[name]] for name in ("times", "own", "setups")
        )
        measured = {
            "seconds": median(times),
            "least": min(times),
            "most": max(times),
            "solver_seconds": median(own),
            "setup_seconds": median(setups),
            "repeats": len(times),
            "MB": max(each["MB"] for each in same),
            "own_MB": max(each["own_MB"] for each in same),
        }
        plain = {name: x for name, x in row.items() if name not in ("times", "own", "setups")}
        rows.append(plain | measured)
    return rows


def spent(rows: list[Row]) -> float:
    """Seconds that the rows of one turn took."""
    return sum(sum(row.get("times", ())) for row in rows)


def make_reference(name: str, references: Path, say: Say) -> None:
    """Solve a scene exactly and keep the reference."""
    reference(name, references)


def _again(times: list[float], setups: list[float]) -> bool:
    """Five times, three where that takes more than half a second, less where three seconds do."""
    spent = sum(times) + sum(setups)
    if len(times) < _LEAST:
        return spent < _LONG
    return len(times) < _REPEATS and spent < _ENOUGH


def _warm_up(chosen: Method, scene_name: str) -> None:
    kind, _, *options = scene_name.split()
    with suppress(FailedError):
        chosen.run(problem(build(" ".join([kind, "3", *options]))), chosen.settings[0])


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
