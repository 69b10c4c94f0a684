"""Vectors of exact numbers: integers over one common denominator.

Every exact result of the package is one of these until somebody reads an entry. One denominator
for all entries is what makes exact linear algebra fast: the determinant of the system stands once
instead of once an entry, and nothing is ever reduced by a greatest common divisor before it is
read.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import lcm
from typing import Any, TypeVar

import numpy as np
from flint import fmpz
from scipy.sparse import csr_array

from .exact import Exact, surd
from .floats import LOST, UNIT, Bounded, if_safe, quotients
from .floats import FloatArray as FloatArray
from .roots import root_product, surd_sign
from .surds import ONE, ZERO, Surd

IntArray = np.ndarray[Any, np.dtype[np.int64]]
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]
T = TypeVar("T", bound=Hashable)


@dataclass(frozen=True, eq=False, repr=False)
class ExactVector:
    """Exact numbers v_i = factors[factor_of[i]] * sum_r sqrt(r) numerators[r][i] / denominator.

    `numerators` maps each square-free radicand r to integers (1 always among them); the
    denominator is positive, and so is every factor: signs are those of the sums.

    >>> v = exact_vector(["1/2", "sqrt(3)", 0])
    >>> v[1], [str(x) for x in v], v.signs(), v.array().round(3).tolist()
    (Surd('sqrt(3)'), ['1/2', 'sqrt(3)', '0'], [1, 1, 0], [0.5, 1.732, 0.0])
    """

    numerators: dict[int, list[fmpz]]
    denominator: fmpz
    factors: tuple[Surd, ...] = (ONE,)
    factor_of: IntArray | None = None

    def __repr__(self) -> str:
        return f"<ExactVector of {len(self)} entries>"

    def __len__(self) -> int:
        return len(self.numerators[1])

    def __getitem__(self, i: int) -> Surd:
        """Entry i in lowest terms."""
        den = int(self.denominator)
        sum_ = Surd(
            tuple(
                (r, Fraction(int(column[i]), den))
                for r, column in sorted(self.numerators.items())
                if column[i] != 0
            )
        )
        return self.factor(i) * sum_ if sum_ else sum_

    def __iter__(self) -> Iterator[Surd]:
        return (self[i] for i in range(len(self)))

    def factor(self, i: int) -> Surd:
        """The factor of entry i."""
        return self.factors[0 if self.factor_of is None else int(self.factor_of[i])]

    def signs(self) -> list[int]:
        """-1, 0 or 1 for each entry, exactly. The list is shared: do not write."""
        return self._signs

    @cached_property
    def _signs(self) -> list[int]:
        if len(self.numerators) == 1:
            return [(x > 0) - (x < 0) for x in self.numerators[1]]
        parts = list(self.numerators.items())
        signs = [[(x > 0) - (x < 0) for x in column] for _, column in parts]
        # Parts of one sign do not cancel.
        return [
            least or most
            if least == 0 or most == 0 or least == most
            else surd_sign([(r, column[i], 1) for r, column in parts])
            for i, (least, most) in enumerate(zip(map(min, *signs), map(max, *signs), strict=True))
        ]

    def array(self) -> FloatArray:
        """The entries as floats, each rounded a few times, infinite beyond the range of floats.

        With R radicands an entry x that is not zero comes out within (R + 8) 2^-53 |x|, or, below
        the range of normal floats, within 2^-1074; zero comes out as zero.
        """
        columns = self.numerators.items()
        parts = np.array([quotients(x, self.denominator, r) for r, x in columns])
        scales = np.array([if_safe(float(f)) for f in self.factors])
        spread = scales[0] if self.factor_of is None else scales[self.factor_of]
        with np.errstate(all="ignore"):  # what overflows or loses digits is not safe
            values: FloatArray = parts.sum(axis=0) * spread
        # What is not safe, and terms of both signs, which may cancel, exact arithmetic rounds.
        unsafe = ~np.isfinite(values) | ((parts.min(axis=0) < 0) & (parts.max(axis=0) > 0))
        for i in np.flatnonzero(unsafe).tolist():
            values[i] = float(self[i])
        return values

    def bounded(self) -> Bounded:
        """The entries as floats, with bounds of their errors."""
        middle = self.array()
        return Bounded(middle, np.abs(middle) * ((len(self.numerators) + 9) * UNIT) + LOST)

    def plain(self) -> ExactVector:
        """The same numbers without factors: every root is among the radicands."""
        if self.factors == (ONE,):
            return self
        terms = [dict(factor.terms) for factor in self.factors]
        common = fmpz(lcm(*(c.denominator for factor in terms for c in factor.values())))
        which = [0] * len(self) if self.factor_of is None else self.factor_of.tolist()
        zero = fmpz(0)
        numerators: dict[int, list[fmpz]] = {}
        # Long integers are shared, not copied, wherever nothing is done to them.
        for s in {root for factor in terms for root in factor}:
            own = [factor.get(s, Fraction(0)) for factor in terms]
            scale = [fmpz(c.numerator) * (common // c.denominator) for c in own]
            for r, column in self.numerators.items():
                factor, root = root_product(r, s)
                times = [k * factor for k in scale]
                part = [
                    x if times[f] == 1 else x * times[f] if times[f] != 0 else zero
                    for x, f in zip(column, which, strict=True)
                ]
                total = numerators.get(root)
                if total:
                    part = [
                        x + y if x != 0 and y != 0 else y if x == 0 else x
                        for x, y in zip(total, part, strict=True)
                    ]
                numerators[root] = part
        numerators.setdefault(1, [zero] * len(self))
        return ExactVector(numerators, self.denominator * common)

    def spread(self, matrix: csr_array) -> ExactVector:
        """The product of an integer matrix and a vector that has no factors."""
        plain = self.plain()
        starts, columns, entries = (
            part.tolist() for part in (matrix.indptr, matrix.indices, matrix.data)
        )
        zero = fmpz(0)

        def entry(column: list[Any], first: int, last: int) -> Any:
            if last == first:
                return zero
            if last == first + 1 and entries[first] == 1:
                return column[columns[first]]  # shared, not copied
            total = zero
            for k in range(first, last):
                total = total + column[columns[k]] * entries[k]
            return total

        numerators = {
            r: [entry(column, *ends) for ends in pairwise(starts)]
            for r, column in plain.numerators.items()
        }
        return ExactVector(numerators, plain.denominator)

    def take(
        self, indices: Sequence[int] | IntArray, signs: Sequence[int] | IntArray
    ) -> ExactVector:
        """The vector of signs[k] * v[indices[k]]; a sign of 0 makes the entry zero."""
        places, moved = np.asarray(indices).tolist(), np.asarray(signs)
        zero = fmpz(0)
        if (moved == 1).all():
            numerators = {r: [x[i] for i in places] for r, x in self.numerators.items()}
        else:
            pairs = list(zip(places, moved.tolist(), strict=True))
            numerators = {
                r: [column[i] if s == 1 else -column[i] if s else zero for i, s in pairs]
                for r, column in self.numerators.items()
            }
        factor_of = None if self.factor_of is None else self.factor_of[np.asarray(indices)]
        return ExactVector(numerators, self.denominator, self.factors, factor_of)


def exact_vector(values: Sequence[Exact]) -> ExactVector:
    """An ExactVector of the numbers given (anything that `surd` takes)."""
    numbers = [ZERO if value is ZERO else surd(value) for value in values]
    den = fmpz(1)
    radicands = {1}
    for number in numbers:
        for r, c in number.terms:
            radicands.add(r)
            den = den.lcm(fmpz(c.denominator))
    numerators = {r: [fmpz(0)] * len(numbers) for r in sorted(radicands)}
    for i, number in enumerate(numbers):
        for r, c in number.terms:
            numerators[r][i] = fmpz(c.numerator) * (den // c.denominator)
    return ExactVector(numerators, den)


def combination(parts: Sequence[tuple[Surd, ExactVector]]) -> ExactVector:
    """The sum of c v over pairs (c, v); the vectors have the same factors.

    >>> one, two = exact_vector([1, 2]), exact_vector(["sqrt(3)", 0])
    >>> [str(x) for x in combination([(surd("1/2"), one), (surd("sqrt(3)"), two)])]
    ['7/2', '1']
    """
    den = fmpz(1)
    for c, v in parts:
        den = den.lcm(v.denominator * lcm(*(x.denominator for _, x in c.terms)))
    model = parts[0][1]
    numerators: dict[int, list[fmpz]] = {}
    for c, v in parts:
        for s, x in c.terms:
            for r, column in v.numerators.items():
                factor, root = root_product(r, s)
                up = den // v.denominator // x.denominator * (x.numerator * factor)
                total = numerators.get(root)
                # Long integers are shared, not multiplied, wherever nothing is done to them.
                if total is None:
                    numerators[root] = column if up == 1 else [up * y for y in column]
                elif up == 1:
                    numerators[root] = [t + y for t, y in zip(total, column, strict=True)]
                elif up == -1:
                    numerators[root] = [t - y for t, y in zip(total, column, strict=True)]
                else:
                    numerators[root] = [
                        t + up * y if y else t for t, y in zip(total, column, strict=True)
                    ]
    numerators.setdefault(1, [fmpz(0)] * len(model))
    return ExactVector(numerators, den, model.factors, model.factor_of)


def content(values: Sequence[fmpz], start: fmpz) -> fmpz:
    """Greatest common divisor of `start` and all values, stopping as soon as it is one."""
    common = abs(start)
    for value in values:
        if common == 1:
            break
        if value != 0:
            common = common.gcd(value)
    return common


def distinct(values: Sequence[T]) -> tuple[list[T], IntArray]:
    """The different values in order, and which of them each is; an object is hashed once.

    Exact numbers are slow to hash, and thousands of contacts share the objects of a few.

    >>> distinct(["a", "b", "a"])[0]
    ['a', 'b']
    """
    by_object = {id(x): x for x in values}
    number: dict[T, int] = {}
    of_object = {key: number.setdefault(x, len(number)) for key, x in by_object.items()}
    return list(number), np.array([of_object[id(x)] for x in values], dtype=np.int64)
