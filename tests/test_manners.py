"""How the command line behaves: the same bytes for the same words, silence, and interrupts."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from test_cli import run

from lcp_piles import (
    KINDS,
    Contact,
    Disc,
    InputError,
    Scene,
    export,
    nt30,
    nt60,
    pile,
    push_path,
    save,
    save_scene,
    solve,
)
from lcp_piles.files.export import FORMATS
from lcp_piles.scenes.named_contact import named_contact
from lcp_piles.scenes.names import contact_name

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
    "ensemble": [
        "ensemble nt60 --layers 3 --amplitude 1 --samples 20 --workers 1 --out e --json e.json",
        "ensemble e --report --plot pictures",
    ],
    "lemke": ["lemke problem.json --json l.json --certificate l.certificate.json"],
    "certify": ["certify solved.json --out c.json"],
    "check": ["check forces.csv --scene nt60 --layers 3 --json k.json --plot k.png"],
}
"""One line or a few of a command, with all its kinds of files; `compare` prints times."""


def given_in(folder: Path) -> None:
    """What some of the lines read."""
    folder.mkdir()
    solved = solve(nt60(3))
    save(solved, folder / "solved.json")
    export(solved, folder / "forces.csv")
    (folder / "problem.json").write_text('{"M": [[2, 1], [1, 2]], "q": [-5, -6]}')


def files_in(folder: Path) -> dict[str, bytes]:
    found = {str(p.relative_to(folder)): p for p in sorted(folder.rglob("*")) if p.is_file()}
    return {name: path.read_bytes() for name, path in found.items()}


@pytest.mark.parametrize("command", WORDS)
def test_the_same_words_make_the_same_bytes(capsys, tmp_path, monkeypatch, command) -> None:
    """Run twice, a second apart (so much is a date written to), all files and what is printed."""
    found = []
    for name in ("one", "two"):
        folder = tmp_path / name
        given_in(folder)
        monkeypatch.chdir(folder)
        started = int(time.time())
        printed = []
        for line in WORDS[command]:
            status, out, _ = run(capsys, *line.split())
            assert status == 0
            printed.append(out)
        found.append((printed, files_in(folder)))
        while name == "one" and int(time.time()) == started:
            time.sleep(0.02)
    (one, files), (two, others) = found
    assert one == two
    assert files.keys() == others.keys()
    assert [name for name in files if files[name] != others[name]] == []


@pytest.mark.parametrize("command", WORDS)
def test_quiet_is_quiet(capsys, tmp_path, monkeypatch, command) -> None:
    given_in(tmp_path / "here")
    monkeypatch.chdir(tmp_path / "here")
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
    """At work by its first progress; a run started in the background may have Ctrl-C ignored."""
    words = ["push", "nt30", "--layers", "40", "--json", "p.json", "--plot", "p.png"]
    process = subprocess.Popen(
        [sys.executable, "-m", "lcp_piles", *words],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stderr is not None
    assert process.stderr.read(1)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    last = err.decode().splitlines()[-1]
    assert (process.returncode, out, last) == (130, b"", "lcp-piles: interrupted")
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


@pytest.mark.parametrize("kind", KINDS)
def test_printed_names_of_contacts_can_be_given_back(kind: str) -> None:
    """Every contact of a small scene of every kind, in either order of its ends."""
    scene = pile(kind, **{p.name: 4 for p in KINDS[kind].parameters if p.default is None})
    for contact in scene.contacts:
        ends = contact.a, contact.b
        assert named_contact(scene, contact_name(ends)) is contact
        assert named_contact(scene, contact_name(reversed(ends))) is contact


def test_names_of_own_scenes_may_be_anything() -> None:
    ids = [-5, "a-b", "a b", ("x", 2), "b"]
    discs = [Disc(id, (2 * k, 0), (0, -1), (None, None)) for k, id in enumerate(ids)]
    scene = Scene(discs, [Contact(id, "my floor", (0, 1)) for id in ids], ("my floor",))
    for contact in scene.contacts:
        assert named_contact(scene, contact_name((contact.a, contact.b))) is contact


def test_a_name_that_means_two_contacts_is_refused() -> None:
    discs = [Disc(id, (2 * k, 0), (0, -1), (None, None)) for k, id in enumerate((1, "1"))]
    scene = Scene(discs, [Contact(id, "floor", (0, 1)) for id in (1, "1")])
    with pytest.raises(InputError, match="2 contacts have this name"):
        named_contact(scene, "1-floor")


def test_contacts_are_taken_by_the_commands(capsys, tmp_path) -> None:
    """The largest force as printed, pasted back; the forces of the path are those of `force`."""
    words = ["nt30", "--layers", "3"]
    _, out, _ = run(capsys, "solve", *words)
    name = out.split("largest force")[1].split(":")[0].strip()
    _, out, _ = run(capsys, "solve", *words, "--contact", name)
    solution = solve(nt30(3))
    assert out.splitlines()[-1].startswith(f"{name}  closed, force {solution.largest_force()[1]} ")
    _, out, _ = run(capsys, "push", *words, "--contact", name)
    path, contact = push_path("nt30", 3), named_contact(nt30(3), name)
    for r in path.rearrangements:
        assert f"force {name}: {path.force(contact.a, contact.b, r.push)} " in out
    status, _, err = run(capsys, "solve", *words, "--contact", "(2,1)-flor")
    assert status == 2
    assert "close to it: " in err
    scene = tmp_path / "scene.json"
    ball = Disc(-5, (0, 0), (0, -1), (None, None))
    save_scene(Scene([ball], [Contact(-5, "floor", (0, 1))]), scene)
    _, out, _ = run(capsys, "solve", str(scene), "--contact", "-5-floor")
    assert "-5-floor  closed, force 1 w, gap 0 w tau" in out


def test_bash_completes_commands_and_options(capsys, tmp_path: Path) -> None:
    """The script is run by bash itself, and asked as it asks."""
    pytest.importorskip("shtab", reason="needs the extra completion")
    status, script, _ = run(capsys, "--print-completion", "bash")
    assert status == 0
    file = tmp_path / "complete.sh"
    file.write_text(script)
    ask = """source complete.sh
        COMP_WORDS=(lcp-piles $1); COMP_CWORD=$2
        $(complete -p lcp-piles | sed 's/.*-F \\([^ ]*\\).*/\\1/') lcp-piles
        echo ${COMPREPLY[@]}"""

    def complete(*words: str) -> list[str]:
        line = ["bash", "-c", ask, "bash", " ".join(words), str(len(words))]
        found = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=True)
        return found.stdout.split()

    assert complete("vi") == ["view"]
    assert complete("solve", "nt30", "--cont") == ["--contact-stiffness", "--contact"]


def test_completion_says_what_is_missing(capsys, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "shtab", None)
    status, _, err = run(capsys, "--print-completion", "zsh")
    assert status == 1
    assert 'pip install "lcp-piles[completion]"' in err
