"""What a proof in floating point says, in lines of text."""

from __future__ import annotations

import numpy as np

from ..methods.contact_proof import ContactProof
from ..packings.packing import Packing
from ..scenes.names import contact_name

Lines = list[tuple[str, str]]


def proof_lines(proof: ContactProof, digits: int) -> Lines:
    """Facts about a proof, as pairs of a name and a text; forces of a packing are in its units."""
    scene, forces = proof.scene, proof.forces
    if proof.collapse is not None:
        return [
            ("status", "unstable: no forces balance the load, and a collapse motion is proved"),
        ]
    own = isinstance(scene, Packing)
    w, tau = ("", "") if own else (" w", " w tau")
    lines = [
        ("contact set", "proved" if proof.proved else "not proved"),
        ("contacts", f"{int(proof.loaded.sum())} carry a force, {int((~proof.loaded).sum())} none"),
    ]
    if proof.zero.any():
        count = int(proof.zero.sum())
        lines.append(("", f"of these {count} touch without force: they hold mechanisms"))
    for k in proof.unproved:
        near = f"force {abs(forces.middle[k]):.3g}{w}, gap {abs(proof.gaps.middle[k]):.3g}{tau}"
        lines.append(("unproved", f"{_name(proof, k)}: {near}, too close to zero to tell"))
    if len(proof.loaded):
        k = int(np.argmax(forces.middle))
        largest = f"{forces.middle[k]:.{min(digits, 17)}g}{w}"
        lines.append(
            ("largest force", f"{_name(proof, k)}: {largest}, within {forces.radius[k]:.1e}")
        )
    lines.append(
        (
            "bounds",
            f"every force within {forces.radius.max(initial=0.0):.1e}{w}, "
            f"every gap within {proof.gaps.radius.max(initial=0.0):.1e}{tau}",
        )
    )
    return lines


def describe_packing(packing: Packing) -> str:
    """The packing in one line."""
    kind = "discs" if packing.dimension == 2 else "spheres"
    walls = ", ".join(packing.supports) or "none"
    return f"packing of {len(packing.ids)} {kind}, {len(packing.a)} contacts; walls: {walls}"


def _name(proof: ContactProof, k: int) -> str:
    scene = proof.scene
    if isinstance(scene, Packing):
        return scene.contact_name(k)
    return contact_name((scene.contacts[k].a, scene.contacts[k].b))
