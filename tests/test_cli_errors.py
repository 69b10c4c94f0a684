"""Whatever the words are, the command line ends with an exit status and a message, never otherwise.

Numbers beyond the range of floats, devices that are full, sizes that no machine holds, and words
drawn at random. The statuses are those that `--help` documents.
"""

from __future__ import annotations

import io
import os
import subprocess
import sys
import warnings
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lcp_piles import FIELDS, METHODS
from lcp_piles.cli.parser import main

HUGE = "1" + "0" * 400
NEARLY = "1" + "0" * 300
NINES = "9" * 400
ALL = ",".join(FIELDS)


def run(*words: str) -> tuple[int, str, str]:
    """Exit status, standard output and standard error; a warning counts as an exception."""
    out, err = io.StringIO(), io.StringIO()
    with warnings.catch_warnings(), redirect_stdout(out), redirect_stderr(err):
        warnings.simplefilter("error")
        # Those of old versions of matplotlib about the libraries that it uses.
        warnings.simplefilter("ignore", DeprecationWarning)
        status = main(words)
    return status, out.getvalue(), err.getvalue()


@pytest.mark.parametrize("push", [HUGE, NEARLY, "-" + HUGE], ids=["400", "300", "minus 400"])
@pytest.mark.parametrize("method", METHODS)
def test_a_push_beyond_floats_is_solved_exactly_and_refused_in_floats(method, push) -> None:
    status, out, err = run("solve", "nt30", "--layers", "3", "--push", push, "--method", method)
    assert status == 0 or (status == 1 and ("beyond the range" in err or "unresolved" in out))
    if method in ("proved", "lemke"):
        assert status == 0


def test_exact_numbers_beyond_floats_keep_their_decimals() -> None:
    """The apex of two layers presses 1/2 w to each side, however far the stones are pushed."""
    words = ("fields", "nt60", "--layers", "2", "--show", "support")
    _, out, _ = run(*words, "--push", HUGE)
    _, more, _ = run(*words, "--push", HUGE + "0")
    assert out == more
    assert "-1.5" in out


@pytest.mark.parametrize("push", [HUGE, NEARLY], ids=["400", "300"])
def test_pictures_of_numbers_beyond_floats(push, tmp_path: Path) -> None:
    file = str(tmp_path / "pile.png")
    for command in (("solve",), ("fields", "--show", "stress")):
        words = (command[0], "nt30", "--layers", "3", *command[1:], "--push", push, "--plot", file)
        status, _, err = run(*words)
        assert status == 0 or (status == 1 and "numbers that can be drawn" in err)
        assert (status == 0) == (push == NEARLY)


def test_fields_of_numbers_beyond_floats() -> None:
    status, out, _ = run("fields", "nt30", "--layers", "3", "--push", HUGE, "--show", ALL)
    assert status == 0
    assert "e+399" in out


@pytest.mark.parametrize("digits", ["6", "5000"])
@pytest.mark.parametrize("command", ["prove", "push", "solve"])
def test_a_floor_compliance_of_400_digits(command: str, digits: str) -> None:
    words = (command, "nt30", "--layers", "3", "--floor-compliance", NINES, "--digits", digits)
    status, _, err = run(*words)
    assert status in (0, 1)
    assert status == 0 or err.splitlines()[-1].startswith("lcp-piles: ")


@pytest.mark.parametrize("push", [HUGE, NEARLY], ids=["400", "300"])
def test_prove_refuses_what_floats_cannot_hold(push) -> None:
    status, out, err = run("prove", "nt30", "--layers", "3", "--push", push, "--digits", "5000")
    assert status == 1
    assert "beyond the range" in err or "not proved" in out or "use solve" in err


def test_a_push_without_a_floor_force_has_no_curve(tmp_path: Path) -> None:
    status, _, err = run("push", "tss", "--layers", "2", "--plot", str(tmp_path / "x.png"))
    assert status == 1
    assert "movable discs on the floor" in err


@pytest.mark.parametrize("last", ["2001", "1000000000", "10**9", "9" * 5000])
def test_sizes_are_looked_at_before_anything_is_computed(last: str) -> None:
    status, out, err = run("compare", "nt30", "--layers", "2.." + last)
    assert status == 2
    assert out == ""
    assert "expected a number from 2 to 2000" in err


def test_parameters_that_a_kind_has_not_are_a_mistake() -> None:
    status, _, err = run("solve", "tbs", "--layers", "2", "--floor-compliance", "0")
    assert status == 2
    assert "tbs" in err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs the device /dev/full")
@pytest.mark.parametrize(
    "words",
    [
        ("solve", "nt60", "--layers", "2"),
        ("solve", "nt60", "--layers", "2", "--json", "-"),
        ("compare", "nt60", "--layers", "2"),
        ("--help",),
        ("--version",),
    ],
    ids=" ".join,
)
def test_standard_output_on_a_full_device(words: tuple[str, ...]) -> None:
    with Path("/dev/full").open("w") as full:
        command = [sys.executable, "-m", "lcp_piles", *words]
        own = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
        done = subprocess.run(
            command, stdout=full, stderr=subprocess.PIPE, text=True, env=own, check=False
        )
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert "standard output cannot be written: No space left on device" in done.stderr
    assert "Exception ignored" not in done.stderr


def test_a_reader_that_has_seen_enough_is_no_error_message() -> None:
    command = [sys.executable, "-m", "lcp_piles", "fields", "nt60", "--layers", "2", "--show", ALL]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        said = process.stderr.read()
    assert "Traceback" not in said
    assert "Exception ignored" not in said


KINDS_AND_WORSE = st.sampled_from(["nt30", "nt60", "tss", "tbs", "nt45", "", "--help"])
LAYERS = st.sampled_from(
    ["1", "2", "3", "0", "-1", "2001", "2..3", "3..2", "..", "1e3", "٣", "²", ""]
)
NUMBERS = st.sampled_from(
    [
        *("0", "1", "20", "-7/3", "7/3*sqrt(3)", "2 - 1/2*sqrt(3)", "0.5", "1e-3", "-1/2", HUGE),
        *("nan", "inf", "1/0", "sqrt(-1)", "sqrt(0)", "", " ", "-", "--", "x", "0x10", "1_000"),
        *("1e999999999", "1/3/5", "٣", "+-1", "sqrt(3)*sqrt(3)", "'", "\n", "\0"),
    ]
)  # fmt: skip
OPTIONS = st.one_of(
    st.tuples(st.just("--push"), NUMBERS),
    st.tuples(st.just("--floor-compliance"), NUMBERS),
    st.tuples(st.just("--until"), NUMBERS),
    st.tuples(st.just("--digits"), st.sampled_from(["1", "30", "0", "-1", "x", "100001", "²"])),
    st.tuples(st.just("--corner-stones"), st.sampled_from(["held", "resting", "falling", ""])),
    st.tuples(st.just("--method"), st.sampled_from([*METHODS, "guess"])),
    st.tuples(st.just("--show"), st.sampled_from([*FIELDS, ALL, "stress,,", "temperature", ""])),
    st.tuples(st.just("--only"), st.just("figure-99")),
    st.tuples(st.just("--friction"), st.sampled_from(["3/10", "0", "-1", "x", "1/10*sqrt(3)"])),
    st.tuples(st.just("--stiffness"), st.sampled_from(["1/1000", "0", "-1", "x", ""])),
    st.tuples(
        st.sampled_from(["--json", "--csv"]), st.sampled_from(["-", "/nowhere/x", "/", "\0"])
    ),
    st.tuples(st.just("--plot"), st.sampled_from(["/nowhere/x.png", "x.gif3", "", "/"])),
    st.tuples(st.sampled_from(["--whole", "--help", "--nonsense", "-x", "--push", "nt30"])),
)


@given(
    command=st.sampled_from(
        ["solve", "fields", "prove", "push", "bounds", "compare", "reproduce", "sovle"]
    ),
    kind=KINDS_AND_WORSE,
    layers=LAYERS,
    options=st.lists(OPTIONS, max_size=3),
)
def test_words_at_random(command, kind, layers, options) -> None:
    if command == "reproduce":  # without a figure's name it would draw them all
        words = ["reproduce", "--only", "figure-99"]
    else:
        words = [command, kind, "--layers", layers]
    status, _, err = run(*words, *(word for option in options for word in option))
    assert status in (0, 1, 2, 3)
    assert status != 1 or err
    assert "Surd(" not in err
    assert len(err) < 5000
