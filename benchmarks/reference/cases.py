"""The cases: scenes that a code for discrete elements should get right, from easy to hard."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from lcp_piles import Scene, nt30, nt60, silo, slab, tbs, tss


class Case(NamedTuple):
    """A scene under a name, and what it is good for."""

    name: str
    scene: Callable[[], Scene]
    tests: str


CASES = (
    Case(
        "tbs-1",
        lambda: tbs(1),
        "one disc on three; by hand: 1/3, 1/3, 2/3 of its weight",
    ),
    Case("tbs-3", lambda: tbs(3), "a tilted pile on a bumpy floor, all held discs in sight"),
    Case("tbs-10", lambda: tbs(10), "the same, larger: contacts on the flanks are open"),
    Case(
        "nt60-2",
        lambda: nt60(2),
        "one disc on two; by hand: 1/sqrt(3) of its weight each",
    ),
    Case("nt60-6", lambda: nt60(6), "Hong's pile: nearly all horizontal contacts are open"),
    Case("nt30-3", lambda: nt30(3), "a flat pile between corner stones"),
    Case("nt30-6", lambda: nt30(6), "the pile of the paper: a plateau and 129 contacts"),
    Case("nt30-6-pushed", lambda: nt30(6, push="20"), "the stones pushed in by 20 w tau each"),
    Case("tss-4", lambda: tss(4), "a saddle: forces balance, but no deformable pile stays there"),
    Case("silo-4-8", lambda: silo(4, 8, walls="smooth"), "walls and floor without friction"),
    Case(
        "slab-7-3",
        lambda: slab(7, 3),
        "three rows between smooth walls",
    ),
    Case(
        "nt60-4-vacancy",
        lambda: nt60(4).without([(4, 1)]),
        "without a corner stone nothing stands: the motion by which it gives way",
    ),
)
