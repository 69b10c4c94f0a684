"""How the command line behaves: the same bytes for the same words, silence, and interrupts."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from test_cli import run

from lcp_piles.files.export import FORMATS

WORDS = {
    "solve": [
        "solve nt60 --layers 3 --json a.json --certificate a.certificate.json --plot a.png",
        "solve nt60 --layers 3 --json r.json --rows --plot a.pdf",
        "solve nt60 --layers 3 --plot a.svg",
        "solve nt60 --layers 3 " + " ".join(f"--out all{ending}" for ending in FORMATS),
    ],
    "fields": ["fields nt60 --layers 3 --show stress,pressure --csv f.csv --plot f.svg"],
    "view": ["view nt60 --layers 3 --push-path --friction 1/10 --out v.html"],
    "push": ["push nt30 --layers 3 --json p.json --certificate c.json --plot p.pdf"],
    "bounds": ["bounds tbs --layers 1 --friction 1/10 --csv b.csv --certificate b.json"],
    "friction": ["friction tss --layers 3 --friction 3/10 --csv f.csv --plot f.png"],
    "prove": ["prove tbs --layers 5"],
    "reproduce": ["reproduce --out . --only table1"],
}
"""One line or a few of a command, with every kind of file that it writes."""


@pytest.mark.parametrize("command", WORDS)
def test_the_same_words_make_the_same_bytes(capsys, tmp_path, monkeypatch, command) -> None:
    """Run twice, a second apart (so much is a date written to), all files and what is printed."""
    found = []
    for name in ("one", "two"):
        folder = tmp_path / name
        folder.mkdir()
        monkeypatch.chdir(folder)
        started = int(time.time())
        printed = []
        for line in WORDS[command]:
            status, out, _ = run(capsys, *line.split())
            assert status == 0
            printed.append(out)
        found.append((printed, {p.name: p.read_bytes() for p in folder.iterdir()}))
        while int(time.time()) == started:
            time.sleep(0.02)
    (one, files), (two, others) = found
    assert one == two
    assert files.keys() == others.keys()
    assert [name for name in files if files[name] != others[name]] == []


@pytest.mark.parametrize("command", WORDS)
def test_quiet_is_quiet(capsys, tmp_path, monkeypatch, command) -> None:
    monkeypatch.chdir(tmp_path)
    line = WORDS[command][0].split()
    _, loud, err = run(capsys, *line)
    status, out, silence = run(capsys, *line, "--quiet")
    assert (status, out, silence) == (0, loud, "")
    assert err != "" or command == "reproduce"
    assert "\x1b" not in loud + err  # no colours


def test_quiet_does_not_hide_what_is_wrong(capsys, tmp_path) -> None:
    status, _, err = run(capsys, "lemke", str(tmp_path / "none.json"), "--quiet")
    assert status == 1
    assert "none.json" in err
    _, out, err = run(capsys, "solve", "tbs", "--layers", "2", "--json", "-", "--quiet")
    assert (out[0], err) == ("{", "")


def test_ctrl_c_says_one_line_and_leaves_no_file(tmp_path: Path) -> None:
    words = ["push", "nt30", "--layers", "16", "--json", "p.json", "--plot", "p.png", "--quiet"]
    program = [sys.executable, "-m", "lcp_piles", *words]
    process = subprocess.Popen(
        program, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    time.sleep(2.5)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130, "", "lcp-piles: interrupted\n")
    assert list(tmp_path.iterdir()) == []


def test_a_picture_that_is_interrupted_leaves_what_was_there(tmp_path, monkeypatch) -> None:
    from matplotlib.figure import Figure

    from lcp_piles.pictures import save

    file = tmp_path / "a.png"
    file.write_text("an older picture")

    def interrupted(self: Figure, page, **_: object) -> None:
        page.write(b"half a pict")
        raise KeyboardInterrupt

    monkeypatch.setattr(Figure, "savefig", interrupted)
    with pytest.raises(KeyboardInterrupt):
        save(Figure(), file)
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]
    assert file.read_text() == "an older picture"
