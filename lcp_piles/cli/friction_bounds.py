"""The bounds of all contacts under friction, with a bar that says how far they are."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack

from ..friction.force_bounds import ContactBounds, contact_bounds
from ..numbers.exact import Surd
from ..scenes.scene import Scene
from .output import Narrator


def bounds_with_bar(
    narrate: Narrator, scene: Scene, mu: Surd, rough: Sequence[str], jobs: int = 1
) -> ContactBounds:
    """`contact_bounds`, shared by so many processes."""
    with ExitStack() as stack:
        executor = None
        if jobs > 1:
            executor = ProcessPoolExecutor(jobs)
            stack.callback(executor.shutdown, cancel_futures=True)  # whoever stops it waits less
        bar = stack.enter_context(narrate.bar("contact"))

        def progress(done: int, total: int) -> None:
            bar.total = total
            bar.update(done - bar.n)

        return contact_bounds(scene, mu, rough, executor=executor, progress=progress)
