"""The workers that an ensemble has of its own: processes of this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from .worker import end_with_parent


def processors() -> int:
    """The number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def own_pool(workers: int | None = None) -> Iterator[ProcessPoolExecutor]:
    """So many processes (default: one for each processor), which end with this one.

    They start from nothing ("spawn"): a fork of a process with threads may hang. So a script that
    uses them has to guard what it does by `if __name__ == "__main__":`.
    """
    pool = ProcessPoolExecutor(
        workers or processors(), mp_context=get_context("spawn"), initializer=end_with_parent
    )
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)
