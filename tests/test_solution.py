"""The three kinds of solution: what they say of themselves, and what the two without forces do."""

import pytest

from lcp_piles import InputError, NotSolvedError, Unresolved, nt30, nt60, solve, surd, tss


def test_a_solution_is_shown_in_one_line() -> None:
    """Counts by hand from the picture of the paper's pile: 129 contacts, 16 of them open."""
    solution = solve(nt30(6))
    assert repr(solution) == (
        "<Solved nt30 layers 6, push 0, floor_compliance 1, corner_stones held: "
        "113 closed, 16 open, 0 osculatory; stable; exact>"
    )
    assert repr(solve(tss(3), "newton")).endswith("; float64>")
    assert repr(solve(nt60(4).without([(4, 1)]))).startswith("<Unstable custom, 9 discs, 18 ")
    assert repr(Unresolved(nt60(3), solution.record)).startswith("<Unresolved nt60 layers 3")
    assert repr(solution.record).startswith("<Record proved (exact): ")


def test_no_number_makes_the_line_long() -> None:
    """A push of 10^400 written out, and parameters of hundreds of digits."""
    scene = nt60(2, push=surd(10**400), floor_compliance="1/" + "7" * 500)
    assert len(repr(solve(scene))) < 220


@pytest.mark.parametrize("scene", [nt60(4).without([(4, 1)]), nt60(3)], ids=["unstable", "none"])
def test_what_only_a_solved_scene_has_is_refused_with_a_remedy(scene) -> None:
    solution = solve(scene)
    if solution.status == "solved":
        solution = Unresolved(scene, solution.record)
    for name in ("forces", "force", "force_array", "states", "count", "stability", "gap_unique"):
        assert not hasattr(solution, name)
        with pytest.raises(NotSolvedError, match=f'expected "solved", to have {name};'):
            getattr(solution, name)
    with pytest.raises(AttributeError) as caught:
        solution.colour  # noqa: B018
    assert not isinstance(caught.value, InputError)
