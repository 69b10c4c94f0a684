"""Rows of B that are independent, shown by elimination modulo a prime that anyone can repeat.

A minor that is not zero modulo a prime is not zero. The prime is one modulo which the square roots
of the scene are integers, so that the elimination can be done on its normals as they are. Here it
is done on the integer matrix of the rational gauge, whose rows and columns differ by factors only.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from itertools import pairwise

import numpy as np
from scipy.sparse import csc_array, csr_array, eye_array

from ..errors import SolveError
from ..files.hex_vectors import hexadecimal
from ..files.json_fields import Entry
from ..linear.factors import sparse_factors
from ..linear.integer_matrix import IntegerMatrix, entries
from ..numbers.roots import smallest_prime
from ..numbers.vectors import IntArray

_FIRST = 2**30 - 1  # primes below it: digits of Python's integers
_PRIMES = 20  # that are tried before giving up; a single one may divide a minor by bad luck


@dataclass(frozen=True)
class Elimination:
    """Pivots (row, column) in the order in which they were found, and the work that they took."""

    pivots: list[tuple[int, int]]
    work: int


def rank_entry(rows: IntegerMatrix, rank: int, radicands: Sequence[int], motions: int = 0) -> Entry:
    """The proof that so many rows are independent; the last ones, `motions`, are taken last."""
    for modulus, roots in _moduli(radicands):
        found = min(
            (_eliminated(rows, order, modulus, motions) for order in _orders(rows)),
            key=lambda elimination: elimination.work,
        )
        if len(found.pivots) == rank:
            flat = hexadecimal(x for pivot in found.pivots for x in pivot)
            named = {str(q): x for q, x in roots.items()}
            return {"modulus": modulus, "roots": named, "pivots": flat}
    raise SolveError(f"no {rank} independent rows were found modulo {_PRIMES} primes")


def _moduli(radicands: Sequence[int]) -> Iterator[tuple[int, dict[int, int]]]:
    """Primes p = 3 mod 4 with roots of all prime factors of the radicands."""
    factors = set()
    for r in radicands:
        while r > 1:
            factors.add(q := smallest_prime(r))
            r //= q
    found = 0
    p = _FIRST
    while found < _PRIMES:
        p -= 4
        if smallest_prime(p) == p:
            roots = {q: pow(q, (p + 1) // 4, p) for q in sorted(factors)}
            if all(x * x % p == q for q, x in roots.items()):
                found += 1
                yield p, roots


def _orders(rows: IntegerMatrix) -> Iterator[IntArray]:
    """Orders of the columns that leave little to do: from the ground up, and of least degree."""
    count = rows.shape[1]
    yield np.arange(count)[::-1].copy()
    if count:
        ones = np.ones(len(rows.indices))
        pattern = csr_array((ones, rows.indices, rows.indptr), shape=rows.shape)
        gram = csc_array(pattern.T @ pattern + rows.shape[0] * count * eye_array(count))
        yield np.array(sparse_factors(gram, symmetric=True).perm_c, dtype=np.int64)


def _eliminated(rows: IntegerMatrix, order: IntArray, modulus: int, motions: int) -> Elimination:
    """Row by row, each from its first column in the order on; a row that vanishes is left out."""
    place = order.tolist()
    column = np.argsort(order).tolist()
    data, indices = entries(rows), rows.indices.tolist()
    spans = list(pairwise(rows.indptr.tolist()))
    turn: dict[int, dict[int, int]] = {}
    pivots, work = [], 0
    first = [min((place[j] for j in indices[a:b]), default=0) for a, b in spans]
    for k in sorted(range(len(spans)), key=lambda k: (k >= len(spans) - motions, first[k])):
        span = range(*spans[k])
        row = {place[indices[i]]: int(data[i]) % modulus for i in span}
        heap = list(row)
        heapify(heap)
        while heap:
            j = heappop(heap)
            x = row.pop(j, 0)
            if x and j not in turn:
                over = pow(x, -1, modulus)
                turn[j] = {d: y * over % modulus for d, y in row.items() if y}
                pivots.append((k, column[j]))
                break
            kept = turn[j] if x else {}
            work += len(kept)
            for d, y in kept.items():
                if d not in row:
                    heappush(heap, d)
                row[d] = (row.get(d, 0) - x * y) % modulus
    return Elimination(pivots, work)
