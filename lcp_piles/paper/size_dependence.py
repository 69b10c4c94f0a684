"""How the forces on one disc depend on the size of the pile (the paper: a, d, e, f of (2, 1))."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..fields.disc_contacts import Number
from ..fields.letters import ContactName, contact_by_letter, letter_force
from ..numbers.exact import Exact
from ..scenes.kinds import pile
from ..scenes.names import DiscId
from ..solution.solution import ContactState, Status
from ..solve import solve


@dataclass(frozen=True, slots=True)
class SizeRecord:
    """One force at one size.

    `contact` is None where the disc has no contact of this letter, and then `force` and `state` are
    None too; they are also None where the pile is not "solved" (see `status`).
    """

    layers: int
    disc: DiscId
    letter: str
    status: Status
    contact: ContactName | None
    force: Number | None
    state: ContactState | None


def size_dependence(
    kind: str,
    disc: DiscId,
    letters: Iterable[str],
    layers: Iterable[int],
    *,
    method: str = "lemke",
    **parameters: Exact,
) -> Iterator[SizeRecord]:
    """The forces that the paper's letters name on a disc, for one size of the pile after the other.

    Parameters
    ----------
    kind : str
        The name of the kind, as for `pile`.
    disc : int, str or tuple
        The id of the disc.
    letters : iterable of str
        The letters, as for `letter_force`.
    layers : iterable of int
        The sizes.
    method : str, default "lemke"
        That of `solve`.
    **parameters : exact number or str
        What else the builder of the kind takes, as for `pile`.

    Yields
    ------
    SizeRecord
        The `force` (w) for each size and letter, as soon as that size is solved: a Surd for exact
        methods. None where the disc has no contact of this letter, or the pile is not solved.

    Raises
    ------
    InputError
        As `pile`, `solve` and `contact_by_letter` do.

    Examples
    --------
    >>> [(r.layers, str(r.force)) for r in size_dependence("tbs", (2, 1), "e", [2, 3, 4])]
    [(2, '9/13'), (3, '1'), (4, '1323/1523')]
    """
    wanted = tuple(letters)
    for count in layers:
        solution = solve(pile(kind, count, **parameters), method)
        solved = solution.status == "solved"
        for letter in wanted:
            contact = contact_by_letter(solution.scene, disc, letter)
            known = solved and contact is not None
            yield SizeRecord(
                count,
                disc,
                letter,
                solution.status,
                contact,
                letter_force(solution, disc, letter) if known else None,
                solution.state(*contact) if contact is not None and solved else None,
            )
