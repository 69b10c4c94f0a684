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

from ..errors import InputError
from ..numbers.exact import Surd, surd_sign
from ..numbers.vectors import ExactVector
from ..scenes.scene import Contact, Scene
from .solution import Solution, Solved

Columns = dict[int, list[fmpz]]
"""Sums of integers times square roots: for each radicand the integer of every entry."""
_PLAIN = {(1, 0, "closed"), (0, 1, "open"), (0, 0, "osculatory")}


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
        if len(solution.collapse) != sizes[0]:
            raise InputError("the size of the collapse", len(solution.collapse), f"{sizes[0]}")
        return _first(_collapse_faults(scene, solution.collapse), shown)
    u, f, g = solution.displacements, solution.forces, solution.gaps
    lengths = (len(u), len(f), len(g))
    if lengths != (sizes[0], sizes[1], sizes[1]):
        raise InputError("the sizes of u, f and g", lengths, f"{(sizes[0], sizes[1], sizes[1])}")
    if len(solution.states) != sizes[1]:
        raise InputError("the number of states", len(solution.states), f"{sizes[1]}")
    if isinstance(u, ExactVector) and isinstance(f, ExactVector) and isinstance(g, ExactVector):
        return _first(_faults(scene, u.plain(), f.plain(), g.plain(), solution.states), shown)
    return Verification(False, (), _residual(scene, solution))


def _first(faults: Iterator[str], shown: int) -> Verification:
    return Verification(True, tuple(fault for fault, _ in zip(faults, range(shown), strict=False)))


def _faults(
    scene: Scene, u: ExactVector, f: ExactVector, g: ExactVector, states: tuple[str, ...]
) -> Iterator[str]:
    yield from _held_faults(scene, u)
    forces, gaps = f.signs(), g.signs()
    for k, seen in enumerate(zip(forces, gaps, states, strict=True)):
        if seen not in _PLAIN:
            contact = scene.contacts[k]
            for fault in _sign_faults(contact, *seen):
                yield f"contact {contact.a}-{contact.b}: {fault}"
    # One denominator for all, so that the identities are between integers; `clear` times it.
    bottom = u.denominator.lcm(f.denominator).lcm(g.denominator) * _given_denominator(scene)
    us, fs, gs = (_over(v, bottom) for v in (u, f, g))
    stretch, pulled, clear = _geometry(scene, us, fs)
    hooke = _hooke(scene, fs, gs, stretch, bottom, clear)
    for k in _not_zero(hooke):
        contact = scene.contacts[k]
        yield f"contact {contact.a}-{contact.b}: Hooke's law fails"
    dimension = scene.dimension
    loads: dict[int, fmpz] = {}  # most discs share the objects of their loads
    for k, disc in enumerate(scene.discs):
        for axis, (held, load) in enumerate(zip(disc.held, disc.load, strict=True)):
            for r, x in load.terms if held is None else ():
                if id(x) not in loads:
                    loads[id(x)] = bottom // x.denominator * (x.numerator * clear)
                column = pulled.setdefault(r, [fmpz(0)] * (len(scene.discs) * dimension))
                column[k * dimension + axis] += loads[id(x)]
    for place in _not_zero(pulled):
        disc, axis = scene.discs[place // dimension], place % dimension
        if disc.held[axis] is None:
            yield f"disc {disc.id}: axis {axis} is not balanced"


def _not_zero(columns: Columns) -> list[int]:
    """Where any of the columns is not zero."""
    return sorted({k for column in columns.values() for k, x in enumerate(column) if x != 0})


def _sign_faults(contact: Contact, force: int, gap: int, named: str) -> Iterator[str]:
    if gap < 0:
        yield "the gap is negative"
    if force and gap:
        yield "neither force nor gap is zero"
    if contact.bilateral:
        return
    if force < 0:
        yield "the force is negative"
    state = "closed" if force else "open" if gap else "osculatory"
    if named != state:
        yield f"called {named}, but it is {state} in this solution"


def _over(vector: ExactVector, bottom: fmpz) -> Columns:
    up = bottom // vector.denominator
    if up == 1:
        return vector.numerators
    return {r: [x * up for x in column] for r, column in vector.numerators.items()}


def _geometry(scene: Scene, us: Columns, fs: Columns | None) -> tuple[Columns, Columns, int]:
    """N . (u_a - u_b) of every contact and sum n f of every disc and axis, times an integer.

    That integer clears the denominators of the normals, and comes third. The forces may be left
    out, and the sums are empty then.
    """
    normals, which = scene.normals
    clear = lcm(*(x.denominator for n in normals for part in n for _, x in part.terms))
    a, b = scene.ends
    dimension = scene.dimension
    zero = fmpz(0)
    stretch: Columns = {1: [zero] * len(scene.contacts)}
    sums: Columns = {1: [zero] * (len(scene.discs) * dimension)}
    for axis in range(dimension):
        first = (a * dimension + axis).tolist()
        # A support does not move: its place is one past the end, where a zero stands.
        second = np.where(b >= 0, b * dimension + axis, -1).tolist()
        for root in sorted({r for n in normals for r, _ in n[axis].terms}):
            parts = [int(dict(n[axis].terms).get(root, 0) * clear) for n in normals]
            weight = [parts[n] for n in which.tolist()]
            for r, column in us.items():
                if not any(column[axis::dimension]):
                    continue
                at, factor = _product(r, root)
                total = stretch.setdefault(at, [zero] * len(weight))
                moved = [*column, zero]
                stretch[at] = [
                    t + (moved[i] - moved[j]) * (n * factor)
                    for t, i, j, n in zip(total, first, second, weight, strict=True)
                ]
            for r, column in (fs or {}).items():
                at, factor = _product(r, root)
                total = [*sums.setdefault(at, [zero] * (len(scene.discs) * dimension)), zero]
                for i, j, n, x in zip(first, second, weight, column, strict=True):
                    if n and x != 0:
                        pull = x * (n * factor)
                        total[i] += pull
                        total[j] -= pull
                sums[at] = total[:-1]
    return stretch, sums, clear


def _hooke(
    scene: Scene, fs: Columns, gs: Columns, stretch: Columns, bottom: fmpz, clear: int
) -> Columns:
    """(g - o - c f) - n . (u_a - u_b) of every contact, up to positive factors."""
    soft = [contact.compliance.denominator for contact in scene.contacts]
    hard = [contact.compliance.numerator for contact in scene.contacts]
    zero = [fmpz(0)] * len(soft)
    rest: Columns = {}
    for r in {*fs, *gs, *stretch}:
        columns = (stretch.get(r, zero), fs.get(r, zero), gs.get(r, zero), soft, hard)
        rest[r] = [
            (g * clear - s) * d - x * (n * clear) for s, x, g, d, n in zip(*columns, strict=True)
        ]
    for k, contact in enumerate(scene.contacts):
        for r, x in contact.gap.terms:
            column = rest.setdefault(r, list(zero))
            column[k] -= bottom // x.denominator * (x.numerator * clear * soft[k])
    return rest


def _product(r: int, s: int) -> tuple[int, int]:
    """(t, k) with sqrt(r) sqrt(s) = k sqrt(t) and t square-free."""
    common = gcd(r, s)
    return r // common * (s // common), common


def _held_faults(scene: Scene, u: ExactVector) -> Iterator[str]:
    dimension = scene.dimension
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            if held is not None and u[k * dimension + axis] != held:
                yield f"disc {disc.id}: axis {axis} is not where it is held"


def _collapse_faults(scene: Scene, collapse: ExactVector) -> Iterator[str]:
    us = collapse.plain().numerators
    dimension = scene.dimension
    common = _given_denominator(scene)
    work: dict[int, fmpz] = {}
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            moves = {r: column[k * dimension + axis] for r, column in us.items()}
            if held is not None and any(x != 0 for x in moves.values()):
                yield f"disc {disc.id}: held along axis {axis}, but the collapse moves it"
            for s, p in disc.load[axis].terms if held is None else ():
                for r, x in moves.items():
                    at, factor = _product(r, s)
                    load = p.numerator * (common // p.denominator) * factor
                    work[at] = work.get(at, fmpz(0)) + x * load
    stretch, _, _ = _geometry(scene, us, None)
    for k, contact in enumerate(scene.contacts):
        sign = surd_sign([(r, column[k], 1) for r, column in stretch.items()])
        if sign < 0 or (sign and contact.bilateral):
            yield f"contact {contact.a}-{contact.b}: the collapse would have to close it further"
    if surd_sign([(r, x, 1) for r, x in work.items()]) <= 0:
        yield "the load does no work on the collapse"


def _given_denominator(scene: Scene) -> int:
    """A common denominator of all loads and initial gaps."""
    given = {id(p): p for disc in scene.discs for p in disc.load}
    given |= {id(contact.gap): contact.gap for contact in scene.contacts}
    return lcm(*(x.denominator for p in given.values() for _, x in p.terms))


def _residual(scene: Scene, solution: Solved) -> float:
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
