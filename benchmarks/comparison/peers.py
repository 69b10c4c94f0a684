"""What a user would pick instead: one thin adapter each, `solve(B, C, o, p, setting) -> Raw`.

All solve the force QP min 1/2 f^T diag(C) f + o^T f, B^T f = -p, f >= 0 or its LCP. An adapter
imports its package when it runs; `PEERS` says which one that is and what to install.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from benchmarks.comparison.problem import FailedError, Raw
from lcp_piles.numbers.vectors import FloatArray

Solve = Callable[[csr_array, FloatArray, FloatArray, FloatArray, Any], Raw]


@dataclass(frozen=True)
class Peer:
    """An adapter: `module` is what has to be importable, `extra` what to install for it.

    `settings` are swept for work against precision; one None where there is nothing to choose.
    Beyond `limit` contacts it is not run: what is dense would take minutes.
    """

    name: str
    module: str
    extra: str
    sparse: bool
    settings: tuple[float | None, ...]
    limit: int
    solve: Solve


TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9, 5e-10, 1e-10, 1e-11)


def nnls(B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray, setting: Any) -> Raw:
    """Lawson and Hanson's least distance programme, by scipy's `nnls`.

    With f = C^-1/2 (x0 + N xi), N an orthonormal basis of the self-stresses and x0 the forces with
    every contact bilateral: min |xi|^2 / 2 subject to N xi >= -x0.
    """
    from scipy.linalg import null_space
    from scipy.optimize import nnls as scipy_nnls

    root = np.sqrt(C)
    A = (B.T / root).toarray()
    x0 = -o / root
    x0 += np.linalg.lstsq(A, -p - A @ x0, rcond=None)[0]
    N = null_space(A)
    E = np.vstack([N.T, -x0])
    target = np.zeros(len(E))
    target[-1] = 1
    y, _ = scipy_nnls(E, target)
    rest = E @ y - target
    if abs(rest[-1]) < 1e-14:
        raise FailedError("the least distance programme says that no forces balance the load")
    xi = -rest[:-1] / rest[-1]
    return Raw((x0 + N @ xi) / root, -y / rest[-1] * root, True)


def quantecon(B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray, setting: Any) -> Raw:
    """QuantEcon's Lemke with lexicographic rule, in floats and compiled."""
    from quantecon.optimize.lcp_lemke import lcp_lemke

    M, q = dense_lcp(B, C, o, p)
    result = lcp_lemke(M, q)
    if not result.success:
        raise FailedError(f"status {result.status} after {result.num_iter} pivots")
    return _of_z(M, q, result.z, pivots=int(result.num_iter))


def lemkelcp(B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray, setting: Any) -> Raw:
    """The package lemkelcp, written for Python 2: its `range` has to be a list."""
    import lemkelcp.lemkelcp as package

    package.range = lambda *words: list(range(*words))
    M, q = dense_lcp(B, C, o, p)
    z, code, words = package.lemkelcp(M, q, maxIter=20 * len(q))
    if code != 0:
        raise FailedError(str(words))
    return _of_z(M, q, np.asarray(z, dtype=float))


def drake(B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray, setting: Any) -> Raw:
    """Drake's UnrevisedLemkeSolver."""
    from pydrake.solvers import MathematicalProgram, UnrevisedLemkeSolver

    M, q = dense_lcp(B, C, o, p)
    program = MathematicalProgram()
    z = program.NewContinuousVariables(len(q))
    program.AddLinearComplementarityConstraint(M, q, z)
    result = UnrevisedLemkeSolver().Solve(program)
    if not result.is_success():
        raise FailedError(f"no success: {result.get_solution_result()}")
    return _of_z(M, q, result.GetSolution(z))


def dense_lcp(
    B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The LCP w = M z + q, z the gaps and w the forces: M = E - E B K^-1 B^T E with E = C^-1."""
    scaled = (B / C[:, None]).toarray()
    K = B.T @ scaled
    try:
        X = np.linalg.solve(K, np.column_stack([scaled.T, p - scaled.T @ o]))
    except np.linalg.LinAlgError as error:
        raise FailedError("the pile with every contact closed is singular") from error
    M = np.diag(1 / C) - scaled @ X[:, :-1]
    return (M + M.T) / 2, -(scaled @ X[:, -1] + o / C)


def _of_z(M: FloatArray, q: FloatArray, z: FloatArray, **facts: Any) -> Raw:
    return Raw(M @ z + q, z, True, facts)


def _qp(name: str, sparse: bool, words: Callable[[Any], dict[str, Any]]) -> Solve:
    """An adapter of a qpsolvers back end; `words` are its keywords at a tolerance."""

    def solve(B: csr_array, C: FloatArray, o: FloatArray, p: FloatArray, setting: Any) -> Raw:
        import warnings

        from qpsolvers import Problem, solve_problem

        P: Any = csc_array(diags_array(C)) if sparse else np.diag(C)
        A: Any = csc_array(B.T) if sparse else B.T.toarray()
        if sparse:  # the back ends know scipy's matrices, not its arrays
            from scipy.sparse import csc_matrix

            P, A = csc_matrix(P), csc_matrix(A)
        task = Problem(P, o, A=A, b=-p, lb=np.zeros(len(o)))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                solution = solve_problem(task, solver=name, **words(setting))
            except Exception as error:
                raise FailedError(f"{type(error).__name__}: {error}") from error
        if solution.x is None:
            raise FailedError("no solution returned")
        f = np.asarray(solution.x, dtype=float)
        y = solution.y
        known = y is not None and len(y) == len(p) and np.isfinite(np.asarray(y, float)).all()
        gaps = C * f + o + B @ np.asarray(y, dtype=float) if known else None
        return Raw(f, gaps, bool(solution.found))

    return solve


def _absolute(tolerance: Any) -> dict[str, Any]:
    return {"eps_abs": tolerance, "eps_rel": 0.0}


def _piqp(tolerance: Any) -> dict[str, Any]:
    return {**_absolute(tolerance), "eps_duality_gap_abs": tolerance, "eps_duality_gap_rel": 0.0}


def _highs(tolerance: Any) -> dict[str, Any]:
    return {
        "primal_feasibility_tolerance": tolerance,
        "dual_feasibility_tolerance": tolerance,
        "qp_regularization_value": tolerance,
    }


PEERS = (
    Peer("nnls", "scipy", "", False, (None,), 700, nnls),
    Peer("quantecon", "quantecon", "peers", False, (None,), 1500, quantecon),
    Peer("lemkelcp", "lemkelcp", "peers", False, (None,), 130, lemkelcp),
    Peer("drake", "pydrake", "peers", False, (None,), 350, drake),
    Peer("daqp", "daqp", "peers", False, (None,), 1000, _qp("daqp", False, lambda t: {})),
    Peer(
        "quadprog", "quadprog", "peers", False, (None,), 1000, _qp("quadprog", False, lambda t: {})
    ),
    Peer(
        "clarabel",
        "clarabel",
        "peers",
        True,
        TOLERANCES,
        10**6,
        _qp("clarabel", True, lambda t: {"tol_gap_abs": t, "tol_gap_rel": t, "tol_feas": t}),
    ),
    Peer("piqp", "piqp", "peers", True, TOLERANCES, 10**6, _qp("piqp", True, _piqp)),
    Peer(
        "osqp",
        "osqp",
        "peers",
        True,
        (1e-3, 1e-5, 1e-7, 1e-9),
        10**4,
        _qp("osqp", True, lambda t: {**_absolute(t), "max_iter": 200_000}),
    ),
    Peer("proxqp", "proxsuite", "peers", True, TOLERANCES, 1300, _qp("proxqp", True, _absolute)),
    Peer(
        "highs",
        "highspy",
        "peers",
        True,
        (1e-3, 1e-7, 1e-10),
        1500,
        _qp("highs", True, _highs),
    ),
)
