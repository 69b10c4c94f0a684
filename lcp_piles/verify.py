"""The check of a solution from the scene alone.

Nothing of the solver is used: no gauge, no symmetry, no linear system. Balance, Hooke's law, signs
and complementarity are evaluated contact by contact and disc by disc, exactly for exact solutions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import gcd, lcm

import numpy as np
from flint import fmpz

from .errors import InputError
from .exact import Surd, surd_sign
from .scene import Scene
from .solution import Solution
from .vectors import ExactVector

Sum = dict[int, fmpz]
"""A sum of integers times square roots, by radicand."""


@dataclass(frozen=True)
class Verification:
    """The outcome: `faults` lists every identity that fails, in words (at most `shown` of them).

    For floating-point solutions `residual` is the largest violation (w, or w tau), nothing is a
    fault by itself, and `exact` is false.
    """

    exact: bool
    faults: tuple[str, ...]
    residual: float = 0.0

    @property
    def ok(self) -> bool:
        """Whether every identity holds exactly."""
        return self.exact and not self.faults


def verify(scene: Scene, solution: Solution, *, shown: int = 10) -> Verification:
    """Check a solution against a scene: balance, Hooke's law, signs and complementarity.

    For an unstable scene: that the collapse closes no contact, moves nothing that is held, and
    that the load does work on it. A solution without answer ("unresolved") is a fault.

    >>> from lcp_piles import nt60, solve
    >>> verify(nt60(3), solve(nt60(3))).ok
    True
    """
    if solution.status == "unresolved":
        return Verification(solution.exact, ("the scene is unresolved: nothing is claimed",))
    sizes = (len(scene.discs) * scene.dimension, len(scene.contacts))
    if solution.status == "unstable":
        if not isinstance(solution.collapse, ExactVector) or len(solution.collapse) != sizes[0]:
            raise InputError("the collapse", solution.collapse, f"{sizes[0]} exact numbers")
        return _first(_collapse_faults(scene, solution.collapse), shown)
    vectors = (solution.displacements, solution.forces, solution.gaps)
    lengths = tuple(-1 if v is None else len(v) for v in vectors)
    if lengths != (sizes[0], sizes[1], sizes[1]):
        raise InputError("the sizes of u, f and g", lengths, f"{(sizes[0], sizes[1], sizes[1])}")
    if not all(isinstance(v, ExactVector) for v in vectors):
        return Verification(False, (), _residual(scene, solution))
    u, f, g = (v.plain() for v in vectors if isinstance(v, ExactVector))
    return _first(_faults(scene, u, f, g, solution.states), shown)


def _first(faults: Iterator[str], shown: int) -> Verification:
    return Verification(True, tuple(fault for fault, _ in zip(faults, range(shown), strict=False)))


def _faults(
    scene: Scene, u: ExactVector, f: ExactVector, g: ExactVector, states: tuple[str, ...]
) -> Iterator[str]:
    yield from _held_faults(scene, u)
    # One denominator for all, so that the identities are between integers.
    bottom = u.denominator.lcm(f.denominator).lcm(g.denominator) * _given_denominator(scene)
    us, fs, gs = (_by_entry(v, bottom // v.denominator) for v in (u, f, g))
    normals, clear = _integer_normals(scene)
    _, which = scene.normals
    a, b = (ends.tolist() for ends in scene.ends)
    dimension = scene.dimension
    balance: list[Sum] = [{} for _ in us]
    for k, contact in enumerate(scene.contacts):
        name = f"contact {contact.a}-{contact.b}"
        force, gap = surd_sign(_terms(fs[k])), surd_sign(_terms(gs[k]))
        if force < 0 and not contact.bilateral:
            yield f"{name}: the force is negative"
        if gap < 0:
            yield f"{name}: the gap is negative"
        if force and gap:
            yield f"{name}: force and gap are both positive"
        if contact.bilateral and gap:
            yield f"{name}: a bilateral contact has a gap"
        if states and not contact.bilateral:
            state = "closed" if force else "open" if gap else "osculatory"
            if states[k] != state:
                yield f"{name}: called {states[k]}, but it is {state} in this solution"
        # g - o - c f - n . (u_a - u_b) = 0, all times the normals' common denominator.
        c = contact.compliance
        rest: Sum = {}
        _add(rest, gs[k], 1, clear * c.denominator)
        _add(rest, fs[k], 1, -clear * c.numerator)
        for r, x in contact.gap.terms:
            whole = bottom // x.denominator * (x.numerator * clear * c.denominator)
            _add(rest, {r: whole}, 1, -1)
        for axis, root, n in normals[int(which[k])]:
            i = a[k] * dimension + axis
            _add(rest, us[i], root, -n * c.denominator)
            _add(balance[i], fs[k], root, n)
            if b[k] >= 0:
                j = b[k] * dimension + axis
                _add(rest, us[j], root, n * c.denominator)
                _add(balance[j], fs[k], root, -n)
        if any(x != 0 for x in rest.values()):
            yield f"{name}: Hooke's law fails"
    for i, total in enumerate(balance):
        disc, axis = scene.discs[i // dimension], i % dimension
        if disc.held[axis] is None:
            for r, x in disc.load[axis].terms:
                _add(total, {r: bottom // x.denominator * (x.numerator * clear)}, 1, 1)
            if any(x != 0 for x in total.values()):
                yield f"disc {disc.id}: axis {axis} is not balanced"


def _held_faults(scene: Scene, u: ExactVector) -> Iterator[str]:
    dimension = scene.dimension
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            if held is not None and u[k * dimension + axis] != held:
                yield f"disc {disc.id}: axis {axis} is not where it is held"


def _collapse_faults(scene: Scene, collapse: ExactVector) -> Iterator[str]:
    u = collapse.plain()
    dimension = scene.dimension
    us = _by_entry(u, fmpz(1))
    common = _given_denominator(scene)
    work: Sum = {}
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            i = k * dimension + axis
            if held is not None and us[i]:
                yield f"disc {disc.id}: held along axis {axis}, but the collapse moves it"
            for r, x in disc.load[axis].terms if held is None else ():
                _add(work, us[i], r, x.numerator * (common // x.denominator))
    normals, _ = _integer_normals(scene)
    _, which = scene.normals
    a, b = scene.ends
    for k, contact in enumerate(scene.contacts):
        rate: Sum = {}
        for axis, root, n in normals[int(which[k])]:
            _add(rate, us[int(a[k]) * dimension + axis], root, n)
            if b[k] >= 0:
                _add(rate, us[int(b[k]) * dimension + axis], root, -n)
        sign = surd_sign(_terms(rate))
        if sign < 0 or (sign and contact.bilateral):
            yield f"contact {contact.a}-{contact.b}: the collapse would have to close it further"
    if surd_sign(_terms(work)) <= 0:
        yield "the load does no work on the collapse"


def _given_denominator(scene: Scene) -> int:
    """A common denominator of all loads and initial gaps."""
    given = {p.terms for disc in scene.discs for p in disc.load}
    given |= {contact.gap.terms for contact in scene.contacts if contact.gap}
    return lcm(*(x.denominator for terms in given for _, x in terms))


def _integer_normals(scene: Scene) -> tuple[list[list[tuple[int, int, int]]], int]:
    """For each different normal its terms (axis, radicand, integer), over one denominator."""
    normals, _ = scene.normals
    clear = lcm(*(x.denominator for n in normals for part in n for _, x in part.terms))
    return [
        [(axis, r, int(x * clear)) for axis, part in enumerate(n) for r, x in part.terms]
        for n in normals
    ], clear


def _by_entry(vector: ExactVector, factor: fmpz) -> list[Sum]:
    """Each entry as a sum, all times factor."""
    entries: list[Sum] = [{} for _ in range(len(vector))]
    for r, column in vector.numerators.items():
        for entry, x in zip(entries, column, strict=True):
            if x != 0:
                entry[r] = x * factor
    return entries


def _add(total: Sum, entry: Sum, root: int, factor: int | fmpz) -> None:
    """Add factor * sqrt(root) * entry to total."""
    for r, x in entry.items():
        common = gcd(r, root)
        at = r // common * (root // common)
        value = x * (factor * common)
        total[at] = total[at] + value if at in total else value


def _terms(entry: Sum) -> list[tuple[int, fmpz, int]]:
    return [(r, x, 1) for r, x in entry.items()]


def _residual(scene: Scene, solution: Solution) -> float:
    """The largest violation of a floating-point solution."""
    u, f, g = solution.displacement_array, solution.force_array, solution.gap_array
    normals, which = scene.normals
    n = np.array([[float(x) for x in normal] for normal in normals])[which]
    a, b = scene.ends
    relative = u[a] - np.where((b >= 0)[:, None], u[b], 0.0)
    c = np.array([float(contact.compliance) for contact in scene.contacts])
    o = np.array([float(contact.gap) if contact.gap else 0.0 for contact in scene.contacts])
    hooke = np.abs(g - o - c * f - (n * relative).sum(axis=1))
    balance = np.array([[float(p) for p in disc.load] for disc in scene.discs])
    np.add.at(balance, a, n * f[:, None])
    np.add.at(balance, b[b >= 0], -(n * f[:, None])[b >= 0])
    free = np.array([[h is None for h in disc.held] for disc in scene.discs])
    wanted = np.array([[float(h or Surd(())) for h in disc.held] for disc in scene.discs])
    held = np.abs(u - wanted)[~free]
    one_sided = np.array([not contact.bilateral for contact in scene.contacts])
    both = np.minimum(np.abs(f), np.abs(g))
    parts = [hooke, np.abs(balance)[free], held, -f[one_sided], -g, both]
    return float(max((part.max() for part in parts if part.size), default=0.0))
