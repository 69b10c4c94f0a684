"""An exact solution next to a packing in floats, and how far it is from that of the packing."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

import numpy as np

from .errors import SolveError
from .methods.contact_proof import ContactProof
from .methods.packings.prove import prove_packing
from .numbers.exact import floats_exactly
from .packings.packing import NORMAL_ERROR, Packing
from .packings.rational import rational_scene
from .scenes.scene import Scene
from .solution.solution import Solution
from .solve import solve


@dataclass(frozen=True, eq=False, repr=False)
class NearSolution:
    """The exact solution of a rational scene near a packing, beside the proof of the packing.

    Attributes
    ----------
    packing : Packing
        The packing as it was given.
    solution : Solved, Unstable or Unresolved
        That of the rational scene, in the packing's units.
    proof : ContactProof or None
        That of the packing itself; None where it found no bounds.
    angle : float
        The largest angle between the normals of the two, of all contacts (radians).

    Examples
    --------
    >>> from lcp_piles import packing, solve_packing
    >>> near = solve_packing(packing([(0, 1)], 1, supports={"floor": 0}))
    >>> near.angle < 1e-9, near.differing
    (True, ())
    """

    packing: Packing
    solution: Solution
    proof: ContactProof | None
    angle: float

    def __repr__(self) -> str:
        told = self.warning or "the same contacts carry a force"
        return f"<NearSolution {self.solution.status}, normals within {self.angle:.1e}: {told}>"

    @property
    def force_change(self) -> float:
        """The most that a force of the solution is away from that of the packing, in its unit.

        Infinite where one of the two has no forces.
        """
        if self.proof is None or self.proof.collapse is not None or not self._solved:
            return float("inf")
        bounds = self.proof.forces
        change = np.abs(self.solution.force_array - bounds.middle) + bounds.radius
        return float(change.max(initial=0.0))

    @property
    def differing(self) -> tuple[int, ...]:
        """Contacts, by number, that are closed or open in one and proved not to be in the other."""
        if self.proof is None or self.proof.collapse is not None or not self._solved:
            return ()
        here = np.where(self.proof.loaded, "closed", "open")
        here[list(self.proof.unproved)] = ""
        there = np.array(self.solution.states)
        return tuple(np.flatnonzero((here != there) & (here != "")).tolist())

    @property
    def warning(self) -> str:
        """What the solution says that is not so of the packing, or is not known; empty if nothing.

        It names the verdict where that differs, and else the contacts whose states do.
        """
        if self.proof is None:
            return "nothing is proved of the packing itself"
        here = "unstable" if self.proof.collapse is not None else "solved"
        there = self.solution.status
        if here != there:
            return f"the packing is {here}, the rational scene {there}"
        parts = []
        for numbers, what in (
            (self.differing, "have another state in the packing"),
            (self.proof.unproved, "are not told in the packing"),
        ):
            if numbers:
                names = ", ".join(map(self.packing.contact_name, numbers[:5]))
                more = f" and {len(numbers) - 5} more" if len(numbers) > 5 else ""
                parts.append(f"contacts {names}{more} {what}")
        return "; ".join(parts)

    @property
    def _solved(self) -> bool:
        return self.solution.status == "solved"


def solve_packing(packing: Packing, angle: float = 1e-9) -> NearSolution:
    """Solve, exactly, a packing whose normals are rational and near those given.

    Parameters
    ----------
    packing : Packing
        The packing.
    angle : float, default 1e-9
        The most that a normal is turned (radians).

    Returns
    -------
    NearSolution
        `solution` is that of the rational scene, verified as any; the other fields say how far that
        is from the packing itself (`prove_packing`), and `warning` where the two disagree.

    Raises
    ------
    InputError
        For an angle out of range.

    Examples
    --------
    >>> from lcp_piles import packing
    >>> groove = {"left": ((0, 0), (1, 1)), "right": ((0, 0), (-1, 1))}
    >>> near = solve_packing(packing([(0, 1.4142)], 1, supports=groove, stiffness=1e4), 1e-6)
    >>> [str(f) for f in near.solution.forces], near.force_change < 1e-6, near.warning
    (['1136689/1607522', '1136689/1607522'], True, '')
    """
    scene = rational_scene(packing, angle)
    try:
        proof = prove_packing(packing)
    except SolveError:
        proof = None
    return NearSolution(packing, solve(scene), proof, _largest_angle(packing, scene))


def _largest_angle(packing: Packing, scene: Scene) -> float:
    """A bound of the angles between the normals of the two."""
    largest = 0.0
    high, low = floats_exactly(packing.normals.high), floats_exactly(packing.normals.low)
    for contact, *words in zip(scene.contacts, high, low, strict=True):
        given = (a + b for a, b in zip(*words, strict=True))
        apart = [float(x - n.rational()) for x, n in zip(given, contact.normal, strict=True)]
        largest = max(largest, hypot(*apart))
    # An angle of up to 0.001 is longer than its chord by less than a millionth of it.
    return largest * (1 + 2.0**-20) + NORMAL_ERROR
