"""Proof without digits: the contact set, proved, and forces and gaps within rigorous bounds.

For who wants certainty and no fractions of thousands of digits. Floating point proposes the contact
set; a few steps of the lifting of `sparse_exact` give the displacements U to far more than double
precision, and what is left over is an exact integer residual r. So with a proved lower bound mu of
the least eigenvalue of the matrix A (`definite`),

    |U - U_computed|_inf <= |r|_2 / mu,

and forces and gaps, linear in U with small integer coefficients, have bounds too. Where every force
of a closed contact and every gap of an open one is away from zero by more than its bound, the signs
are proved and with them the set: any state that satisfies all conditions is the solution. A contact
that is exactly zero cannot be told from a tiny one this way and is named, unless it is one of those
that hold a mechanism without load: those carry exactly nothing (`regular_set`).
"""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from ..errors import SolveError
from ..linear.definite import least_eigenvalue
from ..linear.threads import one_thread
from ..mechanics.equations import Cause, Equations
from ..mechanics.motions import CollapseError
from ..mechanics.system import ContactSystem, contact_system
from ..numbers.exact import Surd
from ..numbers.floats import Bounded
from ..numbers.vectors import ExactVector, Mask
from ..scenes.scene import Scene
from .proved import float_guess
from .regular_set import regular_set

_STEPS = 3
_UNIT = 2.0**-53
_WIDER = 1 + 1e-9  # rounding of the bounds themselves
_FEW = 4 * _UNIT


@dataclass(frozen=True, eq=False)
class ContactProof:
    """The contact set of a scene, proved without exact fractions.

    `loaded` marks the contacts that carry a force; `forces` (w) and `gaps` (w tau) are those of
    every contact within bounds. `zero` marks contacts proved to carry exactly nothing while they
    hold a mechanism. `unproved` lists contacts whose force or gap is too close to zero to tell, by
    number; the set is proved where it is empty, and with it all bounds. `seconds` is wall time.
    """

    scene: Scene
    loaded: Mask
    zero: Mask
    forces: Bounded
    gaps: Bounded
    unproved: tuple[int, ...]
    dof: int
    seconds: float

    @property
    def proved(self) -> bool:
        """Whether the contact set and all bounds are proved."""
        return not self.unproved


@one_thread()
def prove_contacts(scene: Scene, *, whole: bool = False) -> ContactProof:
    """Prove the contact set of a scene with elastic contacts, and bound its forces and gaps.

    Raises `SolveError` for rigid or negative compliances, and where no bound is found: the exact
    `solve` is for those.

    >>> from lcp_piles import nt30
    >>> proof = prove_contacts(nt30(6))
    >>> proof.proved, int(proof.loaded.sum()), bool(proof.forces.radius.max() < 1e-13)
    (True, 113, True)
    """
    clock = perf_counter()
    system = contact_system(scene, "whole" if whole else None)
    if system.stiffness is None or any(c <= 0 for c in system.compliances[0]):
        raise SolveError(
            "bounds without digits need elastic contacts of few different compliances above 0: "
            "use solve"
        )
    if not system.in_range():
        raise SolveError("the scene has numbers beyond the range of floating point: use solve")
    regular = regular_set(system, float_guess(system))
    try:
        regular.held.free.check(system.load)
    except CollapseError as error:
        raise SolveError("a load moves the scene freely, without bounds: use solve") from error
    closed, zero = regular.held.closed, regular.idle
    pile = regular.held.equations
    least = least_eigenvalue(pile.solver.A)
    if not least:
        raise SolveError("the contacts hold the pile too weakly for bounds: use solve")
    gaps = _gaps(pile, regular.gap, least)
    E = 1 / system.floats()[1]
    middle = np.where(zero, 0.0, -E * gaps.middle)
    forces = Bounded(middle, np.where(zero, 0.0, E * gaps.radius * _WIDER + abs(middle) * _FEW))
    right = np.where(closed, zero | system.bilateral | (forces.signs() > 0), gaps.signs() > 0)
    unproved = np.append(~right, False)[system.reduction.contact]
    return ContactProof(
        scene,
        (closed & ~zero)[system.reduction.contact],
        zero[system.reduction.contact],
        _whole(system, system.force_factor, forces, closed),
        _whole(system, system.gap_factor, gaps, ~closed),
        tuple(np.flatnonzero(unproved).tolist()),
        system.dof,
        perf_counter() - clock,
    )


def _gaps(pile: Equations, gap: ExactVector, least: float) -> Bounded:
    """B U + o of every contact with the closed ones bilateral: their overlaps come out negative."""
    rights, common = _right_sides(pile, gap)
    system = pile.system
    B = csr_array(system.B[:, pile.free])
    reach = np.asarray(abs(B).sum(axis=1), dtype=np.float64)
    total, radius = np.zeros(system.contacts), np.zeros(system.contacts)
    for r, (right, own) in rights.items():
        near = pile.solver.approximate(right, _STEPS)
        weight = [2.0 ** (near.shift * (near.length - 1 - k)) for k in range(len(near.digits))]
        # B times a digit is exact in int64: digits and rows of B are small (`_steps` bounds them).
        parts = [(B @ d).astype(np.float64) * x for d, x in zip(near.digits, weight, strict=True)]
        parts.append(np.array([float(int(x)) for x in own]))
        rest = float(np.linalg.norm([float(int(x)) for x in near.rest])) * weight[-1]
        root = float(r) ** 0.5 / float(common)
        total += sum(parts) * root
        size = sum(abs(part) for part in parts)
        radius += (reach * (rest / least) * _WIDER + size * (len(parts) + 8) * _UNIT) * root
    return Bounded(total, radius * _WIDER + abs(total) * 4 * _UNIT)


def _right_sides(
    pile: Equations, gap: ExactVector
) -> tuple[dict[int, tuple[list[fmpz], list[fmpz]]], fmpz]:
    """For each radicand (b, o), over one integer: A x = b gives U, and o are initial gaps."""
    load = pile.system.load
    common = gap.denominator.lcm(load.denominator)
    up, across = common // gap.denominator, common // load.denominator
    zero = [fmpz(0)] * pile.system.contacts
    sides = {}
    for r in sorted({*gap.numerators, *load.numerators}):
        own = [x * up for x in gap.numerators.get(r, zero)]
        weights = load.numerators.get(r)
        stretch = {k: -x for k, x in enumerate(own) if x != 0 and pile.closed[k]}
        cause = Cause(stretch, {}, [x * across for x in weights] if weights else None)
        sides[r] = pile.right(cause), own
    return sides, common


def _whole(
    system: ContactSystem, factors: tuple[Surd, ...], part: Bounded, present: Mask
) -> Bounded:
    """Forces or gaps of the whole pile from those of its part; exactly zero where not present."""
    contact = system.reduction.contact
    scale = np.array([float(f) for f in factors])[system.factor_of] * present
    middle, radius = scale * part.middle, scale * part.radius
    radius = radius * _WIDER + abs(middle) * _FEW
    return Bounded(middle[contact], radius[contact])
