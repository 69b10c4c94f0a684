"""Reading a file that may be anything, in bounded time and memory."""

from __future__ import annotations

import os
import stat

from ..errors import FileFormatError

MAX_BYTES = 4 * 2**30


def read_text(path: str | os.PathLike[str]) -> str:
    """The text of a regular file in UTF-8; `FileFormatError` for anything else.

    Pipes, devices and folders are refused before anything is read of them: a pipe without a writer
    would wait for ever, and a device may have no end.
    """
    try:
        # Opened like this, a pipe does not wait for somebody to write.
        with open(path, "rb", opener=_without_waiting) as file:
            status = os.fstat(file.fileno())
            size = status.st_size if stat.S_ISREG(status.st_mode) else -1
            text = file.read(size).decode("utf-8") if 0 <= size <= MAX_BYTES else ""
    except (OSError, ValueError) as error:  # ValueError: bytes or a name that are no text
        raise FileFormatError("the file", str(path), f"a readable text file ({error})") from error
    if size < 0:
        raise FileFormatError("the file", str(path), "a regular file")
    if size > MAX_BYTES:
        raise FileFormatError("the size of the file", size, f"at most {MAX_BYTES} bytes")
    return text


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
