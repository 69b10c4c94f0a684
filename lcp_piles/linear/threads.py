"""One BLAS thread while we factor and solve: our matrices are narrow bands, and want no more.

On a machine with other work, threads that wait for each other make a factorisation of milliseconds
take minutes. The number of threads belongs to the process, not to a call, so other Python threads
that use BLAS at the same time share the limit.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from threading import Lock
from typing import Any


@cache
def _libraries() -> Any:
    """The BLAS libraries of numpy and scipy, found once: that takes milliseconds."""
    import scipy.linalg.blas  # noqa: F401  loads the one of scipy, so that it is found
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController().select(user_api="blas")


@dataclass(eq=False)
class _Limit:
    """The limit of this process: `limiter` lifts it, and is None while no call of ours is in.

    The lock is held while the threads are counted and set, so that nobody takes our limit for the
    setting of the user.
    """

    lock: Lock = field(default_factory=Lock)
    limiter: Any = None

    def enter(self) -> bool:
        """Set the limit, unless a call of ours is in; whether it was set."""
        with self.lock:
            if self.limiter is not None:
                return False
            self.limiter = _libraries().limit(limits=1)
            self.limiter.__enter__()
            return True

    def leave(self) -> None:
        """Lift the limit; in the Python thread that has set it, no other may."""
        with self.lock:
            self.limiter.__exit__(None, None, None)
            self.limiter = None

    def forked(self) -> None:
        """In a child process none of the parent's calls goes on: start with the user's setting."""
        self.lock = Lock()
        if self.limiter is not None:
            self.limiter.restore_original_limits()
            self.limiter = None


_LIMIT = _Limit()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_LIMIT.forked)


@contextmanager
def one_thread() -> Iterator[None]:
    """Within this context, or a function that it decorates, BLAS uses one thread.

    What the process had set before holds again afterwards. Contexts may be nested. Of several
    Python threads the first one in sets the limit and lifts it when it leaves, for all of them.

    >>> with one_thread():
    ...     pass
    """
    mine = _LIMIT.enter()
    try:
        yield
    finally:
        if mine:
            _LIMIT.leave()
