"""Random degenerate problems of known solution: no wrong state, no false claim by exact methods."""

import pytest

from benchmarks.failures.random_degenerate import (
    count_collapses,
    count_lcps,
    count_scenes,
    true_states,
)
from lcp_piles import nt30, solve
from lcp_piles.problems import SceneCase

EXACT = ("exact Lemke", "exact, proved", "exact, Lemke", "exact, Z")
COLLAPSES = ("collapse, proved", "collapse, exact Lemke")
ALWAYS_SOLVED = (*EXACT[:3], *COLLAPSES)


def check(lcps, scenes, collapses):
    counts = count_lcps(lcps)
    counts.update(count_scenes(scenes))
    counts.update(count_collapses(collapses))
    for name in (*EXACT, *COLLAPSES):
        assert counts[name, "runs"] == {EXACT[0]: lcps}.get(
            name, scenes if name in EXACT else collapses
        )
        assert counts[name, "wrong states"] == 0
        assert counts[name, "false claims"] == 0
    for name in ALWAYS_SOLVED:
        assert counts[name, "unsolved"] == 0
    # The problems are hard ones: floating point does misread them.
    assert counts["float64 Newton", "wrong states"] > 0
    assert counts["float32 Lemke", "wrong states"] > 0
    assert counts["collapse, Newton", "false claims"] > 0


def test_fifty_random_degenerate_problems():
    check(25, 15, 10)


@pytest.mark.slow
def test_more_random_degenerate_problems():
    """The benchmark asks a thousand."""
    check(60, 36, 24)


def test_the_truth_of_a_scene_agrees_with_its_signs_where_gaps_are_unique():
    """The linear programme that names the true states, on a pile that has no ties."""
    solution = solve(nt30(4))
    assert all(solution.gap_unique)
    case = SceneCase(solution.scene, tuple(solution.force_array), tuple(solution.gap_array))
    assert true_states(case) == list(solution.states)
