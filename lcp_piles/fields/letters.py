"""The paper's letters for the contacts of a disc.

A letter is a direction from the disc's centre. On the tilted lattice a, b, c, d, e, f are at 30,
90, 150, 210, 270 and 330 degrees, on the untilted one at 0, 60, 120, 180, 240 and 300 degrees with
p at 270 degrees for the floor. (The paper's text fixes the tilted ones and the order; that the
untilted ones start at 0 degrees is our reading.) Which lattice a scene has is read from its
normals.
"""

from __future__ import annotations

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Surd, sqrt_of, surd
from ..scenes.names import DiscId, end_name
from ..scenes.scene import Scene
from ..solution.solution import Solution
from .disc_contacts import Direction, Number, disc_contacts, plane_forces
from .field import Column, Field, Table

ContactName = tuple[DiscId, DiscId | str]

_TILTED = {"a": 30, "b": 90, "c": 150, "d": 210, "e": 270, "f": 330}
_UNTILTED = {"a": 0, "b": 60, "c": 120, "d": 180, "e": 240, "f": 300, "p": 270}
_COSINE = {0: ONE, 30: sqrt_of(3) / 2, 60: surd("1/2"), 90: ZERO}


def contact_by_letter(scene: Scene, disc: DiscId, letter: str) -> ContactName | None:
    """The contact that one of the paper's letters names on a disc.

    Parameters
    ----------
    scene : Scene
        A scene on one of the two lattices.
    disc : int, str or tuple
        The id of the disc.
    letter : str
        A letter of the lattice.

    Returns
    -------
    tuple of int, str or tuple, shape (2,), or None
        The ends (a, b) of the scene's contact: the disc is either of them. None where it has no
        such contact.

    Raises
    ------
    InputError
        For an unknown disc, a letter that the lattice has not, and a scene on neither lattice.

    Examples
    --------
    >>> from lcp_piles import tss
    >>> pile = tss(5)
    >>> contact_by_letter(pile, (2, 1), "e"), contact_by_letter(pile, (2, 1), "b")
    (((2, 1), (4, 2)), None)
    >>> contact_by_letter(pile, (2, 1), "a"), contact_by_letter(pile, (5, 2), "e")
    (((1, 1), (2, 1)), ((5, 2), 'floor'))
    """
    directions = letter_directions(scene)
    if letter not in directions:
        raise InputError("the letter", letter, "one of " + ", ".join(directions))
    for found in disc_contacts(scene, disc):
        if found.direction == directions[letter]:
            contact = scene.contacts[found.index]
            return contact.a, contact.b
    return None


def letter_force(solution: Solution, disc: DiscId, letter: str) -> Number | None:
    """The force of the contact that one of the paper's letters names on a disc.

    Parameters
    ----------
    solution : Solved
        A solution of a scene on one of the two lattices.
    disc : int, str or tuple
        The id of the disc.
    letter : str
        A letter of the lattice.

    Returns
    -------
    Surd, float or None
        The force (w), a Surd for exact solutions, else a float; zero for a contact that is open,
        and None where there is no such contact.

    Raises
    ------
    InputError
        As of `contact_by_letter`; `NotSolvedError` where the solution has no forces.

    Examples
    --------
    >>> from lcp_piles import solve, tss
    >>> pile = solve(tss(6))
    >>> letter_force(pile, (2, 1), "e") + letter_force(pile, (2, 1), "f")
    Surd('1')
    """
    forces = plane_forces(solution)
    contact = contact_by_letter(solution.scene, disc, letter)
    if contact is None:
        return None
    force: Number = forces[solution.contact_index(*contact)]
    return force


def letter_forces(solution: Solution) -> dict[DiscId, dict[str, Number]]:
    """The forces (w) on every disc by the letters of its contacts.

    >>> from lcp_piles import nt60, solve
    >>> {letter: str(force) for letter, force in letter_forces(solve(nt60(2)))[(1, 1)].items()}
    {'e': '1/3*sqrt(3)', 'f': '1/3*sqrt(3)'}
    """
    forces = plane_forces(solution)
    scene = solution.scene
    letters = {direction: letter for letter, direction in letter_directions(scene).items()}
    return {
        disc.id: {
            letters[c.direction]: forces[c.index]
            for c in disc_contacts(scene, disc.id)
            if c.direction in letters
        }
        for disc in scene.discs
    }


def letter_directions(scene: Scene) -> dict[str, Direction]:
    """The unit vector from a disc's centre to its contact, for each letter of the scene's lattice.

    Raises `InputError` for a scene whose disc-disc contacts are on neither of the two lattices.
    """
    normals, which = scene.normals
    between_discs = {normals[k] for k in which[scene.ends[1] >= 0].tolist()}
    for angles in (_TILTED, _UNTILTED):
        lattice = {_unit(angle) for letter, angle in angles.items() if letter != "p"}
        if between_discs and between_discs <= lattice:
            return {letter: _unit(angle) for letter, angle in angles.items()}
    shown = sorted(f"({', '.join(map(str, n))})" for n in between_discs)
    raise InputError(
        "the set of normals",
        "; ".join(shown),
        "those of one triangular lattice, tilted or untilted",
    )


def _unit(degrees: int) -> Direction:
    """(cos, sin) of a multiple of 30 degrees."""
    return _cosine(degrees), _cosine(degrees - 90)


def _cosine(degrees: int) -> Surd:
    turned = degrees % 360
    turned = min(turned, 360 - turned)
    return _COSINE[turned] if turned <= 90 else -_COSINE[180 - turned]


def _table(found: dict[DiscId, dict[str, Number]]) -> Table:
    letters = sorted({letter for forces in found.values() for letter in forces})
    columns = (Column("disc"), *(Column(letter, exact=True) for letter in letters))
    rows = [
        [end_name(disc), *(forces.get(letter) for letter in letters)]
        for disc, forces in found.items()
    ]
    return Table(columns, rows)


FIELD = Field("letters", "forces by the paper's letters (w)", letter_forces, _table, None)
