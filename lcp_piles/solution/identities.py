"""The identities of a solution, from the scene alone.

Nothing of the solver is used: no gauge, no symmetry, no linear system. Balance, Hooke's law, signs
and complementarity are evaluated contact by contact and disc by disc, exactly.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import lcm

import numpy as np
from flint import fmpz

from ..numbers.exact import surd_sign
from ..numbers.roots import root_product
from ..numbers.vectors import ExactVector
from ..scenes.scene import Contact, Scene

Columns = dict[int, list[fmpz]]
"""Sums of integers times square roots: for each radicand the integer of every entry."""
_PLAIN = {(1, 0, "closed"), (0, 1, "open"), (0, 0, "osculatory")}


def identity_faults(
    scene: Scene, u: ExactVector, f: ExactVector, g: ExactVector, states: tuple[str, ...]
) -> Iterator[str]:
    """Every identity that displacements, forces, gaps and states fail, in words.

    The sizes have to fit the scene.
    """
    u, f, g = u.plain(), f.plain(), g.plain()
    yield from _held_faults(scene, u)
    forces, gaps = f.signs(), g.signs()
    for k, seen in enumerate(zip(forces, gaps, states, strict=True)):
        contact = scene.contacts[k]
        if seen not in _PLAIN or (contact.bilateral and seen[1]):
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
    if gap and contact.bilateral:
        yield "held closed, but it has a gap"
    if force < 0 and not contact.bilateral:
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
                factor, at = root_product(r, root)
                total = stretch.setdefault(at, [zero] * len(weight))
                moved = [*column, zero]
                stretch[at] = [
                    t + (moved[i] - moved[j]) * (n * factor)
                    for t, i, j, n in zip(total, first, second, weight, strict=True)
                ]
            for r, column in (fs or {}).items():
                factor, at = root_product(r, root)
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


def _held_faults(scene: Scene, u: ExactVector) -> Iterator[str]:
    dimension = scene.dimension
    for k, disc in enumerate(scene.discs):
        for axis, held in enumerate(disc.held):
            if held is not None and u[k * dimension + axis] != held:
                yield f"disc {disc.id}: axis {axis} is not where it is held"


def gaps_of(scene: Scene, u: ExactVector, f: ExactVector) -> ExactVector:
    """The gaps g = n . (u_a - u_b) + o + c f that displacements and forces make, one a contact.

    >>> from lcp_piles import nt60, solve
    >>> solved = solve(nt60(3))
    >>> list(gaps_of(solved.scene, solved.displacements, solved.forces)) == list(solved.gaps)
    True
    """
    u, f = u.plain(), f.plain()
    bottom = u.denominator.lcm(f.denominator) * _given_denominator(scene)
    stretch, _, clear = _geometry(scene, _over(u, bottom), None)
    soft = lcm(*(c.denominator for c in {contact.compliance for contact in scene.contacts}))
    gaps = {r: [x * soft for x in column] for r, column in stretch.items()}
    zero = [fmpz(0)] * len(scene.contacts)
    for r, column in _over(f, bottom).items():
        terms = zip(gaps.get(r, zero), column, scene.contacts, strict=True)
        gaps[r] = [g + x * (int(c.compliance * soft) * clear) if x != 0 else g for g, x, c in terms]
    for k, contact in enumerate(scene.contacts):
        for r, o in contact.gap.terms:
            up = bottom // o.denominator * (o.numerator * clear * soft)
            gaps.setdefault(r, list(zero))[k] += up
    return ExactVector(gaps, bottom * clear * soft)


def collapse_faults(scene: Scene, collapse: ExactVector) -> Iterator[str]:
    """Every condition that a collapse motion fails, in words.

    It may close no contact, move nothing that is held, and the load has to do work on it.
    """
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
                    factor, at = root_product(r, s)
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
