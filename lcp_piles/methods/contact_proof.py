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

    `loaded` marks the contacts that carry a force; `forces` (w) and `gaps` (w tau) are those of
    every contact within bounds, of a packing in its own units. `zero` marks contacts proved to
    carry exactly nothing while they hold a mechanism. `unproved` lists contacts whose force or gap
    is too close to zero to tell, by number; the set is proved where it is empty, and with it all
    bounds. `collapse` is None, or a motion (discs, axes) that proves that no forces balance the
    loads of a packing, which then has none: it lowers the loads and closes no contact. `seconds`
    is wall time.
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
