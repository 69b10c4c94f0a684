"""Time and peak memory of one piece of work, in a process of its own.

`measured(task, **arguments)` runs a function of `tasks` in a new interpreter: once to warm up on
the smallest pile, then `repeats` times; imports are not counted.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import statistics
import subprocess
import sys
from dataclasses import dataclass
from time import perf_counter, process_time
from typing import Any


@dataclass(frozen=True)
class Measurement:
    """Median, least and largest seconds, peak memory (MB) and what the task said of its result.

    `cpu` is the median of the processor's seconds, which other work on the machine lengthens less.
    """

    median: float
    least: float
    most: float
    megabytes: float
    said: dict[str, Any]
    cpu: float


def measured(task: str, repeats: int = 3, **arguments: Any) -> Measurement:
    """Run a task in a process of its own; raises `RuntimeError` with its message where it fails."""
    words = [
        sys.executable,
        "-m",
        "benchmarks.speed.measure",
        task,
        str(repeats),
        json.dumps(arguments),
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{task} {arguments}: {done.stderr.strip().splitlines()[-1]}")
    content = json.loads(done.stdout.splitlines()[-1])
    seconds = content["seconds"]
    return Measurement(
        statistics.median(seconds),
        min(seconds),
        max(seconds),
        content["MB"],
        content["said"],
        statistics.median(content["cpu"]),
    )


def machine() -> str:
    """The machine and the versions, for the head of a table."""
    import flint
    import numpy
    import scipy

    versions = (
        f"numpy {numpy.__version__}, scipy {scipy.__version__}, FLINT {flint.__FLINT_VERSION__}"
    )
    python = f"Python {platform.python_version()}"
    return f"{platform.machine()}, {os.cpu_count()} cores, {python}, {versions}"


def _main() -> None:
    from benchmarks.speed import tasks

    task, repeats, arguments = sys.argv[1], int(sys.argv[2]), json.loads(sys.argv[3])
    run = getattr(tasks, task)
    tasks.warm_up()
    seconds, cpu, said = [], [], {}
    for _ in range(repeats):
        start, busy = perf_counter(), process_time()
        said = run(**arguments)
        seconds.append(perf_counter() - start)
        cpu.append(process_time() - busy)
    megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"seconds": seconds, "cpu": cpu, "MB": megabytes, "said": said}))


if __name__ == "__main__":
    _main()
