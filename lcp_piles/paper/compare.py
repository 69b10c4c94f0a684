"""Lemke's method and the Z algorithm of the paper on the same piles, size by size, both exact."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from time import perf_counter
from typing import Literal

from ..mechanics.system import contact_system
from ..methods.z.z_algorithm import z_algorithm
from ..methods.z.z_iteration import ZStatus
from ..numbers.exact import Exact
from ..scenes.kinds import pile
from ..scenes.names import DiscId
from ..solution.solution import ContactState, Solved, Status
from ..solve import solve

Reason = Literal["osculatory contact kept", "osculatory contact dropped", "mechanism", "other"]


@dataclass(frozen=True)
class Difference:
    """A contact between a and b on which the raw contact sets of the two methods may differ.

    `state` is that of the optimal partition in Lemke's solution, `kept` says whether Z holds the
    contact closed. Reasons: an osculatory contact carries nothing, so either set is right, and Z
    kept it in its set or dropped it; where a mechanism moves the contact, its gap is not unique,
    and Z ended in a state in which it happens to touch; anything else ("other") is a
    disagreement of the two methods.
    """

    a: DiscId
    b: DiscId | str
    state: ContactState
    kept: bool
    reason: Reason


@dataclass(frozen=True)
class Comparison:
    """Both methods on one pile.

    `pivots` are Lemke's, `iterations` the systems that Z solved, `reintroductions` the contacts
    that it had to put back, `singular` its singular but solvable systems, `cycle` the length of the
    cycle it ended in (0: none). `contacts` counts those of the whole pile.

    `differences` lists where the contacts with force in Lemke's solution are not those outside Z at
    its end, and every osculatory contact, which the two sets may treat either way; one contact of
    each mirror pair, none where a method did not solve the pile. `states_equal` compares the
    optimal partitions of the two solutions, `forces_equal` their forces, exactly; None without two
    solutions.
    """

    kind: str
    layers: int
    contacts: int
    lemke_status: Status
    z_status: ZStatus
    pivots: int
    iterations: int
    reintroductions: int
    singular: int
    cycle: int
    differences: tuple[Difference, ...]
    states_equal: bool | None
    forces_equal: bool | None
    lemke_seconds: float
    z_seconds: float

    @property
    def equal(self) -> bool | None:
        """Whether the raw contact sets are the same; None without two solutions."""
        return None if self.states_equal is None else not self.differences


def compare(kind: str, layers: Iterable[int], **parameters: Exact) -> list[Comparison]:
    """Solve piles of one kind by Lemke's method and by the Z algorithm.

    Parameters
    ----------
    kind : str
        The name of the kind, as for `pile`.
    layers : iterable of int
        The sizes.
    **parameters : exact number or str
        What else the builder of the kind takes, as for `pile`.

    Returns
    -------
    list of Comparison
        A record a size: pivots, iterations, and where the two differ.

    Raises
    ------
    InputError
        As `pile` does.

    Examples
    --------
    >>> [(c.layers, c.equal, c.pivots, c.iterations) for c in compare("tbs", [2, 3])]
    [(2, True, 0, 1), (3, True, 2, 2)]
    """
    return [_comparison(kind, N, parameters) for N in layers]


def _comparison(kind: str, layers: int, parameters: dict[str, Exact]) -> Comparison:
    scene = pile(kind, layers, **parameters)
    by_lemke = solve(scene, "lemke")
    clock = perf_counter()
    by_z = z_algorithm(scene)
    seconds = perf_counter() - clock
    differences: tuple[Difference, ...] = ()
    states_equal = forces_equal = None
    solution = by_z.solution
    if by_lemke.status == "solved" and solution.status == "solved":
        differences = _differences(by_lemke, by_z.Z)
        states_equal = by_lemke.states == solution.states
        forces_equal = list(by_lemke.forces) == list(solution.forces)
    return Comparison(
        kind=kind,
        layers=layers,
        contacts=len(scene.contacts),
        lemke_status=by_lemke.status,
        z_status=by_z.status,
        pivots=by_lemke.record.pivots,
        iterations=len(by_z.trace),
        reintroductions=by_z.reintroductions,
        singular=by_z.singular,
        cycle=len(by_z.cycle),
        differences=differences,
        states_equal=states_equal,
        forces_equal=forces_equal,
        lemke_seconds=by_lemke.record.seconds,
        z_seconds=seconds,
    )


def _differences(solution: Solved, Z: Iterable[int]) -> tuple[Difference, ...]:
    """Where the contacts with force are not those outside Z; one contact of each mirror pair."""
    scene = solution.scene
    removed = set(Z)
    found = []
    for k in contact_system(scene).reduction.representative.tolist():
        contact, state, kept = scene.contacts[k], solution.states[k], k not in removed
        reason: Reason = "other"
        if contact.bilateral:
            continue
        if state == "osculatory":
            reason = "osculatory contact kept" if kept else "osculatory contact dropped"
        elif kept == (state == "closed"):
            continue
        elif kept and not solution.gap_unique[k]:
            reason = "mechanism"
        found.append(Difference(contact.a, contact.b, state, kept, reason))
    return tuple(found)
