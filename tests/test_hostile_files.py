"""Files made to hang the reader or to fill the memory: each is refused at once."""

import json
import os
import signal
from pathlib import Path
from time import process_time

import pytest

from lcp_piles import FileFormatError, load, nt30, solve
from lcp_piles.files.read_result import loads
from lcp_piles.files.write_result import dumps

SECONDS = 5
"""Less than one on an idle machine; the old reader took from eight seconds to for ever."""


@pytest.fixture(autouse=True)
def _limit():
    """No test waits for ever, whatever it opens."""

    def ring(signum: int, frame: object) -> None:
        raise AssertionError(f"not done in {4 * SECONDS} s")

    before = signal.signal(signal.SIGALRM, ring)
    signal.alarm(4 * SECONDS)
    start = process_time()
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)
    assert process_time() - start < SECONDS


@pytest.fixture(name="content", scope="module")
def _content():
    return json.loads(dumps(solve(nt30(3))))


@pytest.mark.parametrize("name", ["pipe", "/dev/zero", "/dev/random", "/dev/null", ".", "link"])
def test_what_is_no_file_is_not_read(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("pipe")
    with pytest.raises(FileFormatError, match=r"the file is .*(a regular file|Is a directory)"):
        load(tmp_path / name)


@pytest.mark.parametrize("name", ["nowhere", "loop", "nul\0", "n" * 300, "latin"])
def test_what_cannot_be_read_is_named(tmp_path: Path, name: str) -> None:
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "latin").write_bytes(b'{"format": "\xe9"}')
    with pytest.raises(FileFormatError, match=r"the file is .*a readable text file"):
        load(tmp_path / name)


def test_a_file_beyond_all_bounds_is_not_read(tmp_path: Path) -> None:
    with (tmp_path / "long").open("wb") as file:
        file.truncate(5 * 2**30)  # sparse: it takes no room
    with pytest.raises(FileFormatError, match=r"size of the file is 5368709120, expected at most"):
        load(tmp_path / "long")


@pytest.mark.parametrize(
    ("row", "discs"), [(0, 5_999_000), *((row, 3000) for row in ({}, [], None, {"id": [1, 1]}))]
)
def test_a_scene_larger_than_its_file_is_not_built(content, row, discs) -> None:
    """NT30 with 2000 layers has 5,999,000 discs: building it takes over a minute."""
    large = content | {"scene": {"kind": "nt30", "layers": 2000}}
    text = json.dumps(large | {"discs": "ROWS", "contacts": []})
    text = text.replace('"ROWS"', "[" + ",".join([json.dumps(row)] * discs) + "]")
    with pytest.raises(FileFormatError, match=r"discs(\[0\](\.id|\.x)?)? is "):
        loads(text)


@pytest.mark.parametrize("piece", ["{}", "[]", '{"a":[]}', "[[[]]]", '{"":0}', '{"ab":1}'])
@pytest.mark.parametrize(
    "whole", ["[PIECES]", '{"discs": [PIECES]}', '{"format": {"a": [PIECES]}}']
)
def test_millions_of_small_things_are_not_read(piece: str, whole: str) -> None:
    """Twenty megabytes of empty objects or lists took up to five seconds."""
    pieces = ",".join([piece] * (20_000_000 // (len(piece) + 1)))
    with pytest.raises(FileFormatError, match=r"the number of objects.* in the file is"):
        loads(whole.replace("PIECES", pieces))


def test_rows_as_short_as_the_format_allows_are_read() -> None:
    """What is refused next is said of the scene, by a reader that has seen all rows."""
    rows = ",".join(['{"a":[1,1],"b":[2,1]}'] * 100_000)
    with pytest.raises(FileFormatError, match=r"^format is None"):
        loads(f'{{"contacts":[{rows}]}}')


@pytest.mark.parametrize(
    "text",
    [
        '{"a":' * 100_000,
        "[" * 1_000_000,
        '{"format": ' + "1" * 1_000_000 + "}",
        '{"format": ' + "1" * 1_000_000 + ".5}",
        '{"format": 1e' + "9" * 1_000_000 + "}",
        '{"format": "' + "x" * 10_000_000 + '"}',
        "{" + '"format": 1,' * 300_000,
    ],
    ids=["objects", "lists", "digits", "decimals", "exponent", "text", "repeats"],
)
def test_endless_json_is_refused(text: str) -> None:
    with pytest.raises(FileFormatError):
        loads(text)


@pytest.mark.parametrize("path", [("scene",), ("scene", "push"), ("contacts", 0, "force")])
def test_deep_values_are_refused_by_field(content, path) -> None:
    copy = json.loads(json.dumps(content))
    at = copy
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = "DEEP"
    text = json.dumps(copy).replace('"DEEP"', "[" * 800 + "]" * 800)
    with pytest.raises(FileFormatError, match=r"^(scene|contacts)"):
        loads(text)


NUMBERS = {
    "blanks": " " * 1_000_000,
    "blanks within": "1" + " " * 999_000 + "x",
    "roots": " + ".join(f"sqrt({n})" for n in range(100_000, 120_000, 2)),
    "large roots": " + ".join(f"sqrt({n})" for n in range(999_900_000, 999_910_000)),
    "signs": "+-" * 500_000,
    "divisions": "1/" * 500_000,
    "a long fraction": "7" * 499_999 + "/" + "3" * 499_999,
    "an exponent": "1e" + "9" * 1000,
}


@pytest.mark.parametrize("number", NUMBERS.values(), ids=NUMBERS.keys())
@pytest.mark.parametrize("field", ["force", "push"])
def test_numbers_that_take_for_ever_are_refused_by_field(content, number, field) -> None:
    copy = json.loads(json.dumps(content))
    (copy["scene"] if field == "push" else copy["contacts"][0])[field] = number
    with pytest.raises(FileFormatError, match=rf"^(scene|contacts\[0\])\.{field} is "):
        loads(json.dumps(copy))
