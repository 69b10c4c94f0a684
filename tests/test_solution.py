"""The three kinds of solution: what they say of themselves, and what the two without forces do."""

from dataclasses import replace
from time import perf_counter
from xml.etree import ElementTree

import numpy as np
import pytest

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    NotSolvedError,
    Scene,
    Unresolved,
    cross_check,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    tss,
    verify,
)
from lcp_piles.methods.z.z_algorithm import z_algorithm
from lcp_piles.solution.notebook import MOST


def test_a_solution_is_shown_in_one_line() -> None:
    """Counts by hand from the picture of the paper's pile: 129 contacts, 16 of them open."""
    solution = solve(nt30(6))
    assert repr(solution) == (
        "<Solved NT30, layers 6: 113 closed, 16 open, 0 osculatory; stable; exact>"
    )
    assert repr(solve(tss(3), "newton")).endswith("; float64>")
    assert repr(solve(nt60(4).without([(4, 1)]))).startswith("<Unstable own scene, 9 discs, 18 ")
    assert repr(Unresolved(nt60(3), solution.record)).startswith("<Unresolved NT60, layers 3")
    assert repr(solution.record).startswith("<Record proved (exact): ")


@pytest.mark.parametrize("method", ["proved", "newton"])
def test_the_time_in_the_record_is_part_of_that_of_the_call(method) -> None:
    start = perf_counter()
    solution = solve(nt30(3), method)
    assert 0 < solution.record.seconds <= perf_counter() - start


def test_no_number_makes_the_line_long() -> None:
    """A push of 10^400 written out, and parameters of hundreds of digits."""
    scene = nt60(2, push=surd(10**400), floor_compliance="1/" + "7" * 500)
    assert len(repr(solve(scene))) < 220


@pytest.mark.parametrize("scene", [nt60(4).without([(4, 1)]), nt60(3)], ids=["unstable", "none"])
def test_what_only_a_solved_scene_has_is_refused_with_a_remedy(scene) -> None:
    solution = solve(scene)
    if solution.status == "solved":
        solution = Unresolved(scene, solution.record)
    for name in ("forces", "force", "force_array", "states", "count", "stability", "gap_unique"):
        assert not hasattr(solution, name)
        with pytest.raises(NotSolvedError, match=f'expected "solved", to have {name};'):
            getattr(solution, name)
    with pytest.raises(AttributeError) as caught:
        solution.colour  # noqa: B018
    assert not isinstance(caught.value, InputError)


def drawn(solution) -> tuple[dict[str, str], ElementTree.Element]:
    """The table of a notebook's page as a dictionary, and the page: it has to be well-formed."""
    page = ElementTree.fromstring(f"<div>{solution._repr_html_()}</div>")
    rows = [["".join(cell.itertext()) for cell in row] for row in page.iter("tr")]
    return dict(rows), page


def tags(page: ElementTree.Element, name: str) -> list[ElementTree.Element]:
    return [element for element in page.iter() if element.tag.endswith(name)]


def test_a_notebook_shows_every_disc_and_contact_with_the_width_of_its_force() -> None:
    solution = solve(nt30(6, push=20))
    rows, page = drawn(solution)
    assert rows["contacts"] == "123 closed, 6 open, 0 osculatory"
    assert rows["stability"] == "stable, mechanisms: 0"
    assert rows["proof"] == solution.record.proof
    assert rows["largest force"] == "5.4026 w at (6, 1)-(6, 2)"
    assert len(tags(page, "circle")) == len(solution.scene.discs)
    paths = tags(page, "path")
    lines = {path.get("stroke-width"): path.get("d").count("M") for path in paths}
    assert sum(lines.values()) == len(solution.scene.contacts)
    (dashed,) = [path for path in paths if path.get("stroke-dasharray")]
    assert dashed.get("d").count("M") == 6
    widest = max(map(float, lines))
    assert lines[f"{widest:.2f}"] == (solution.force_array > 5.36).sum() == 2
    left, top, across, up = map(float, tags(page, "svg")[0].get("viewBox").split())
    for circle in tags(page, "circle"):
        assert left + 1 <= float(circle.get("cx")) <= left + across - 1
        assert top + 1 <= float(circle.get("cy")) <= top + up - 1


def test_a_notebook_shows_a_collapse_by_where_the_discs_go() -> None:
    scene = nt60(4).without([(4, 1)])
    solution = solve(scene)
    rows, page = drawn(solution)
    assert rows["status"].startswith("unstable")
    circles = [(float(c.get("cx")), float(c.get("cy"))) for c in tags(page, "circle")]
    count = len(scene.discs)
    assert len(circles) == 2 * count
    places = [[float(d.position[0]), -float(d.position[1])] for d in scene.discs]
    moved = np.array(circles[count:]) - places
    motion = solution.collapse.array().reshape(-1, 2) * [1, -1]
    assert np.abs(moved - motion * 1.6 / np.hypot(*motion.T).max()).max() < 0.02  # two decimals
    status, page = drawn(Unresolved(scene, solution.record))
    assert status["status"].startswith("unresolved")
    assert len(tags(page, "circle")) == count


def test_a_notebook_escapes_text_and_bounds_its_picture() -> None:
    solution = solve(tbs(2))
    evil = replace(solution, record=replace(solution.record, proof="<script>&"))
    rows, page = drawn(evil)
    assert rows["proof"] == "<script>&"
    assert not tags(page, "script")
    many = tbs(50)
    assert len(many.discs) + len(many.contacts) > MOST
    zeros = np.zeros(len(many.contacts))
    states = ("closed",) * len(zeros)
    large = replace(solution, scene=many, forces=zeros, states=states)
    text = large._repr_html_()
    assert "too many to draw" in text
    assert len(text) < 1000
    right = tbs(28)  # nearly as many as are drawn
    zeros = np.zeros(len(right.contacts))
    states = ("closed",) * len(zeros)
    assert len(replace(solution, scene=right, forces=zeros, states=states)._repr_html_()) < 250_000


def test_tension_is_red_and_what_is_not_plane_is_not_drawn() -> None:
    solution = solve(tbs(1))
    _, page = drawn(replace(solution, forces=-solution.force_array))
    assert {path.get("stroke") for path in tags(page, "path")} == {"#c8102e"}
    line = Disc((1,), (surd(0),), (surd(-1),), (None,))
    scene = Scene((line,), (Contact((1,), "floor", (surd(1),)),))
    _, page = drawn(solve(scene))
    assert not tags(page, "svg")


def test_what_belongs_to_a_solution_is_short_too() -> None:
    scene = nt60(9)  # with ties, which floating point names otherwise
    solution = solve(scene)
    check, z = cross_check(solve(nt30(4))), z_algorithm(scene)
    shown = [check, solution.stability, solution.record, z, verify(scene, solution)]
    assert all(len(repr(value)) < 250 for value in shown)
    assert repr(check).endswith("0 states differ>")
    assert repr(z).startswith("<ZResult solved after ")
