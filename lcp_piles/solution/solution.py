"""The solution of a scene: forces, gaps, displacements, states and how they were found.

`Solution` is one of three plain types, told apart by `status`: `Solved`, `Unstable` (the proof that
no forces balance the load) and `Unresolved` (nothing is proved). Whoever only handles the first
may read forces at once: the other two answer with a `NotSolvedError` that says what to do.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import ClassVar, Literal, NoReturn

from ..errors import NotSolvedError
from ..numbers.vectors import ExactVector
from ..scenes.scene import Scene
from .describe import brief
from .notebook import page
from .record import Record
from .solved import ContactState as ContactState
from .solved import Solved as Solved
from .solved import Vector as Vector
from .solved import as_floats as as_floats
from .solved import made
from .solved import states_of as states_of

Status = Literal["solved", "unstable", "unresolved"]

_OF_ALL = {"scene", "record", "status", "exact"}
_OF_SOLVED = {
    name
    for name in ({field.name for field in fields(Solved)} | vars(Solved).keys()) - _OF_ALL
    if not name.startswith("_")
}


@dataclass(frozen=True, eq=False, repr=False)
class Unstable:
    """The proof that a scene cannot stand: no forces balance the load.

    To ask for forces raises `NotSolvedError`.

    Attributes
    ----------
    scene : Scene
        The scene.
    record : Record
        How the proof was made.
    collapse : ExactVector, shape (discs * axes,)
        A motion along which the scene gives way (w tau, any scale), exact, one entry a disc and
        axis, flat: it closes no contact, moves nothing that is held, and the load does work on it.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> [str(x) for x in solve(nt60(2).without([(2, 2)])).collapse]
    ['sqrt(3)', '-1', '0', '0']
    """

    scene: Scene
    record: Record
    collapse: ExactVector
    status: ClassVar[Literal["unstable"]] = "unstable"

    @property
    def exact(self) -> bool:
        """Whether the numbers are exact."""
        return self.record.exact

    def __getattr__(self, name: str) -> NoReturn:
        _refuse(self, name, "no forces balance the load: `collapse` is how the scene gives way")

    def __repr__(self) -> str:
        return f"<Unstable {brief(self.scene)}: no forces balance the load; proved>"

    def _repr_html_(self) -> str:
        why = "unstable: no forces balance the load; it gives way as the red discs show"
        rows = [("scene", brief(self.scene)), ("status", why), *made(self.record)]
        return page(self.scene, rows, motion=self.collapse.array())


@dataclass(frozen=True, eq=False, repr=False)
class Unresolved:
    """No answer: the method gave up, and nothing is proved.

    To ask for forces raises `NotSolvedError`.

    Attributes
    ----------
    scene : Scene
        The scene.
    record : Record
        What was tried; `record.proof` says why it was given up.

    Examples
    --------
    >>> from lcp_piles import nt60, solve
    >>> solve(nt60(2).without([(2, 2)]), "newton").status
    'unresolved'
    """

    scene: Scene
    record: Record
    status: ClassVar[Literal["unresolved"]] = "unresolved"

    @property
    def exact(self) -> bool:
        """Whether the arithmetic was exact."""
        return self.record.exact

    def __getattr__(self, name: str) -> NoReturn:
        _refuse(self, name, "`record.proof` says why; another method may have the answer")

    def __repr__(self) -> str:
        return f"<Unresolved {brief(self.scene)}: nothing is proved; method {self.record.method}>"

    def _repr_html_(self) -> str:
        status = "unresolved: nothing is proved"
        return page(
            self.scene,
            [("scene", brief(self.scene)), ("status", status), *made(self.record)],
        )


Solution = Solved | Unstable | Unresolved
"""What `solve` returns: one of three types, told apart by `status`."""


def _refuse(solution: Unstable | Unresolved, name: str, remedy: str) -> NoReturn:
    if name not in _OF_SOLVED:
        raise AttributeError(f"{type(solution).__name__!r} object has no attribute {name!r}")
    expected = f'"solved", to have {name}'
    raise NotSolvedError("the status of the solution", solution.status, expected, remedy)
