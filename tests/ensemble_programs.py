"""What processes of the tests of ensembles run: functions that workers can import, and a parent."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

from lcp_piles import Sample, Uniform, ensemble, nt60


def doubled(sample: Sample) -> dict[str, Any]:
    """Something else than forces."""
    return {"twice": 2 * sample.k}


def failing(sample: Sample) -> dict[str, Any]:
    """Raises for every seventh sample."""
    if sample.k % 7 == 3:
        raise ValueError(f"no luck with {sample.k}")
    return {"k again": sample.k}


def not_json(sample: Sample) -> dict[str, Any]:
    """What JSON cannot hold."""
    return {"error": float("nan")}


def deadly(sample: Sample) -> dict[str, Any]:
    """Kills its process, once for the file that `DEADLY` names."""
    place = Path(os.environ["DEADLY"])
    if sample.k == 40 and not place.exists():
        place.touch()
        os._exit(1)
    return {"k again": sample.k}


def always_deadly(sample: Sample) -> dict[str, Any]:
    """Kills its process."""
    os._exit(1)


def by_mpi(folder: str, samples: int) -> None:
    """The ensemble of the test by the workers of mpiexec."""
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as pool:
        ensemble(nt60(4), Uniform(10), samples, seed=3, executor=pool, out=folder)


if __name__ == "__main__":
    if sys.argv[3:] == ["mpi"]:
        by_mpi(sys.argv[1], int(sys.argv[2]))
    else:
        ensemble(nt60(4), Uniform(10), int(sys.argv[2]), seed=3, out=sys.argv[1])
