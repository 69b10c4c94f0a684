"""Writing files: nothing that stood there is lost, and nothing is left behind."""

import os
import signal
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from lcp_piles import InputError, load, nt60, save, solve
from lcp_piles.files import safe_write
from lcp_piles.files.safe_write import write_text


@pytest.fixture(autouse=True)
def _umask():
    before = os.umask(0o022)
    yield
    os.umask(before)


@pytest.fixture(params=["nameless", "named"], autouse=True)
def _system(request, monkeypatch):
    """With nameless files, and as on a system that has none."""
    if request.param == "named":
        monkeypatch.setattr(safe_write, "_nameless", lambda folder: None)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@pytest.mark.parametrize(("umask", "expected"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_a_new_file_has_the_mode_that_the_umask_gives(tmp_path, umask, expected):
    os.umask(umask)
    write_text(tmp_path / "new", "text")
    assert mode(tmp_path / "new") == expected


@pytest.mark.parametrize("had", [0o600, 0o640, 0o666, 0o755])
def test_a_file_keeps_its_mode(tmp_path, had):
    file = tmp_path / "there"
    file.write_text("old")
    file.chmod(had)
    write_text(file, "new")
    assert (file.read_text(), mode(file)) == ("new", had)


def test_a_file_that_nobody_may_write_is_refused_and_stays(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a long path is cut in the message
    file = Path("locked")
    file.write_text("old")
    file.chmod(0o444)
    with pytest.raises(InputError, match=r"file to write is 'locked'.*mode is 0444"):
        write_text(file, "new")
    assert (file.read_text(), mode(file)) == ("old", 0o444)
    assert os.listdir(tmp_path) == ["locked"]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may write what belongs to others")
def test_a_file_of_another_owner_stays_theirs(tmp_path):
    file = tmp_path / "theirs"
    file.write_text("old")
    os.chown(file, 1234, 5678)
    write_text(file, "new")
    assert (file.stat().st_uid, file.stat().st_gid) == (1234, 5678)
    assert file.read_text() == "new"


@pytest.mark.parametrize("there", [True, False])
def test_a_symbolic_link_is_followed(tmp_path, there):
    (tmp_path / "far").mkdir()
    target = tmp_path / "far" / "file"
    if there:
        target.write_text("old")
    link = tmp_path / "link"
    link.symlink_to(Path("far") / "file")
    write_text(link, "new")
    assert link.is_symlink()
    assert target.read_text() == "new"
    assert sorted(os.listdir(tmp_path)) == ["far", "link"]
    assert os.listdir(tmp_path / "far") == ["file"]


@pytest.mark.parametrize(("old", "new"), [("long before", "new"), ("", "longer"), ("x", "")])
def test_hard_links_stay_one_file(tmp_path, old, new):
    one, two = tmp_path / "one", tmp_path / "two"
    one.write_text(old)
    one.chmod(0o640)
    two.hardlink_to(one)
    write_text(one, new)
    assert two.read_text() == new
    assert one.samefile(two)
    assert mode(two) == 0o640
    assert sorted(os.listdir(tmp_path)) == ["one", "two"]


def test_a_hard_link_that_cannot_be_written_whole_gets_its_old_text_back(tmp_path, monkeypatch):
    """The disk is full after the first bytes of the new text."""
    one, two = tmp_path / "one", tmp_path / "two"
    one.write_text("old text")
    two.hardlink_to(one)
    fill = safe_write._fill

    def full(handle: int, data: bytes) -> None:
        if data.startswith(b"new"):
            fill(handle, data[:3])
            raise OSError(28, "No space left on device")
        fill(handle, data)

    monkeypatch.setattr(safe_write, "_fill", full)
    with pytest.raises(InputError, match="No space left"):
        write_text(one, "new text")
    assert two.read_text() == "old text"
    assert sorted(os.listdir(tmp_path)) == ["one", "two"]


def test_a_full_disk_leaves_the_old_file(tmp_path, monkeypatch):
    file = tmp_path / "file"
    file.write_text("old")

    def full(handle: int, data: bytes) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(safe_write, "_fill", full)
    with pytest.raises(InputError, match="No space left"):
        write_text(file, "new")
    assert file.read_text() == "old"
    assert os.listdir(tmp_path) == ["file"]


@pytest.mark.parametrize("length", [250, 255])
def test_the_longest_names_can_be_written(tmp_path, length):
    file = tmp_path / ("n" * length)
    for text in ("one", "two"):
        write_text(file, text)
        assert file.read_text() == text
    assert os.listdir(tmp_path) == [file.name]


@pytest.mark.parametrize(
    "path", ["{}/nowhere/file", "{}", "{}/file\0", "{}/" + "n" * 300, "{}/loop", "/dev/full"]
)
def test_what_cannot_be_written_is_named(tmp_path, path):
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(InputError, match=r"the file to write is .* expected a writable path"):
        write_text(path.format(tmp_path), "text")
    assert os.listdir(tmp_path) == ["loop"]


def test_devices_are_written_to():
    write_text(os.devnull, "text")
    assert not Path(os.devnull).is_file()


def test_a_pipe_is_written_to(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    program = ["cat", str(tmp_path / "pipe")]
    with subprocess.Popen(program, stdout=subprocess.PIPE) as reader:
        write_text(tmp_path / "pipe", "text")
        assert reader.communicate(timeout=10)[0] == b"text"
    assert stat.S_ISFIFO((tmp_path / "pipe").stat().st_mode)


STOPPED = """
import os, signal, sys
from lcp_piles.files.safe_write import write_text
os.fsync = lambda handle: os.kill(os.getpid(), signal.SIGTERM)  # while the file is filled
write_text(sys.argv[1], "new text")
"""

STOPPED_LATER = """
import os, signal, sys
from lcp_piles.files.safe_write import write_text
synced = []
def stop(handle):
    synced.append(handle)
    if len(synced) == 2:  # the copy is whole, and the file is filled
        os.kill(os.getpid(), signal.SIGTERM)
os.fsync = stop
write_text(sys.argv[1], "new text")
"""


@pytest.mark.skipif(not hasattr(os, "O_TMPFILE"), reason="no nameless files here")
@pytest.mark.parametrize("there", [True, False])
def test_a_program_that_is_stopped_leaves_nothing_behind(tmp_path, there):
    file = tmp_path / "file"
    if there:
        file.write_text("old")
    run = subprocess.run([sys.executable, "-c", STOPPED, str(file)], check=False)
    assert run.returncode == -signal.SIGTERM
    assert os.listdir(tmp_path) == (["file"] if there else [])
    assert not there or file.read_text() == "old"


def test_a_program_that_is_stopped_between_hard_links_leaves_the_old_text(tmp_path):
    """Nobody can put it back then: it stands beside, whole."""
    one, two = tmp_path / "one", tmp_path / "two"
    one.write_text("old")
    two.hardlink_to(one)
    run = subprocess.run([sys.executable, "-c", STOPPED_LATER, str(one)], check=False)
    assert run.returncode == -signal.SIGTERM
    (copy,) = set(os.listdir(tmp_path)) - {"one", "two"}
    assert (tmp_path / copy).read_text() == "old"
    assert mode(tmp_path / copy) == 0o600


def test_results_are_saved_like_this(tmp_path):
    file = tmp_path / ("n" * 250)
    os.umask(0o077)
    solution = solve(nt60(3))
    save(solution, file)
    assert mode(file) == 0o600
    assert list(load(file).forces) == list(solution.forces)
