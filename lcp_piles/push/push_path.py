"""The pushed corner stones: the paper's continuation in q, section "The effect of displacing".

`push` is the distance by which both corner stones are moved towards the axis, in w tau; the paper's
q is -push. On the line of scenes the parameter is t with push = start + unit t, where the unit is
that of the kind's `Push` (or minus that, for pulling): sqrt(3) for the piles of the paper, whose
gauge makes multiples of it rational.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from time import perf_counter

from ..errors import InputError
from ..mechanics.system import with_loads_of
from ..numbers.exact import ZERO, Exact, Surd, surd
from ..scenes.kind import Push, has_unique_forces, origin_of
from ..scenes.kinds import KINDS, kind_named, pile
from ..scenes.names import DiscId
from ..scenes.scene import Contact, Scene
from ..solution.describe import brief
from ..solution.finish import finished, timed
from ..solution.record import make_record
from ..solution.solution import Solution
from .continuation import continuation
from .path import End, Path, Segment


@dataclass(frozen=True)
class Rearrangement:
    """A push at which the contact network changes, and the contacts that open and close there."""

    push: Surd
    opens: tuple[Contact, ...]
    closes: tuple[Contact, ...]


@dataclass(frozen=True, eq=False, repr=False)
class PushPath:
    """All solutions of one pile from a start push on, in one direction.

    `scene` is the pile at the start and `unit` the push that one unit of the path's t is (negative
    for pulling). `end` says how the path ended (see `path.Path`).
    """

    scene: Scene
    unit: Surd
    path: Path

    def __repr__(self) -> str:
        way = "pushed" if self.unit > 0 else "pulled"
        return f"<PushPath {brief(self.scene)}, {way}: {self.path.summary}>"

    @property
    def start(self) -> Surd:
        """The push where the path starts."""
        origin = origin_of(self.scene)
        return surd(dict(origin.parameters)[_push_of(origin.kind.name).parameter])

    @property
    def end(self) -> End:
        """How it ended: see `path.Path`."""
        return self.path.end

    @cached_property
    def rearrangements(self) -> tuple[Rearrangement, ...]:
        """Every change of the contact network, in the order of the path."""
        contacts = self.scene.contacts
        return tuple(
            Rearrangement(
                self.start + b.t * self.unit,
                tuple(contacts[k] for k in b.opens),
                tuple(contacts[k] for k in b.closes),
            )
            for b in self.path.breakpoints
        )

    def segment(self, push: Exact) -> Segment:
        """The piece of the path that holds a push."""
        return self.path.segment(self._t(push))

    def force(self, a: DiscId, b: DiscId | str, push: Exact) -> Surd:
        """The force (w) of a contact at a push, evaluated from the piece that holds it."""
        t = self._t(push)
        constant, slope = self.path.segment(t).linear_force(self._contact(a, b))
        return constant + slope * t

    def linear_force(self, a: DiscId, b: DiscId | str, push: Exact) -> tuple[Surd, Surd]:
        """(c, s): around this push the force of a contact is c + s * push."""
        constant, slope = self.segment(push).linear_force(self._contact(a, b))
        per_push = slope / self.unit
        return constant - per_push * self.start, per_push

    def solution(self, push: Exact) -> Solution:
        """The verified solution of the whole pile at a push of the path, without solving again."""
        begin = perf_counter()
        origin = origin_of(self.scene)
        scene = origin.scene(**{_push_of(origin.kind.name).parameter: surd(push)})
        t = self._t(push)
        segment = self.path.segment(t)
        system = with_loads_of(segment.system, scene)
        proof = "exact continuation, verified"
        record = make_record(system, "continuation", "exact", self.path.pivots, proof)
        return timed(finished(system, segment.state(t), record), begin)

    @cached_property
    def asymptotic(self) -> Segment:
        """The last piece; it goes on for ever where `end` is "asymptotic"."""
        return self.path.segments[-1]

    def _t(self, push: Exact) -> Surd:
        return (surd(push) - self.start) / self.unit

    def _contact(self, a: DiscId, b: DiscId | str) -> int:
        for k, contact in enumerate(self.scene.contacts):
            if (contact.a, contact.b) in ((a, b), (b, a)):
                return k
        raise InputError("the contact", (a, b), "a contact of the scene")


def push_path(
    kind: str,
    layers: int,
    *,
    start: Exact = 0,
    until: Exact | None = None,
    pull: bool = False,
    progress: Callable[[str], None] | None = None,
    **parameters: Exact,
) -> PushPath:
    """Push (or pull) the corner stones of a pile from `start` on, through every rearrangement.

    Parameters
    ----------
    kind : str
        The name of a kind that can be pushed: "nt30", "nt60" or "tss".
    layers : int
        The rows of discs.
    start : exact number, default 0
        The push to begin at (w tau).
    until : exact number, optional
        The push to stop at (w tau), below `start` for pulling; without it the path ends at the
        network that no longer changes.
    pull : bool, default False
        Whether to pull.
    progress : callable, optional
        Called with a line of text now and then.
    **parameters : exact number or str
        Those of the pile (`floor_compliance`, `corner_stones`).

    Returns
    -------
    PushPath
        The `rearrangements`, and the force of every contact at every push.

    Raises
    ------
    InputError
        For a kind that cannot be pushed, and parameters that are none of these.
    SolveError
        Where the pile does not stand at the start.

    Examples
    --------
    >>> path = push_path("nt30", 2)
    >>> [(str(r.push), [c.a for c in r.closes]) for r in path.rearrangements]
    [('1/6*sqrt(3)', [(2, 2)])]
    >>> path.force((1, 1), (2, 2), 100) == path.force((1, 1), (2, 3), 100)
    True
    """
    pushed = _push_of(kind)
    first = surd(start)
    last = None if until is None else surd(until)
    unit = pushed.unit
    if pull or (last is not None and last < first):
        unit = -unit
    scene = pile(kind, layers, **parameters, **{pushed.parameter: first})
    towards = origin_of(scene).scene(**{pushed.parameter: first + unit})
    limit = None if last is None else (last - first) / unit
    if limit is not None and limit < ZERO:
        raise InputError("until", str(last), f"a push below the start {first}, for pulling")
    return PushPath(scene, unit, continuation(scene, towards, until=limit, progress=progress))


def _push_of(kind: str) -> Push:
    """What pushing means for a kind; `InputError` where it means nothing."""
    push = kind_named(kind).push
    if push is None:
        able = ", ".join(other.name for other in KINDS.values() if other.push)
        raise InputError("the kind of pile", kind, f"one that can be pushed: {able}")
    return push


def promise(scene: Scene) -> str:
    """What is and what is not promised about the path, in one sentence."""
    if scene.definite:
        return "forces exist and are unique at every push, so this is the only path"
    held = (
        "negative compliance: the floor contacts are held closed and every state on the path "
        "solves the scene exactly"
    )
    if has_unique_forces(scene):
        return (
            held + "; forces are unique here (notes/paper.md, section 2), so this is the only path"
        )
    return held + ", but other solutions may exist and the path may turn back"


def force_curve(path: PushPath, contacts: list[int]) -> tuple[list[Surd], list[list[Surd]]]:
    """Pushes, and the forces (w) of some contacts there: the corners of exact broken lines.

    The corners are the ends of the pieces; an endless last piece is shown for a tenth of the way.
    """
    pieces = path.path.segments
    corners = [piece.first for piece in pieces]
    last = pieces[-1].last
    corners.append(last if last is not None else corners[-1] * Fraction(11, 10) + 1)
    rows = []
    for t, piece in zip(corners, [*pieces, pieces[-1]], strict=True):
        forces = piece.forces(t)
        rows.append([forces[k] for k in contacts])
    curves = [list(column) for column in zip(*rows, strict=True)]
    return [path.start + t * path.unit for t in corners], curves
