"""Ensembles in folders: the same samples whatever happens to the processes that make them."""

from __future__ import annotations

import json
import multiprocessing
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from ensemble_programs import always_deadly, deadly, doubled, failing, not_json

from lcp_piles import (
    Contact,
    Disc,
    FileFormatError,
    InputError,
    Normal,
    Scene,
    SolveError,
    Uniform,
    ensemble,
    nt60,
    pile_family,
    proved_sample,
    read_ensemble,
)
from lcp_piles.cli.parser import main
from lcp_piles.ensembles.lock import locked

SCENE, DISORDER = nt60(4), Uniform(10)
TESTS = Path(__file__).parent


@pytest.fixture
def pool() -> Iterator[Executor]:
    with ThreadPoolExecutor(1) as executor:
        yield executor


def parts(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.glob("part-*")}


def numbers(folder: Path) -> list[int]:
    lines = b"".join(content for _, content in sorted(parts(folder).items())).splitlines()
    return [json.loads(line)["k"] for line in lines]


def test_samples_are_those_that_are_proved_one_by_one(tmp_path: Path, pool: Executor) -> None:
    ensemble(SCENE, DISORDER, 70, seed=3, executor=pool, out=tmp_path)
    family = pile_family(SCENE)
    lines = b"".join(content for _, content in sorted(parts(tmp_path).items())).splitlines()
    assert numbers(tmp_path) == list(range(70))
    for k in (0, 31, 32, 69):
        content, sample = json.loads(lines[k]), proved_sample(family, DISORDER, 3, k)
        assert content["forces"] == sample.forces.tolist()
        assert content["verdict"] == sample.verdict
        assert content["road"] == sample.road


@pytest.mark.parametrize("start", ["spawn", "fork", "default"])
def test_processes_make_the_same_files_as_this_one(
    start: str, tmp_path: Path, pool: Executor
) -> None:
    ensemble(SCENE, DISORDER, 70, executor=pool, out=tmp_path / "here")
    if start == "default":
        ensemble(SCENE, DISORDER, 70, out=tmp_path / "there")
    else:
        with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(start)) as processes:
            ensemble(SCENE, DISORDER, 70, executor=processes, out=tmp_path / "there")
    assert parts(tmp_path / "here") == parts(tmp_path / "there")


def test_more_samples_extend_a_folder(tmp_path: Path, pool: Executor) -> None:
    ensemble(SCENE, DISORDER, 10, executor=pool, out=tmp_path)
    before = parts(tmp_path)
    more = ensemble(SCENE, DISORDER, 45, executor=pool, out=tmp_path)
    assert numbers(tmp_path) == list(range(45))
    assert parts(tmp_path)["part-00000000.jsonl"].startswith(before["part-00000000.jsonl"])
    # Fewer are the first ones of what is there.
    fewer = ensemble(SCENE, DISORDER, 10, executor=pool, out=tmp_path)
    assert (fewer.samples, more.samples) == (10, 45)
    assert read_ensemble(tmp_path).samples == 45


PROGRAM = str(TESTS / "ensemble_programs.py")


def environment() -> dict[str, str]:
    places = [str(TESTS.parent), os.environ.get("PYTHONPATH", "")]
    return os.environ | {"PYTHONPATH": os.pathsep.join(places)}


def run_and_kill(folder: Path, samples: int, seconds: float, begun: str | None = None) -> None:
    """Kill it after so many seconds, counted from where the folder has the file `begun`."""
    command = [sys.executable, PROGRAM, str(folder), str(samples)]
    process = subprocess.Popen(command, env=environment(), stderr=subprocess.DEVNULL)
    for _ in range(600):
        if begun is None or (folder / begun).exists():
            break
        time.sleep(0.1)
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
    process.wait()


def killed_again_and_again(tmp_path: Path, pool: Executor, kills: int) -> None:
    """Killed at random moments, then finished: the files are those of a run in peace."""
    samples, luck = 400, random.Random(kills)
    folder = tmp_path / "killed"
    for _ in range(kills):
        run_and_kill(folder, samples, luck.uniform(0.4, 2.5))
    interrupted = ensemble(SCENE, DISORDER, samples, seed=3, executor=pool, out=folder)
    peaceful = ensemble(SCENE, DISORDER, samples, seed=3, executor=pool, out=tmp_path / "peace")
    assert parts(folder) == parts(tmp_path / "peace")
    assert interrupted.statistics is not None
    assert peaceful.statistics is not None
    one, other = interrupted.statistics.tally, peaceful.statistics.tally
    assert np.array_equal(one.sums, other.sums, equal_nan=True)
    assert np.array_equal(one.replicates, other.replicates, equal_nan=True)


def test_a_run_that_is_killed_goes_on(tmp_path: Path, pool: Executor) -> None:
    killed_again_and_again(tmp_path, pool, 2)


@pytest.mark.slow
def test_a_run_that_is_killed_twenty_times_goes_on(tmp_path: Path, pool: Executor) -> None:
    killed_again_and_again(tmp_path, pool, 20)


def test_workers_end_with_a_parent_that_is_killed(tmp_path: Path) -> None:
    run_and_kill(tmp_path / "killed", 100_000, 2.0, begun="lock")
    marker = str(tmp_path / "killed")
    for _ in range(50):
        found = [
            path for path in Path("/proc").glob("[0-9]*/cmdline") if marker.encode() in _read(path)
        ]
        if not found:
            break
        time.sleep(0.1)
    assert not found
    with locked(tmp_path / "killed"):
        pass


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


def test_a_torn_tail_is_made_again(tmp_path: Path, pool: Executor) -> None:
    ensemble(SCENE, DISORDER, 40, executor=pool, out=tmp_path)
    whole = parts(tmp_path)
    for cut in (1, 7, 300, len(whole["part-00000000.jsonl"]) - 2):
        path = tmp_path / "part-00000000.jsonl"
        path.write_bytes(whole[path.name][:-cut])
        assert read_ensemble(tmp_path).samples < 40
        ensemble(SCENE, DISORDER, 40, executor=pool, out=tmp_path)
        assert parts(tmp_path) == whole


@pytest.mark.parametrize(
    "line", ["[]", '{"k": -1}', '{"k": 40}', '{"k": true}', "nothing", '{"k": 1}']
)
def test_a_part_with_something_else_is_refused(line: str, tmp_path: Path, pool: Executor) -> None:
    ensemble(SCENE, DISORDER, 32, executor=pool, out=tmp_path)
    path = tmp_path / "part-00000000.jsonl"
    path.write_text(line + "\n" + path.read_text())
    with pytest.raises(FileFormatError, match=r"part-00000000.jsonl, line [1-3]"):
        ensemble(SCENE, DISORDER, 32, executor=pool, out=tmp_path)


@pytest.mark.parametrize(
    "change",
    [
        {"scene": nt60(5)},
        {"disorder": Uniform(11)},
        {"disorder": Normal(10)},
        {"seed": 1},
        {"observe": doubled},
    ],
    ids=["scene", "amplitude", "distribution", "seed", "observe"],
)
def test_the_folder_of_another_ensemble_is_refused(
    change: dict[str, object], tmp_path: Path, pool: Executor
) -> None:
    given: dict[str, object] = {"scene": SCENE, "disorder": DISORDER, "samples": 3}
    ensemble(**given, executor=pool, out=tmp_path)  # type: ignore[arg-type]
    before = parts(tmp_path)
    with pytest.raises(InputError, match="it holds another one"):
        ensemble(**given | change, executor=pool, out=tmp_path)  # type: ignore[arg-type]
    assert parts(tmp_path) == before


def test_a_manifest_that_was_altered_is_refused(tmp_path: Path, pool: Executor) -> None:
    ensemble(SCENE, DISORDER, 3, executor=pool, out=tmp_path)
    path = tmp_path / "ensemble.json"
    text = path.read_text()
    path.write_text(text.replace('"amplitude": "10"', '"amplitude": "20"'))
    with pytest.raises(FileFormatError, match="hash"):
        read_ensemble(tmp_path)
    path.write_text(text.replace("}", ""))
    with pytest.raises(FileFormatError):
        read_ensemble(tmp_path)


def test_a_second_parent_is_refused(tmp_path: Path) -> None:
    """A lock of another process; that one's death frees it."""
    program = (
        "import sys, time; from pathlib import Path; from lcp_piles.ensembles.lock import locked\n"
        "with locked(Path(sys.argv[1])): print('in', flush=True); time.sleep(60)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program, str(tmp_path)], stdout=subprocess.PIPE
    ) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"in\n"
        with pytest.raises(SolveError, match="another process works on"):
            ensemble(SCENE, DISORDER, 3, out=tmp_path)
        other.kill()
    with locked(tmp_path):
        pass


def test_samples_that_fail_are_recorded_and_stop_nothing(tmp_path: Path) -> None:
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as processes:
        found = ensemble(
            SCENE, DISORDER, 40, seed=5, executor=processes, out=tmp_path, observe=failing
        )
    assert (found.samples, found.failed, found.statistics) == (40, 6, None)
    text = parts(tmp_path)["part-00000000.jsonl"].decode().splitlines()
    assert json.loads(text[10]) == {"k": 10, "seed": 5, "failed": "ValueError: no luck with 10"}
    assert json.loads(text[11]) == {"k": 11, "k again": 11}


def test_what_json_cannot_hold_is_a_failure(tmp_path: Path, pool: Executor) -> None:
    found = ensemble(SCENE, DISORDER, 2, executor=pool, out=tmp_path, observe=not_json)
    assert found.failed == 2


def test_a_scene_that_cannot_stand_fails_in_every_sample(pool: Executor) -> None:
    ball = Disc("ball", (0, 0), (1, -1), (None, None))
    scene = Scene([ball], [Contact("ball", "floor", (0, 1))])
    found = ensemble(scene, DISORDER, 5, executor=pool)
    assert (found.failed, found.statistics) == (5, None)


def test_a_worker_that_dies_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DEADLY", str(tmp_path / "died"))
    found = ensemble(SCENE, DISORDER, 80, out=tmp_path / "all", observe=deadly)
    assert (tmp_path / "died").exists()
    assert (found.samples, found.failed) == (80, 0)
    assert numbers(tmp_path / "all") == list(range(80))


def test_workers_that_always_die_are_given_up(tmp_path: Path) -> None:
    with (
        ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as processes,
        pytest.raises(SolveError, match="the workers died"),
    ):
        ensemble(SCENE, DISORDER, 5, executor=processes, out=tmp_path, observe=always_deadly)


@pytest.mark.parametrize("samples", [0, -1, 1.5, True, "10"])
def test_numbers_of_samples_that_are_none(samples: object) -> None:
    with pytest.raises(InputError, match="the number of samples"):
        ensemble(SCENE, DISORDER, samples)  # type: ignore[arg-type]


def test_what_workers_cannot_import_is_refused() -> None:
    with pytest.raises(InputError, match="observe"):
        ensemble(SCENE, DISORDER, 2, observe=lambda sample: {})


@contextmanager
def dask_cluster(workers: int) -> Iterator[object]:
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=workers, threads_per_worker=1, dashboard_address=None, processes=True
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


@pytest.mark.slow
def test_dask_whose_workers_are_killed_makes_the_same(tmp_path: Path, pool: Executor) -> None:
    """Each worker is killed in between; dask starts new ones and asks them again."""
    ensemble(SCENE, DISORDER, 600, executor=pool, out=tmp_path / "here")
    with dask_cluster(2) as client:
        for worker in client.cluster.workers.values():  # type: ignore[attr-defined]
            pid = worker.process.process.pid
            killer = ThreadPoolExecutor(1)
            killer.submit(lambda pid=pid: (time.sleep(1.0), os.kill(pid, signal.SIGKILL)))
        executor = client.get_executor()  # type: ignore[attr-defined]
        ensemble(SCENE, DISORDER, 600, executor=executor, out=tmp_path / "there")
    assert parts(tmp_path / "here") == parts(tmp_path / "there")


@pytest.mark.slow
def test_workers_of_mpi_make_the_same(tmp_path: Path, pool: Executor) -> None:
    pytest.importorskip("mpi4py", reason="needs the extra mpi")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("no mpiexec on this machine")
    folder = str(tmp_path / "there")
    python = [sys.executable, "-m", "mpi4py.futures"]
    command = [mpiexec, "-n", "3", *python, PROGRAM, folder, "200", "mpi"]
    subprocess.run(command, env=environment(), check=True, timeout=120)
    ensemble(SCENE, DISORDER, 200, seed=3, executor=pool, out=tmp_path / "here")
    assert parts(tmp_path / "here") == parts(tmp_path / "there")


def test_a_folder_that_cannot_be_made_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    with pytest.raises(InputError, match="the folder"):
        ensemble(SCENE, DISORDER, 2, out=file / "inside")
    words = ["nt60", "--layers", "3", "--amplitude", "1", "--samples", "2", "--out", str(file)]
    assert main(["ensemble", *words]) == 1
    assert "the folder is" in capsys.readouterr().err
    assert file.read_text() == "mine"


def test_the_command_makes_reports_and_draws(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "samples"
    words = ["nt60", "--layers", "4", "--amplitude", "10", "--samples", "40", "--out", str(out)]
    assert main(["ensemble", *words, "--workers", "1", "--plot", str(tmp_path / "plots")]) == 0
    made = capsys.readouterr().out
    assert "40, 0 failed" in made
    assert {path.name for path in (tmp_path / "plots").iterdir()} == {
        f"{name}.png"
        for name in ("base_pressure", "closing_map", "correlation", "force_density", "mean_stress")
    }
    assert main(["ensemble", str(out), "--report", "--json", "-"]) == 0
    printed = capsys.readouterr()
    content = json.loads(printed.out)
    assert content["samples"] == 40
    assert content["numbers"]["contacts with force"]["value"] <= 20
    assert printed.err.strip().splitlines()[-1] == made.strip().splitlines()[-1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nt60", "--samples", "3"], "--amplitude is needed"),
        (["nt60", "--amplitude", "-1", "--samples", "3"], "the amplitude is -1"),
        (["nt60", "--amplitude", "1", "--samples", "0"], "not a whole number from 1"),
        (["nt60", "--amplitude", "1", "--samples", "2", "--seed", "-3"], "--seed"),
        (["nt60", "--amplitude", "1", "--samples", "2", "--parquet", "a"], "--out"),
        ([".", "--amplitude", "1", "--samples", "2"], "--report reads one"),
        ([".", "--report", "--samples", "2"], "only reads"),
        (["nowhere", "--report"], "nowhere"),
    ],
)
def test_words_that_make_no_sense(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["ensemble", *words]) in (1, 2)
    assert said in capsys.readouterr().err


def test_samples_as_parquet(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    out, table = tmp_path / "samples", tmp_path / "samples.parquet"
    words = ["nt60", "--layers", "3", "--amplitude", "1", "--samples", "5", "--out", str(out)]
    assert main(["ensemble", *words, "--workers", "1", "--parquet", str(table)]) == 0
    read = parquet.read_table(table).to_pylist()
    assert [row["k"] for row in read] == list(range(5))
    lines = parts(out)["part-00000000.jsonl"].decode().splitlines()
    assert [row["forces"] for row in read] == [json.loads(line)["forces"] for line in lines]


def test_a_scene_without_a_name_is_kept_whole(tmp_path: Path, pool: Executor) -> None:
    scene = replace(SCENE, contacts=SCENE.contacts[::-1])
    ensemble(scene, DISORDER, 3, executor=pool, out=tmp_path)
    assert read_ensemble(tmp_path).manifest.scene == scene
