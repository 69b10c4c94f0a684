"""Certificates of every kind of claim, small ones, to check, to alter and to forge."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

from lcp_piles import (
    Contact,
    Disc,
    Scene,
    bound_certificate,
    certificate,
    continuation,
    critical_friction,
    lcp,
    lcp_certificate,
    lemke,
    nt30,
    nt60,
    push_path,
    solve,
    tbs,
    tss,
)

Entry = dict[str, Any]


def _collapse() -> Entry:
    return certificate(solve(freed(nt60(3))))


def freed(pile: Scene) -> Scene:
    """NT60 without its left corner stone's hold: it slides off to the left."""
    discs = tuple(replace(d, held=(None, None)) if d.id == (3, 1) else d for d in pile.discs)
    return replace(pile, discs=discs)


def between_clamps() -> Scene:
    """A disc between rigid walls and on rigid slopes: its forces are several."""
    ball = Disc("ball", (0, 0), (0, -1), (None, None))
    slopes = [("left", ("1/2*sqrt(3)", "1/2")), ("right", ("-1/2*sqrt(3)", "1/2"))]
    contacts = [Contact("ball", name, normal, compliance=0) for name, normal in slopes]
    contacts.append(Contact("ball", "floor", (0, 1), compliance=0))
    return Scene([ball], contacts, supports=("left", "right", "floor"))


def beside_a_wall() -> Scene:
    """A disc on a rigid floor that just touches a rigid wall, and one that hangs in tension."""
    discs = [
        Disc("ball", (0, 0), (0, -1), (None, None)),
        Disc("hook", (6, 0), (0, 0), (0, 0)),
        Disc("bob", (6, -2), (0, -1), (None, None)),
    ]
    contacts = [
        Contact("ball", "floor", (0, 1), compliance=0),
        Contact("ball", "wall", (1, 0), compliance=0),
        Contact("ball", "stop", (-1, 0)),
        Contact("bob", "hook", (0, -1), compliance="1/3", bilateral=True),
    ]
    return Scene(discs, contacts, supports=("floor", "wall", "stop"))


def clamped() -> Scene:
    """A disc on a floor that a clamp keeps from going sideways, and that bears nothing."""
    ball = Disc("ball", (0, 0), (0, -1), (None, None))
    contacts = [Contact("ball", "floor", (0, 1)), Contact("ball", "clamp", (1, 0), bilateral=True)]
    return Scene([ball], contacts, supports=("floor", "clamp"))


def rolling_by() -> Scene:
    """A disc on a rigid floor, free to move past another that it does not touch."""
    ball = Disc("ball", (0, 0), (0, -1), (None, None))
    post = Disc("post", (3, 0), (0, 0), (0, 0))
    touching = Contact("ball", "floor", (0, 1), compliance=0)
    return Scene([ball, post], [touching, Contact("ball", "post", (-1, 0), gap=1)])


def tied_together() -> Scene:
    """A disc on two others on a smooth floor, tied by a rod: all move as one, and none slides."""
    discs = [
        Disc("left", (0, 0), (0, -1), (None, None)),
        Disc("right", (2, 0), (0, -1), (None, None)),
        Disc("top", (1, "sqrt(3)"), (0, -1), (None, None)),
    ]
    contacts = [
        Contact("top", "left", ("1/2", "1/2*sqrt(3)")),
        Contact("top", "right", ("-1/2", "1/2*sqrt(3)")),
        Contact("left", "right", (-1, 0), bilateral=True),
        Contact("left", "floor", (0, 1)),
        Contact("right", "floor", (0, 1)),
    ]
    return Scene(discs, contacts, supports=("floor",))


def tiny() -> list[str]:
    """(sqrt(3) - sqrt(2))^(2 n + 1), some 10^-20 to 10^-25, and their negatives.

    They are c sqrt(3) - b sqrt(2) with integers of 10^20 and more: nearly all digits cancel.
    """
    b, c, found = 1, 1, []
    for n in range(1, 26):
        b, c = 5 * b + 6 * c, 4 * b + 5 * c
        if n >= 20:
            found += [f"{c}*sqrt(3) - {b}*sqrt(2)", f"-{c}*sqrt(3) + {b}*sqrt(2)"]
    return found


def in_space() -> Scene:
    """A sphere in three rigid corners of a box."""
    ball = Disc(1, (0, 0, 0), ("-1/7", -1, -2), (None, None, None))
    ways = {"wall": (1, 0, 0), "side": (0, 1, 0), "floor": (0, 0, 1)}
    contacts = [Contact(1, name, way, gap="1/5") for name, way in ways.items()]
    return Scene([ball], contacts, supports=tuple(ways))


MAKERS: dict[str, Callable[[], Entry]] = {
    "stable": lambda: certificate(solve(nt30(4))),
    "pushed by a rational": lambda: certificate(solve(nt30(3, push="20"))),
    "saddle": lambda: certificate(solve(tss(4))),
    "osculatory": lambda: certificate(solve(nt60(3))),
    "rigid floor": lambda: certificate(solve(nt60(4, floor_compliance=0))),
    "resting": lambda: certificate(solve(nt60(4, corner_stones="resting"))),
    "bumpy": lambda: certificate(solve(tbs(3))),
    "negative compliance": lambda: certificate(solve(nt30(3, floor_compliance="-1/2"))),
    "several forces": lambda: certificate(solve(between_clamps())),
    "written out": lambda: certificate(solve(beside_a_wall())),
    "two layers": lambda: certificate(solve(nt60(2))),
    "a clamp without force": lambda: certificate(solve(clamped())),
    "neutral": lambda: certificate(solve(rolling_by())),
    "rolling as one": lambda: certificate(solve(tied_together())),
    "in space": lambda: certificate(solve(in_space())),
    "collapse": _collapse,
    "push": lambda: certificate(push_path("nt30", 3)),
    "loads": lambda: certificate(continuation(nt30(3), nt30(3, push="-30*sqrt(3)"))),
    "bounds": lambda: bound_certificate(nt30(3), "1/10*sqrt(3)", {((3, 4), "floor"): 1}),
    "bounds, rough": lambda: bound_certificate(
        tss(3), "3/10", {((3, 2), "floor"): (1, 2)}, ["floor"]
    ),
    "bounds without friction": lambda: bound_certificate(nt30(2), 0, {((2, 2), "floor"): 1}),
    "no bound": lambda: bound_certificate(nt30(2), "3/10", {((2, 1), (2, 2)): 1}, ["floor"]),
    "collapse with friction": lambda: bound_certificate(
        freed(nt60(3)), "1/100", {((2, 1), (2, 2)): 1}, ["floor"]
    ),
    "critical friction": lambda: certificate(critical_friction(nt60(2), "1/1000")),
    "lcp": lambda: _lcp([[2, 1], [1, 2]], ["-5", "-6*sqrt(2)"]),
    "lcp of fractions": lambda: _lcp([["2/3", "1/2"], ["1/2", "5/7"]], [-1, "-2/5"]),
    "lcp that is not symmetric": lambda: _lcp([[2, -1, 0], [3, 1, "1/2"], [-1, 0, 4]], [1, -2, -5]),
    "lcp of tiny numbers": lambda: _lcp(
        [[int(i == j) for j in range(12)] for i in range(12)], tiny()
    ),
    "lcp without solution": lambda: _lcp([[0, "1/3"], ["-1/3", 0]], [1, -1]),
}


def _lcp(M: Any, q: Any) -> Entry:
    problem = lcp(M, q)
    return lcp_certificate(problem, lemke(problem))


@cache
def made(name: str) -> Entry:
    """The certificate of this name; do not write into it."""
    return MAKERS[name]()
