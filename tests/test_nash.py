"""Equilibria of games: from textbooks, by brute force over supports, and degenerate ones."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from random import Random

import pytest
from flint import fmpq_mat
from helpers import fmpq_of
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import InputError, VerificationError, nash, nash_equilibria
from lcp_piles.games import nash as nash_module
from lcp_piles.games.equilibrium import equilibrium
from lcp_piles.games.float_path import FloatPath
from lcp_piles.numbers.rational_matrix import rational_column, rational_matrix

F = Fraction
THIRDS = (F(1, 3),) * 3


def assert_equilibrium(A, B, found) -> None:
    """In plain Fractions: probabilities, and no pure strategy earns more."""
    x, y = found.x, found.y
    assert min(*x, *y) >= 0
    assert sum(x) == sum(y) == 1
    of_rows = [sum(F(a) * p for a, p in zip(row, y, strict=True)) for row in A]
    of_columns = [
        sum(F(b) * p for b, p in zip(col, x, strict=True)) for col in zip(*B, strict=True)
    ]
    expected = (
        sum(p * v for p, v in zip(x, of_rows, strict=True)),
        sum(p * v for p, v in zip(y, of_columns, strict=True)),
    )
    assert found.payoffs == expected == (max(of_rows), max(of_columns))


def by_supports(A, B) -> set[tuple[tuple[Fraction, ...], tuple[Fraction, ...]]]:
    """Every equilibrium of a game without ties: all pairs of supports of one size, by Cramer."""

    def shares(payoffs, size, mine) -> tuple[Fraction, ...] | None:
        """The mix on `mine` that makes all rows of `payoffs` earn the same."""
        k = len(mine)
        rows = [[*row, -1] for row in payoffs] + [[1] * k + [0]]
        table = fmpq_mat(k + 1, k + 1, [fmpq_of(x) for row in rows for x in row])
        if table.det() == 0:
            return None
        mix = table.solve(fmpq_mat(k + 1, 1, [0] * k + [1])).entries()[:k]
        if min(mix) <= 0:
            return None
        full = [F(0)] * size
        for i, p in zip(mine, mix, strict=True):
            full[i] = F(int(p.p), int(p.q))
        return tuple(full)

    m, n = len(A), len(A[0])
    turned = list(zip(*B, strict=True))
    found = set()
    for k in range(1, min(m, n) + 1):
        for rows in combinations(range(m), k):
            for columns in combinations(range(n), k):
                y = shares([[A[i][j] for j in columns] for i in rows], n, columns)
                x = shares([[B[i][j] for i in rows] for j in columns], m, rows)
                if x is None or y is None:
                    continue
                gains = [sum(a * p for a, p in zip(row, y, strict=True)) for row in A]
                others = [sum(b * p for b, p in zip(c, x, strict=True)) for c in turned]
                if max(gains) == gains[rows[0]] and max(others) == others[columns[0]]:
                    found.add((x, y))
    return found


def test_matching_pennies() -> None:
    half = (F(1, 2),) * 2
    game = nash([[1, -1], [-1, 1]], [[-1, 1], [1, -1]])
    assert (game.x, game.y, game.payoffs) == (half, half, (0, 0))


def test_battle_of_the_sexes() -> None:
    """Both pure equilibria; the mixed one, (3/5, 2/5) and (2/5, 3/5), is on no path from z = 0."""
    found = nash_equilibria([[3, 0], [0, 2]], [[2, 0], [0, 3]])
    assert {(e.x, e.y) for e in found} == {((1, 0), (1, 0)), ((0, 1), (0, 1))}


def test_rock_paper_scissors() -> None:
    A = [[0, -1, 1], [1, 0, -1], [-1, 1, 0]]
    game = nash(A, [[-x for x in row] for row in A])
    assert (game.x, game.y, game.payoffs) == (THIRDS, THIRDS, (0, 0))


def test_prisoners_dilemma() -> None:
    assert nash([[-1, -3], [0, -2]], [[-1, 0], [-3, -2]]).payoffs == (-2, -2)


def test_von_stengel() -> None:
    """The example of von Stengel (2002), "Computing equilibria for two-person games": he has three.

    Two of them are on paths from z = 0.
    """
    A, B = [[0, 6], [2, 5], [3, 3]], [[1, 0], [0, 2], [4, 3]]
    three = {
        ((0, 0, 1), (1, 0)),
        ((0, F(1, 3), F(2, 3)), (F(2, 3), F(1, 3))),
        ((F(2, 3), F(1, 3), 0), (F(1, 3), F(2, 3))),
    }
    assert by_supports(A, B) == three
    found = {(e.x, e.y) for e in nash_equilibria(A, B)}
    assert len(found) == 2
    assert found < three


def test_a_game_with_equilibria_that_no_path_reaches() -> None:
    """A symmetric game of seven equilibria: the three pure ones are at the ends of all paths."""
    A = [[0, 3, 0], [2, 2, 0], [1, 1, 1]]
    B = [list(column) for column in zip(*A, strict=True)]
    everything = by_supports(A, B)
    assert len(everything) == 7
    found = {(e.x, e.y) for e in nash_equilibria(A, B)}
    assert len(found) == 3
    assert found == {(x, y) for x, y in everything if max(x) == max(y) == 1}


numbers = st.integers(-9, 9)


@st.composite
def games(draw, entries=numbers, most=4):
    m, n = draw(st.integers(1, most)), draw(st.integers(1, most))
    line = st.lists(entries, min_size=n, max_size=n)
    matrix = st.lists(line, min_size=m, max_size=m)
    return draw(matrix), draw(matrix)


@given(game=games(st.fractions(-9, 9, max_denominator=50)))
@settings(max_examples=60, deadline=None)
def test_random_games(game) -> None:
    A, B = game
    found = nash_equilibria(A, B)
    assert found
    for one in found:
        assert_equilibrium(A, B, one)


def test_games_without_ties_by_brute_force() -> None:
    """Every end of a path is one of all equilibria, of which there is an odd number."""
    random = Random(5)
    for _ in range(25):
        m, n = random.randint(2, 4), random.randint(2, 4)
        A, B = ([[random.randint(-999, 999) for _ in range(n)] for _ in range(m)] for _ in "AB")
        everything = by_supports(A, B)
        assert len(everything) % 2 == 1
        assert {(e.x, e.y) for e in nash_equilibria(A, B)} <= everything


@given(game=games(st.integers(0, 1)))
@settings(max_examples=60, deadline=None)
def test_degenerate_games_by_exact_pivots(game) -> None:
    """Ties everywhere, and nothing proposed: the lexicographic rule comes to an end."""
    A, B = game
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(nash_module, "float_path", lambda *_: FloatPath(None))
        for label in range(len(A) + len(A[0])):
            assert_equilibrium(A, B, nash(A, B, label=label))


def test_exact_pivots_end_where_floats_do() -> None:
    """Without ties the path from a label is one: both walks of it have the same end."""
    random = Random(7)
    A, B = ([[random.randint(0, 999) for _ in range(6)] for _ in range(7)] for _ in "AB")
    floats = [nash(A, B, label=k) for k in range(13)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(nash_module, "float_path", lambda *_: FloatPath(None))
        assert [nash(A, B, label=k) for k in range(13)] == floats


def test_payoffs_that_floats_cannot_tell_apart() -> None:
    """Matching pennies on top of 10^40: by exact pivots."""
    large = 10**40
    game = nash(
        [[large + 1, large], [large, large + 1]], [[-large, 1 - large], [1 - large, -large]]
    )
    assert game.x == game.y == (F(1, 2), F(1, 2))
    wide = nash([[large, 0, 1], [0, 1, 0]], [[0, 1, 3], [large, 0, large - 1]])
    assert_equilibrium([[large, 0, 1], [0, 1, 0]], [[0, 1, 3], [large, 0, large - 1]], wide)


def test_a_game_of_150_strategies_each() -> None:
    """From label 0 the path has 175,636 pivots: others are short."""
    random = Random(3)
    A, B = ([[random.randint(0, 100) for _ in range(150)] for _ in range(150)] for _ in "AB")
    assert_equilibrium(A, B, nash(A, B))


def test_the_check_refuses_what_is_no_equilibrium() -> None:
    A, B = (rational_matrix([[3, 0], [0, 2]], name) for name in "AB")
    for x, y in (([1, 0], [0, 1]), ([2, -1], [1, 0]), (["1/2", 0], [1, 0])):
        with pytest.raises(VerificationError):
            equilibrium(A, B, rational_column(x, "x"), rational_column(y, "y"))


@pytest.mark.parametrize(
    ("A", "B", "label", "message"),
    [
        ([[1, 2]], [[1], [2]], 0, "shape of B"),
        ([], [], 0, "shape of A"),
        ([[1.5]], [[1]], 0, "floats_exactly"),
        ([[1, 2], [3]], [[1, 2], [3, 4]], 0, "row 1 of A"),
        ([["sqrt(2)"]], [[1]], 0, "a rational number"),
        ([[1]], [[1]], 2, "from 0 to 1"),
        ([[1]], [[1]], True, "from 0 to 1"),
        ([[1]], [[1]], "0", "from 0 to 1"),
        ("12", [[1]], 0, "a sequence"),
        (5, [[1]], 0, "a sequence"),
    ],
)
def test_errors_say_what_is_wrong(A, B, label, message) -> None:
    with pytest.raises(InputError, match=message):
        nash(A, B, label=label)
