"""The reference cases: what is on file is what the program writes, and balances by its decimals."""

from __future__ import annotations

import json
import subprocess
import sys
from hashlib import sha256
from math import fsum

import jsonschema
import pytest

import lcp_piles.certificates.check_certificate as checker
from benchmarks.reference.__main__ import DATA, SUMS, files
from benchmarks.reference.cases import CASES

NAMES = [case.name for case in CASES]


def case(name: str) -> dict:
    return json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))


def test_the_files_are_what_the_program_writes() -> None:
    for name, text in files().items():
        assert (DATA / name).read_text(encoding="utf-8") == text, name


def test_the_checksums_are_those_of_the_files() -> None:
    for line in (DATA / SUMS).read_text(encoding="utf-8").splitlines():
        found, name = line.split("  ")
        assert sha256((DATA / name).read_bytes()).hexdigest() == found


@pytest.mark.parametrize("name", NAMES)
def test_the_decimals_alone_balance(name: str) -> None:
    """The sum of forces on every disc, and of its load, along every axis that is free."""
    data = case(name)
    for disc in data["discs"]:
        for axis, held in enumerate(disc["held"]):
            if held is None and data["status"] == "solved":
                acting = [disc["load"][axis]]
                for contact in data["contacts"]:
                    side = (contact["a"] == disc["id"]) - (contact["b"] == disc["id"])
                    acting.append(side * contact["force"][0] * contact["normal"][axis])
                assert abs(fsum(acting)) < 1e-14
    if name == "nt60-2":
        assert {c["force"][1] for c in data["contacts"]} == {"1/3*sqrt(3)"}


@pytest.mark.parametrize("name", NAMES)
def test_the_schema_describes_them(name: str) -> None:
    jsonschema.validate(case(name), json.loads((DATA / "case.schema.json").read_text()))


@pytest.mark.parametrize("name", NAMES)
def test_their_certificates_hold(name: str) -> None:
    words = [sys.executable, checker.__file__, str(DATA / f"{name}.certificate.json")]
    run = subprocess.run(words, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    verdict = case(name).get("stability", "gives way")
    assert verdict in run.stdout
