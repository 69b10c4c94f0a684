"""Every command's help shows an example, and the example is one."""

from __future__ import annotations

import pytest
from test_cli import run

from lcp_piles.cli.parser import COMMANDS, build_parser


@pytest.mark.parametrize("command", COMMANDS, ids=lambda c: c.__name__.split(".")[-1])
def test_the_example_is_understood_and_shown(capsys, tmp_path, monkeypatch, command) -> None:
    monkeypatch.chdir(tmp_path)
    words = command.EXAMPLE.split()
    options = build_parser().parse_args(words)
    assert options.run is command.run
    status, out, _ = run(capsys, words[0], "--help")
    assert status == 0
    assert command.EXAMPLE in " ".join(out.split())
