"""Scenes as files: written and read back the same, written by people, and made to do harm."""

import json
from pathlib import Path
from time import process_time

import pytest
from hypothesis import given, settings

from lcp_piles import (
    KINDS,
    Contact,
    Disc,
    FileFormatError,
    InputError,
    Scene,
    load_scene,
    nt30,
    nt60,
    save,
    save_scene,
    solve,
    tbs,
)
from lcp_piles.cli.parser import main
from lcp_piles.files.scene_file import scene_of_text
from lcp_piles.files.scene_json import MOST_DISCS
from tests.helpers import piles, rough_piles

BALL = {"id": "ball", "position": [0, 0], "load": [0, -1], "held": [None, None]}
STONE = {"id": "stone", "position": [2, "0"], "load": [0, 0], "held": [0, "0"]}
FLOOR = {"a": "ball", "b": "floor", "normal": [0, 1], "compliance": "1/2"}
SIDE = {"a": "stone", "b": "ball", "normal": [1, 0], "gap": "0.1"}
BY_HAND = {"discs": [BALL, STONE], "contacts": [FLOOR, SIDE]}


def text_of(scene: object) -> str:
    return json.dumps({"format": "lcp-piles/2", "scene": scene})


@settings(max_examples=25, deadline=None)
@given(scene=piles() | rough_piles())
def test_a_saved_scene_loads_as_the_same(tmp_path_factory, scene) -> None:
    file = tmp_path_factory.mktemp("scenes") / "scene.json"
    save_scene(scene, file)
    again = load_scene(file)
    assert again == scene
    assert again.origin == scene.origin


@pytest.mark.parametrize("axes", [1, 2, 3])
def test_scenes_of_all_dimensions_with_everything_in_them(axes, tmp_path: Path) -> None:
    up = (0,) * (axes - 1) + (1,)
    scene = Scene(
        [
            Disc(("é", -1), ("1/3*sqrt(2)",) * axes, (-1,) * axes, (None,) * axes),
            Disc(7, (0,) * axes, (0,) * axes, ("-1/7",) + (None,) * (axes - 1)),
        ],
        [
            Contact(("é", -1), "wall", up, "2/3", "-1/5", bilateral=True),
            Contact(("é", -1), 7, up, 0),
        ],
        supports=("wall", "unused"),
        geometric=False,
    )
    save_scene(scene, tmp_path / "scene.json")
    assert load_scene(tmp_path / "scene.json") == scene


def test_what_has_a_default_in_python_may_be_left_out() -> None:
    """The example of the notes, as a person writes it in Python."""
    free = (None, None)
    expected = Scene(
        [Disc("ball", (0, 0), (0, -1), free), Disc("stone", (2, 0), (0, 0), (0, 0))],
        [
            Contact("ball", "floor", (0, 1), compliance="1/2"),
            Contact("stone", "ball", (1, 0), gap="1/10"),
        ],
    )
    assert scene_of_text(text_of(BY_HAND)) == expected
    assert scene_of_text(text_of({"kind": "nt30", "layers": 3})).origin == nt30(3).origin


def test_the_example_of_the_notes_is_read() -> None:
    notes = Path(__file__).parents[1] / "notes" / "result-format.md"
    section = notes.read_text(encoding="utf-8").split("## Scene files")[1]
    lines = [line for line in section.splitlines() if line.startswith("    ")]
    assert solve(scene_of_text("\n".join(lines))).status == "solved"


def test_the_scene_of_a_result_file_is_one(tmp_path: Path) -> None:
    save(solve(tbs(2)), tmp_path / "result.json")
    assert load_scene(tmp_path / "result.json") == tbs(2)


def with_field(row: dict, **fields: object) -> dict:
    """The scene by hand, some fields of one row changed."""
    return BY_HAND | {
        name: [r | fields if r is row else r for r in BY_HAND[name]]
        for name in ("discs", "contacts")
    }


def without(row: dict, name: str) -> dict:
    rest = {key: value for key, value in row.items() if key != name}
    lists = ("discs", "contacts")
    return {of: [rest if r is row else r for r in BY_HAND[of]] for of in lists}


BAD = {
    "a decimal that is no text": (with_field(SIDE, gap=0.1), "scene.contacts[1].gap"),
    "a truth for a number": (with_field(BALL, load=[0, True]), "scene.discs[0].load"),
    "a radical compliance": (
        with_field(FLOOR, compliance="sqrt(2)"),
        "scene.contacts[0].compliance",
    ),
    "no load": (without(BALL, "load"), "scene.discs[0].load"),
    "no normal": (without(SIDE, "normal"), "scene.contacts[1].normal"),
    "a field of no use": (with_field(SIDE, friction="1/2"), "scene.contacts[1].friction"),
    "no contacts": ({"discs": [BALL]}, "scene.contacts"),
    "contacts that are none": (BY_HAND | {"contacts": [1]}, "scene.contacts[0]"),
    "no discs": (BY_HAND | {"discs": []}, "scene"),
    "an unknown end": (with_field(FLOOR, b="table"), "scene"),
    "an unknown kind": ({"kind": "nt45", "layers": 3}, "scene.kind"),
    "a kind without its size": ({"kind": "nt30"}, "scene.layers"),
    "a kind beyond all bounds": ({"kind": "nt30", "layers": 10**9}, "scene.layers"),
    "a kind too large": ({"kind": "nt30", "layers": 2000}, "the number of discs of nt30"),
    "a list": ([], "scene"),
    "nothing": (None, "scene"),
    "a number that takes for ever": (
        with_field(SIDE, gap="1e" + "9" * 1000),
        "scene.contacts[1].gap",
    ),
    "a deep value": (with_field(SIDE, gap=[[[[]]]]), "scene.contacts[1].gap"),
}


@pytest.mark.parametrize(("scene", "field"), BAD.values(), ids=BAD.keys())
def test_a_bad_scene_is_refused_by_field_at_once(scene, field) -> None:
    start = process_time()
    with pytest.raises(FileFormatError) as caught:
        scene_of_text(text_of(scene))
    assert str(caught.value).startswith(f"{field} is ")
    assert process_time() - start < 1


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", "[" * 100_000, '{"format": NaN}', '{"format": 2}']
)
def test_other_text_is_refused(text: str) -> None:
    with pytest.raises(FileFormatError, match=r"^(the file|format) is "):
        scene_of_text(text)


def test_versions_before_had_no_scene_files() -> None:
    with pytest.raises(FileFormatError, match="format is 'lcp-piles/1'"):
        scene_of_text('{"format": "lcp-piles/1", "scene": {"kind": "tbs", "layers": 2}}')


def test_the_largest_scene_of_a_kind_is_the_limit() -> None:
    """NT30 of N layers has N(3N - 1)/2 discs (notes/paper.md): 258 layers are the last below it."""
    sizes = [KINDS["nt30"].size(**dict(KINDS["nt30"].values({"layers": n})))[0] for n in (258, 259)]
    assert sizes[0] < MOST_DISCS < sizes[1]


def test_a_result_with_a_false_claim_about_its_scene_has_none(tmp_path: Path) -> None:
    save(solve(nt60(3)), tmp_path / "result.json")
    content = json.loads((tmp_path / "result.json").read_text())
    content["discs"][0]["x"] = "17"
    with pytest.raises(FileFormatError, match=r"discs\[0\]\.x"):
        scene_of_text(json.dumps(content))


def test_a_scene_that_cannot_be_written() -> None:
    with pytest.raises(InputError, match="writable"):
        save_scene(nt60(2), "/nowhere/scene.json")


@pytest.fixture(name="file")
def _file(tmp_path: Path) -> str:
    save_scene(nt60(4).without([(1, 1)]), tmp_path / "pile.json")
    return str(tmp_path / "pile.json")


@pytest.mark.parametrize(
    "command",
    [
        ("solve",),
        ("fields", "--show", "support"),
        ("prove",),
        ("bounds", "--friction", "1/10"),
    ],
    ids=lambda words: words[0],
)
def test_every_command_of_one_scene_takes_a_file(command, file, capsys) -> None:
    assert main([command[0], file, *command[1:]]) == 0
    captured = capsys.readouterr()
    assert "own scene, 9 discs" in captured.out + captured.err


def test_a_file_of_a_kind_is_that_kind(tmp_path: Path, capsys) -> None:
    """The lines of both, but for the time, are the same."""
    save_scene(nt30(3, push="1/2"), tmp_path / "pile.json")
    shown = []
    for words in ((str(tmp_path / "pile.json"),), ("nt30", "--layers", "3", "--push", "1/2")):
        assert main(["solve", *words]) == 0
        shown.append([line for line in capsys.readouterr().out.splitlines() if " s (" not in line])
    assert shown[0] == shown[1]


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("solve", "FILE", "--layers", "3"), 2, "--layers: FILE is a file, which says it all"),
        (("prove", "FILE", "--push", "0"), 2, "--push: FILE is a file"),
        (("solve", "FILE.no"), 2, "is neither a kind (nt30, "),
        (("solve", "/dev/zero"), 1, "expected a regular file"),
        (("solve", "/"), 1, "expected a readable text file"),
        (("bounds", "FILE", "--rough", "--friction", "x"), 2, "--friction"),
        (("compare", "FILE", "--layers", "3"), 2, "invalid choice"),
        (("push", "FILE", "--layers", "3"), 2, "invalid choice"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else None,
)
def test_bad_words_about_files(words, status, said, file, capsys) -> None:
    assert main([word.replace("FILE", file) for word in words]) == status
    assert said.replace("FILE", file) in capsys.readouterr().err


def test_a_bad_file_is_an_error_that_names_the_field(tmp_path: Path, capsys) -> None:
    (tmp_path / "bad.json").write_text(text_of(BAD["no load"][0]))
    assert main(["solve", str(tmp_path / "bad.json")]) == 1
    assert "scene.discs[0].load is 'missing'" in capsys.readouterr().err
