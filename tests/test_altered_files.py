"""Every single field of a result file, altered: refused by `load`, or refuted by `verify`.

Only how a result was made (method, steps, time, the words of the proof) cannot be checked, and a
scene that is written out is the question and not an answer: altered, it may have the same one.
"""

import json
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import (
    Contact,
    Disc,
    FileFormatError,
    LcpPilesError,
    Scene,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.files.read_result import loads
from lcp_piles.files.write_result import dumps

HISTORY = {
    ("method",),
    ("solver", "pivots"),
    ("solver", "seconds"),
    ("solver", "proof"),
    ("solver", "guess_errors"),
}
WORDS = {
    "closed": ["open", "osculatory"],
    "open": ["closed", "osculatory"],
    "osculatory": ["closed", "open"],
    "stable": ["saddle", "neutral", "undecided"],
    "saddle": ["stable", "neutral", "undecided"],
    "solved": ["unstable", "unresolved"],
    "unstable": ["solved", "unresolved"],
    "held": ["resting"],
    "even": ["whole"],
    "whole": ["even"],
}
FREE = (None, None)
SCENES = {
    "nt30": nt30(2, push="20"),
    "tss, a saddle": tss(3),
    "tbs": tbs(1),
    "own, rigid": nt60(3, floor_compliance=0).without([(1, 1)]),
    "own, two walls": Scene(
        [Disc("a", (0, 0), ("1/2", -1), FREE), Disc(2, (-2, 0), (0, -1), FREE)],
        [
            Contact("a", 2, (1, 0), gap="1/3"),
            Contact("a", "floor", (0, 1)),
            Contact("a", "wall", (-1, 0), 0),
            Contact(2, "floor", (0, 1), "1/2"),
        ],
        supports=("floor", "wall"),
    ),
    "unstable": nt60(3).without([(3, 1)]),
}


def leaves(content: Any, path: tuple = ()) -> Iterator[tuple[tuple, Any]]:
    if isinstance(content, dict | list):
        pairs = content.items() if isinstance(content, dict) else enumerate(content)
        for key, value in pairs:
            yield from leaves(value, (*path, key))
    else:
        yield path, content


def others(value: Any) -> list[Any]:
    """Values of the same look that mean something else."""
    if isinstance(value, bool):
        return [not value, None]
    if isinstance(value, int):
        return [value + 1, value - 1, -7]
    if isinstance(value, float):
        return [value + 1, -1.0]
    if value is None:
        return ["0", True]
    if value in WORDS:
        return WORDS[value]
    try:
        number = surd(value)
    except LcpPilesError:
        return [value + "x"]
    return [str(number + 1), str(-number), str(number + surd("sqrt(3)") / 10**6)]


def part_of(content: Any, path: tuple) -> Any:
    for key in path:
        content = content[key]
    return content


def changed(content: Any, path: tuple, value: Any) -> Any:
    copy = json.loads(json.dumps(content))
    part_of(copy, path[:-1])[path[-1]] = value
    return copy


def holds(content: Any) -> bool:
    """Whether a file is read and its claims are found true."""
    try:
        again = loads(json.dumps(content))
    except FileFormatError:
        return False
    return verify(again.scene, again).ok


@pytest.mark.parametrize("name", SCENES)
def test_no_altered_field_is_believed(name):
    content = json.loads(dumps(solve(SCENES[name])))
    assert holds(content)
    believed = [
        (path, other)
        for path, value in leaves(content)
        if path not in HISTORY and not (path[0] == "scene" and SCENES[name].origin is None)
        for other in others(value)
        if other != value and holds(changed(content, path, other))
    ]
    # A collapse is a proof, and another motion that `verify` accepts is one too.
    assert {path[0] for path, _ in believed} <= {"collapse"}, believed


OPTIONAL = {("solver", name) for name in ("arithmetic", "part", "dof", "contacts")}
OPTIONAL |= {("solver", name) for name in ("whole_dof", "whole_contacts")}
OPTIONAL |= {("scene", name) for name in ("push", "floor_compliance", "corner_stones")}
"""Fields that may be left out: then they have their defaults, or follow from the rest."""


@pytest.mark.parametrize("name", SCENES)
def test_fields_are_neither_left_out_nor_added(name):
    content = json.loads(dumps(solve(SCENES[name])))
    sections = [(), ("scene",), ("solver",), ("stability",)]
    sections += [(rows, 0) for rows in ("discs", "contacts", "collapse")]
    for at in sections:
        if at and at[0] not in content:
            continue
        for key in part_of(content, at):
            copy = json.loads(json.dumps(content))
            del part_of(copy, at)[key]
            if (*at, key) not in HISTORY | OPTIONAL:
                assert not holds(copy), (*at, key)
        assert not holds(changed(content, (*at, "colour"), "red")), at


CONTENT = {name: dumps(solve(scene)) for name, scene in SCENES.items()}
json_values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=8)
    | st.sampled_from(["1/0", "sqrt(0)", "1e999", "0", "closed", "floor", "-", "9**9"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=4,
)


@settings(max_examples=200)
@given(st.sampled_from(sorted(CONTENT)), st.data())
def test_whatever_stands_in_a_field_is_read_or_refused(name, data):
    """Any JSON in place of any part of a file: an error of the family, or a verdict."""
    content = json.loads(CONTENT[name])
    path = data.draw(st.sampled_from([path for path, _ in leaves(content)]))
    path = path[: data.draw(st.integers(1, len(path)))]
    text = json.dumps(changed(content, path, data.draw(json_values)))
    try:
        again = loads(text)
    except FileFormatError:
        return
    verify(again.scene, again)


@settings(max_examples=100)
@given(st.sampled_from(sorted(CONTENT)), st.data())
def test_whatever_stands_in_the_text_is_read_or_refused(name, data):
    """A few characters changed, cut out or put in, anywhere."""
    text = CONTENT[name]
    start = data.draw(st.integers(0, len(text)))
    end = min(len(text), start + data.draw(st.integers(0, 4)))
    other = data.draw(st.text(alphabet='0123456789"[]{},:./-+*sqrtenul \n\\', max_size=4))
    try:
        again = loads(text[:start] + other + text[end:])
    except FileFormatError:
        return
    verify(again.scene, again)
