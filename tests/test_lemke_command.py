"""`lcp-piles lemke`: problems in files, judged by their own equations."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from test_cli import run

from lcp_piles.certificates import check_certificate as checker


def problem(place: Path, M: object, q: object, **more: object) -> str:
    file = place / "problem.json"
    file.write_text(json.dumps({"M": M, "q": q, **more}), encoding="utf-8")
    return str(file)


def test_a_solution_solves_and_its_certificate_says_so(capsys, tmp_path) -> None:
    """z = (5/2, 0): w = (0, 12/5), by hand."""
    file = problem(tmp_path, [[2, 1], [1, "2/3"]], [-5, "-0.1"])
    certificate = tmp_path / "c.json"
    words = ("lemke", file, "--json", "-", "--certificate", str(certificate))
    status, out, err = run(capsys, *words)
    assert status == 0
    found = json.loads(out)
    z, w = ([Fraction(x) for x in found[name]] for name in "zw")
    assert (z, w) == ([Fraction(5, 2), 0], [0, Fraction(12, 5)])
    assert "solved" in err
    assert checker.check(certificate.read_bytes()) == [
        "z solves the complementarity problem of 2 unknowns"
    ]


def test_what_has_no_solution_is_proved(capsys, tmp_path) -> None:
    """-z - 1 is never more than -1."""
    certificate = tmp_path / "c.json"
    file = problem(tmp_path, [[-1]], [-1])
    status, out, _ = run(capsys, "lemke", file, "--certificate", str(certificate))
    assert status == 3
    assert "no z >= 0 has M z + q >= 0" in out
    assert "has no solution" in checker.check(certificate.read_bytes())[0]


def test_a_ray_without_a_proof_proves_nothing(capsys, tmp_path) -> None:
    """M is indefinite, so that the ray on which the method ends gives no certificate."""
    certificate = tmp_path / "c.json"
    file = problem(tmp_path, [[-2, 1], [1, 2]], [-2, 1])
    status, out, err = run(capsys, "lemke", file, "--certificate", str(certificate))
    assert status == 5
    assert "proves nothing" in out
    assert "no certificate" in err
    assert not certificate.exists()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("[]", "a JSON object"),
        ("{", "JSON, whole and valid"),
        ('{"M": [[1]]}', "q is None, expected a list"),
        ('{"M": [[1]], "q": []}', "the length of q is 0"),
        ('{"M": [[1]], "q": ["x"]}', "q[0] is 'x'"),
        ('{"M": [[1, 2]], "q": [1]}', "M[0]"),
        ('{"M": [], "q": [1]}', "rows of M is 0, expected 1"),
        ('{"M": [["sqrt(2)"]], "q": [1]}', "a rational number"),
        ('{"M": [[1.5]], "q": [1]}', "M[0][0] is 1.5"),
        ('{"M": [[true]], "q": [1]}', "M[0][0] is True"),
        ('{"M": [[1]], "q": [1], "d": [1]}', "no field of this name"),
        ('{"M": [[1]], "q": ["1e999999999"]}', "q[0]"),
    ],
)
def test_bad_files_are_refused_in_a_line(capsys, tmp_path, content, said) -> None:
    file = tmp_path / "problem.json"
    file.write_text(content, encoding="utf-8")
    status, _, err = run(capsys, "lemke", str(file))
    assert status == 1
    assert said in err
    assert len(err.splitlines()) == 1
