"""How a solution was made: method, arithmetic, sizes, time."""

from __future__ import annotations

from dataclasses import dataclass

from ..mechanics.system import ContactSystem


@dataclass(frozen=True, repr=False)
class Record:
    """How a solution was made.

    `method` and `arithmetic` ("exact", "float64" or "float32") name it; `pivots` counts its steps,
    whatever they are; `proof` says in words why the answer is one. `dof` and `contacts` are the
    sizes that were solved, `whole_dof` and `whole_contacts` those of the whole pile. `seconds` is
    wall time from scene to verified solution, and `guess_errors` how many contacts of the solved
    part a floating-point guess had named wrongly.
    """

    method: str
    arithmetic: str
    pivots: int
    proof: str
    part: str
    dof: int
    contacts: int
    whole_dof: int
    whole_contacts: int
    seconds: float
    guess_errors: int | None = None

    @property
    def exact(self) -> bool:
        """Whether the arithmetic was exact."""
        return self.arithmetic == "exact"

    def __repr__(self) -> str:
        return (
            f"<Record {self.method} ({self.arithmetic}): {self.pivots} steps, {self.dof} freedoms "
            f"and {self.contacts} contacts of the {self.part} part, {self.seconds:.3g} s>"
        )


def make_record(
    system: ContactSystem,
    method: str,
    arithmetic: str,
    pivots: int,
    proof: str,
    guess_errors: int | None = None,
    seconds: float = 0.0,
) -> Record:
    """The record of what a method made of a contact system."""
    scene = system.scene
    free = sum(h is None for disc in scene.discs for h in disc.held)
    return Record(
        method,
        arithmetic,
        pivots,
        proof,
        system.reduction.part,
        system.dof,
        system.contacts,
        free,
        len(scene.contacts),
        seconds,
        guess_errors,
    )
