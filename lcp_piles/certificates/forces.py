"""The certificate of a solved scene: forces and displacements, and why they are what is said."""

from __future__ import annotations

import numpy as np
from flint import fmpz

from ..errors import InputError
from ..files.hex_vectors import vector_entry
from ..files.json_fields import Entry
from ..linear.integer_matrix import integer_matrix
from ..linear.kernel import kernel
from ..linear.rearrangement import blocks, rows_of, transposed
from ..mechanics.system import ContactSystem, contact_system
from ..numbers.vectors import ExactVector, IntArray, Mask
from ..solution.solution import Solved, Unstable
from .entries import FORMAT, certified_scene
from .rank import rank_entry
from .states import opening_motion, pressing_stress


def forces_certificate(solution: Solved) -> Entry:
    """That forces and displacements solve the scene, and which states, gaps and verdict follow.

    Where a compliance is negative nothing follows on other solutions, states and stability.
    """
    u, f, g = solution.displacements, solution.forces, solution.gaps
    if not isinstance(u, ExactVector) or not isinstance(f, ExactVector):
        raise InputError("the solution", solution.record.arithmetic, "an exact one")
    scene = solution.scene
    found: Entry = {"format": FORMAT, "claim": "forces", "scene": certified_scene(scene)}
    found |= {"u": vector_entry(u), "f": vector_entry(f)}
    assert isinstance(g, ExactVector)  # all three are of one kind
    system = contact_system(scene, "whole")
    force, gap = np.array(f.signs(), dtype=int), np.array(g.signs(), dtype=int)
    held = (force != 0) | system.bilateral
    idle = np.flatnonzero(~held & (gap == 0))
    mechanisms = kernel(rows_of(system.B, held))[0]
    found["mechanisms"] = _kernel_entry(system, np.flatnonzero(held), mechanisms)
    if not scene.definite:
        return found
    if len(idle):
        found["stress"] = vector_entry(pressing_stress(system, held, idle, mechanisms))
    hard_idle = idle[system.rigid[idle]]
    if len(hard_idle):
        found["motion"] = vector_entry(opening_motion(system, held, hard_idle))
    found |= _uniqueness(system, held)
    if len(idle) and mechanisms:
        touching = np.concatenate([np.flatnonzero(held), idle])
        found["free"] = _kernel_entry(system, touching, kernel(rows_of(system.B, touching))[0])
    return found


def collapse_certificate(solution: Unstable) -> Entry:
    """That no forces balance the loads: the motion along which the scene gives way."""
    found: Entry = {"format": FORMAT, "claim": "collapse"}
    found["scene"] = certified_scene(solution.scene)
    found["motion"] = vector_entry(solution.collapse)
    return found


def _radicands(system: ContactSystem) -> list[int]:
    """The square roots in the normals and the motions of a scene."""
    normals, _ = system.scene.normals
    numbers = [*system.displacement_factor, *(x for normal in normals for x in normal)]
    return sorted({r for number in numbers for r, _ in number.terms})


def _uniqueness(system: ContactSystem, held: Mask) -> Entry:
    """Whether the rigid contacts that bear something are independent."""
    hard = np.flatnonzero(system.rigid & held)
    if not len(hard):
        return {}
    B = rows_of(system.B, hard)
    stresses = kernel(transposed(B))[0]
    if not stresses:
        return {"rigid": rank_entry(B, len(hard), _radicands(system))}
    spread = [fmpz(0)] * system.contacts
    for k, x in zip(hard.tolist(), stresses[0], strict=True):
        spread[k] = x
    return {"rigid stress": vector_entry(system.whole_forces(ExactVector({1: spread}, fmpz(1))))}


def _kernel_entry(system: ContactSystem, chosen: IntArray, motions: list[list[fmpz]]) -> Entry:
    """All motions that leave the chosen contacts at rest, and why there are no others."""
    moved = [
        system.whole_displacements(ExactVector({1: motion}, fmpz(1)), prescribed=False)
        for motion in motions
    ]
    rows = rows_of(system.B, chosen)
    if motions:
        rows = blocks([[rows], [integer_matrix(motions)]])
    proof = rank_entry(rows, system.dof, _radicands(system), len(motions))
    return {"motions": [vector_entry(motion) for motion in moved], **proof}
