"""The comparison: its adapters against the exact solution, its baseline, its resumable rows."""

from __future__ import annotations

import pkgutil
import sys
from fractions import Fraction
from importlib import import_module
from random import Random

import numpy as np
import pytest

import benchmarks
import lcp_piles
from benchmarks.comparison import csv_rows
from benchmarks.comparison.bars import bars
from benchmarks.comparison.fraction_tableau import lemke_tableau
from benchmarks.comparison.judge import exact_hash, reference, unbalanced, verdict
from benchmarks.comparison.methods import METHODS, Method
from benchmarks.comparison.problem import problem
from benchmarks.comparison.run import compare
from benchmarks.comparison.scenes import build
from benchmarks.comparison.table import points
from benchmarks.comparison.worker import in_own_process
from benchmarks.friction import __main__ as friction
from benchmarks.friction import sweep
from lcp_piles import lemke, solve

SCENE = "nt30 4"
# What each method is good for on a small pile at its finest setting; LAMMPS has the error of tau.
COARSE = {"lammps": 1e-4, "lammps, tau to 0": 1e-6, "lemke-float32": 1e-5, "z-float32": 1e-4}


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name.replace(" ", "-"))
def test_every_method_against_the_exact_solution(method: Method, tmp_path) -> None:
    pytest.importorskip(method.module, reason=f"needs the extra {method.extra}")
    name = SCENE + " push=0" if method.name == "continuation" else SCENE
    scene = build(name)
    try:
        answer = method.run(problem(scene), method.settings[-1])
    except ImportError as error:
        pytest.skip(f"needs the extra {method.extra}: {error}")
    truth = reference(SCENE, tmp_path)
    said = verdict(method, method.settings[-1], scene, answer, truth)
    assert said["relative"] <= COARSE.get(method.name, 1e-7)
    if method.group == "exact":
        assert said["digits"] == "all"
    assert said["claim_true"] in (True, "")


MODULES = sorted(m.name for m in pkgutil.walk_packages(benchmarks.__path__, "benchmarks."))


@pytest.mark.parametrize("name", MODULES)
def test_every_module_can_be_imported(name: str) -> None:
    """The programs too: each runs only as `python -m`."""
    module = import_module(name)
    assert module.__doc__


def test_the_programs_are_there() -> None:
    programs = {name.split(".")[1] for name in MODULES if name.endswith("__main__")}
    own = {"comparison", "speed", "failures", "paper", "stiffness", "scenes", "friction"}
    own |= {"disorder"}
    wanted = own | {"reference"}
    assert programs == wanted


def test_the_methods_are_those_of_the_registry_and_more() -> None:
    ours = {m.name for m in METHODS if m.group in ("exact", "float")}
    assert set(lcp_piles.METHODS) <= ours
    assert len({m.name for m in METHODS}) == len(METHODS)


def test_the_fraction_tableau_pivots_as_exact_lemke_does() -> None:
    """On random positive semidefinite problems with solutions, which both have to find."""
    random = Random(5)
    for size in range(1, 8):
        A = [[random.randint(-3, 3) for _ in range(size)] for _ in range(size)]
        M = [[sum(a * b for a, b in zip(r, s, strict=True)) for s in A] for r in A]
        q = [random.randint(-5, 5) - sum(row) * 2 for row in M]
        ours = lemke(M, q)
        theirs = lemke_tableau(M, q)
        assert (ours.status == "solved") == (theirs is not None)
        if theirs is None:
            continue
        z = theirs[0]
        w = [
            b + sum(m * x for m, x in zip(row, z, strict=True)) for row, b in zip(M, q, strict=True)
        ]
        assert min(z) >= 0
        assert min(w) >= 0
        assert sum(a * b for a, b in zip(z, w, strict=True)) == 0
        assert w == [Fraction(x) for x in ours.w]


def test_a_wrong_claim_is_found_out(tmp_path) -> None:
    """Forces that are off by a part in a thousand: no claim of 1e-9 survives them."""
    newton = next(m for m in METHODS if m.name == "newton")
    scene = build(SCENE)
    answer = newton.run(problem(scene), None)
    truth = reference(SCENE, tmp_path)
    answer.forces[int(np.argmax(answer.forces))] *= 1.001
    said = verdict(newton, None, scene, answer, truth)
    assert said["claim_true"] is False
    assert 1e-4 < said["relative"] < 1e-2


def test_balance_is_measured_on_the_scene() -> None:
    scene = build("tss 5")
    assert unbalanced(scene, solve(scene).force_array) < 1e-14
    assert unbalanced(scene, np.zeros(len(scene.contacts))) == 1.0


def test_hashes_tell_exact_forces_apart() -> None:
    first, second = solve(build("nt60 4")), solve(build("nt60 4"), "lemke")
    assert exact_hash(first.forces) == exact_hash(second.forces)
    assert exact_hash(first.forces) != exact_hash(solve(build("nt60 4 push=1")).forces)


def test_rows_are_not_run_twice(tmp_path) -> None:
    compare(("tbs 2",), tmp_path, 30, ("proved", "newton"))
    rows = csv_rows.read(tmp_path / "methods.csv")
    assert {row["method"]: row["status"] for row in rows} == {"proved": "ok", "newton": "ok"}
    compare(("tbs 2",), tmp_path, 30, ("proved", "newton", "contacts"))
    again = csv_rows.read(tmp_path / "methods.csv")
    assert again[:2] == rows
    assert [row["method"] for row in again] == ["proved", "newton", "contacts"]
    assert all(p.claim_true for p in points(again))
    assert bars(points(again), "seconds") == []


def test_a_missing_package_names_its_extra(tmp_path, monkeypatch, capsys) -> None:
    from dataclasses import replace

    from benchmarks.comparison import run, worker

    absent = replace(METHODS[0], name="absent", module="no_such_package", extra="peers")
    monkeypatch.setattr(run, "METHODS", (absent,))
    monkeypatch.setattr(worker, "method", lambda name: absent)
    compare(("tbs 2",), tmp_path, 30)
    assert "lcp-piles[peers]" in capsys.readouterr().out
    assert csv_rows.read(tmp_path / "methods.csv") == []


def test_a_run_without_end_is_ended() -> None:
    def forever(say) -> None:
        say({"status": "begun"})
        while True:
            pass

    assert in_own_process(forever, seconds=0.3) == ([{"status": "begun"}], "ended after 0.3 s")


def test_the_closure_of_all_contacts_at_the_limit_is_overdetermined_on_floors() -> None:
    rows = [line.strip("| ").split(" | ") for line in friction.closure()[2:]]
    counts = {name: int(difference) for name, *_, difference in rows}
    assert (counts["NT30 4"], counts["TSS 6"], counts["TBS 4"]) == (-10, -13, 0)
    # An Euler count for TBS: a free disc has its share of three contacts, and three equations.
    assert counts["TBS 6"] == 0


def test_the_sweep_of_bounds_goes_on_where_it_stopped(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(sweep, "FILE", tmp_path / "results" / "sweep.csv")
    monkeypatch.setattr(sys, "argv", ["sweep", "1"])
    sweep.main()
    done = sweep.rows()
    assert [(row["kind"], row["layers"]) for row in done] == [("tbs", "1")] * 4
    sweep.main()
    assert sweep.rows() == done
