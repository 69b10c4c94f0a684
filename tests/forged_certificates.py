"""Certificates that are wrong in one respect each, to be refused; most are right elsewhere."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from copy import deepcopy
from typing import Any

from tests.certified import Entry, made


def changed(name: str, *changes: tuple[tuple[Any, ...], Any]) -> bytes:
    """The certificate of this name with values put in places."""
    entry = deepcopy(made(name))
    for path, value in changes:
        at: Any = entry
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = value
    return text(entry)


def text(entry: Entry) -> bytes:
    return json.dumps(entry).encode()


def without(name: str, *path: Any) -> bytes:
    """The certificate of this name without one of its fields."""
    entry = deepcopy(made(name))
    at: Any = entry
    for key in path[:-1]:
        at = at[key]
    del at[path[-1]]
    return text(entry)


def zeros(count: int) -> str:
    return " ".join(["0"] * count)


def ball(*contacts: Entry, load: Any = ("0", "-1"), extra: Entry | None = None) -> Entry:
    """A disc on a floor, and what else it touches; its force is 1 on the floor alone."""
    return {
        "format": "lcp-piles-certificate/1",
        "claim": "forces",
        "scene": {
            "supports": ["floor", "wall"],
            "discs": [{"id": "ball", "load": list(load), "held": [None, None]}],
            "contacts": [side("floor", ["0", "1"]), *contacts],
        },
        "u": {"denominator": "1", "1": "0 -1"},
        "f": {"denominator": "1", "1": " ".join(["1", *["0"] * len(contacts)])},
        "mechanisms": {
            "modulus": 7,
            "roots": {},
            "motions": [{"denominator": "1", "1": "1 0"}],
            "pivots": "0 1 1 0",
        },
    } | (extra or {})


def _still(row: str) -> Entry:
    """The proof that the ball cannot move, by the floor and one more contact that touches."""
    row = format(int(row) - 1, "x")
    return {"modulus": 7, "roots": {}, "motions": [], "pivots": f"0 1 {row} 0"}


def groove(**changes: Any) -> Entry:
    """A disc in a groove, that just touches the floor below: no motion, and one idle contact."""
    slopes = [side(name, [x, "4/5"]) for name, x in (("left", "3/5"), ("right", "-3/5"))]
    return {
        "format": "lcp-piles-certificate/1",
        "claim": "forces",
        "scene": {
            "supports": ["left", "right", "floor"],
            "discs": [{"id": "ball", "load": ["0", "-1"], "held": [None, None]}],
            "contacts": [*slopes, side("floor", ["0", "1"], gap="25/32")],
        },
        "u": {"denominator": "20", "1": "0 -19"},
        "f": {"denominator": "8", "1": "5 5 0"},
        "mechanisms": {"modulus": 7, "roots": {}, "motions": [], "pivots": "0 0 1 1"},
        "stress": {"denominator": "8", "1": "-5 -5 8"},
    } | changes


def _dependent() -> bytes:
    """Three rigid contacts of a disc in a plane, of which two are shown to be independent."""
    entry = deepcopy(made("several forces"))
    del entry["rigid stress"]
    proof = entry["mechanisms"]
    entry["rigid"] = {name: proof[name] for name in ("modulus", "roots", "pivots")}
    return text(entry)


def _squeezed() -> bytes:
    """A disc on a rigid floor, squeezed by soft walls: no stress acts on rigid contacts alone."""
    walls = [side("wall", [x, "0"], gap="-1") for x in ("1", "-1")]
    entry = ball(*walls)
    entry["scene"]["contacts"][0]["compliance"] = "0"
    still = {"modulus": 7, "roots": {}, "motions": [], "pivots": "0 1 1 0"}
    entry |= {"u": {"denominator": "1", "1": "0 0"}, "f": {"denominator": "1", "1": "1 1 1"}}
    return text(entry | {"mechanisms": still, "rigid stress": {"denominator": "1", "1": "0 1 1"}})


def _path(change: tuple[tuple[Any, ...], Any]) -> bytes:
    """A path on which nothing happens to the disc on its floor, to a scene with one thing else."""
    start = ball(side("wall", ["1", "0"], gap="5"))
    end = deepcopy(start["scene"])
    (*way, last), value = change
    at: Any = end
    for key in way:
        at = at[key]
    at[last] = value
    points = [{"t": t, "u": start["u"], "f": start["f"]} for t in ("0", "1")]
    head = {"format": start["format"], "claim": "path", "scene": start["scene"]}
    return text(head | {"towards": end, "points": points})


def _lifted(first: str, last: str) -> bytes:
    """A held disc that presses on its floor at one end of a way, and hangs at the other."""

    def scene(height: str) -> Entry:
        disc = {"id": "ball", "load": ["0", "-1"], "held": ["0", height]}
        return {"supports": ["floor"], "discs": [disc], "contacts": [side("floor", ["0", "1"])]}

    def point(t: str, height: str) -> Entry:
        force = "1" if height == "-1" else "0"
        u = {"denominator": "1", "1": f"0 {height}"}
        return {"t": t, "u": u, "f": {"denominator": "1", "1": force}}

    head: Entry = {"format": "lcp-piles-certificate/1", "claim": "path"}
    ends = {"scene": scene(first), "towards": scene(last)}
    return text(head | ends | {"points": [point("0", first), point("1", last)]})


def _ball_in_space(**more: Any) -> Entry:
    """A sphere that falls: along the third axis, as one without friction does."""
    ball = {"id": "ball", "load": ["0", "0", "-1"], "held": [None, None, None]}
    contact = side("floor", ["1", "0", "0"])
    return {
        "format": "lcp-piles-certificate/1",
        "claim": "collapse",
        "scene": {"supports": ["floor"], "discs": [ball], "contacts": [contact]},
        "motion": {"denominator": "1", "1": "0 0 -1" + (" 0" if more else "")},
    } | more


def side(name: str, normal: list[str], **more: Any) -> Entry:
    """A contact of the ball with a support."""
    contact = {"a": "ball", "b": name, "normal": normal, "compliance": "1", "gap": "0"}
    return contact | {"bilateral": False} | more


def spoiled(*changes: tuple[tuple[Any, ...], Any], contacts: tuple[Entry, ...] = ()) -> bytes:
    """The disc on its floor with values put in places."""
    entry = ball(*contacts)
    for path, value in changes:
        at: Any = entry
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = value
    return text(entry)


_FAR = side("wall", ["1", "0"], gap="5")
_TWICE = b'"claim": "forces", "claim": "forces"'

FORGERIES: dict[str, Callable[[], bytes]] = {
    # numbers and vectors
    "a root of a square": lambda: spoiled((("u", "4"), "0 0")),
    "a root of zero": lambda: spoiled((("u", "0"), "0 0")),
    "a root in other digits": lambda: spoiled((("u", "\u0663"), "0 0")),
    "a number beyond all bounds": lambda: spoiled(
        (("scene", "contacts", 0, "gap"), "0" * 4100),
    ),
    "an integer beyond all bounds": lambda: spoiled((("u", "1"), "0" * 100_001 + " -1")),
    "a number with a tail": lambda: spoiled((("scene", "contacts", 0, "gap"), "0x")),
    "a number with a head": lambda: spoiled((("scene", "contacts", 0, "gap"), "x0")),
    "a sum without a sign": lambda: spoiled((("scene", "contacts", 0, "gap"), "0 0")),
    "an empty number": lambda: spoiled((("scene", "contacts", 0, "gap"), "")),
    "a bare sign": lambda: spoiled((("scene", "contacts", 0, "gap"), "-")),
    "a number of JSON": lambda: spoiled((("scene", "contacts", 0, "gap"), 0)),
    "a fraction over zero": lambda: spoiled((("scene", "contacts", 0, "gap"), "0/0")),
    "a denominator of zero": lambda: spoiled((("u", "denominator"), "0")),
    "a denominator below zero": lambda: spoiled((("u", "denominator"), "-1"), (("u", "1"), "0 1")),
    "two denominators": lambda: spoiled((("u", "denominator"), "1 1")),
    "a vector too short": lambda: spoiled((("f", "1"), "")),
    "a vector too long": lambda: spoiled((("f", "1"), "1 0")),
    "nine roots": lambda: spoiled(
        *((("u", r), "0 0") for r in ("2", "3", "5", "6", "7", "10", "11", "13"))
    ),
    # scenes
    "two discs of one name": lambda: text(
        _with(
            ball(),
            discs=[{"id": "ball", "load": ["0", "-1"], "held": [None, None]}] * 2,
            u="0 -1 0 -1",
        )
    ),
    "a support named twice": lambda: spoiled((("scene", "supports"), ["floor", "floor"])),
    "a support like a disc": lambda: spoiled((("scene", "supports"), ["floor", "ball"])),
    "no discs": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "collapse",
            "scene": {"supports": [], "discs": [], "contacts": []},
            "motion": {"denominator": "1"},
        }
    ),
    "bilateral by a number": lambda: spoiled((("scene", "contacts", 0, "bilateral"), 0)),
    "a contact of two supports": lambda: text(ball(_FAR | {"a": "floor"})),
    "a contact of a support with a disc": lambda: text(
        ball(_FAR | {"a": "wall", "b": "ball", "normal": ["-1", "0"]})
    ),
    "a contact of a disc with itself": lambda: text(ball(_FAR | {"b": "ball"})),
    "a contact of nothing": lambda: text(ball(_FAR | {"b": "moon"})),
    "a load with three axes": lambda: spoiled((("scene", "discs", 0, "load"), ["0", "-1", "0"])),
    "a normal with three axes": lambda: text(ball(_FAR | {"normal": ["1", "0", "0"]})),
    "a normal too long": lambda: text(ball(_FAR | {"normal": ["2", "0"]})),
    "a compliance with a root": lambda: text(ball(_FAR | {"compliance": "sqrt(2)"})),
    "a pile of another kind": lambda: changed("bumpy", (("scene", "kind"), "tbs ")),
    "a pile without layers": lambda: changed("bumpy", (("scene", "layers"), 0)),
    "a pile of half a layer": lambda: changed("bumpy", (("scene", "layers"), 3.5)),
    "corner stones of another sort": lambda: changed(
        "stable", (("scene", "corner_stones"), "free")
    ),
    "a pile with a push of nothing": lambda: changed("stable", (("scene", "push"), None)),
    "a field too many in a scene": lambda: changed("stable", (("scene", "colour"), "red")),
    "a field too many in a disc": lambda: spoiled((("scene", "discs", 0, "colour"), "red")),
    "a field too many": lambda: spoiled((("verdict",), "stable")),
    "a field too many in a proof": lambda: spoiled((("mechanisms", "rank"), 1)),
    # solutions
    "a disc that is held elsewhere": lambda: changed(
        "stable", (("scene", "push"), "1"), (("scene", "corner_stones"), "held")
    ),
    "a force that pulls": lambda: text(_with(ball(side("wall", ["0", "-1"])), f="0 -1", u="0 0")),
    "two that overlap": lambda: text(ball(_FAR | {"gap": "-5"})),
    "a force across a gap": lambda: text(
        _with(ball(side("wall", ["0", "1"], gap="5", compliance="0")), f="1/2 1/2")
    ),
    "forces that do not balance": lambda: text(_with(ball(), f="2", u="0 -2")),
    "a bilateral contact with a gap": lambda: text(ball(_FAR | {"bilateral": True})),
    # proofs
    "no stress": lambda: without("osculatory", "stress"),
    "a stress that pulls": lambda: _negated("osculatory", "stress"),
    "no stress at all": lambda: changed(
        "osculatory", (("stress",), {"denominator": "1", "1": zeros(10)})
    ),
    "a stress that does not balance": lambda: changed(
        "osculatory", (("stress",), {"denominator": "1", "1": "0 0 0 0 0 0 0 1 2 0"})
    ),
    "no motion": lambda: without("written out", "motion"),
    "a motion that opens nothing": lambda: changed("written out", (("motion", "1"), zeros(6))),
    "a motion that closes": lambda: _negated("written out", "motion"),
    "a motion of what is held": lambda: changed("written out", (("motion", "1"), "1 0 1 0 0 0")),
    "a stress of nothing": lambda: changed("several forces", (("rigid stress", "1"), zeros(3))),
    "a rigid stress that does not balance": lambda: changed(
        "several forces", (("rigid stress", "1"), "1 1 1")
    ),
    "a stress where none is needed": lambda: spoiled((("stress",), {"denominator": "1", "1": "0"})),
    "no word on rigid contacts": lambda: without("several forces", "rigid stress"),
    "rank modulo one": lambda: spoiled(
        (("mechanisms", "modulus"), 1), (("mechanisms", "pivots"), "0 0 1 1")
    ),
    "a modulus that is no number": lambda: spoiled((("mechanisms", "modulus"), "7")),
    "too few motions": lambda: spoiled(
        (("mechanisms", "motions"), []), (("mechanisms", "pivots"), "0 1")
    ),
    "too many motions": lambda: spoiled(
        (("mechanisms", "motions"), [{"denominator": "1", "1": "1 0"}] * 2)
    ),
    "a motion of zero": lambda: spoiled((("mechanisms", "motions", 0, "1"), "0 0")),
    "a motion that moves a contact": lambda: spoiled((("mechanisms", "motions", 0, "1"), "1 1")),
    "a row twice": lambda: spoiled((("mechanisms", "pivots"), "0 1 0 0")),
    "a column twice": lambda: spoiled((("mechanisms", "pivots"), "0 1 1 1")),
    "a pivot too few": lambda: spoiled((("mechanisms", "pivots"), "0 1")),
    "half a pivot": lambda: spoiled((("mechanisms", "pivots"), "0 1 1 0 0")),
    "a row that is none": lambda: spoiled((("mechanisms", "pivots"), "0 1 2 0")),
    "a root that is none": lambda: spoiled((("mechanisms", "roots"), {"2": 2})),
    "a root of one": lambda: spoiled((("mechanisms", "roots"), {"1": 6})),
    "a root of no prime": lambda: spoiled((("mechanisms", "roots"), {"15": 1})),
    # collapses and paths
    "a collapse that closes": lambda: _negated("collapse", "motion"),
    "a collapse of nothing": lambda: changed(
        "collapse", (("motion", "1"), zeros(12)), (("motion", "3"), zeros(12))
    ),
    "a path of another pile": lambda: changed("push", (("towards", "layers"), 4)),
    "a path of another floor": lambda: changed("push", (("towards", "floor_compliance"), "2")),
    "a path of other corner stones": lambda: changed(
        "push", (("towards", "corner_stones"), "resting")
    ),
    "a path that turns back": lambda: _reversed(),
    "a path with a corner cut": lambda: _cut(),
    "a path that goes on the other way": lambda: _negated("push", "direction", "f"),
    "a path that goes on from elsewhere": lambda: _stopped(),
    # bounds
    "a rough floor by a word": lambda: changed("bounds, rough", (("rough",), "floor")),
    "friction in space": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "collapse",
            "scene": {
                "supports": ["floor"],
                "discs": [{"id": "ball", "load": ["0", "0", "-1"], "held": [None] * 3}],
                "contacts": [side("floor", ["0", "0", "1"])],
            },
            "friction": "1/3",
            "rough": ["floor"],
            "motion": {"denominator": "1", "1": "0 0 -1 0"},
        }
    ),
    "a bound of the other end": lambda: changed("bounds", (("bounds", 1, "end"), "least")),
    "a bound of no end": lambda: changed("bounds", (("bounds", 1, "end"), "most")),
    "a larger bound": lambda: changed("bounds", (("bounds", 1, "value"), "6")),
    "a bound that nothing attains": lambda: changed(
        "bounds", (("bounds", 1, "network"), made("bounds")["bounds"][0]["network"])
    ),
    "a bound that nothing proves": lambda: changed(
        "bounds", (("bounds", 1, "motion"), made("bounds")["bounds"][0]["motion"])
    ),
    "a ray that pulls": lambda: _negated("no bound", "bounds", 1, "ray"),
    "a ray that leads nowhere": lambda: changed(
        "no bound", (("bounds", 1, "ray"), {"denominator": "1", "1": zeros(14)})
    ),
    "a ray that does not balance": lambda: changed(
        "no bound", (("bounds", 1, "ray"), {"denominator": "1", "1": " ".join(["1"] * 14)})
    ),
    "less friction than it takes": lambda: changed("critical friction", (("upper",), "1/4")),
    "more friction than it may": lambda: changed("critical friction", (("lower",), "1/2")),
    # complementarity problems
    "a negative z": lambda: changed("lcp", (("q", "1"), "-5 -5"), (("z", "1"), "-1 0")),
    "a z that is no solution": lambda: changed("lcp", (("z", "denominator"), "4")),
    "a y that is negative": lambda: _negated("lcp without solution", "y"),
    "a y of nothing": lambda: changed("lcp without solution", (("y", "1"), "0 0")),
    "a y with M^T y above zero": lambda: changed("lcp without solution", (("y", "1"), "9 1")),
    "a problem larger than it says": lambda: changed("lcp", (("size",), 3)),
    "a problem of a thousand million": lambda: changed("lcp", (("size",), 10**9)),
    "entries in one place": lambda: changed("lcp", (("rows",), "0 0 0 1")),
    "entries outside": lambda: changed("lcp", (("rows",), "0 1 0 2")),
    # claims about a disc on its floor
    "a stress on what is open": lambda: text(
        ball(
            side("wall", ["1", "0"]),
            side("wall", ["-1", "0"], gap="5"),
            extra={"stress": {"denominator": "1", "1": "0 1 1"}, "free": _still("2")},
        )
    ),
    "rigid contacts of which one depends on others": lambda: _dependent(),
    "a stress on soft contacts": lambda: _squeezed(),
    "a network that pulls": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "critical friction",
            "scene": ball(load=("0", "1"))["scene"],
            "rough": ["floor"],
            "upper": "0",
            "network": {"denominator": "1", "1": "-1"},
        }
    ),
    "a motion that is too fast": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "bounds",
            "scene": ball(side("wall", ["0", "-1"]))["scene"],
            "friction": "0",
            "rough": [],
            "bounds": [
                {
                    "end": "least",
                    "weights": {"0": ["1", "0"]},
                    "network": {"denominator": "1", "1": "3 2"},
                    "motion": {"denominator": "1", "1": "0 3 0"},
                    "value": "3",
                }
            ],
        }
    ),
    "a y that proves nothing of M": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "lcp",
            "size": 1,
            "rows": "0",
            "columns": "0",
            "M": {"denominator": "1", "1": "1"},
            "q": {"denominator": "1", "1": "-1"},
            "y": {"denominator": "1", "1": "1"},
        }
    ),
    "a motion that opens a clamp": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "collapse",
            "scene": {
                "supports": ["floor"],
                "discs": [{"id": "ball", "load": ["0", "1"], "held": [None, None]}],
                "contacts": [side("floor", ["0", "1"], bilateral=True)],
            },
            "motion": {"denominator": "1", "1": "0 1"},
        }
    ),
    "a z below zero by a hair": lambda: _hair_below(),
    "a contact that pulls": lambda: text(
        ball(load=("0", "1"))
        | {"u": {"denominator": "1", "1": "0 1"}, "f": {"denominator": "1", "1": "-1"}}
    ),
    "a force at a gap": lambda: spoiled((("u", "1"), "0 0")),
    "a z below zero": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "lcp",
            "size": 1,
            "rows": "0",
            "columns": "0",
            "M": {"denominator": "1", "1": "1"},
            "q": {"denominator": "1", "1": "1"},
            "z": {"denominator": "1", "1": "-1"},
        }
    ),
    "a w below zero": lambda: text(
        {
            "format": "lcp-piles-certificate/1",
            "claim": "lcp",
            "size": 1,
            "rows": "0",
            "columns": "0",
            "M": {"denominator": "1", "1": "1"},
            "q": {"denominator": "1", "1": "-1"},
            "z": {"denominator": "1", "1": "0"},
        }
    ),
    "a path from the floor into the air": lambda: _lifted("-1", "1"),
    "a path from the air to the floor": lambda: _lifted("1", "-1"),
    "a collapse in space with friction": lambda: text(_ball_in_space(friction="1/2", rough=[])),
    "a path to another normal": lambda: _path((("contacts", 1, "normal"), ["0", "-1"])),
    "a path to a clamp": lambda: _path((("contacts", 1, "bilateral"), True)),
    "a path to another compliance": lambda: _path((("contacts", 1, "compliance"), "2")),
    "a path to what is held": lambda: _path((("discs", 0, "held"), [None, "0"])),
    "a number of one character too many": lambda: spoiled(
        (("scene", "contacts", 0, "gap"), "0" * 4001)
    ),
    "a root of ten digits": lambda: spoiled((("u", "1000000007"), "0 0")),
    # files
    "another format": lambda: spoiled((("format",), "lcp-piles-certificate/2")),
    "no format": lambda: _less(ball(), "format"),
    "another claim": lambda: spoiled((("claim",), "stability")),
    "a name twice": lambda: text(ball()).replace(b'"claim": "forces"', _TWICE),
    "no JSON": lambda: b"{",
    "nothing": lambda: b"",
    "a list": lambda: b"[]",
    "a number": lambda: b"7",
    "no text": lambda: b"\xff\xfe\x00",
    "brackets without end": lambda: b"[" * 100_000,
    "objects without end": lambda: b'{"a":' * 100_000,
    "millions of objects": lambda: b"[" + b"{}," * 4_200_000 + b"{}]",
    "an integer of ten million digits": lambda: b'{"format": ' + b"7" * 10**7 + b"}",
}


def _with(entry: Entry, **changes: Any) -> Entry:
    """The certificate with other discs, or other numbers for u and f (over two)."""
    copy = deepcopy(entry)
    if "discs" in changes:
        copy["scene"]["discs"] = changes["discs"]
    for name in ("u", "f"):
        if name in changes:
            numbers = [2 * _half(word) for word in changes[name].split(" ")]
            copy[name] = {"denominator": "2", "1": " ".join(format(int(x), "x") for x in numbers)}
    return copy


def _half(word: str) -> float:
    return 0.5 if word == "1/2" else float(word)


def _less(entry: Entry, name: str) -> bytes:
    return text({key: value for key, value in entry.items() if key != name})


def _negated(name: str, *path: Any) -> bytes:
    """The certificate with one vector turned round."""
    entry = deepcopy(made(name))
    at: Any = entry
    for key in path:
        at = at[key]
    for root in at.keys() - {"denominator"}:
        at[root] = " ".join(format(-int(word, 16), "x") for word in at[root].split(" "))
    return text(entry)


def _hair_below() -> bytes:
    """z = -q where q is above zero too: w = z + q = 0, and z is negative by some 10^-20."""
    entry = deepcopy(made("lcp of tiny numbers"))
    entry["z"] = deepcopy(entry["q"])
    for root in entry["q"].keys() - {"denominator"}:
        words = entry["q"][root].split(" ")
        entry["z"][root] = " ".join(format(-int(word, 16), "x") for word in words)
    return text(entry)


def _reversed() -> bytes:
    entry = deepcopy(made("push"))
    del entry["direction"]
    entry["points"].reverse()
    return text(entry)


def _cut() -> bytes:
    """Without its corners in between: the straight way from first to last is no solution."""
    entry = deepcopy(made("push"))
    entry["points"] = [entry["points"][0], entry["points"][-1]]
    return text(entry)


def _stopped() -> bytes:
    """The direction of the last piece, from the first point on."""
    entry = deepcopy(made("push"))
    entry["points"] = entry["points"][:1]
    return text(entry)


def sound() -> Iterator[Entry]:
    """What is spoiled above, whole, and what is just within the bounds: to be accepted."""
    yield ball()
    yield ball(_FAR)
    yield groove()
    yield ball(_FAR | {"gap": "0" * 3999 + "5"})
    yield ball() | {"u": {"denominator": "1", "1": "0" * 100_000 + " -1"}}
    yield ball() | {"mechanisms": ball()["mechanisms"] | {"modulus": 2}}
    yield _ball_in_space()
