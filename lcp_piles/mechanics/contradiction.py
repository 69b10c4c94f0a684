"""Rigid contacts that contradict each other: no displacements fit, and a stress that proves it.

A contact without compliance can neither overlap nor, where it is held closed, open. Forces sigma of
such contacts that are in balance at every freedom, and pull at none that may open, do no work on
displacements that are free: sigma . g = sigma . o with o the initial gaps, prescribed displacements
included. Where that is negative, no gaps g >= 0 exist (Farkas; formulation notes, section 6).
"""

from __future__ import annotations

from collections.abc import Iterator

from flint import fmpz

from ..errors import SolveError, VerificationError
from ..numbers.exact import ZERO, Surd
from ..numbers.vectors import ExactVector
from ..scenes.names import contact_name, end_name
from ..scenes.scene import Scene
from .loads_and_gaps import initial_gaps
from .system import ContactSystem

_SHOWN = 4


class ContradictionError(SolveError):
    """No displacements fit a scene, whatever its loads: its rigid contacts contradict each other.

    Parameters
    ----------
    message : str
        What is said.
    stress : ExactVector
        The proof.

    Attributes
    ----------
    stress : ExactVector, shape (contacts,)
        Forces (any scale) that prove it: at rigid contacts only, pulling at none that may open, in
        balance at every freedom, and doing negative work on the initial gaps; see `stress_faults`.

    Examples
    --------
    >>> from lcp_piles import Contact, ContradictionError, Disc, Scene, solve
    >>> disc = Disc(1, (0, 0), (0, -1), (0, None))
    >>> floor = Contact(1, "floor", (0, 1), compliance=0, gap=-1)
    >>> ceiling = Contact(1, "ceiling", (0, -1), compliance=0)
    >>> try:
    ...     solve(Scene([disc], [floor, ceiling], ("floor", "ceiling")))
    ... except ContradictionError as error:
    ...     print([str(x) for x in error.stress])
    ['1', '1']
    """

    def __init__(self, message: str, stress: ExactVector) -> None:
        super().__init__(message)
        self.stress = stress

    def __reduce__(self) -> tuple[type[ContradictionError], tuple[str, ExactVector]]:
        return ContradictionError, (str(self), self.stress)


def contradiction(system: ContactSystem, stress: list[fmpz]) -> ContradictionError:
    """The error that a stress of the contacts of a system proves, checked on the scene."""
    scene = system.scene
    whole = system.whole_forces(ExactVector({1: stress}, fmpz(1)))
    faults = list(stress_faults(scene, whole))
    if faults:
        raise VerificationError("the contradiction fails its own check: " + "; ".join(faults))
    pairs = zip(scene.contacts, whole.signs(), strict=True)
    names = [contact_name((contact.a, contact.b)) for contact, sign in pairs if sign]
    shown = ", ".join(names[:_SHOWN])
    if len(names) > _SHOWN:
        shown += f" and {len(names) - _SHOWN} more"
    return ContradictionError(
        "no displacements fit the scene: rigid contacts would have to overlap, or to open where "
        f"they are held closed, because their gaps contradict each other at {shown}; widen a gap "
        "there, or give a contact some compliance",
        whole,
    )


def stress_faults(scene: Scene, stress: ExactVector) -> Iterator[str]:
    """What keeps a stress, one number a contact, from proving that no displacements fit a scene.

    It has to act at rigid contacts only, to pull at none that may open, to be in balance at every
    freedom, and to do negative work on the initial gaps.
    """
    dimension = scene.dimension
    sums: dict[tuple[int, int], Surd] = {}
    work = ZERO
    gaps = initial_gaps(scene)
    first, second = scene.ends
    for k, sign in enumerate(stress.signs()):
        if not sign:
            continue
        contact, value = scene.contacts[k], stress[k]
        if contact.compliance != 0:
            yield f"{contact.name}: it is not rigid"
        if sign < 0 and not contact.bilateral:
            yield f"{contact.name}: the stress pulls"
        work += value * gaps.get(k, ZERO)
        for end, pull in ((int(first[k]), value), (int(second[k]), -value)):
            for axis in range(dimension if end >= 0 else 0):
                total = sums.get((end, axis), ZERO)
                sums[end, axis] = total + pull * contact.normal[axis]
    for (end, axis), total in sums.items():
        if total and scene.discs[end].held[axis] is None:
            yield f"disc {end_name(scene.discs[end].id)}: axis {axis} is not balanced"
    if work >= 0:
        yield "the stress does no negative work on the gaps"
