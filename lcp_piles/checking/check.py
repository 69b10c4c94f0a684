"""A user's forces held against ours: how far off they are, where, and what that means."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ..deformation.correction import FirstOrder, NoFirstOrder
from ..deformation.first_order import first_order
from ..errors import InputError
from ..methods.contact_proof import ContactProof
from ..methods.packings.prove import prove_packing
from ..numbers.exact import Exact, surd
from ..numbers.vectors import FloatArray, IntArray, Mask
from ..packings.packing import Packing
from ..scenes.scene import Scene
from ..solution.solution import Solution, Solved
from ..solve import solve
from .given import given_forces
from .match import Matched, matched
from .reference import Reference, reference_of, reference_of_packing

Verdict = Literal["agree", "another solution", "differ", "nothing to compare"]
TOLERANCE = 1e-3


@dataclass(frozen=True, eq=False, repr=False)
class Check:
    """Given forces beside ours, in w, one entry a contact in the scene's order.

    `given` is zero, and not `present`, where no force was given; `flipped` tells that compression
    was negative. `judged` are all contacts but those with a support of which no force was given,
    which dumps of pairs do not have. `expected` are ours, with the first-order change at `tau`
    where one was asked for and `softened` is found. `others` are given forces between ends that
    have no contact in the scene, by their names. `residual` (discs, axes) is what the given forces
    leave unbalanced along our normals, zero on discs with contacts that are not judged, and
    `own_residual` along their own vectors. The `tolerance` is relative to the largest of the
    expected forces. The `solution` is the proof of a packing, whose units are its own.
    """

    solution: Solution | ContactProof
    reference: Reference
    given: FloatArray
    present: Mask
    judged: Mask
    flipped: bool
    expected: FloatArray
    tau: Exact | None
    softened: FirstOrder | NoFirstOrder | None
    tangential: float | None
    others: tuple[tuple[str, float], ...]
    residual: FloatArray
    own_residual: FloatArray | None
    tolerance: float

    @property
    def scene(self) -> Scene | Packing:
        """The scene or packing that the forces are of."""
        return self.solution.scene

    @property
    def unit(self) -> str:
        """The unit of force for people, behind a number: w, or nothing for a packing's own."""
        return "" if isinstance(self.scene, Packing) else " w"

    @cached_property
    def difference(self) -> FloatArray:
        """Given minus expected forces (w), zero where they are not judged."""
        return np.where(self.judged, self.given - self.expected, 0.0)

    @property
    def off_rigid(self) -> float:
        """The largest difference (w) from the forces of the rigid limit, whatever `tau` is."""
        off = np.abs(self.given - self.reference.forces)[self.judged]
        return float(off.max(initial=0.0))

    @property
    def allowed(self) -> float:
        """The largest difference that still agrees (w)."""
        return self.tolerance * float(np.abs(self.expected).max(initial=0.0))

    @property
    def largest(self) -> float:
        """The largest difference (w), by size."""
        return float(np.abs(self.difference).max(initial=0.0))

    @property
    def relative(self) -> float:
        """The norm of the differences over that of the expected forces, both Euclidean."""
        whole = float(np.linalg.norm(self.expected[self.judged]))
        return float(np.linalg.norm(self.difference)) / whole if whole else self.largest

    @cached_property
    def scale(self) -> float:
        """The factor by which our forces fit the given ones best."""
        expected = np.where(self.judged, self.expected, 0.0)
        square = float(expected @ expected)
        return float(self.given @ expected) / square if square else float("nan")

    @cached_property
    def worst(self) -> IntArray:
        """The contacts by the size of their differences, the largest first."""
        return np.argsort(-np.abs(self.difference), kind="stable")

    @cached_property
    def wrong(self) -> IntArray:
        """The contacts that are named wrongly.

        Those that the scene has surely open, with a given force beyond the tolerance, and those
        that carry a force beyond it, with none given.
        """
        none = self.judged & (self.given == 0)
        too_many = self.reference.open & (np.abs(self.given) > self.allowed)
        too_few = self.reference.closed & none & (np.abs(self.expected) > self.allowed)
        return np.flatnonzero(too_many | too_few)

    @property
    def largest_other(self) -> float:
        """The largest given force that is of no contact of the scene (w)."""
        return max((abs(force) for _, force in self.others), default=0.0)

    @property
    def largest_residual(self) -> float:
        """The largest force that the given ones leave unbalanced on a disc (w)."""
        return float(np.linalg.norm(self.residual, axis=1).max(initial=0.0))

    @cached_property
    def verdict(self) -> Verdict:
        """What comes out: agreement within the tolerance, or none, or another solution.

        Where rigid contacts share the load in several ways, forces that balance, pull nowhere,
        vanish where the scene is open and agree at all elastic contacts are a solution as well.
        """
        if np.isnan(self.expected).any():
            return "nothing to compare"
        limit = self.allowed
        if self.largest_other > limit:
            return "differ"
        if self.largest <= limit:
            return "agree"
        several = isinstance(self.solution, Solved) and self.solution.forces_unique is False
        elastic = np.abs(self.difference[~self.reference.rigid]).max(initial=0.0)
        apart = np.abs(self.given[self.reference.open]).max(initial=0.0)
        pulling = -min(self.given.min(initial=0.0), 0.0)
        off = max(elastic, apart, pulling, self.largest_residual)
        others = several and bool(self.judged.all()) and off <= limit
        return "another solution" if others else "differ"

    @property
    def agrees(self) -> bool:
        """Whether the given forces are, within the tolerance, forces of the scene."""
        return self.verdict in ("agree", "another solution")

    def __repr__(self) -> str:
        return (
            f"<Check of {int(self.present.sum())} forces: {self.verdict}; largest difference "
            f"{self.largest:.3g}{self.unit}, {len(self.wrong)} contacts named wrongly, residual "
            f"{self.largest_residual:.3g}{self.unit}>"
        )


def check(
    scene: Scene | Solution | Packing | ContactProof,
    forces: Any,
    *,
    radius: float = 1.0,
    weight: float = 1.0,
    tolerance: float = TOLERANCE,
    tau: Exact | None = None,
    progress: Callable[[str], None] | None = None,
) -> Check:
    """Hold forces from elsewhere, a simulation or a solver, against the exact ones of a scene.

    Ends may be in either order and compression of either sign, all of the same; contacts that are
    missing have no force.

    Parameters
    ----------
    scene : Scene, Solved, Unstable, Unresolved, Packing or ContactProof
        What the forces are of. A packing is proved as it stands, in its own units and with its own
        stiffness.
    forces : mapping, array of float, shape (contacts,), or list of GivenForce
        Pairs of ends with forces or vectors, `{((6, 2), "floor"): 2.5, ...}`; or a number a contact
        in the scene's order; or what `read_forces` reads from a file.
    radius : float, default 1
        The unit in which lengths are given.
    weight : float, default 1
        The unit in which forces are given.
    tolerance : float, default 1e-3
        The difference of a force that is none, as a share of the largest force.
    tau : exact number, optional
        The compliance (disc radii a disc weight) of a simulation: ours have the change that this
        makes to first order.
    progress : callable, optional
        Called with a line of text now and then.

    Returns
    -------
    Check
        The `verdict`, the contacts that differ most, what is unbalanced.

    Raises
    ------
    InputError
        For a force that is of no disc of the scene, and numbers that are none of these.
    ContradictionError
        As `solve` does; for a packing `SolveError`, as `prove_packing` does.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> found = check(nt60(2), {((2, 1), (1, 1)): -0.5774, ((1, 1), (2, 2)): -0.5773})
    >>> found.verdict, found.flipped, round(found.largest, 6)
    ('agree', True, 5e-05)
    """
    for name, number in (("radius", radius), ("weight", weight)):
        if not 0 < number < float("inf"):
            raise InputError(f"the {name}", number, "a positive number")
    if not 0 <= tolerance < float("inf"):
        raise InputError("the tolerance", tolerance, "a number of at least 0")
    softened = None
    solution: Solution | ContactProof
    if isinstance(scene, Packing | ContactProof):
        solution, reference = _proved(scene)
        if tau is not None:
            raise InputError("tau", tau, "nothing for a packing, which has its own stiffness")
    else:
        solution = solve(scene, progress=progress) if isinstance(scene, Scene) else scene
        solved = solution if isinstance(solution, Solved) else None
        reference = reference_of(solution.scene, solved)
        softened = first_order(solved) if solved is not None and tau is not None else None
    expected = reference.forces
    if isinstance(softened, FirstOrder) and tau is not None:
        expected = softened.forces_at(surd(tau)).array()
    entries = given_forces(forces, map(reference.ends, range(len(reference.a))))
    found = matched(reference, entries, radius, weight)
    return _compared(solution, reference, found, expected, tau, softened, tolerance)


def _proved(given: Packing | ContactProof) -> tuple[ContactProof, Reference]:
    proof = prove_packing(given) if isinstance(given, Packing) else given
    if not isinstance(proof.scene, Packing):
        raise InputError("the scene of the proof", proof.scene, "a packing; a scene is solved here")
    return proof, reference_of_packing(proof.scene, proof)


def _compared(
    solution: Solution | ContactProof,
    reference: Reference,
    found: Matched,
    expected: FloatArray,
    tau: Exact | None,
    softened: FirstOrder | NoFirstOrder | None,
    tolerance: float,
) -> Check:
    sign = -1.0 if float(found.forces @ np.nan_to_num(expected, nan=1.0)) < 0 else 1.0
    given = sign * found.forces + 0.0
    vectors = found.vectors
    if vectors is not None:  # their own sign: they may be forces on the other end
        own = -1.0 if float((vectors * reference.normals).sum(axis=1) @ given) < 0 else 1.0
        vectors = own * vectors
    held = np.asarray(reference.held.all(axis=1))
    others = tuple(
        (reference.pair_name(ends), sign * force)
        for ends, force in found.others
        # What is held on both sides may push as it likes.
        if not all(end >= len(held) or held[end] for end in ends)
    )
    judged = _judged(reference, found.present)
    return Check(
        solution,
        reference,
        given,
        found.present,
        judged,
        sign < 0,
        expected,
        tau,
        softened,
        found.tangential,
        others,
        _known(reference, judged, reference.unbalanced(given)),
        None if vectors is None else _known(reference, judged, reference.balance(vectors)),
        tolerance,
    )


def _judged(reference: Reference, present: Mask) -> Mask:
    """All contacts but those with supports that no force was given of, if any was given."""
    discs = len(reference.ids)
    silent = set(range(discs, discs + len(reference.supports)))
    silent -= set(reference.b[present].tolist())
    return ~np.isin(reference.b, list(silent)) if present.any() else ~present


def _known(reference: Reference, judged: Mask, residual: FloatArray) -> FloatArray:
    """The residual of the discs all of whose contacts are judged."""
    left = residual.copy()
    left[reference.a[~judged]] = 0.0
    return left
