"""Projected Gauss-Seidel on contact forces: the kernel of contact dynamics, in floating point.

Jean (1999), "The non-smooth contact dynamics method", Comput. Methods Appl. Mech. Engrg. 177;
Jourdan, Alart and Jean (1998), "A Gauss-Seidel like algorithm". One implicit time step of length h
from the state U_n at rest, with one unit of mass for every freedom, asks for

    U = U_n + h^2 (p + B^T lambda),  gap = B U + o + C lambda,  0 <= lambda, gap, lambda . gap = 0,

an LCP in lambda with the matrix C + h^2 B B^T (Delassus). Contact by contact

    lambda_k <- max(0, lambda_k - gap_k / (C_k + h^2 |B_k|^2)),

and U is not solved for but kept as the sum of what the forces did to it. After some sweeps the next
step starts at rest from where U is: implicit Euler with all kinetic energy taken out, which is the
proximal-point method on the energy of the pile and ends where p + B^T lambda = 0. Contacts that
share no freedom are swept together, a colour at a time, which changes the order and not the method.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from ..mechanics.system import ContactSystem
from ..numbers.vectors import IntArray
from .float_state import FloatState
from .method import Method, Outcome, Progress, float_outcome


def gauss_seidel(
    system: ContactSystem,
    *,
    tolerance: float = 1e-8,
    max_sweeps: int = 20_000,
    sweeps_per_step: int = 4,
    stiffness: float = 6.0,
    dtype: Any = np.float64,
) -> FloatState:
    """Forces of a contact system by projected Gauss-Seidel, from the undisplaced pile.

    Steps are sweeps. The gaps of the last iterate are negative by what is left, and the residual
    is the larger of the unbalanced force and the error of complementarity |min(lambda_k, gap_k /
    C)|, C the largest compliance (1 if all are rigid), over the largest force or load.

    Parameters: `tolerance` on the residual; `max_sweeps` over all contacts; `sweeps_per_step`,
    before the next time step; `stiffness`, h^2 times the stiffness of the softest contact; `dtype`,
    float64 or float32. Rigid contacts are allowed, they are what the method was made for.

    >>> from lcp_piles import contact_system, nt60
    >>> gauss_seidel(contact_system(nt60(4))).converged
    True
    """
    sparse, C, o, p = (x.astype(dtype) for x in system.floats())
    B = csr_array(sparse)
    softest = dtype(np.abs(C).max(initial=0.0) or 1.0)
    square_h = dtype(stiffness * float(softest))
    delassus = C + square_h * np.asarray((B * B).sum(axis=1)).ravel()
    delassus[delassus == 0] = np.inf  # a rigid contact that nothing moves keeps its gap
    colours = [
        (members, rows, csr_array(rows.T))
        for members in _colours(B)
        for rows in (csr_array(B[members]),)
    ]
    before = np.zeros(len(p), dtype=dtype)
    U = before + square_h * p
    forces = np.zeros(len(o), dtype=dtype)
    sweeps = 0
    while True:
        for members, rows, columns in colours:
            old = forces[members]
            gap = rows @ U + o[members] + C[members] * old
            new = old - gap / delassus[members]
            new = np.where(system.bilateral[members], new, np.maximum(new, 0)).astype(dtype)
            forces[members] = new
            U = U + square_h * (columns @ (new - old))
        sweeps += 1
        if sweeps % sweeps_per_step:
            continue
        unbalanced = p + B.T @ forces
        gaps = B @ U + o + C * forces
        left = gaps / softest
        left = np.where(system.bilateral, left, np.minimum(forces, left))
        largest = max(float(np.abs(x).max(initial=0.0)) for x in (forces, p)) or 1.0
        errors = (float(np.abs(x).max(initial=0.0)) for x in (unbalanced, left))
        residual = max(errors) / largest
        if residual <= tolerance or sweeps >= max_sweeps or not np.isfinite(residual):
            closed = system.bilateral | (forces > 0)
            return FloatState(U, forces, gaps, closed, sweeps, residual, residual <= tolerance)
        before = U
        U = before + square_h * unbalanced


def _colours(B: csr_array) -> list[IntArray]:
    """The contacts in groups of which no two share a freedom, greedily."""
    taken: list[set[int]] = []
    groups: list[list[int]] = []
    ends, freedoms = B.indptr.tolist(), B.indices.tolist()
    for k, (first, last) in enumerate(pairwise(ends)):
        mine = set(freedoms[first:last])
        for used, group in zip(taken, groups, strict=True):
            if not used & mine:
                used |= mine
                group.append(k)
                break
        else:
            taken.append(mine)
            groups.append([k])
    return [np.array(group, dtype=np.int64) for group in groups]


def run_gauss_seidel(system: ContactSystem, progress: Progress | None = None) -> Outcome:
    """`gauss_seidel` as a method of `solve`."""
    return float_outcome(gauss_seidel(system))


GAUSS_SEIDEL = Method(
    "gauss-seidel",
    "projected Gauss-Seidel, as contact dynamics does it",
    "float64",
    run_gauss_seidel,
    1e-6,
)
