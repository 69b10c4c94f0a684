"""The least friction at which a pile stands, between exact ends that prove themselves.

What friction mu admits, a larger one admits too, so bisection closes in on the least: a network
proves that the pile stands at the upper end, a motion (a Farkas vector) that it slides at the lower
one. Floating point proposes while the ends are far apart; closer, exact pivots go on from the last
feasible basis, so any width can be asked for. A number in the roots of the normals is recognised on
the way (`threshold_in_roots`), others from the ends (`threshold`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from flint import fmpz

from ..errors import InputError
from ..numbers.exact import ONE, ZERO, Exact, Surd, rational
from ..numbers.simplest import simplest_between
from ..numbers.vectors import ExactVector
from ..programs.linear_program import LinearProgramResult, minimise
from ..programs.simplex import without_idle
from ..scenes.scene import Contact, Disc, Numbers, Scene
from .algebraic import AlgebraicNumber
from .equations import FrictionProblem, Network, friction_problem
from .force_bounds import InadmissibleError
from .threshold import threshold
from .threshold_in_roots import as_algebraic, threshold_in_roots

_COARSE = Fraction(1, 10)
_NEAR = Fraction(1, 10**5)  # of ends between which short numbers show
_MOST = 2**20  # a pile that does not stand with this friction stands with none


@dataclass(frozen=True, eq=False)
class CriticalFriction:
    """The least friction at which `scene` stands, all its discs free: in (lower, upper].

    `network` stands at `upper`. `motion` proves that nothing stands at `lower` (see
    `InadmissibleError`); it is None where the scene stands without friction, and both ends are 0.
    `in_roots` is the number itself, proved, where it is one in the roots of the normals.
    """

    scene: Scene
    lower: Fraction
    upper: Fraction
    network: Network
    motion: ExactVector | None
    basis: tuple[int, ...]
    in_roots: Surd | None = None

    @cached_property
    def exact(self) -> AlgebraicNumber | None:
        """The number itself, proved by substitution; None where it is not recognised.

        Outside the roots of the normals that takes the determinants of a matrix of the size of the
        pile, so large piles are not tried.
        """
        if self.motion is None:
            return AlgebraicNumber((0, 1), Fraction(0), Fraction(0))
        if self.in_roots is not None:
            return as_algebraic(self.in_roots, self.lower, self.upper)
        problem = _problem(self.scene, self.upper)
        above = without_idle(problem.constraints.scaled, self.basis)
        _, end = _solved(self.scene, self.lower, above)
        return threshold(problem, above, end.basis, self.lower, self.upper)

    def __repr__(self) -> str:
        return f"<CriticalFriction in ({float(self.lower):.12g}, {float(self.upper):.12g}]>"


def critical_friction(
    scene: Scene,
    width: Exact = Fraction(1, 10**12),
    *,
    progress: Callable[[Fraction, Fraction], None] | None = None,
) -> CriticalFriction:
    """The least friction of discs and supports at which a pile stands with all discs free.

    Parameters
    ----------
    scene : Scene
        A plane scene; `free_standing` says which of its discs are freed.
    width : exact number, default 1e-12
        What the exact ends may be apart, positive.
    progress : callable, optional
        Called with the two ends as they close in.

    Returns
    -------
    CriticalFriction
        The ends, `lower` and `upper`, what proves them, and the number itself (`exact`).

    Raises
    ------
    InadmissibleError
        Where no friction makes the pile stand, however large.
    InputError
        For a scene that is not plane, contacts held closed, and a width that is not positive.

    Examples
    --------
    >>> from lcp_piles import nt60
    >>> found = critical_friction(nt60(2), "1/1000000")
    >>> found.upper - found.lower <= Fraction(1, 10**6), found.exact
    (True, <AlgebraicNumber 2 - sqrt(3)>)
    """
    most = rational(width, "the width")
    if most <= 0:
        raise InputError("the width", width, "a positive number")
    free = free_standing(scene)
    problem, result = _solved(free, Fraction(0), None)
    if result.status != "infeasible":
        network = _network(problem, result)
        return CriticalFriction(free, Fraction(0), Fraction(0), network, None, ())
    low, low_end = Fraction(0), (problem, result)
    high = Fraction(1)
    high_end = _solved(free, high, None)
    while high_end[1].status == "infeasible":
        low, low_end = high, high_end
        high *= 2
        if high > _MOST:
            assert high_end[1].y is not None
            raise InadmissibleError(high_end[0].motion(high_end[1].y))
        high_end = _solved(free, high, None)
    alpha: Surd | None = None
    middles: list[Fraction] = []
    tried = False
    while high - low > most:
        if high - low < _NEAR and not tried:
            tried = True
            alpha = threshold_in_roots(free, low, high)
            middles = [] if alpha is None else _around(alpha, low, high, most)
        quarter = (high - low) / 4
        middle = middles.pop() if middles else simplest_between(low + quarter, high - quarter)
        start = high_end[1].basis if high - low < _COARSE else None
        end = _solved(free, middle, start)
        if end[1].status == "infeasible":
            low, low_end = middle, end
        else:
            high, high_end = middle, end
        if progress is not None:
            progress(low, high)
    assert low_end[1].y is not None
    motion = low_end[0].motion(low_end[1].y)
    network = _network(*high_end)
    return CriticalFriction(free, low, high, network, motion, high_end[1].basis, alpha)


def _around(alpha: Surd, low: Fraction, high: Fraction, width: Fraction) -> list[Fraction]:
    """Short fractions on both sides of a number, no further apart than a width."""
    bits = int(8 / width).bit_length()
    below, above = as_algebraic(alpha, low, high).narrowed(bits)
    third = width / 3
    return [
        simplest_between(below - third, below - third / 2),
        simplest_between(above + third / 2, above + third),
    ]


def free_standing(scene: Scene) -> Scene:
    """The scene with every disc of the pile free.

    A held disc that bears a load is a disc of the pile that somebody holds, like a corner stone: it
    is let go, stands on the support if it is as low as the lowest of such discs, and touches what
    it touched already and other freed discs. Held discs without a load (a bumpy bed) are part of
    the support and stay.

    >>> from lcp_piles import nt60
    >>> [contact.name for contact in free_standing(nt60(2)).contacts[2:]]
    ['contact (2,1)-(2,2)', 'contact (2,1)-floor', 'contact (2,2)-floor']
    """
    if scene.dimension != 2:
        raise InputError("the number of axes", scene.dimension, "2: friction is for plane scenes")
    freed = [d for d in scene.discs if any(h is not None for h in d.held) and any(d.load)]
    if not freed:
        return scene
    known = {frozenset((c.a, c.b)) for c in scene.contacts}
    more = [
        Contact(one.id, two.id, normal)
        for k, one in enumerate(freed)
        for two in freed[k + 1 :]
        if frozenset((one.id, two.id)) not in known and (normal := _touching(one, two)) is not None
    ]
    lowest = min(disc.position[1] for disc in scene.discs if any(disc.load))
    for disc in freed:
        on_support = any(frozenset((disc.id, name)) in known for name in scene.supports)
        if disc.position[1] == lowest and not on_support:
            if len(scene.supports) != 1:
                raise InputError(
                    "the supports",
                    scene.supports,
                    f"one, for disc {disc.id} to stand on when it is let go",
                    "give the disc a contact with its support",
                )
            more.append(Contact(disc.id, scene.supports[0], (ZERO, ONE)))
    ids = {disc.id for disc in freed}
    discs = [replace(d, held=(None, None)) if d.id in ids else d for d in scene.discs]
    return replace(scene, discs=tuple(discs), contacts=(*scene.contacts, *more))


def _touching(one: Disc, two: Disc) -> Numbers | None:
    """The normal from the second disc to the first, if these two touch."""
    apart = [x - y for x, y in zip(one.position, two.position, strict=True)]
    square = sum((x * x for x in apart), ZERO)
    reach = one.radius + two.radius
    return tuple(x / reach for x in apart) if square == reach * reach else None


def _problem(scene: Scene, mu: Fraction) -> FrictionProblem:
    return friction_problem(scene, mu, scene.supports)


def _solved(
    scene: Scene, mu: Fraction, start: Sequence[int] | None
) -> tuple[FrictionProblem, LinearProgramResult]:
    """Any admissible network, or the proof that there is none."""
    problem = _problem(scene, mu)
    nothing = ExactVector({1: [fmpz(0)] * len(problem.constraints.columns)}, fmpz(1))
    return problem, minimise(problem.constraints, nothing, start=start)


def _network(problem: FrictionProblem, result: LinearProgramResult) -> Network:
    assert result.x is not None
    return problem.network(result.x)
