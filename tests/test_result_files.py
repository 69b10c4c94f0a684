"""Result files: what is written reads back the same, and bad files are refused by field."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from lcp_piles import (
    Contact,
    Disc,
    FileFormatError,
    InputError,
    LcpPilesError,
    Scene,
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
from lcp_piles.files.read_result import loads
from lcp_piles.files.write_result import dumps

SCENES = {
    "nt30 pushed by a rational": nt30(4, push="20"),
    "nt60 on a rigid floor": nt60(4, floor_compliance=0),
    "tss with mechanisms": tss(6, push="-7/3*sqrt(3)"),
    "tbs": tbs(3),
    "without its apex": nt60(4).without([(1, 1)]),
    "unstable": nt60(4).without([(4, 1)]),
    "a kind with other contacts": replace(
        nt30(3), contacts=[replace(c, gap=Fraction(k, 7)) for k, c in enumerate(nt30(3).contacts)]
    ),
    "ids of all sorts": Scene(
        [
            Disc("left wall", (0, 4), (0, -1), (None, None)),
            Disc(-(2**63), (0, 2), (0, -1), (None, None)),
            Disc(("é", 0), (0, 0), (0, -1), (None, None)),
        ],
        [
            Contact("left wall", -(2**63), (0, 1)),
            Contact(-(2**63), ("é", 0), (0, 1)),
            Contact(("é", 0), "floor", (0, 1), gap="1/2"),
            Contact(("é", 0), "wall", (1, 0)),
        ],
        supports=("floor", "wall", "unused"),
    ),
    "without geometry": Scene(
        [Disc(k, (0, 0), (0, -1), (None, None)) for k in (0, 1)],
        [Contact(0, 1, (0, 1)), Contact(1, "floor", (0, 1), "2/3", bilateral=True)],
        geometric=False,
    ),
    "one axis": Scene([Disc(0, [1], [-1], [None])], [Contact(0, "floor", [1])]),
    "three axes": Scene(
        [Disc(0, (1, 2, 3), (0, 0, -1), (0, "1/2", None))], [Contact(0, "floor", (0, 0, 1))]
    ),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_a_saved_solution_loads_as_the_same_and_verifies(scene, tmp_path: Path) -> None:
    solution = solve(scene)
    file = tmp_path / "pile.json"
    save(solution, file)
    again = load(file)
    assert again.scene == scene
    assert again.scene.origin == scene.origin
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
    """Keys and types of notes/result-format.md."""
    content = json.loads(dumps(solved))
    assert content["format"] == "lcp-piles/2"
    assert content["scene"]["kind"] == "nt30"
    assert content["scene"]["push"] == "0"
    assert content["exact"] is True
    assert content["status"] == "solved"
    assert content["stability"]["mechanisms"] == 0
    assert content["stability"]["stable"] is True
    assert {"pivots", "contacts", "dof"} <= content["solver"].keys()
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


def _key(text: str) -> int | str:
    return int(text) if text.lstrip("-").isdigit() else text


def _set(path: str, value: object):
    """A change of one field of the JSON content, given by a dotted path."""

    def change(content: dict) -> None:
        at = content
        *way, last = path.split(".")
        for key in way:
            at = at[_key(key)]
        if value is _GONE:
            del at[_key(last)]
        else:
            at[_key(last)] = value

    return change


_GONE = object()
_CODE = "__import__('os').system('touch /tmp/owned')"
BAD = {
    "another version": ("format", _set("format", "lcp-piles/3")),
    "an unhashable version": ("format", _set("format", [])),
    "an unhashable kind": ("scene.kind", _set("scene.kind", {})),
    "an unhashable state": ("contacts[1].state", _set("contacts.1.state", [])),
    "a field of no use": ("colour", _set("colour", "red")),
    "a field of no use of a disc": ("discs[0].colour", _set("discs.0.colour", "red")),
    "a field of no use of a contact": ("contacts[0].z", _set("contacts.0.z", 1)),
    "a collapse of what stands": ("collapse", _set("collapse", [])),
    "a disc of another name": ("discs[1].id", _set("discs.1.id", [1, 2])),
    "an id that is no number": ("discs[0].id", _set("discs.0.id", [1, True])),
    "a free disc called fixed": ("discs[0].fixed", _set("discs.0.fixed", True)),
    "a fixed disc called free": ("discs[-1].fixed", _set("discs.-1.fixed", False)),
    "fixed as a number": ("discs[0].fixed", _set("discs.0.fixed", 0)),
    "a number as unique": ("contacts[0].gap_unique", _set("contacts.0.gap_unique", 0)),
    "unique forces as text": ("forces_unique", _set("forces_unique", "yes")),
    "floating-point arithmetic": ("solver.arithmetic", _set("solver.arithmetic", "float64")),
    "an arithmetic that is no text": ("solver.arithmetic", _set("solver.arithmetic", 1)),
    "another part": ("solver.part", _set("solver.part", "odd")),
    "the whole instead of the half": ("solver.dof", _set("solver.part", "whole")),
    "other freedoms": ("solver.dof", _set("solver.dof", 7)),
    "other contacts": ("solver.contacts", _set("solver.contacts", -1)),
    "other freedoms of the whole": ("solver.whole_dof", _set("solver.whole_dof", 0)),
    "other contacts of the whole": ("solver.whole_contacts", _set("solver.whole_contacts", 1)),
    "pivots below zero": ("solver.pivots", _set("solver.pivots", -1)),
    "pivots without end": ("solver.pivots", _set("solver.pivots", 10**4000)),
    "a time below zero": ("solver.seconds", _set("solver.seconds", -1e-9)),
    "a time without end": ("solver.seconds", _set("solver.seconds", 10**4000)),
    "a proof that is no text": ("solver.proof", _set("solver.proof", ["trust me"])),
    "a method that is no text": ("method", _set("method", None)),
    "stable as a list": ("stability.stable", _set("stability.stable", [])),
    "stable as a number": ("stability.stable", _set("stability.stable", 1)),
    "stable against the verdict": ("stability.stable", _set("stability.stable", False)),
    "an unknown verdict": ("stability.verdict", _set("stability.verdict", "fine")),
    "mechanisms below zero": ("stability.mechanisms", _set("stability.mechanisms", -7)),
    "mechanisms as a truth": ("stability.mechanisms", _set("stability.mechanisms", False)),
    "more free than there are": ("stability.free", _set("stability.free", 1)),
    "no word of stability": ("stability", _set("stability", _GONE)),
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
    "more layers than discs": ("discs", _set("scene.layers", 4)),
    "other contacts than discs": ("contacts", _set("scene.corner_stones", "resting")),
    "no layers": ("scene.layers", _set("scene.layers", _GONE)),
    "layers as text": ("scene.layers", _set("scene.layers", "3")),
    "an unknown parameter": ("scene.colour", _set("scene.colour", "red")),
    "a float as compliance": ("scene.floor_compliance", _set("scene.floor_compliance", 0.5)),
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
    named = field.replace("[-1]", f"[{len(solved.scene.discs) - 1}]")
    assert str(caught.value).startswith(named)
    assert isinstance(caught.value, LcpPilesError)


OWN = {
    "an unknown support": ("scene", _set("scene.supports", ["table"])),
    "supports that are text": ("scene.supports", _set("scene.supports", "floor")),
    "a support that is no text": ("scene", _set("scene.supports", ["floor", 1])),
    "no word of geometry": ("scene.geometric", _set("scene.geometric", _GONE)),
    "a kind as well": ("scene.kind", _set("scene.kind", "custom")),
    "more discs": ("scene.discs", _set("scene.discs", [])),
    "contacts of no use": ("scene.contacts", _set("scene.contacts", {})),
    "a disc that is a list": ("scene.discs[0]", _set("scene.discs.0", [])),
    "a disc without load": ("scene.discs[0].load", _set("scene.discs.0.load", _GONE)),
    "a load of one axis": ("scene", _set("scene.discs.0.load", ["0"])),
    "a load in floats": ("scene.discs[0].load", _set("scene.discs.0.load", [0.0, -1.0])),
    "an id of lists": ("scene.discs[0].id", _set("scene.discs.0.id", [[1]])),
    "a radius below zero": ("scene.discs[0].radius", _set("scene.discs.0.radius", "-2")),
    "a colour": ("scene.discs[0].colour", _set("scene.discs.0.colour", "red")),
    "a root as compliance": (
        "scene.contacts[0].compliance",
        _set("scene.contacts.0.compliance", "sqrt(2)"),
    ),
    "a normal that is none": ("scene", _set("scene.contacts.0.normal", ["1", "1"])),
    "a normal against the centres": ("scene", _set("scene.contacts.0.normal", ["-1", "0"])),
    "another place": ("discs[0].x", _set("scene.discs.0.position", ["1/1000000", "0"])),
}


@pytest.mark.parametrize(("field", "change"), OWN.values(), ids=OWN.keys())
def test_a_bad_scene_is_refused_by_field(field, change) -> None:
    scene = Scene(
        [Disc("a", (0, 0), (0, -1), (None, None)), Disc("b", (-2, 0), (0, -1), (None, None))],
        [Contact("a", "b", (1, 0)), *(Contact(id, "floor", (0, 1)) for id in ("a", "b"))],
    )
    content = json.loads(dumps(solve(scene)))
    assert loads(json.dumps(content)).scene == scene
    change(content)
    with pytest.raises(FileFormatError) as caught:
        loads(json.dumps(content))
    assert str(caught.value).startswith(f"{field} is ")


BAD_COLLAPSE = {
    "no collapse": ("collapse", _set("collapse", _GONE)),
    "a collapse of one disc": (
        "collapse",
        _set("collapse", [{"id": [1, 1], "dx": "0", "dy": "1"}]),
    ),
    "another disc": ("collapse[0].id", _set("collapse.0.id", [2, 1])),
    "no number": ("collapse[0].dx", _set("collapse.0.dx", 1)),
    "one axis": ("collapse[0].dy", _set("collapse.0.dy", _GONE)),
    "in floats": ("exact", _set("exact", False)),
    "another place": ("discs[1].y", _set("discs.1.y", "0")),
    "another id": ("discs[1].id", _set("discs.1.id", [5, 5])),
    "other ends": ("contacts[1].b", _set("contacts.1.b", "floor")),
    "a force": ("contacts[0].force", _set("contacts.0.force", "0")),
    "a displacement": ("discs[0].dx", _set("discs.0.dx", "0")),
    "stability": ("stability", _set("stability", {"mechanisms": 0, "stable": True})),
}


@pytest.mark.parametrize(("field", "change"), BAD_COLLAPSE.values(), ids=BAD_COLLAPSE.keys())
def test_a_bad_collapse_is_refused_by_field(field, change) -> None:
    content = json.loads(dumps(solve(SCENES["unstable"])))
    change(content)
    if content["exact"] is False:
        content["solver"]["arithmetic"] = "float64"
    with pytest.raises(FileFormatError) as caught:
        loads(json.dumps(content))
    assert str(caught.value).startswith(field)


CLAIMS = [
    _set("stability", {"mechanisms": 0, "free": 0, "stable": True, "verdict": "stable"}),
    _set("forces_unique", True),
    _set("contacts.0.gap_unique", False),
    _set("exact", True),
    _set("solver.arithmetic", "exact"),
    _set("contacts.0.force", "1"),
    _set("contacts.0.force", None),
]


@pytest.mark.parametrize("change", CLAIMS)
def test_a_floating_point_file_claims_nothing(change) -> None:
    content = json.loads(dumps(solve(nt30(3), "newton")))
    assert loads(json.dumps(content)).gap_unique == ()
    change(content)
    with pytest.raises(FileFormatError, match=r"exact|solver.arithmetic|contacts\[0\].force"):
        loads(json.dumps(content))


def test_a_floating_point_file_called_exact_is_refused() -> None:
    content = json.loads(dumps(solve(nt30(3), "newton")))
    content["exact"], content["solver"]["arithmetic"] = True, "exact"
    with pytest.raises(FileFormatError, match=r"discs\[0\].dx|contacts\[0\].force"):
        loads(json.dumps(content))


VERSION_1 = {  # name: scene and method that the file was made with, by the version before
    "nt30": (nt30(2, push="20"), "proved"),
    "mechanisms": (tss(3), "lemke"),
    "own": (nt60(3, floor_compliance=0).without([(1, 1)]), "proved"),
    "unstable": (nt60(3).without([(3, 1)]), "proved"),
    "float": (nt60(2), "newton"),
}


@pytest.mark.parametrize("name", VERSION_1)
def test_files_of_version_1_are_read(name) -> None:
    again = load(Path(__file__).parent / "data" / f"result-1-{name}.json")
    scene, method = VERSION_1[name]
    fresh = solve(scene, method)
    assert again.scene == replace(scene, supports=again.scene.supports)
    assert again.scene.origin == scene.origin
    assert again.scene.supports == ("floor",)
    assert again.status == fresh.status
    assert verify(again.scene, again).ok == fresh.exact
    if fresh.status == "solved":
        assert np.allclose(again.force_array, fresh.force_array, atol=1e-12)
        assert again.states == fresh.states
        assert again.stability == fresh.stability


def test_a_scene_of_version_1_may_have_no_geometry() -> None:
    """Version 1 did not ask for it: here two discs are at one place."""
    content = json.loads((Path(__file__).parent / "data" / "result-1-own.json").read_text())
    for disc in content["scene"]["discs"]:
        disc["position"] = ["0", "0"]
    for disc in content["discs"]:
        disc["x"] = disc["y"] = "0"
    content["solver"]["part"] = "whole"
    for name in ("dof", "contacts"):
        del content["solver"][name]
    again = loads(json.dumps(content))
    assert not again.scene.geometric
    assert verify(again.scene, again).ok


def test_version_1_could_leave_much_out() -> None:
    """The example of version 1 as it was published: no free motions, no verdict, few sizes."""
    content = json.loads((Path(__file__).parent / "data" / "result-1-nt30.json").read_text())
    content["stability"] = {"mechanisms": 0, "stable": True}
    content["solver"] = {"pivots": 12, "seconds": 0.03, "part": "even"}
    again = loads(json.dumps(content))
    assert again.stability == solve(again.scene).stability
    assert again.record.whole_dof == 6  # five discs, two of them held
    assert again.record.arithmetic == "exact"


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
