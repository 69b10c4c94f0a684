"""Result files as vectors: the same solutions, and no number of theirs is believed when altered."""

from __future__ import annotations

import json
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from lcp_piles import FileFormatError, Scene, load, nt30, nt60, save, solve, tbs, tss, verify
from lcp_piles.files.read_result import loads
from lcp_piles.files.write_result import dumps
from tests.certified import beside_a_wall, in_space

SCENES = {
    "pushed by a rational": nt30(3, push="20"),
    "saddle": tss(4),
    "osculatory": nt60(3),
    "bumpy": tbs(2),
    "own": beside_a_wall(),
    "in space": in_space(),
    "unstable": nt60(3).without([(3, 1)]),
}


@pytest.mark.parametrize("name", SCENES)
def test_both_forms_hold_the_same(name: str) -> None:
    solved = solve(SCENES[name])
    short, long = (loads(dumps(solved, compact=compact)) for compact in (True, False))
    for again in (short, long):
        assert verify(again.scene, again).ok
        assert again.scene == solved.scene
        assert again.record == short.record
    if solved.status == "unstable":
        assert list(short.collapse) == list(solved.collapse)
        return
    assert (short.states, short.gap_unique) == (solved.states, solved.gap_unique)
    assert (short.stability, short.forces_unique) == (solved.stability, solved.forces_unique)
    for vector in ("forces", "gaps", "displacements"):
        assert list(getattr(short, vector)) == list(getattr(solved, vector))


def test_thousands_of_contacts_are_written_as_vectors(tmp_path: Path) -> None:
    """TBS with 40 layers has 2,460 contacts; people may ask for rows all the same."""
    solved = solve(tbs(40))
    save(solved, tmp_path / "short.json")
    save(solved, tmp_path / "rows.json", compact=False)
    assert "vectors" in json.loads((tmp_path / "short.json").read_text())
    assert len(json.loads((tmp_path / "rows.json").read_text())["contacts"]) == 2460
    assert load(tmp_path / "short.json").states == solved.states


def test_floating_point_has_no_vectors() -> None:
    assert "contacts" in json.loads(dumps(solve(nt30(3), "newton"), compact=True))


def holds(content: Any) -> bool:
    try:
        again = loads(json.dumps(content))
    except FileFormatError:
        return False
    return verify(again.scene, again).ok


@pytest.mark.parametrize("name", SCENES)
def test_no_altered_number_is_believed(name: str) -> None:
    """Every integer of every vector plus one, every gap that is not unique another one."""
    content = json.loads(dumps(solve(SCENES[name]), compact=True))
    assert holds(content)
    believed = []
    for vector, entry in content["vectors"].items():
        if vector == "gaps_not_unique":
            altered = [[k for k in entry if k != other] for other in entry] + [[*entry, 0]]
            assert not any(holds(with_vector(content, vector, other)) for other in altered[:-1])
            continue
        for root, text in entry.items():
            tokens = text.split(" ")
            for k, token in enumerate(tokens):
                other = " ".join([*tokens[:k], format(int(token, 16) + 1, "x"), *tokens[k + 1 :]])
                if holds(with_vector(content, vector, entry | {root: other})):
                    believed.append((vector, root, k))
    # A collapse is a proof, and another motion that `verify` accepts is one too. The bob of the
    # own scene, disc 2, may hang a little to the side: x is its place 4.
    free = {("displacements", "1", 4)} if name == "own" else set()
    assert {found for found in believed if found[0] != "collapse"} == free


def with_vector(content: Any, name: str, entry: Any) -> Any:
    copy = deepcopy(content)
    copy["vectors"][name] = entry
    return copy


BAD: dict[str, Any] = {
    "a number too few": {"denominator": "1", "1": "0 0"},
    "no number": {"denominator": "1"},
    "no denominator": {"1": "0 0 0 0 0 0"},
    "a denominator of zero": {"denominator": "0", "1": "0 0 0 0 0 0"},
    "a denominator below zero": {"denominator": "-1", "1": "0 0 0 0 0 0"},
    "two denominators": {"denominator": "1 1", "1": "0 0 0 0 0 0"},
    "no hexadecimal": {"denominator": "1", "1": "0 0 0 0 0 g"},
    "Python's own spelling": {"denominator": "1", "1": "0 0 0 0 0 0x1"},
    "an underscore": {"denominator": "1", "1": "0 0 0 0 0 1_0"},
    "two spaces": {"denominator": "1", "1": "0  0 0 0 0 0"},
    "a root of a square": {"denominator": "1", "4": "0 0 0 0 0 0"},
    "a root of nothing": {"denominator": "1", "0": "0 0 0 0 0 0"},
    "a root in words": {"denominator": "1", "three": "0 0 0 0 0 0"},
    "a root of thirty digits": {"denominator": "1", "3" * 30: "0 0 0 0 0 0"},
    "a list": {"denominator": "1", "1": [0, 0, 0, 0, 0, 0]},
    "no object": "0 0 0 0 0 0",
}


@pytest.mark.parametrize("entry", BAD.values(), ids=BAD)
def test_a_vector_that_is_none_is_refused_by_field(entry: Any) -> None:
    content = json.loads(dumps(solve(tbs(1)), compact=True))
    for name in ("displacements", "forces"):
        with pytest.raises(FileFormatError, match="vectors"):
            loads(json.dumps(with_vector(content, name, entry)))


def test_a_scene_larger_than_its_vectors_is_not_built() -> None:
    content = json.loads(dumps(solve(nt30(3)), compact=True))
    content["scene"]["layers"] = 2000
    with pytest.raises(FileFormatError, match=r"scene\.discs"):
        loads(json.dumps(content))


def test_fields_are_neither_left_out_nor_added() -> None:
    content = json.loads(dumps(solve(nt30(3)), compact=True))
    for name in ("vectors", "status", "exact", "stability", "solver"):
        assert not holds({key: value for key, value in content.items() if key != name})
    assert not holds(content | {"contacts": []})
    assert not holds(with_vector(content, "gaps", content["vectors"]["forces"]))
    assert not holds(with_vector(content, "gaps_not_unique", [99]))
    assert not holds(with_vector(content, "gaps_not_unique", [True]))


def test_own_scenes_are_read_as_they_were_written() -> None:
    again = loads(dumps(solve(beside_a_wall()), compact=True))
    assert isinstance(again.scene, Scene)
    assert [contact.gap for contact in again.scene.contacts] == [0, 0, 0, 0]
