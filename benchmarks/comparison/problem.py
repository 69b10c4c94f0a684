"""What every method is given, and what every method has to give back."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from lcp_piles import Scene, contact_system
from lcp_piles.mechanics.system import ContactSystem
from lcp_piles.numbers.vectors import ExactVector, FloatArray


@dataclass(frozen=True, eq=False)
class Problem:
    """A scene as the force QP: min 1/2 f^T diag(C) f + o^T f, B^T f = -p, f >= 0.

    The arrays are those of `ContactSystem.floats`, of the symmetric half where there is one.
    """

    scene: Scene
    system: ContactSystem
    B: csr_array
    C: FloatArray
    o: FloatArray
    p: FloatArray


@dataclass(frozen=True, eq=False)
class Raw:
    """A method's own answer, in the units of the system it was given.

    `forces` one entry a contact; `gaps` too, None where the method has none (then its states
    cannot be read); `claimed`, whether the method says that it succeeded; `facts` for the record.
    """

    forces: FloatArray
    gaps: FloatArray | None
    claimed: bool
    facts: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Answer:
    """Forces (w) and gaps (w tau) of every contact of the whole scene, as floats.

    `exact` are the forces where the method has them in exact numbers; `radius` bounds the error of
    each force where the method proves bounds.
    """

    forces: FloatArray
    gaps: FloatArray | None
    claimed: bool
    facts: dict[str, Any] = field(default_factory=dict)
    exact: ExactVector | None = None
    radius: FloatArray | None = None


class FailedError(Exception):
    """A method that says itself that it failed, with its reason."""


def problem(scene: Scene) -> Problem:
    """The arrays of a scene."""
    system = contact_system(scene)
    return Problem(scene, system, *system.floats())


def whole(given: Problem, raw: Raw) -> Answer:
    """The answer for the whole scene from one for its part."""
    system = given.system
    contact = system.reduction.contact

    def spread(values: FloatArray) -> FloatArray:
        return np.where(contact >= 0, values[contact], 0.0)

    gaps = None if raw.gaps is None else spread(raw.gaps)
    return Answer(spread(raw.forces / system.reduction.weight), gaps, raw.claimed, raw.facts)
