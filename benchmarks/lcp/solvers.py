"""Ours and what a user would pick instead, one thin adapter each, with its default settings.

An adapter takes a problem of `public_problems`, imports its package when it runs, and returns the
numbers that the package claims, or raises `NoAnswerError` where it says that there are none.
"""

from __future__ import annotations

import signal
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from benchmarks.lcp import cgal, siconos
from benchmarks.lcp.judge import NoAnswerError
from benchmarks.lcp.public_problems import PublicGame, PublicLCP, PublicQP
from lcp_piles import lemke, nash, quadratic_program, solve_lcp
from lcp_piles.pivoting.lemke import LemkeResult

LIMIT = 10
"""Seconds for one answer."""


@dataclass(frozen=True)
class Solver:
    """A name, the adapter, and whether what it needs is there."""

    name: str
    solve: Callable[[Any], Any]
    present: Callable[[], bool]


def _module(name: str) -> Callable[[], bool]:
    return lambda: find_spec(name) is not None


def _floats(values: Any) -> Any:
    return np.array(values, dtype=float)


def _our_lcp(solver: Callable[[Any, Any], LemkeResult]) -> Callable[[PublicLCP], Any]:
    """An adapter of one of ours."""

    def solve(problem: PublicLCP) -> Any:
        result = solver(problem.M, problem.q)
        if not result.success:
            raise NoAnswerError("none, proved" if result.certificate else result.status)
        return result.z

    return solve


def _quantecon_lcp(problem: PublicLCP) -> Any:
    from quantecon.optimize.lcp_lemke import lcp_lemke

    result = lcp_lemke(_floats(problem.M), _floats(problem.q))
    if not result.success:
        raise NoAnswerError(f"status {result.status}")
    return result.z


def _lemkelcp(problem: PublicLCP) -> Any:
    import lemkelcp.lemkelcp as package

    package.range = lambda *words: list(range(*words))  # it is written for Python 2
    z, code, words = package.lemkelcp(_floats(problem.M), _floats(problem.q), maxIter=10_000)
    if code != 0:
        raise NoAnswerError(str(words).lower())
    return z


def _drake(name: str) -> Callable[[PublicLCP], Any]:
    """An adapter of one of Drake's solvers."""

    def solve(problem: PublicLCP) -> Any:
        from pydrake import solvers

        program = solvers.MathematicalProgram()
        z = program.NewContinuousVariables(len(problem.q))
        M, q = _floats(problem.M), _floats(problem.q)
        program.AddLinearComplementarityConstraint(M, q, z)
        result = getattr(solvers, name)().Solve(program)
        if not result.is_success():
            raise NoAnswerError("no success")
        return result.GetSolution(z)

    return solve


def _our_game(problem: PublicGame) -> Any:
    found = nash(problem.A, problem.B)
    return found.x, found.y


def _quantecon_game(problem: PublicGame) -> Any:
    from quantecon.game_theory import NormalFormGame, Player, lemke_howson

    turned = _floats(problem.B).T.copy()
    game = NormalFormGame((Player(_floats(problem.A)), Player(turned)))
    found, result = lemke_howson(game, full_output=True)
    if not result.converged:
        raise NoAnswerError("not converged")
    return found


def _nashpy(problem: PublicGame) -> Any:
    import nashpy

    game = nashpy.Game(_floats(problem.A), _floats(problem.B))
    return game.lemke_howson(initial_dropped_label=0)


def _gambit(problem: PublicGame) -> Any:
    import pygambit

    payoffs = (np.array(problem.A, dtype=object), np.array(problem.B, dtype=object))
    game = pygambit.Game.from_arrays(*payoffs)
    found = pygambit.nash.lcp_solve(game, rational=True, stop_after=1).equilibria
    if not found:
        raise NoAnswerError("no equilibrium")
    return tuple([share for _, share in found[0][player]] for player in game.players)


def _our_qp(problem: PublicQP) -> Any:
    case = problem.case
    result = quadratic_program(
        case.P, case.c, G=case.G, h=case.h, lower=case.lower, upper=case.upper
    )
    return result.x


def _qp(name: str) -> Callable[[PublicQP], Any]:
    """An adapter of a back end of qpsolvers."""

    def solve(problem: PublicQP) -> Any:
        from qpsolvers import Problem, solve_problem
        from scipy.sparse import csc_matrix

        case = problem.case
        P, G = _floats(case.P), _floats(case.G)
        if name == "clarabel":
            P, G = csc_matrix(P), csc_matrix(G)
        bounds = [
            np.array([default if v is None else float(v) for v in given])
            for given, default in ((case.lower, -np.inf), (case.upper, np.inf))
        ]
        task = Problem(P, _floats(case.c), G, _floats(case.h), lb=bounds[0], ub=bounds[1])
        solution = solve_problem(task, solver=name)
        if not solution.found or solution.x is None:
            raise NoAnswerError("not found")
        return solution.x

    return solve


LCP_SOLVERS = (
    Solver("`solve_lcp`", _our_lcp(solve_lcp), _module("lcp_piles")),
    Solver("`lemke`", _our_lcp(lemke), _module("lcp_piles")),
    Solver("QuantEcon", _quantecon_lcp, _module("quantecon")),
    Solver("lemkelcp", _lemkelcp, _module("lemkelcp")),
    Solver("Drake, Moby", _drake("MobyLcpSolver"), _module("pydrake")),
    Solver("Drake, unrevised Lemke", _drake("UnrevisedLemkeSolver"), _module("pydrake")),
    Solver("Siconos, Lemke", siconos.siconos(siconos.LEMKE), siconos.present),
    Solver("Siconos, Newton min", siconos.siconos(siconos.NEWTON_MIN), siconos.present),
    Solver("Siconos, pivots", siconos.siconos(siconos.PIVOT), siconos.present),
)
GAME_SOLVERS = (
    Solver("`nash`", _our_game, _module("lcp_piles")),
    Solver("QuantEcon", _quantecon_game, _module("quantecon")),
    Solver("nashpy", _nashpy, _module("nashpy")),
    Solver("pygambit (exact)", _gambit, _module("pygambit")),
)
QP_SOLVERS = (
    Solver("`quadratic_program`", _our_qp, _module("lcp_piles")),
    Solver("DAQP", _qp("daqp"), _module("daqp")),
    Solver("PIQP", _qp("piqp"), _module("piqp")),
    Solver("Clarabel", _qp("clarabel"), _module("clarabel")),
    Solver("ProxQP", _qp("proxqp"), _module("proxsuite")),
    Solver("CGAL (exact)", cgal.cgal, cgal.present),
)


def quietly(solve: Callable[[Any], Any], problem: Any) -> Any:
    """The answer, whatever the package warns of; an error of its own or `LIMIT` is no answer."""

    def late(*_: Any) -> None:
        raise NoAnswerError(f"not within {LIMIT} s")

    signal.signal(signal.SIGALRM, late)
    signal.alarm(LIMIT)
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        try:
            return solve(problem)
        except NoAnswerError:
            raise
        except Exception as error:
            raise NoAnswerError(type(error).__name__) from error
        finally:
            signal.alarm(0)
