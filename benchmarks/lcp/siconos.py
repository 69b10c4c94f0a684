"""Siconos (INRIA's, of nonsmooth dynamics), by its C library: Debian's libsiconos-numerics7."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from ctypes.util import find_library
from functools import cache
from typing import Any

import numpy as np

from benchmarks.lcp.judge import NoAnswerError
from benchmarks.lcp.public_problems import PublicLCP

LEMKE, NEWTON_MIN, PIVOT = 200, 208, 215
"""Numbers of its methods (lcp_cst.h): Lemke's, Newton's on min(z, w), Bard's pivots."""
_DENSE = 0


class _Problem(ctypes.Structure):
    _fields_ = (("size", ctypes.c_int), ("M", ctypes.c_void_p), ("q", ctypes.c_void_p))


def present() -> bool:
    """Whether the library is installed."""
    return find_library("siconos_numerics") is not None


@cache
def _library() -> Any:
    library = ctypes.CDLL(find_library("siconos_numerics"))
    library.NM_create_from_data.restype = ctypes.c_void_p
    library.NM_create_from_data.argtypes = [ctypes.c_int] * 3 + [ctypes.c_void_p]
    library.solver_options_create.restype = ctypes.c_void_p
    library.solver_options_delete.argtypes = [ctypes.c_void_p]
    library.linearComplementarity_driver.argtypes = [ctypes.c_void_p] * 4
    return library


def siconos(method: int) -> Callable[[PublicLCP], Any]:
    """An adapter of one of its methods, with its default options."""

    def solve(problem: PublicLCP) -> Any:
        library = _library()
        n = len(problem.q)
        M, q = np.array(problem.M, dtype=float).T.copy(), np.array(problem.q, dtype=float)
        z, w = np.zeros(n), np.zeros(n)
        matrix = library.NM_create_from_data(_DENSE, n, n, M.ctypes.data)
        given = _Problem(n, matrix, q.ctypes.data)
        options = library.solver_options_create(method)
        code = library.linearComplementarity_driver(
            ctypes.byref(given), z.ctypes.data, w.ctypes.data, options
        )
        library.solver_options_delete(options)
        if code != 0:
            raise NoAnswerError(f"code {code}")
        return z

    return solve
