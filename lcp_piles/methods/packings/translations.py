"""Motions that closed contacts leave free, and that can be read off a packing without arithmetic.

Along one axis, let contacts whose normal has a component there connect their discs. A group of
discs that neither a wall nor a held disc is connected to can be moved along the axis as one, which
changes no overlap of a closed contact, exactly: a disc on a level floor, a whole packing of a
period on it, a rattler that nothing loads. Where the loads on such a group add up to zero, one
freedom of it may be kept where it is, and balance along the others is balance along all.
"""

from __future__ import annotations

from math import fsum

import numpy as np
from scipy.sparse import coo_array, csr_array, hstack
from scipy.sparse.csgraph import connected_components

from ...numbers.vectors import FloatArray, IntArray, Mask
from ...packings.packing import Packing


def free_translations(packing: Packing, closed: Mask) -> csr_array:
    """Each a column of ones, shape (freedoms, translations).

    >>> from lcp_piles import packing
    >>> one = packing([(0, 1)], 1, supports={"floor": 0})
    >>> free_translations(one, np.array([True])).toarray().tolist()
    [[1.0], [0.0]]
    """
    discs = len(packing.ids)
    a, b = packing.a[closed], packing.b[closed]
    freedoms: list[IntArray] = [np.empty(0, dtype=np.int64)]
    groups: list[IntArray] = [np.empty(0, dtype=np.int64)]
    count = 0
    for axis in range(packing.dimension):
        # All that does not move is one node more.
        node = np.append(np.where(packing.held[:, axis], discs, np.arange(discs)), discs)
        there = packing.normals.high[closed, axis] != 0
        ends = node[a[there]], node[b[there]]  # the support, -1, is the last of all
        graph = coo_array((np.ones(len(ends[0])), ends), shape=(discs + 1, discs + 1))
        _, label = connected_components(graph, directed=False)
        loose = np.flatnonzero((label[:-1] != label[-1]) & ~packing.held[:, axis])
        names, number = np.unique(label[loose], return_inverse=True)
        freedoms.append(packing.free[loose, axis])
        groups.append(number + count)
        count += len(names)
    rows, columns = np.concatenate(freedoms), np.concatenate(groups)
    shape = (int((~packing.held).sum()), count)
    return csr_array((np.ones(len(rows)), (rows, columns)), shape=shape)


def driven(translations: csr_array, p: FloatArray) -> bool:
    """Whether the loads p (freedoms) on one of the translated groups do not add up to zero."""
    if not (p[np.diff(translations.indptr) > 0]).any():
        return False
    columns = translations.tocsc()
    groups = np.split(columns.indices, columns.indptr[1:-1])
    return any(fsum(p[group].tolist()) != 0 for group in groups)


def room(rates: csr_array, gaps: FloatArray) -> FloatArray | None:
    """How far each translation goes so that the least of the gaps + rates x is as large as can be.

    Gaps are those of the contacts that are open, `rates` (contacts, translations) their changes. No
    gap is made larger than the largest there is. None where there is no better place.
    """
    from scipy.optimize import linprog  # slow to import, seldom needed

    touched = np.diff(rates.indptr) > 0
    most = float(np.abs(gaps).max(initial=0.0))
    if not touched.any() or not most > 0:
        return None
    m, n = int(touched.sum()), rates.shape[1]
    found = linprog(
        np.append(np.zeros(n), -1.0),
        A_ub=hstack([-rates[touched], np.ones((m, 1))], format="csr"),
        b_ub=gaps[touched] / most,
        bounds=[(None, None)] * n + [(None, 1.0)],
        method="highs",
    )
    return found.x[:-1] * most if found.status == 0 and found.x[-1] > 0 else None


def pinned(translations: csr_array) -> IntArray:
    """One freedom of each translation."""
    columns = translations.tocsc()
    return np.asarray(columns.indices[columns.indptr[:-1]], dtype=np.int64)
