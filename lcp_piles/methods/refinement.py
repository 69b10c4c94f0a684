"""Displacements of a held pile, improved in floats against a residual that is exact.

The gaps B U + o of given U are computed in integers. The forces -(B U + o) / C of the springs are
rounded down to a fixed point of 2^-T, far behind the digits of floats, and what they leave
unbalanced is summed up in integers again. So it is known to within the rounding of the forces,
sum_k |B_kj| 2^-T at freedom j, however much cancels; compliances of any denominators will do.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import frexp, inf

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from ..errors import SolveError
from ..linear.integer_matrix import largest_entry
from ..linear.integer_product import times_words
from ..linear.springs import Springs
from ..mechanics.held_set import HeldSet
from ..mechanics.physical import in_units
from ..mechanics.system import ContactSystem
from ..numbers.exact import sqrt_of
from ..numbers.floats import LOST, UP
from ..numbers.vectors import ExactVector, FloatArray, IntArray

_SPARE = 110  # bits of the fixed points behind the size of the largest force
_ENOUGH = 2.0**-58  # what is left, relative to that: less than rounding of the results
_ROUNDS = 12
_DIGITS = 48  # bits of a step: fewer than floats have, so that B U of most scenes is int64


@dataclass(frozen=True, eq=False)
class Refined:
    """Gaps B U + o (w tau) of a U near the true one, exactly, and `rest`, a bound of |D r|.

    r is the unbalanced force (w) of U on every freedom, D the scaling of the springs.
    """

    gaps: ExactVector
    rest: float


def refined(held: HeldSet, gap: ExactVector, bound: Springs, r: int) -> Refined:
    """The displacements under the parts of gaps o and load on sqrt(r), as far as floats see.

    `bound` are the springs of the closed contacts; open contacts carry nothing.
    """
    data = _data(held, gap, r)
    strain = [fmpz(0)] * held.system.contacts
    gaps: list[fmpz] = []
    rest, step = inf, bound.solve(data.start[data.free])
    enough = _ENOUGH * bound.least * data.largest * float(bound.D.min(initial=1.0))
    for _ in range(_ROUNDS):
        if not np.isfinite(step).all():
            break
        tried = _strained(data, strain, step)
        new_gaps = _gaps(data, tried)
        force = _unbalanced(data, new_gaps)
        left = _norm(data, bound, force)
        if not left < rest:
            break
        strain, gaps, rest = tried, new_gaps, left
        step = bound.solve(force[data.free])
        if left <= enough:
            break
    if not rest < inf:
        raise SolveError("the displacements leave the range of floating point: use solve")
    return Refined(_physical_gaps(data, gaps), rest)


@dataclass(frozen=True, eq=False)
class _Data:
    """The parts of a held pile's gaps o and load p on sqrt(r), integers over `den`.

    U are integers over 2^bits, forces over 2^force_bits. `closed` lists for each closed contact its
    number, its row of B and the integers n, d of its compliance n / d; `free` the freedoms that are
    not pinned. `stretch` is the displacement (w tau) of U = 1 at every freedom, `rounding` the most
    that rounding the forces makes of the unbalanced force (w) there. `start` is the unbalanced
    force of U = 0 in floats, and `largest` the size of forces.
    """

    system: ContactSystem
    r: int
    den: fmpz
    gap: list[fmpz]
    load: list[fmpz]
    bits: int
    force_bits: int
    closed: list[tuple[int, list[tuple[int, int | fmpz]], int, int]]
    axis: IntArray
    free: list[int]
    stretch: FloatArray
    rounding: FloatArray
    start: FloatArray
    largest: float


def _data(held: HeldSet, initial: ExactVector, r: int) -> _Data:
    system = held.system
    den = initial.denominator.lcm(system.load.denominator)
    gap, load = (_over(vector, r, den) for vector in (initial, system.load))
    axis = system.reduction.axis
    root = float(sqrt_of(r))
    stretch = system.freedom_scale * root
    # Floats say how many bits are enough and where to start; none of this is a bound.
    B, C, _, _ = system.floats()
    o = in_units(ExactVector(_on(r, gap), den), system.gap_factor, system.factor_of)
    p = in_units(
        ExactVector(_on(r, load), den), tuple(1 / t for t in system.displacement_factor), axis
    )
    closed = np.flatnonzero(held.closed)
    B_closed = csr_array(B[closed])
    pull = o[closed] / C[closed]
    start = p - B_closed.T @ pull
    largest = max(float(np.abs(x).max(initial=0.0)) for x in (pull, p))
    spare = _SPARE - frexp(largest)[1]
    stiffest = frexp(
        float((1 / C[closed]).max(initial=1.0)) * float(system.freedom_scale.max(initial=1.0))
    )[1]
    row_bits = largest_entry(system.B).bit_length()
    bits = max(spare + stiffest, 0)
    force_bits = max(spare + row_bits, bits)
    values, which = system.compliances
    parts = [(c.numerator, c.denominator) for c in values]
    rows = held.equations.rows
    law = [(k, rows[k], *parts[which[k]]) for k in closed.tolist()]
    count = np.bincount(B_closed.indices, minlength=system.dof)
    # Each of the forces is less than 2^-force_bits too small, and |B| < 2^row_bits.
    rounding = np.ldexp(count, row_bits - force_bits) * (root / system.freedom_scale) * UP + LOST
    return _Data(
        system,
        r,
        den,
        gap,
        load,
        bits,
        force_bits,
        law,
        axis,
        held.equations.free,
        stretch,
        rounding,
        start,
        largest,
    )


def _strained(data: _Data, strain: list[fmpz], step: FloatArray) -> list[fmpz]:
    """B U over 2^bits after a step of the free freedoms (w tau), which is rounded."""
    whole = np.zeros(data.system.dof)
    whole[data.free] = step
    step = whole / data.stretch
    exponent = frexp(float(np.abs(step).max(initial=0.0)))[1]
    digits = np.rint(np.ldexp(step, _DIGITS - exponent)).astype(np.int64)
    shift = data.bits + exponent - _DIGITS
    if shift < 0:
        digits, shift = digits >> min(-shift, 63), 0
    change = times_words(data.system.B, digits)
    return [x + (y << shift) for x, y in zip(strain, change, strict=True)]


def _gaps(data: _Data, strain: list[fmpz]) -> list[fmpz]:
    """B U + o of every contact, over den 2^bits."""
    return [x * data.den + (o << data.bits) for x, o in zip(strain, data.gap, strict=True)]


def _unbalanced(data: _Data, gaps: list[fmpz]) -> FloatArray:
    """B^T lambda + p (w) of the forces of closed contacts, to a few units in the last place."""
    total = [p << data.force_bits for p in data.load]
    up = data.force_bits - data.bits
    for k, row, n, d in data.closed:
        force = -((gaps[k] * d << up) // (data.den * n)) * data.den
        for j, b in row:
            total[j] += force * b
    vector = ExactVector(_on(data.r, total), data.den << data.force_bits)
    return in_units(vector, tuple(1 / t for t in data.system.displacement_factor), data.axis)


def _physical_gaps(data: _Data, gaps: list[fmpz]) -> ExactVector:
    system = data.system
    bottom = data.den << data.bits
    return ExactVector(_on(data.r, gaps), bottom, system.gap_factor, system.factor_of)


def _norm(data: _Data, bound: Springs, force: FloatArray) -> float:
    """An upper bound of |D r|, r being within `rounding` and a few u of `force`."""
    with np.errstate(all="ignore"):
        sizes = bound.D * (np.abs(force) + data.rounding)[data.free]
        return float(np.linalg.norm(sizes)) * UP + LOST


def _over(vector: ExactVector, r: int, den: fmpz) -> list[fmpz]:
    """The numerators on sqrt(r) over another denominator."""
    up = den // vector.denominator
    return [x * up for x in vector.numerators.get(r, [fmpz(0)] * len(vector))]


def _on(r: int, numbers: list[fmpz]) -> dict[int, list[fmpz]]:
    return {1: [fmpz(0)] * len(numbers), r: numbers}
