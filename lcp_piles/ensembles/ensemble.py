"""Ensembles: many proved samples of one disordered scene, made by workers and kept in a folder.

Workers make batches of samples and hand back lines; only this process writes. What stands in the
folder is the truth: a run that was stopped, however, goes on with the samples that are not there.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ..disorder.draws import Disorder, sample_words
from ..errors import InputError, SolveError
from ..files.safe_write import make_folder
from ..scenes.scene import Scene
from .lock import locked
from .manifest import Manifest, claim, observed_by, read_manifest, scene_text
from .parts import all_lines, lines_of_part, missing, write_part
from .pool import own_pool
from .record import Observe, forces_of, is_failed
from .statistics import Statistics, statistics_of
from .worker import Batch, lines_of

_IN_FLIGHT = 64
"""Batches handed to workers and not yet written: memory is bounded, and a cluster kept busy."""
_TRIES = 3
"""How often the processes of our own are started anew where one dies."""


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """An ensemble of so many samples.

    Attributes
    ----------
    manifest : Manifest
        Of what: the scene, the disorder, the seed.
    folder : Path or None
        Where they are kept; None where they were not.
    samples : int
        How many there are.
    failed : int
        How many of them failed.
    statistics : Statistics or None
        Those of all samples that did not fail; None where something else than forces was observed.

    Examples
    --------
    >>> from lcp_piles import Uniform, ensemble, nt60
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> with ThreadPoolExecutor(1) as pool:
    ...     ensemble(nt60(3), Uniform(10), 20, executor=pool).failed
    0
    """

    manifest: Manifest
    folder: Path | None
    samples: int
    failed: int
    statistics: Statistics | None

    def __repr__(self) -> str:
        where = f" in {self.folder}" if self.folder else ""
        return f"<Ensemble of {self.samples} samples{where}, {self.failed} failed>"


def ensemble(
    scene: Scene,
    disorder: Disorder,
    samples: int,
    *,
    seed: int = 0,
    executor: Executor | None = None,
    out: str | os.PathLike[str] | None = None,
    observe: Observe = forces_of,
    progress: bool = False,
) -> Ensemble:
    """Make the samples 0, 1, ... of a disordered scene, each proved, and their statistics.

    A sample that fails is kept as such, with its error, and does not stop the rest.

    Parameters
    ----------
    scene : Scene
        The scene.
    disorder : Uniform, Normal or Radii
        The distribution of the gaps, or any with `amplitude` and `draw`.
    samples : int
        How many, 1 or more.
    seed : int, default 0
        The seed, at least 0.
    executor : Executor, optional
        Whatever has the interface of `concurrent.futures`, such as dask's `Client.get_executor()`
        or `mpi4py.futures.MPIPoolExecutor`; by default a process for each processor, which end with
        this one.
    out : str or path, optional
        The folder that keeps them, so that a run that was stopped goes on and a larger one begins
        where a smaller one ended; by default they are thrown away when the statistics are made.
    observe : callable, optional
        A function at the top level of a module, from a `Sample` to a dict of what JSON can hold,
        which is kept instead of the forces.
    progress : bool, default False
        Whether a bar is shown on standard error.

    Returns
    -------
    Ensemble
        The statistics, and where the samples are.

    Raises
    ------
    InputError
        Where the folder is of another ensemble.
    SolveError
        Where another process works on the folder or the workers of the executor die.

    Examples
    --------
    >>> from lcp_piles import Uniform, ensemble, nt60
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> with ThreadPoolExecutor(1) as pool:
    ...     found = ensemble(nt60(3), Uniform(10), 40, executor=pool)
    >>> found
    <Ensemble of 40 samples, 0 failed>
    """
    from .. import __version__

    if isinstance(samples, bool) or not isinstance(samples, int) or samples < 1:
        raise InputError("the number of samples", samples, "an integer from 1 on")
    sample_words(seed, samples)  # refuses a seed that is none
    manifest = Manifest(scene, disorder, int(seed), observed_by(observe), __version__)
    batch = Batch(scene_text(scene), disorder, int(seed), (), observe)
    place: AbstractContextManager[Any] = TemporaryDirectory() if out is None else nullcontext(out)
    with place as name:
        folder = make_folder(name)
        with locked(folder):
            claim(folder, manifest)
            _make(folder, batch, samples, executor, progress)
        found = _read(folder, manifest, samples)
    return found if out is not None else replace(found, folder=None)


def read_ensemble(folder: str | os.PathLike[str]) -> Ensemble:
    """The ensemble that a folder holds, as far as it has come.

    Parameters
    ----------
    folder : str or path
        The folder that `ensemble` was given as `out`.

    Returns
    -------
    Ensemble
        All samples in it.

    Raises
    ------
    FileFormatError
        Where it holds none.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from lcp_piles import Uniform, nt60
    >>> with TemporaryDirectory() as folder, ThreadPoolExecutor(1) as pool:
    ...     _ = ensemble(nt60(3), Uniform(10), 20, executor=pool, out=folder)
    ...     read_ensemble(folder).samples
    20
    """
    return _read(Path(folder), read_manifest(Path(folder)), None)


def _read(folder: Path, manifest: Manifest, samples: int | None) -> Ensemble:
    counts = {False: 0, True: 0}

    def whole() -> Iterator[str]:
        for line in all_lines(folder, samples):
            failed = is_failed(line)
            counts[failed] += 1
            if not failed:
                yield line

    found = None
    if manifest.observed == observed_by(forces_of):
        found = statistics_of(manifest.scene, manifest.seed, whole())
    else:
        deque(whole(), maxlen=0)
    return Ensemble(manifest, folder, sum(counts.values()), counts[True], found)


def _make(
    folder: Path, batch: Batch, samples: int, executor: Executor | None, progress: bool
) -> None:
    """Make the samples that are missing and write them, a part as soon as it is there."""
    todo = list(missing(folder, samples))
    count = sum(len(ks) for _, ks in todo)
    with _bar(samples, samples - count, progress) as bar:
        if executor is not None:
            try:
                _run(executor, folder, batch, todo, bar)
            except BrokenExecutor as error:
                raise _died() from error
            return
        for _ in range(_TRIES):
            try:
                with own_pool() as pool:
                    _run(pool, folder, batch, todo, bar)
                return
            except BrokenExecutor:  # a worker was killed, perhaps for want of memory: once more
                todo = list(missing(folder, samples))
        raise _died()


def _run(
    executor: Executor,
    folder: Path,
    batch: Batch,
    todo: Iterable[tuple[int, list[int]]],
    bar: Any,
) -> None:
    """Let workers make the samples of these parts, a bounded number of parts at a time."""
    waiting: dict[Future[list[str]], tuple[int, list[int]]] = {}
    rest = iter(todo)
    try:
        while True:
            for part, ks in islice(rest, _IN_FLIGHT - len(waiting)):
                waiting[executor.submit(lines_of, replace(batch, ks=ks))] = (part, ks)
            if not waiting:
                return
            done, _ = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                part, ks = waiting.pop(future)
                lines = dict(zip(ks, future.result(), strict=True))
                write_part(folder, part, lines_of_part(folder, part) | lines)
                bar.update(len(ks))
    finally:
        for future in waiting:
            future.cancel()


def _died() -> SolveError:
    return SolveError(
        "the workers died: killed, or out of memory, or they could not start because the program "
        'that wants them is no file, or has no `if __name__ == "__main__":` before it does; what '
        "is done is kept in `out`, so start again, with fewer workers if memory is short"
    )


def _bar(total: int, done: int, shown: bool) -> Any:
    from tqdm import tqdm  # slow to import

    return tqdm(total=total, initial=done, unit="sample", disable=not shown, dynamic_ncols=True)
