"""One sample of a disordered scene: its contact set and forces, proved.

The fast road: Newton's method from the pile without disorder proposes the closed contacts, their
springs are factored and proved definite (`pinned`), and forces and gaps come out within rigorous
bounds (`bounds`) whose signs prove the set. The exact road, where that proves nothing: `solve`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np

from ..errors import SolveError
from ..linear.threads import one_thread
from ..methods.newton import minimum
from ..numbers.floats import UNIT
from ..numbers.vectors import FloatArray, IntArray, Mask
from ..solution.solution import Solved
from ..solution.stability import Verdict
from ..solve import solve
from .bounds import HeldState, fixed_points, held_state
from .draws import Disorder
from .family import Integers, PileFamily, Springs
from .gap_grid import drawn, drawn_steps, step_floats
from .loosened import loosened
from .pinned import PinnedSprings, pinned_springs

Road = Literal["proved", "exact"]
_ENOUGH = (1e-6, 0.0)  # what may be unbalanced of a proposal: its set is mostly right long before
_PROPOSALS = 4  # the first, and others with fewer contacts or moved off a stop


@dataclass(frozen=True, eq=False, repr=False)
class Sample:
    """The forces of one sample, within bounds of the exact ones, and what is proved.

    Attributes
    ----------
    k : int
        The number of the sample.
    forces : array of float, shape (contacts,)
        The forces (w), 0 exactly where the contact carries nothing.
    error : float
        What all forces are within (w).
    closed : array of bool, shape (contacts,)
        Marks the contacts that carry a force.
    mechanisms : int
        The independent motions of the whole scene that leave those at rest.
    verdict : {"stable", "saddle", "neutral", "undecided"}
        What becomes of the pile (see `Stability`).
    road : {"proved", "exact"}
        Whether floating point with rigorous bounds did, or exact arithmetic had to; the set, the
        count and the verdict are proved on either.

    Examples
    --------
    >>> from lcp_piles import Uniform, nt60, pile_family, proved_sample
    >>> proved_sample(pile_family(nt60(4)), Uniform(1), seed=0, k=3).mechanisms
    0
    """

    k: int
    forces: FloatArray
    error: float
    closed: Mask
    mechanisms: int
    verdict: Verdict
    road: Road

    def __repr__(self) -> str:
        loaded = f"{int(self.closed.sum())} of {len(self.closed)} loaded"
        return f"<Sample {self.k}: {loaded}, {self.verdict}, {self.road}>"


@one_thread()
def proved_sample(family: PileFamily, disorder: Disorder, seed: int, k: int) -> Sample:
    """The forces of sample k of a family, proved; the sample is that of `drawn`.

    For exact forces solve the scene of `drawn`.

    Parameters
    ----------
    family : PileFamily
        What all samples share (`pile_family`).
    disorder : Uniform, Normal or Radii
        The distribution of the gaps.
    seed : int
        The seed of the ensemble, at least 0.
    k : int
        The number of the sample, at least 0.

    Returns
    -------
    Sample
        The forces (w) within bounds, and what is proved.

    Raises
    ------
    InputError
        For a seed or number that is none.
    SolveError
        Where no forces balance the loads.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> from lcp_piles.disorder.draws import Uniform
    >>> from lcp_piles.disorder.family import pile_family
    >>> sample = proved_sample(pile_family(nt60(4)), Uniform(1), seed=0, k=3)
    >>> sample, sample.error < 1e-9
    (<Sample 3: 20 of 20 loaded, stable, proved>, True)
    """
    steps = drawn_steps(family.scene, family.grid, disorder, seed, k)
    return _by_bounds(family, disorder, steps, k) or _exactly(family, disorder, seed, k)


def _by_bounds(family: PileFamily, disorder: Disorder, steps: IntArray, k: int) -> Sample | None:
    springs = family.springs
    if springs is None:
        return None
    o = springs.gap + step_floats(family.grid, steps, disorder.amplitude)
    U = springs.start
    with np.errstate(all="ignore"):  # what is no number proves nothing
        for enough in _ENOUGH:
            near = minimum(springs.energy, o, U, enough)
            U = near.U
            if not (near.converged or near.residual <= enough) or not np.isfinite(U).all():
                return None
            closed = springs.bilateral | (near.closed & (near.forces > 0))
            found = _proved(springs, steps, disorder.amplitude, closed, U, k)
            if found is not None:
                return found
    return None


def _proved(
    springs: Springs, steps: IntArray, amplitude: Fraction, closed: Mask, U: FloatArray, k: int
) -> Sample | None:
    """The sample from a proposal, mended where it can be."""
    for _ in range(_PROPOSALS):
        pinned = pinned_springs(springs, closed)
        points = fixed_points(springs.integers, steps, amplitude, U)
        if pinned is None or points is None:
            return None
        state = held_state(springs, pinned, closed, points)
        signs = np.where(closed, state.forces.signs(), state.gaps.signs())
        wrong = (signs <= 0) & ~springs.bilateral
        if not wrong.any():
            return _sample(springs, pinned, state, closed, k)
        if (wrong & closed).any():
            closed = closed & ~wrong
        else:
            gaps = state.gaps.middle
            moved = loosened(springs.integers, pinned.motions, ~closed, gaps, U)
            if moved is None:
                return None
            U = moved
    return None


def _sample(
    springs: Springs, pinned: PinnedSprings, state: HeldState, closed: Mask, k: int
) -> Sample:
    forces = state.forces.middle
    error = float(state.forces.radius.max(initial=0.0))
    verdict = _verdict(springs.integers, forces, pinned.motions)
    return Sample(k, forces, error, closed, pinned.motions.shape[1], verdict, "proved")


def _verdict(integers: Integers, forces: FloatArray, motions: IntArray) -> Verdict:
    """What free motions do to a scene whose open contacts are all open (see `Stability`)."""
    if not motions.shape[1]:
        return "stable"
    moves = (integers.sliding @ motions).any(axis=1)
    slides = moves.reshape(len(forces), -1).any(axis=1) & integers.between & (forces != 0)
    if (forces[slides] < 0).any():  # a bilateral contact in tension
        return "undecided"
    return "saddle" if slides.any() else "neutral"


def _exactly(family: PileFamily, disorder: Disorder, seed: int, k: int) -> Sample:
    solution = solve(drawn(family.scene, disorder, seed, k), whole=True)
    if not isinstance(solution, Solved) or solution.stability is None:
        raise SolveError(f"sample {k} of seed {seed} is {solution.status}: no forces balance it")
    forces = solution.force_array
    error = 4 * UNIT * float(np.abs(forces).max(initial=0.0))
    stability = solution.stability
    closed = np.array([state == "closed" for state in solution.states], dtype=bool)
    return Sample(k, forces, error, closed, stability.mechanisms, stability.verdict, "exact")
