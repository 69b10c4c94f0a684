"""One parent at a time: a lock on a folder that ends with its process, however that ends."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import SolveError

FILE = "lock"


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Within this context no other process can have the folder; `SolveError` if one has it."""
    handle = os.open(folder / FILE, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        try:
            _lock(handle)
        except OSError as error:
            raise SolveError(
                f"another process works on {folder}: wait until it ends, or take another folder"
            ) from error
        yield
    finally:
        os.close(handle)  # which unlocks


def _lock(handle: int) -> None:
    """Lock an open file for this process; its children do not inherit that."""
    try:
        import fcntl
    except ImportError:  # Windows
        import msvcrt

        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
    else:
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
