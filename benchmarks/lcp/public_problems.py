"""Published LCPs, games and quadratic programmes, written out with where they come from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq, fmpq_mat

from lcp_piles.problems import (
    QuadraticCase,
    fathi,
    gilbert,
    grain,
    hock_schittkowski_21,
    hock_schittkowski_35,
    hock_schittkowski_76,
    hock_schittkowski_118,
    kostreva,
    murty,
    newton_min_definite,
)

Rows = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class PublicLCP:
    """The LCP w = M z + q, and whether it has a solution."""

    name: str
    source: str
    M: Rows
    q: tuple[Fraction, ...]
    solvable: bool = True


@dataclass(frozen=True)
class PublicGame:
    """The payoffs of a game of two players."""

    name: str
    source: str
    A: Rows
    B: Rows


@dataclass(frozen=True)
class PublicQP:
    """A quadratic programme with its solution."""

    case: QuadraticCase
    source: str

    @property
    def name(self) -> str:
        """What the case is called."""
        return self.case.name


def _exact(rows: Sequence[Sequence[object]]) -> Rows:
    return tuple(tuple(Fraction(str(x)) for x in row) for row in rows)


def _lcp(name: str, source: str, M: object, q: object, solvable: bool = True) -> PublicLCP:
    (right,) = _exact([q])
    return PublicLCP(name, source, _exact(M), right, solvable)


_MURTY = "Murty (1988), Linear Complementarity, Linear and Nonlinear Programming"
_KOSTREVA = "Kostreva (1979), Math. Program. 16"


def lcps() -> list[PublicLCP]:
    """Textbook problems, those with ties, and those of exponentially many pivots."""
    named = [gilbert(), newton_min_definite(), grain(), kostreva()]
    named += [murty(n) for n in (4, 8, 10)] + [fathi(n) for n in (4, 8)]
    return [
        _lcp(
            "murty 2.8",
            f"{_MURTY}, example 2.8",
            [[1, -1, -1, -1], [-1, 1, -1, -1], [1, 1, 2, 0], [1, 1, 0, 2]],
            [3, 5, -9, -5],
        ),
        _lcp(
            "murty 2.9",
            f"{_MURTY}, example 2.9",
            [[-1, 0, -3], [1, -2, -5], [-2, -1, -2]],
            [-3, -2, -1],
            solvable=False,
        ),
        _lcp("murty 2.11", f"{_MURTY}, example 2.11", [["-3/2", 2], [-4, 4]], [-5, 17]),
        _lcp(
            "kostreva 2",
            _KOSTREVA,
            [[1, -1, 3], [2, -1, 3], [-1, -2, 0]],
            [-1, -1, -1],
            solvable=False,
        ),
        *(PublicLCP(c.name, "`lcp_piles.problems`", c.M, c.q) for c in named),
    ]


def games() -> list[PublicGame]:
    """Textbook games, degenerate ones, large payoffs, and the exponential paths."""
    first, second = [[0, 0, 0], [0, 1, 1], [1, 1, 0]], [[1, 0, 1], [1, 1, 0], [0, 0, 2]]
    found = [
        ("pennies", "textbooks", [[1, -1], [-1, 1]], [[-1, 1], [1, -1]]),
        ("sexes", "textbooks", [[3, 0], [0, 2]], [[2, 0], [0, 3]]),
        ("dilemma", "textbooks", [[-1, -3], [0, -2]], [[-1, 0], [-3, -2]]),
        (
            "rock",
            "textbooks",
            [[0, -1, 1], [1, 0, -1], [-1, 1, 0]],
            [[0, 1, -1], [-1, 0, 1], [1, -1, 0]],
        ),
        (
            "von stengel 2002",
            "von Stengel (2002), Handbook of Game Theory 3",
            [[0, 6], [2, 5], [3, 3]],
            [[1, 0], [0, 2], [4, 3]],
        ),
        (
            "von stengel 2007",
            "von Stengel (2007), Algorithmic Game Theory, chapter 3",
            [[3, 3], [2, 5], [0, 6]],
            [[3, 2], [2, 6], [3, 1]],
        ),
        (
            "degenerate",
            "von Stengel (2007), Algorithmic Game Theory, chapter 3",
            [[3, 3], [2, 5], [0, 6]],
            [[3, 3], [2, 6], [3, 1]],
        ),
        ("ties", "QuantEcon, test_lemke_howson (cycles under careless rules)", first, second),
        (
            "ties 2",
            "QuantEcon, test_lemke_howson (the same, columns in another order)",
            [[row[j] for j in (2, 0, 1)] for row in first],
            [second[i] for i in (2, 0, 1)],
        ),
    ]
    for scale in (15, 16):
        A, B = [[3, 1], [1, 3]], [[1, 3], [3, 1]]
        large = [[[x * 10**scale for x in row] for row in payoffs] for payoffs in (A, B)]
        found.append((f"payoffs 1e{scale}", "QuantEcon, test_lemke_howson", *large))
    exponential = [
        PublicGame(
            f"exponential {d}",
            "Savani and von Stengel (2006), Econometrica 74",
            *exponential_game(d),
        )
        for d in (4, 6, 8, 10)
    ]
    return [PublicGame(n, s, _exact(A), _exact(B)) for n, s, A, B in found] + exponential


def exponential_game(d: int) -> tuple[Rows, Rows]:
    """The d x d game (d even) of exponentially long paths from every label.

    Savani and von Stengel (2006), "Hard-to-solve bimatrix games", Econometrica 74: both best
    response polytopes are dual to a cyclic polytope of 2 d points on the moment curve. In that of
    the row player's strategies point k has the label k, in the other one the label l(k): 1 and d
    keep theirs, 2..d-1 and d+1..2d are exchanged in pairs.
    """
    label = list(range(1, 2 * d + 1))
    for k in (*range(1, d - 2, 2), *range(d, 2 * d - 1, 2)):
        label[k], label[k + 1] = label[k + 1], label[k]
    mine = _dual_cyclic(d, list(range(d)))
    others = _dual_cyclic(d, list(range(d, 2 * d)))
    B = [[mine[j][i] for j in range(d)] for i in range(d)]
    A = [[Fraction(0)] * d for _ in range(d)]
    for k in range(d):
        for j in range(d):
            A[label[k] - 1][label[d + j] - 1 - d] = others[k][j]
    return tuple(map(tuple, A)), tuple(map(tuple, B))


def _dual_cyclic(d: int, base: list[int]) -> list[list[Fraction]]:
    """R with {s >= 0, R s <= 1} the dual cyclic polytope of 2 d points, s >= 0 the base facets."""
    points = [[fmpq(t**p) for p in range(1, d + 1)] for t in range(1, 2 * d + 1)]
    middle = [sum(column, fmpq(0)) / (2 * d) for column in zip(*points, strict=True)]
    facets = [[x - m for x, m in zip(point, middle, strict=True)] for point in points]
    rest = [k for k in range(2 * d) if k not in base]
    # On facet c: 1 - c . x is the slack; x = C_base^-1 (1 - s).
    frame = fmpq_mat(d, d, [x for k in base for x in facets[k]])
    turned = fmpq_mat(d, d, [x for k in rest for x in facets[k]]) * frame.inv()
    rows = []
    for row in turned.tolist():
        room = 1 - sum(row, fmpq(0))  # the slack at s = 0, positive since that is a vertex
        rows.append([Fraction(int(x.p), int(x.q)) for x in (-y / room for y in row)])
    return rows


def quadratic_programmes() -> list[PublicQP]:
    """Those of Hock and Schittkowski, and the example of Goldfarb and Idnani's programme."""
    goldfarb = QuadraticCase(
        "goldfarb-idnani",
        P=_exact([[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        c=_exact([[0, -5, 0]])[0],
        G=_exact([[4, 3, 0], [-2, -1, 0], [0, 2, -1]]),
        h=_exact([[8, -2, 0]])[0],
        lower=(None,) * 3,
        upper=(None,) * 3,
        constant=Fraction(0),
        x=_exact([["10/21", "22/21", "44/21"]])[0],
        value=Fraction(-50, 21),
    )
    source = "Hock and Schittkowski (1981), Test Examples for Nonlinear Programming Codes"
    cases = [
        hock_schittkowski_21(),
        hock_schittkowski_35(),
        hock_schittkowski_76(),
        hock_schittkowski_118(),
    ]
    manual = "the manual of quadprog, for Goldfarb and Idnani (1983)"
    return [*(PublicQP(case, source) for case in cases), PublicQP(goldfarb, manual)]
