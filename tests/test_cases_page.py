"""The page of reference cases: every number is solved anew from the scene that its row names."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import lcp_piles
from benchmarks.reference.__main__ import DATA
from benchmarks.reference.cases import CASES
from lcp_piles import Solved, Surd, decimal, first_order, solve, surd
from lcp_piles.scenes.names import end_name

PAGE = Path(__file__).parents[1] / "docs" / "cases.md"
Row = list[str]


def tables() -> tuple[list[Row], list[Row]]:
    """The rows of both tables, without their heads."""
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line[:1] == "|"]
    rows = [[cell.strip().strip("`") for cell in line[1:-1].split("|")] for line in lines]
    heads = [k for k, row in enumerate(rows) if row[0] == "case"]
    assert len(heads) == 2
    return rows[2 : heads[1]], rows[heads[1] + 2 :]


SETUPS, FORCES = tables()
SCENES = {row[0]: row[1] for row in SETUPS}


def solved(name: str) -> Solved:
    """The case, from the words of its row; its forces are those on file, contact by contact."""
    solution = solve(eval(SCENES[name], vars(lcp_piles)))
    data = json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))
    assert [str(force) for force in solution.forces] == [c["force"][1] for c in data["contacts"]]
    return solution


def test_all_cases_have_a_row() -> None:
    assert list(SCENES) == [case.name for case in CASES]
    assert {row[0] for row in FORCES} == {row[0] for row in SETUPS if row[4] != "unstable"}


@pytest.mark.parametrize("row", SETUPS, ids=lambda row: row[0])
def test_setup(row: Row) -> None:
    _, scene, discs, counts, stability, until, _ = row
    solution = solve(eval(scene, vars(lcp_piles)))
    assert int(discs) == len(solution.scene.discs)
    if stability == "unstable":
        assert solution.status == "unstable"
        assert (counts, until) == ("", "")
        return
    states = ("closed", "open", "osculatory")
    assert counts == ", ".join(str(solution.count(state)) for state in states)
    assert stability == solution.stability.verdict
    soft = first_order(solution)
    if soft.status == "none":
        assert until == "none"
    else:
        end = soft.range[0]
        assert until == ("always" if end is None else f"{float(end):.3g}")


@pytest.mark.parametrize("row", FORCES, ids=lambda row: f"{row[0]} {row[1]}")
def test_force(row: Row) -> None:
    name, contact, exact, rounded, slope = row
    solution = solved(name)
    names = [f"{end_name(c.a)}-{end_name(c.b)}" for c in solution.scene.contacts]
    k = names.index(contact)
    assert surd(exact) == solution.forces[k]
    assert rounded == decimal(solution.forces[k], 12)
    soft = first_order(solution)
    if soft.status == "none":
        assert slope == "none"
    else:
        assert slope == decimal(soft.forces[k] / solution.forces[k], 6)


@pytest.mark.parametrize("name", [row[0] for row in SETUPS if row[4] != "unstable"])
def test_the_first_force_is_the_largest_and_the_second_changes_most(name: str) -> None:
    solution = solved(name)
    shown = [surd(row[2]) for row in FORCES if row[0] == name]
    most = max(solution.forces)
    assert shown[0] == most
    others = [k for k, f in enumerate(solution.forces) if f >= surd("1/10") and f != most]
    assert len(shown) == 1 + bool(others)
    soft = first_order(solution)
    if soft.status == "found" and others:

        def relative(k: int) -> Surd:
            return abs(soft.forces[k] / solution.forces[k])

        assert shown[1] == solution.forces[max(others, key=relative)]
