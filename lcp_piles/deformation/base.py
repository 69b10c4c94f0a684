"""A rigid solution as the first order needs it: its half, what touches there, what moves freely."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from flint import fmpz

from ..mechanics.held_set import HeldSet
from ..mechanics.motions import Motions, free_motions
from ..mechanics.state import State
from ..mechanics.system import ContactSystem, contact_system
from ..numbers.vectors import ExactVector, IntArray, Mask
from ..solution.partition import Partition
from ..solution.solution import Solved
from .columns import at
from .expansion import Joints, at_discs, joints_of


@dataclass(frozen=True, eq=False)
class Base:
    """A rigid solution as the first order needs it.

    `displacements`, `gaps` and `forces` are those of the whole scene, without factors; `held` holds
    the contacts of its symmetric half that carry a force, where it is symmetric, and `free` are the
    motions that leave all touching ones at rest, both found anew. `touching` is a mask of the
    half's contacts, `partition` says the same of all states. `near` are the scene's contacts at the
    discs of the half (`discs`), and `joints` those of them between discs, with `pressing` their
    forces.
    """

    rigid: Solved
    displacements: ExactVector
    gaps: ExactVector
    forces: ExactVector
    held: HeldSet
    free: Motions
    touching: Mask
    partition: Partition
    discs: Mask
    near: IntArray
    joints: Joints
    pressing: ExactVector

    @property
    def system(self) -> ContactSystem:
        """The contact system of the half, or of the whole."""
        return self.held.system


def base_of(solution: Solved) -> Base:
    """The base of an exact solution; its mechanisms are not believed but sought anew."""
    u, f, g = (_plain(v) for v in (solution.displacements, solution.forces, solution.gaps))
    scene = solution.scene
    system = contact_system(scene)
    if not is_mirrored(system, (u,), (f,)):
        system = contact_system(scene, "whole")
    half = system.reduction
    states = np.array(solution.states)[half.representative]
    closed, touching = (states == "closed") | system.bilateral, states != "open"
    held = HeldSet(system, free_motions(system, closed))
    free = free_motions(system, touching, [held.free])
    signs = at(f, half.representative).signs()
    rest = Partition(closed, ~touching, held.free, pressing_signs(signs))
    numbers = np.arange(len(scene.discs))
    image = numbers if system.symmetry is None else system.symmetry.discs
    discs = numbers <= image
    near = np.flatnonzero(at_discs(scene, np.arange(len(scene.contacts)), discs))
    joints = joints_of(scene, near)
    own = at(f, joints.contacts)
    return Base(solution, u, g, f, held, free, touching, rest, discs, near, joints, own)


def pressing_signs(signs: list[int]) -> State:
    """A state of which only the signs of the forces count."""
    vector = ExactVector({1: [fmpz(x) for x in signs]}, fmpz(1))
    return State(vector, vector, vector)


def is_mirrored(
    system: ContactSystem, motions: Iterable[ExactVector], scalars: Iterable[ExactVector]
) -> bool:
    """Whether displacements, flat, and numbers of contacts are their own mirror images.

    True where the system is of a scene without mirror.
    """
    image = system.symmetry
    if image is None:
        return True
    dimension = system.scene.dimension
    freedoms = np.arange(len(image.discs) * dimension)
    axis = freedoms % dimension
    places = image.discs[freedoms // dimension] * dimension + axis
    flips = np.where(axis == 0, -1, 1)
    return all(u.take(places, flips).numerators == u.numerators for u in motions) and all(
        at(f, image.contacts).numerators == f.numerators for f in scalars
    )


def _plain(vector: object) -> ExactVector:
    assert isinstance(vector, ExactVector)
    return vector.plain()
