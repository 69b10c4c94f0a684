"""What a proof without digits says: the contact set, and forces and gaps within bounds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numbers.floats import LOST, UNIT, UP, Bounded
from ..numbers.vectors import FloatArray, Mask
from ..packings.packing import Packing
from ..scenes.scene import Scene


@dataclass(frozen=True, eq=False, repr=False)
class ContactProof:
    """The contact set of a scene or packing, proved without exact fractions.

    Units are w and w tau for a scene, its own for a packing.

    Attributes
    ----------
    scene : Scene or Packing
        What it is a proof of.
    loaded : array of bool, shape (contacts,)
        Marks the contacts that carry a force.
    zero : array of bool, shape (contacts,)
        Marks contacts proved to carry exactly nothing while they hold a mechanism.
    forces : Bounded, shape (contacts,)
        The forces within bounds.
    gaps : Bounded, shape (contacts,)
        The gaps within bounds.
    unproved : tuple of int
        The contacts whose force or gap is too close to zero to tell; the set is proved where there
        are none, and with it all bounds.
    dof : int
        The freedoms of the part that was solved.
    seconds : float
        Wall time (s).
    collapse : array of float, shape (discs, axes), or None
        A motion that proves that no forces balance the loads of a packing, which then has none: it
        lowers the loads and closes no contact.

    Examples
    --------
    >>> from lcp_piles import nt60, prove_contacts
    >>> prove_contacts(nt60(2)).loaded.tolist()
    [True, True]
    """

    scene: Scene | Packing
    loaded: Mask
    zero: Mask
    forces: Bounded
    gaps: Bounded
    unproved: tuple[int, ...]
    dof: int
    seconds: float
    collapse: FloatArray | None = None

    def __repr__(self) -> str:
        told = "proved" if self.proved else f"{len(self.unproved)} contacts not proved"
        if self.collapse is not None:
            return "<ContactProof no forces: a collapse is proved>"
        return f"<ContactProof {told}, {int(self.loaded.sum())} of {len(self.loaded)} loaded>"

    @property
    def proved(self) -> bool:
        """Whether the contact set and all bounds are proved."""
        return self.collapse is None and not self.unproved


def forces_of(gaps: Bounded, c: FloatArray, pushing: Mask) -> Bounded:
    """Forces of contacts whose overlaps are known, of compliances c within 1.01 u of themselves."""
    return Bounded(
        np.where(pushing, -gaps.middle / c, 0.0),
        # g / c of rounded g and c, once more rounded.
        np.where(pushing, (gaps.radius + np.abs(gaps.middle) * 4 * UNIT) / c * UP + LOST, 0.0),
    )
