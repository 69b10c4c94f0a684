"""What forces are held against: a solved scene in floats, whichever way it was solved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..methods.contact_proof import ContactProof
from ..numbers.exact import surd
from ..numbers.vectors import FloatArray, IntArray, Mask
from ..packings.packing import Packing
from ..scenes.names import DiscId, contact_name
from ..scenes.scene import Scene
from ..solution.solution import Solved


@dataclass(frozen=True, eq=False, repr=False)
class Reference:
    """Discs, contacts and their forces, in units of w and of radii where the scene has these.

    Shapes: `centres` (discs, axes), None where positions mean nothing; `loads` and `held` (discs,
    axes); `a` and `b` (contacts,), b counts supports on from the number of discs; `normals`
    and `points` (contacts, axes), where contacts touch disc a; `forces` (contacts,), NaN where the
    scene has none. `closed` contacts carry a force and `open` ones are surely apart; what is
    neither may be named as one likes. `rigid` ones have no compliance. `size` is the least radius.
    """

    ids: tuple[DiscId, ...]
    supports: tuple[str, ...]
    centres: FloatArray | None
    points: FloatArray | None
    loads: FloatArray
    held: Mask
    a: IntArray
    b: IntArray
    normals: FloatArray
    forces: FloatArray
    closed: Mask
    open: Mask
    rigid: Mask
    size: float

    def ends(self, k: int) -> tuple[DiscId, DiscId]:
        """The ids of the ends of contact k."""
        return self.ids[self.a[k]], self.end(int(self.b[k]))

    def end(self, number: int) -> DiscId:
        """A disc or support by its number."""
        discs = len(self.ids)
        return self.ids[number] if number < discs else self.supports[number - discs]

    def name(self, k: int) -> str:
        """What people call contact k."""
        return contact_name(self.ends(k))

    def pair_name(self, ends: tuple[int, int]) -> str:
        """What people call a pair of ends, given by their numbers."""
        return contact_name(map(self.end, ends))

    def unbalanced(self, forces: FloatArray) -> FloatArray:
        """Loads and forces along the normals, summed disc by disc; zero where motions are held."""
        return self.balance(forces[:, None] * self.normals)

    def balance(self, vectors: FloatArray) -> FloatArray:
        """The same for vectors (contacts, axes) of the force on a."""
        total = self.loads.copy()
        np.add.at(total, self.a, vectors)
        between = self.b < len(self.ids)
        np.subtract.at(total, self.b[between], vectors[between])
        total[self.held] = 0.0
        return total


def reference_of(scene: Scene, solution: Solved | None) -> Reference:
    """The reference of a scene, without forces where it has no solution."""
    values, which = scene.normals
    table = np.array([[float(x) for x in normal] for normal in values])
    normals = table.reshape(-1, scene.dimension)[which]
    centres = np.array([[float(x) for x in disc.position] for disc in scene.discs])
    radii = np.array([float(disc.radius) for disc in scene.discs])
    a, b = scene.ends
    support = len(scene.discs) + scene.support_of
    count = len(scene.contacts)
    forces, states = np.full(count, np.nan), np.array([""] * count)
    sure = np.ones(count, dtype=bool)
    if solution is not None:
        forces, states = solution.force_array, np.array(solution.states)
        if solution.gap_unique:
            sure = np.array(solution.gap_unique)
    return Reference(
        tuple(disc.id for disc in scene.discs),
        scene.supports,
        centres if scene.geometric else None,
        centres[a] - radii[a, None] * normals if scene.geometric else None,
        np.array([[float(x) for x in disc.load] for disc in scene.discs]),
        np.array([[h is not None for h in disc.held] for disc in scene.discs]),
        a,
        np.where(b >= 0, b, support),
        normals,
        forces,
        states == "closed",
        (states == "open") & sure,
        np.array([surd(c.compliance) == 0 for c in scene.contacts], dtype=bool),
        float(radii.min()),
    )


def reference_of_packing(packing: Packing, proof: ContactProof) -> Reference:
    """The reference of a packing, in its own units: forces where they are proved to be."""
    geometry, count = packing.geometry, len(packing.a)
    told = np.ones(count, dtype=bool)
    told[list(proof.unproved)] = False
    normals = packing.normals.high
    return Reference(
        packing.ids,
        packing.supports,
        None if geometry is None else geometry.centres,
        None
        if geometry is None
        else geometry.centres[packing.a] - geometry.radii[packing.a, None] * normals,
        packing.loads,
        packing.held,
        packing.a,
        np.where(packing.b >= 0, packing.b, len(packing.ids) + packing.support),
        normals,
        proof.forces.middle,
        proof.loaded & told,
        ~proof.loaded & told,
        np.zeros(count, dtype=bool),
        1.0 if geometry is None else float(geometry.radii.min()),
    )
