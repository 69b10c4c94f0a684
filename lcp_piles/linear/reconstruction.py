"""From the digits of a lifting to fractions: one common denominator, by continued fractions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from flint import fmpz

from ..numbers.vectors import IntArray

SLACK = 40
"""Bits beyond those of a fraction that have to be there before it is believed."""


def reconstruct(
    digits: Sequence[IntArray], den: fmpz, bits: int, shift: int
) -> tuple[list[fmpz], fmpz] | None:
    """Numerators over one denominator of the vector sum_k digits[k] 2^(-shift k), to be proved.

    `bits` of it are behind the point, and `den` is the denominator, or part of it, such as that of
    a combination of its entries. None where more digits are needed.
    """
    numerators: list[fmpz] = []
    modulus = fmpz(1) << bits
    half = modulus >> 1
    near = fmpz(1) << (den.bit_length() + SLACK // 2)
    for value in joined(digits, shift):
        scaled = den * value
        numerator, rest = divmod(scaled + half, modulus)
        if not -near < rest - half < near:
            extra = denominator(scaled, bits)
            if extra is None:
                return None
            numerators = [x * extra for x in numerators]
            den = den * extra
            near = fmpz(1) << (den.bit_length() + SLACK // 2)
            numerator = (den * value + half) >> bits
        numerators.append(numerator)
    return numerators, den


def joined(digits: Sequence[IntArray], shift: int) -> list[fmpz]:
    """sum_k digits[k] 2^(shift (last - k)) for each entry, through bytes rather than sums."""
    table = np.array(digits[::-1])  # least significant first
    size = shift // 8
    carry = np.zeros(table.shape[1], dtype=np.int64)
    mask = np.int64((1 << shift) - 1)
    packed = np.empty((table.shape[1], len(table) * size + 8), dtype=np.uint8)
    for k, row in enumerate(table):
        total = row + carry
        carry = total >> shift
        low = np.ascontiguousarray(total & mask).astype("<i8").view(np.uint8).reshape(-1, 8)
        packed[:, k * size : (k + 1) * size] = low[:, :size]
    packed[:, len(table) * size :] = carry.astype("<i8").view(np.uint8).reshape(-1, 8)
    return [fmpz(int.from_bytes(row.tobytes(), "little", signed=True)) for row in packed]


def denominator(value: fmpz, bits: int) -> fmpz | None:
    """The q of the fraction p/q nearest to value / 2^bits, if it stands out; else None.

    Continued fractions: a convergent p/q of a rational with numerator and denominator well below
    2^(bits/2) is followed by a huge partial quotient, which is how it is known.
    """
    limit = fmpz(1) << max((bits - SLACK) // 2, 0)
    a, b = fmpz(1) << bits, value % (fmpz(1) << bits)
    q_before, q = fmpz(0), fmpz(1)
    while b != 0:
        quotient, rest = divmod(a, b)
        following = quotient * q + q_before
        if following > limit:
            return q if quotient.bit_length() > SLACK // 2 else None
        q_before, q = q, following
        a, b = b, rest
    return q
