"""Writing a file so that nothing is lost: neither what stood there nor whose it was.

A new file is made without a name, filled, and only then put in its place, with the mode that the
umask gives or that the file in that place had. So it is there whole or not at all, and a program
that is stopped while it writes leaves nothing behind (but for the instant between two calls of the
system; where there are no nameless files, a hidden one). Two kinds of file cannot be exchanged for
another: one that has several names (hard links), and one whose owner a new file cannot be given.
These are written over where they stand, with a copy beside them until that is done: if the program
is stopped meanwhile, the copy stays.

A symbolic link is followed, and what is not a file of a disk (a pipe, /dev/null) is written to.
"""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path
from secrets import token_hex

from ..errors import InputError

_ANY_WRITER = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)


def check_ending(path: str | os.PathLike[str], ending: str) -> None:
    """`InputError` for a name with another ending than that of its format; none at all may be.

    Nobody is to find one format under the name of another.
    """
    found = os.path.splitext(os.fspath(path))[1]
    if found and found.lower() != ending:
        remedy = "`export` and `solve --out` write other formats"
        raise InputError("the file to write", str(path), f"a name that ends in {ending}", remedy)


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a text file in UTF-8, as `write_bytes` does."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: str | os.PathLike[str], data: bytes) -> None:
    """Write a file; `InputError` where the path cannot be written.

    A file that nobody has the permission to write is refused, even to those who need none.
    """
    try:
        there = _status(path)
        if there is not None and not stat.S_ISREG(there.st_mode):
            Path(path).write_bytes(data)
            return
        if there is not None and not (there.st_mode & _ANY_WRITER and os.access(path, os.W_OK)):
            raise PermissionError(f"its mode is {stat.S_IMODE(there.st_mode):04o}")
        target = Path(os.path.realpath(path))
        if there is None:
            _put_in_place(target, data, None)
        elif there.st_nlink == 1 and _may_be_given(there):
            owner = (there.st_uid, there.st_gid)
            _put_in_place(target, data, stat.S_IMODE(there.st_mode), owner)
        else:
            _write_over(target, data)
    except (OSError, ValueError) as error:  # ValueError: a name that no file can have
        raise InputError("the file to write", str(path), f"a writable path ({error})") from error


def _status(path: str | os.PathLike[str]) -> os.stat_result | None:
    try:
        return os.stat(path)
    except FileNotFoundError:
        return None


def _may_be_given(there: os.stat_result) -> bool:
    """Whether a new file can have the owner of this one."""
    if not hasattr(os, "geteuid") or os.geteuid() == 0:
        return True
    return (there.st_uid, there.st_gid) == (os.geteuid(), os.getegid())


def _beside(target: Path, ending: str = "") -> Path:
    """A name for what stands beside the file for a while: short, whatever its own."""
    return target.with_name(f".lcp-piles-{token_hex(8)}{ending}")


def _put_in_place(
    target: Path, data: bytes, mode: int | None, owner: tuple[int, int] | None = None
) -> None:
    """A new file of this name, with the mode (None: what the umask gives) and the owner."""
    name = _beside(target)
    nameless = _nameless(target.parent)
    handle = os.open(name, _NEW, 0o666) if nameless is None else nameless
    try:
        try:
            if owner is not None and hasattr(os, "fchown"):
                os.fchown(handle, *owner)
            if mode is not None and hasattr(os, "fchmod"):
                os.fchmod(handle, mode)
            _fill(handle, data)
            if nameless is not None:
                # Python follows the link that /proc has only where it is told a folder.
                os.link(f"/proc/self/fd/{handle}", name, src_dir_fd=handle)
        finally:
            os.close(handle)
        os.replace(name, target)
    except BaseException:
        name.unlink(missing_ok=True)
        raise


def _nameless(folder: Path) -> int | None:
    """A new file without a name, None where the system has no such files."""
    flag = getattr(os, "O_TMPFILE", None)
    if flag is None or not os.path.isdir("/proc/self/fd"):
        return None
    with suppress(OSError):
        return os.open(folder, os.O_WRONLY | flag, 0o666)
    return None


def _write_over(target: Path, data: bytes) -> None:
    """The same file with other content; the old one is kept beside it meanwhile."""
    old = target.read_bytes()
    copy = _beside(target, ".backup")
    _put_in_place(copy, old, 0o600)
    with target.open("r+b", buffering=0) as file:
        try:
            _fill(file.fileno(), data)
        except BaseException:
            _fill(file.fileno(), old)  # where this fails too, the copy stays
            copy.unlink()
            raise
    copy.unlink()


def _fill(handle: int, data: bytes) -> None:
    """Make this the whole content of an open file, on the disk."""
    os.lseek(handle, 0, os.SEEK_SET)
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]
    os.ftruncate(handle, len(data))
    os.fsync(handle)


def sync_folder(folder: str | os.PathLike[str]) -> None:
    """Make sure that the names in a folder are on the disk, where the system can do that."""
    if not hasattr(os, "O_DIRECTORY"):
        return
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def make_folder(path: str | os.PathLike[str]) -> Path:
    """The folder of this name, made if it is not there; `InputError` where it cannot be made."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:  # ValueError: a name that no folder can have
        raise InputError("the folder", str(path), f"one that can be made ({error})") from error
    return folder
