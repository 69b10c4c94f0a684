"""What a worker does: a batch of samples of one scene, as lines.

What all samples of a scene share is found once in a worker, at its first batch.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from multiprocessing import parent_process
from multiprocessing.connection import wait

from ..disorder.draws import Disorder
from ..disorder.family import PileFamily, pile_family
from ..disorder.proved_sample import proved_sample
from ..files.scene_file import scene_of_text
from ..linear.threads import one_thread
from .record import Observe, failed_line, line_of


@dataclass(frozen=True)
class Batch:
    """Samples to make: of the scene that a scene file of this text has."""

    scene: str
    disorder: Disorder
    seed: int
    ks: Sequence[int]
    observe: Observe


@one_thread()
def lines_of(batch: Batch) -> list[str]:
    """A line for each sample of a batch; one that fails does not stop the others."""
    family = _family(batch.scene)
    return [_line(family, batch, k) for k in batch.ks]


def _line(family: PileFamily, batch: Batch, k: int) -> str:
    try:
        sample = proved_sample(family, batch.disorder, batch.seed, k)
        return line_of(sample, batch.observe)
    except Exception as error:  # recorded, whatever it is
        return failed_line(k, batch.seed, error)


@lru_cache(maxsize=2)
def _family(scene: str) -> PileFamily:
    return pile_family(scene_of_text(scene))


def end_with_parent() -> None:
    """Let this worker process end when the one that started it does, however that ends.

    A worker that waits for work would else wait for ever: its siblings hold the pipe open.
    """
    parent = parent_process()
    if parent is None:
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
