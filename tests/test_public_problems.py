"""The published problems of `benchmarks.lcp`: ours solve all of them, and the judge sees errors."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from helpers import brute_force

from benchmarks.lcp import cgal
from benchmarks.lcp import random_problems as drawn
from benchmarks.lcp.judge import GOOD, NoAnswerError, game_error, lcp_error, qp_error
from benchmarks.lcp.public_problems import exponential_game, games, lcps, quadratic_programmes
from benchmarks.lcp.solvers import GAME_SOLVERS, LCP_SOLVERS, QP_SOLVERS, quietly
from lcp_piles import lemke, nash, prove_lcp, solve_lcp

LCPS = [problem for problem in lcps() if len(problem.q) <= 8]


@pytest.mark.parametrize("solver", LCP_SOLVERS[:2], ids=lambda s: s.name)
@pytest.mark.parametrize("problem", LCPS, ids=lambda p: p.name)
def test_ours_solve_the_lcps(problem, solver) -> None:
    """No solution only where brute force over all bases has none."""
    if len(problem.q) <= 4:
        found = brute_force([list(row) for row in problem.M], list(problem.q))
        assert bool(found) == problem.solvable
    if problem.solvable:
        assert lcp_error(problem, quietly(solver.solve, problem)) == 0
    else:
        with pytest.raises(NoAnswerError, match="proved"):
            quietly(solver.solve, problem)


@pytest.mark.parametrize("problem", games(), ids=lambda p: p.name)
def test_ours_solve_the_games(problem) -> None:
    assert game_error(problem, *quietly(GAME_SOLVERS[0].solve, problem)) == 0


@pytest.mark.parametrize("problem", quadratic_programmes(), ids=lambda p: p.name)
def test_ours_solve_the_quadratic_programmes(problem) -> None:
    assert qp_error(problem, quietly(QP_SOLVERS[0].solve, problem)) == 0


def test_paths_of_the_exponential_games_grow() -> None:
    """From every label they more than double with two strategies more; the end is fully mixed."""

    def lengths(d: int) -> list[int]:
        found = []
        for label in range(2 * d):
            count = [0]
            game = nash(
                *exponential_game(d),
                label=label,
                progress=lambda n, count=count: count.__setitem__(0, n),
            )
            assert min(*game.x, *game.y) > 0
            found.append(count[0])
        return found

    four, six, eight = lengths(4), lengths(6), lengths(8)
    assert min(six) > 2 * min(four)
    assert min(eight) > 2 * min(six)
    assert max(eight) > 4 * max(six) > 16 * max(four)


def test_the_judge_measures_errors_exactly() -> None:
    lcp = next(problem for problem in LCPS if problem.name == "kostreva")
    assert lcp_error(lcp, [0, 0, 0]) == 1
    assert lcp_error(lcp, [1 / 3] * 3) < GOOD
    pennies = games()[0]
    assert game_error(pennies, [1, 0], [1, 0]) == 1  # of the spread 2, the other gains 2
    assert game_error(pennies, [1, 1], [3, 3]) == 0  # shares are made to add up
    assert game_error(pennies, [1.5, -0.5], [1, 1]) >= Fraction(1, 2)
    programme = quadratic_programmes()[0]
    assert qp_error(programme, [2, 1.5]) == Fraction(1, 2)
    for wrong in ([float("nan")] * 3, [1], ["x"] * 3):
        with pytest.raises(NoAnswerError):
            lcp_error(lcp, wrong)


@pytest.mark.parametrize(
    "problem",
    [
        drawn.definite(8),
        drawn.semidefinite(8, 4),
        drawn.dominant(8),
        drawn.tridiagonal(8),
        drawn.grid(3),
    ],
    ids=["definite", "semidefinite", "dominant", "tridiagonal", "grid"],
)
def test_drawn_problems_are_solved(problem) -> None:
    """By cold pivots too; where M is definite there is only one solution."""
    found, cold = solve_lcp(*problem), lemke(*problem)
    assert found.success
    assert cold.success
    assert found.z == cold.z or not found.matrix.unique


def test_a_membrane_lies_on_its_floor_in_the_middle() -> None:
    """It has the square's symmetry, and where it hangs free no floor presses.

    A single point is 1/4 below its frame by hand: 4 u = -1.
    """
    found = solve_lcp(*drawn.membrane(5, 1))
    height = np.array(found.z).reshape(5, 5)
    assert (height == height[::-1]).all()
    assert (height == height.T).all()
    assert height[2, 2] == 0 < height[0, 0]
    assert all(0 <= w <= 1 for w in found.w)
    assert solve_lcp(*drawn.membrane(1, 3)).z == (3 - Fraction(1, 4),)


def test_a_membrane_is_proved() -> None:
    proof = prove_lcp(*drawn.membrane(9, 4))
    exact = solve_lcp(*drawn.membrane(9, 4))
    assert proof.proved
    assert proof.support.tolist() == [x > 0 for x in exact.z]


@pytest.mark.slow
@pytest.mark.skipif(not cgal.present(), reason="CGAL is not installed")
def test_cgal_finds_the_same() -> None:
    """An exact solver that is not ours."""
    for problem in quadratic_programmes():
        assert tuple(cgal.cgal(problem)) == problem.case.x
