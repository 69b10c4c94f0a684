"""Reading a file that may be anything, in bounded time and memory."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO

from ..errors import FileFormatError

MAX_BYTES = 4 * 2**30
MAX_LINE = 2**16


def read_text(path: str | os.PathLike[str]) -> str:
    """The text of a regular file in UTF-8; `FileFormatError` for anything else."""
    with _opened(path) as file:
        size = os.fstat(file.fileno()).st_size
        if size > MAX_BYTES:
            raise FileFormatError("the size of the file", size, f"at most {MAX_BYTES} bytes")
        return file.read(size).decode("utf-8")


def read_lines(path: str | os.PathLike[str]) -> Iterator[tuple[int, str]]:
    """The lines of a regular file in UTF-8 with their numbers, from 1, one at a time.

    The file may have any length, a line may not. `FileFormatError` as for `read_text`.
    """
    with _opened(path) as file:
        number = 0
        while line := file.readline(MAX_LINE + 1):
            number += 1
            if len(line) > MAX_LINE:
                where = f"{os.fspath(path)}, line {number}"
                raise FileFormatError(where, line[:40], f"a line of at most {MAX_LINE} bytes")
            yield number, line.decode("utf-8").rstrip("\r\n")


@contextmanager
def _opened(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """A regular file, open to read.

    Pipes, devices and folders are refused before anything is read of them: a pipe without a writer
    would wait for ever, and a device may have no end.
    """
    try:
        # Opened like this, a pipe does not wait for somebody to write.
        with open(path, "rb", opener=_without_waiting) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise FileFormatError("the file", str(path), "a regular file")
            yield file
    except FileFormatError:
        raise
    except (OSError, ValueError) as error:  # ValueError: bytes or a name that are no text
        raise FileFormatError("the file", str(path), f"a readable text file ({error})") from error


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
