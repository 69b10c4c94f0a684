"""Result files: what is written reads back the same, and bad files are refused by field."""

import json
from pathlib import Path

import numpy as np
import pytest

from lcp_piles import (
    FileFormatError,
    InputError,
    LcpPilesError,
    Solved,
    load,
    nt30,
    nt60,
    save,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.files.write_result import dumps

SCENES = {
    "nt30 pushed by a rational": nt30(4, push="20"),
    "nt60 on a rigid floor": nt60(4, floor_compliance=0),
    "tss with mechanisms": tss(6, push="-7/3*sqrt(3)"),
    "tbs": tbs(3),
    "custom": nt60(4).without([(1, 1)]),
    "unstable": nt60(4).without([(4, 1)]),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_a_saved_solution_loads_as_the_same_and_verifies(scene, tmp_path: Path) -> None:
    solution = solve(scene)
    file = tmp_path / "pile.json"
    save(solution, file)
    again = load(file)
    assert again.scene == scene
    assert verify(scene, again).ok
    assert dumps(again) == dumps(solution)
    assert again.status == solution.status
    if again.status == "solved":
        assert again.states == solution.states
        assert again.gap_unique == solution.gap_unique
        assert again.stability == solution.stability


def test_a_floating_point_solution_is_written_as_numbers(tmp_path: Path) -> None:
    solution = solve(nt30(4), "newton")
    save(solution, tmp_path / "pile.json")
    content = json.loads((tmp_path / "pile.json").read_text())
    assert content["exact"] is False
    assert isinstance(content["contacts"][0]["force"], float)
    again = load(tmp_path / "pile.json")
    assert np.array_equal(again.force_array, solution.force_array)
    assert not verify(again.scene, again).exact


def test_the_file_keeps_to_the_published_format(solved: Solved) -> None:
    """Keys and types of result format lcp-piles/1, version 1."""
    content = json.loads(dumps(solved))
    assert content["format"] == "lcp-piles/1"
    assert content["scene"]["kind"] == "nt30"
    assert content["scene"]["push"] == "0"
    assert content["exact"] is True
    assert content["status"] == "solved"
    assert content["stability"]["mechanisms"] == 0
    assert content["stability"]["stable"] is True
    assert {"pivots", "seconds", "contacts", "dof"} <= content["solver"].keys()
    for disc in content["discs"]:
        assert {"id", "x", "y", "fixed", "dx", "dy"} <= disc.keys()
    for contact in content["contacts"]:
        assert {"a", "b", "force", "gap", "state"} <= contact.keys()
        assert contact["state"] in ("closed", "open", "osculatory")


def test_numbers_of_more_than_4300_digits_are_written_and_read() -> None:
    """Python refuses to print such integers by default."""
    text = "1/" + "7" * 6000
    assert str(surd(text)) == text


@pytest.fixture(name="solved")
def _solved() -> Solved:
    return solve(nt30(3))


def _set(path: str, value: object):
    """A change of one field of the JSON content, given by a dotted path."""

    def change(content: dict) -> None:
        at = content
        *way, last = path.split(".")
        for key in way:
            at = at[int(key) if key.isdigit() else key]
        if value is _GONE:
            del at[last]
        else:
            at[int(last) if last.isdigit() else last] = value

    return change


_GONE = object()
_CODE = "__import__('os').system('touch /tmp/owned')"
BAD = {
    "another version": ("format", _set("format", "lcp-piles/2")),
    "no format": ("format", _set("format", _GONE)),
    "a number that is code": ("contacts[0].force", _set("contacts.0.force", _CODE)),
    "a power": ("contacts[0].force", _set("contacts.0.force", "9**9**9")),
    "a float in an exact file": ("contacts[0].gap", _set("contacts.0.gap", 0.5)),
    "an unknown state": ("contacts[1].state", _set("contacts.1.state", "ajar")),
    "a contact of other discs": ("contacts[0].a", _set("contacts.0.a", [3, 3])),
    "a missing displacement": ("discs[2].dx", _set("discs.2.dx", _GONE)),
    "a disc elsewhere": ("discs[2].x", _set("discs.2.x", "17")),
    "an unknown kind": ("scene.kind", _set("scene.kind", "nt45")),
    "too many layers": ("scene.layers", _set("scene.layers", 10**9)),
    "fewer layers than discs": ("discs", _set("scene.layers", 2)),
    "layers as text": ("scene.layers", _set("scene.layers", "3")),
    "an unknown parameter": ("scene", _set("scene.colour", "red")),
    "a float as compliance": ("scene", _set("scene.floor_compliance", 0.5)),
    "no discs": ("discs", _set("discs", _GONE)),
    "discs that are no list": ("discs", _set("discs", {"a": 1})),
    "an unknown status": ("status", _set("status", "fine")),
    "mechanisms as text": ("stability.mechanisms", _set("stability.mechanisms", "0")),
    "exact as text": ("exact", _set("exact", "yes")),
}


@pytest.mark.parametrize(("field", "change"), BAD.values(), ids=BAD.keys())
def test_a_bad_file_is_refused_by_field(field, change, solved: Solved, tmp_path: Path) -> None:
    content = json.loads(dumps(solved))
    change(content)
    file = tmp_path / "bad.json"
    file.write_text(json.dumps(content))
    with pytest.raises(FileFormatError) as caught:
        load(file)
    assert str(caught.value).startswith(field)
    assert isinstance(caught.value, LcpPilesError)


@pytest.mark.parametrize("part", [0.1, 0.5, 0.99])
def test_a_file_cut_short_is_refused(part: float, solved: Solved, tmp_path: Path) -> None:
    text = dumps(solved)
    file = tmp_path / "short.json"
    file.write_text(text[: int(len(text) * part)])
    with pytest.raises(FileFormatError, match="JSON"):
        load(file)


@pytest.mark.parametrize("text", ["", "[]", "3", "[" * 100_000, '{"format": NaN}', "\x00"])
def test_other_text_is_refused(text: str, tmp_path: Path) -> None:
    file = tmp_path / "other.json"
    file.write_text(text)
    with pytest.raises(FileFormatError):
        load(file)


def test_a_tampered_force_loads_but_does_not_verify(solved: Solved, tmp_path: Path) -> None:
    content = json.loads(dumps(solved))
    content["contacts"][0]["force"] = "1/7"
    file = tmp_path / "tampered.json"
    file.write_text(json.dumps(content))
    again = load(file)
    assert not verify(again.scene, again).ok


def test_a_file_that_cannot_be_written_leaves_the_old_one(solved: Solved, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="writable"):
        save(solved, tmp_path / "nowhere" / "pile.json")
    with pytest.raises(FileFormatError, match="readable"):
        load(tmp_path / "missing.json")
    assert list(tmp_path.iterdir()) == []
