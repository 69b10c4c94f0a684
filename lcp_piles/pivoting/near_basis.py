"""A basis of an LCP in floats with rigorous bounds, from nothing but the columns of M.

With A the basic z (z0 among them) and J the rows whose w is not basic, the values of the basic z
solve G x = -q_J, G = M_JA, and they change by G dx = -c_J while a z with the column c enters, or by
G dx = e_i while w_i does. G is known as floats with a bound of the error of every entry, and so are
c and q. With R a float inverse of G and F = 1 - R G,

    x - x' = (1 - F)^-1 R (b - G x'),   |x - x'| <= |d| + |d|_inf |F| / (1 - |F|),

for any x', d being R times the residual and |F| the norm of largest row sums; |F| < 1 proves that
G is regular. (Rump 2010, "Verification methods", Acta Numerica 19, section 10.) Every rounding is
in the bounds: a sum of m products in any order is off by at most m u / (1 - m u) times the sum of
their sizes. Nothing is carried from basis to basis, so bounds do not grow along a path.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..numbers.floats import ENTRY, LOST, UNIT, UP, Bounded, FloatArray
from .columns import cover_floats
from .doubt import in_doubt
from .lcp import LCP


class NearColumns:
    """Columns of M in floats with bounds, by variable, fetched when asked for; and d, and q."""

    def __init__(self, problem: LCP, d: Sequence[int]) -> None:
        self.size = len(problem)
        self.q = problem.q.plain().bounded()
        self._problem = problem
        cover, _ = cover_floats(d)
        self._place = {2 * self.size: 0}
        self._middle = cover[None, :]
        self._radius = np.abs(self._middle) * ENTRY + LOST

    def of(self, variables: Sequence[int]) -> Bounded:
        """The columns of some z, and of z0 in a unit of its own, side by side."""
        missing = [v for v in variables if v not in self._place]
        if missing:
            found = self._problem.bounded_columns([v - self.size for v in missing])
            for v in missing:
                self._place[v] = len(self._place)
            room = len(self._middle)
            if len(self._place) > room:
                more = np.zeros((max(room, len(self._place) - room, 16), self.size))
                self._middle = np.vstack([self._middle, more])
                self._radius = np.vstack([self._radius, more])
            at = [self._place[v] for v in missing]
            self._middle[at], self._radius[at] = found.middle, found.radius
        at = [self._place[v] for v in variables]
        return Bounded(self._middle[at].T, self._radius[at].T)


def first_to_leave(
    columns: NearColumns, active: list[int], left: list[int], entering: int
) -> list[int]:
    """The basic variables that could reach zero first while another enters.

    The basis has `active` basic z and the rows `left`, as many, and its values are >= 0. If there
    is but one, that is proved to reach zero, and before all others; there are none where floats
    tell nothing. (Of a ray they do not.)
    """
    step = near_step(columns, active, left, entering)
    if step is None:
        return []
    value, change = step
    n = columns.size
    basic = np.ones(len(value.middle), dtype=bool)
    basic[left] = False
    places = in_doubt(value, change, basic).tolist()
    if len(places) == 1 and not change.middle[places[0]] + change.radius[places[0]] < 0:
        return []
    return [k if k < n else active[k - n] for k in places]


def near_step(
    columns: NearColumns, active: list[int], left: list[int], entering: int
) -> tuple[Bounded, Bounded] | None:
    """Values, and changes a unit of the entering variable, of all w and then those of `active`.

    Of w that are not basic they mean nothing. None where the basis is not proved to be one.
    """
    n, size = columns.size, len(active)
    near = columns.of([*active, entering] if entering >= n else active)
    middle, radius = near.middle[:, :size], near.radius[:, :size]
    with np.errstate(all="ignore"):
        start, lost = np.zeros((n, 2)), np.zeros((n, 2))
        start[:, 0], lost[:, 0] = columns.q.middle, columns.q.radius
        if entering >= n:
            start[:, 1], lost[:, 1] = near.middle[:, size], near.radius[:, size]
        right = -start[left]
        if entering < n:
            right[left.index(entering), 1] = 1.0
        solved = _solution(middle[left], radius[left], right, lost[left])
        if solved is None:
            return None
        x, x_lost = solved
        w = start + middle @ x
        sizes = np.abs(x)
        w_lost = np.abs(middle) @ (x_lost + sizes * _rounding(size)) + radius @ (sizes + x_lost)
        w_lost = (w_lost + lost + np.abs(start) * (4 * UNIT)) * UP + LOST * (size + 1)
    values, bounds = np.vstack([w, x]), np.vstack([w_lost, x_lost])
    return Bounded(values[:, 0], bounds[:, 0]), Bounded(values[:, 1], bounds[:, 1])


def _solution(
    G: FloatArray, lost: FloatArray, b: FloatArray, b_lost: FloatArray
) -> tuple[FloatArray, FloatArray] | None:
    """X with G X = b and a bound of its error, where G and b are known to within bounds."""
    size = len(G)
    try:
        R = np.linalg.inv(G)
    except np.linalg.LinAlgError:
        return None
    rounding = _rounding(size)
    sizes, back = np.abs(G), np.abs(R)
    off = R @ G
    off[np.diag_indices(size)] -= 1.0
    beside = back @ (sizes.sum(axis=1) * rounding + lost.sum(axis=1) + LOST * size)
    norm = float((np.abs(off).sum(axis=1) * (1 + rounding) + beside).max()) * UP + 4 * UNIT
    if not norm < 0.5:
        return None
    x = R @ b
    x += R @ (b - G @ x)
    reach = np.abs(x)
    rest = np.abs(b - G @ x) * (1 + 4 * UNIT) + sizes @ (reach * rounding) + lost @ reach
    rest += b_lost + np.abs(b) * (4 * UNIT) + LOST * (size + 1)
    d = (back @ rest) * UP + LOST * size
    return x, (d + d.max(axis=0) * (norm / (1 - norm))) * UP


def _rounding(terms: int) -> float:
    """The relative error of a sum of products, and of a few more operations."""
    return (terms + 8) * UNIT * UP
