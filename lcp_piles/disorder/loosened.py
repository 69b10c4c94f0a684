"""A proposal that ends against a stop, moved off it.

Free motions leave a pile somewhere between the contacts that stop them. Where floating point left
it at a stop, the gap of an open contact is too near zero to be told from it, or a contact that
carries nothing counts as closed. Such contacts are opened, and the displacements moved along the
free motions to where the least gap is largest: a small linear programme.
"""

from __future__ import annotations

import numpy as np

from ..numbers.vectors import FloatArray, IntArray, Mask
from .family import Integers


def loosened(
    integers: Integers, motions: IntArray, open_: Mask, gaps: FloatArray, U: FloatArray
) -> FloatArray | None:
    """Displacements (w tau) with wider gaps of the open contacts; None where there are none.

    `motions` are integers, one a column, of which B sees only open contacts; `gaps` (w tau) go with
    the displacements U.
    """
    from scipy.optimize import linprog  # slow to import

    rates = (integers.B @ motions)[open_] * integers.gap[open_, None]
    size = np.abs(rates).max(axis=0, initial=0.0)
    if not (size > 0).any():
        return None
    rates = rates[:, size > 0] / size[size > 0]
    g = gaps[open_]
    # Maximise t with gaps of at least t, which is no more than most of them have already.
    count = rates.shape[1]
    cost = np.append(np.zeros(count), -1.0)
    table = np.column_stack([-rates, np.ones(len(g))])
    bounds = [(None, None)] * count + [(None, float(np.median(g)))]
    found = linprog(cost, table, g, bounds=bounds, method="highs")
    if not found.success or not found.x[-1] > 0:
        return None
    amounts = found.x[:-1] / size[size > 0]
    moved: FloatArray = U + (motions[:, size > 0] @ amounts) * integers.freedom
    return moved
