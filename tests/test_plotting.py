"""Pictures are tested by their artists, never by pixels.

Expected counts and forces are those of the solution that is drawn; expected ends of lines are
worked out from the geometry of the piles (discs of radius 1 on the floor y = -1).
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import Collection, LineCollection
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver

from lcp_piles import Contact, InputError, Scene, Unresolved, nt30, nt60, solve, tbs, tss
from lcp_piles.numbers.exact import ONE, ZERO
from lcp_piles.pictures import (
    HAIRLINE,
    draw_network,
    draw_profile,
    draw_scene,
    draw_stress_axes,
    save,
)

STATES = ("closed", "open", "osculatory")


def labelled(ax: Axes, label: str) -> list[Collection]:
    return [c for c in ax.collections if c.get_label() == label]


def lines(ax: Axes, label: str) -> LineCollection:
    (found,) = labelled(ax, label)
    assert isinstance(found, LineCollection)
    return found


def legend_texts(ax: Axes) -> list[str]:
    legend = ax.get_legend()
    return [text.get_text() for text in legend.get_texts()] if legend else []


SCENES = {
    "nt30": nt30(6),
    "nt30 pushed": nt30(6, push="200"),
    "tss": tss(5),
    "tbs": tbs(6),
    "nt60 with osculatory contacts": nt60(3),
    "nt60 resting on a rigid floor": nt60(4, floor_compliance=0, corner_stones="resting"),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_as_many_lines_of_each_style_as_contacts_in_each_state(scene: Scene) -> None:
    solution = solve(scene)
    ax = draw_network(solution)
    for state in STATES:
        count = sum(len(c.get_segments()) for c in labelled(ax, state))
        assert count == solution.count(state)
    (discs,) = labelled(ax, "discs")
    assert len(discs.get_offsets()) == len(scene.discs)


def test_styles_are_full_dashed_and_dash_dot() -> None:
    large, small = draw_network(solve(nt30(6))), draw_network(solve(nt60(3)))
    assert {dashes for _, dashes in lines(large, "closed").get_linestyle()} == {None}
    assert [len(dashes) for _, dashes in lines(large, "open").get_linestyle()] == [2]
    assert [len(dashes) for _, dashes in lines(small, "osculatory").get_linestyle()] == [4]


@pytest.mark.parametrize("log_width", [False, True])
def test_widths_follow_the_forces(log_width: bool) -> None:
    solution = solve(nt30(6))
    widths = np.array(lines(draw_network(solution, log_width=log_width), "closed").get_linewidth())
    forces = solution.force_array[np.array(solution.states) == "closed"]
    scale = np.log1p(forces) if log_width else forces
    expected = scale * widths.max() / scale.max()
    assert widths == pytest.approx(np.maximum(expected, HAIRLINE))
    assert (expected > HAIRLINE).sum() > 100  # the hairline is the exception


def test_the_scale_bar_has_the_width_of_its_force() -> None:
    solution = solve(nt30(6))
    ax = draw_network(solution)
    drawn = np.array(lines(ax, "closed").get_linewidth())
    bar = ax.get_legend().get_lines()[0]
    assert legend_texts(ax)[0] == "force 1 $w$"
    assert bar.get_linewidth() == pytest.approx(drawn.max() / solution.force_array.max())


def test_a_pile_of_large_forces_has_a_round_multiple_as_scale_bar() -> None:
    solution = solve(nt30(6, push="200"))  # the largest force is between 20 and 40 w
    assert legend_texts(draw_network(solution))[0] == "force 10 $w$"
    assert legend_texts(draw_network(solution, log_width=True))[:2] == [
        "force 1 $w$",
        "force 10 $w$",
    ]


def test_one_strong_chain_does_not_thin_out_the_rest() -> None:
    """The median of the forces is 1, so all above 10 are equally wide."""
    solution = solve(tbs(3))
    count = len(solution.forces)
    forces = np.array([1000.0, 2, *[1.0] * (count - 2)])
    strong = replace(solution, forces=forces, states=("closed",) * count)
    ax = draw_network(strong)
    widths = np.array(lines(ax, "closed").get_linewidth())
    assert widths / widths.max() == pytest.approx(np.minimum(forces / 10, 1))
    assert legend_texts(ax)[1] == "force 10 to 1e+03 $w$"
    widths = np.array(lines(draw_network(strong, clip=2), "closed").get_linewidth())
    assert widths / widths.max() == pytest.approx(np.minimum(forces / 2, 1))
    widths = np.array(lines(draw_network(strong, clip=np.inf), "closed").get_linewidth())
    assert widths == pytest.approx(np.maximum(widths.max() * forces / 1000, HAIRLINE))
    with pytest.raises(InputError, match="clip is 0"):
        draw_network(strong, clip=0)


def test_a_saddle_and_loose_gaps_are_named() -> None:
    """NT60 9 on a soft floor is a saddle (one of the project's results), NT30 6 is not."""
    solution = solve(nt60(9))
    assert solution.stability.verdict == "saddle"
    loose = solution.gap_unique.count(False)
    title = draw_network(solution).get_title()
    assert title.split("\n")[1:] == [f"a saddle of the energy, {loose} gaps not unique"]
    assert "\n" not in draw_network(solve(nt30(6))).get_title()


@pytest.mark.parametrize("layers", [15, 40])
def test_the_page_grows_with_the_pile(layers: int) -> None:
    """Discs of at least 0.12 inch in radius, up to the width of A0."""
    ax = draw_scene(tbs(layers), labels=False)
    figure = ax.get_figure(root=True)
    radius = np.ptp(ax.transData.transform([[0, 0], [1, 0]])[:, 0]) / figure.dpi
    assert radius == pytest.approx(0.12)


def test_the_legend_explains_what_is_drawn_and_can_be_left_out() -> None:
    solution = solve(nt60(3))
    texts = legend_texts(draw_network(solution))
    assert texts == ["force 1 $w$", "osculatory contact", "held disc"]
    assert draw_network(solution, legend=False).get_legend() is None


@pytest.mark.parametrize("layers", [2, 9, 25])
def test_the_largest_force_leaves_its_discs_visible(layers: int) -> None:
    # Any forces will do for widths: no need to solve a large pile.
    scene = tbs(layers)
    count = len(scene.contacts)
    solution = replace(
        solve(tbs(1)),
        scene=scene,
        forces=np.linspace(1, layers, count),
        states=("closed",) * count,
    )
    ax = draw_network(solution)
    figure = ax.get_figure(root=True)
    radius = np.ptp(ax.transData.transform([[0, 0], [1, 0]])[:, 0]) / figure.dpi * 72
    assert max(lines(ax, "closed").get_linewidth()) < radius


def test_floor_contacts_end_on_the_floor_line() -> None:
    ax = draw_network(solve(nt60(3)))
    (floor,) = [line for line in ax.lines if line.get_label() == "_floor"]
    assert floor.get_ydata().tolist() == [-1, -1]
    left, right = floor.get_xdata()
    assert left < -3  # beyond the corner stones, which reach from -3 to 3
    assert right > 3
    ends = [segment.tolist() for segment in lines(ax, "closed").get_segments()]
    assert [[0, 0], [0, -1]] in ends


def test_held_discs_are_grey_and_free_ones_white() -> None:
    (discs,) = labelled(draw_scene(nt60(3)), "discs")
    white = [tuple(colour[:3]) == (1, 1, 1) for colour in discs.get_facecolor()]
    assert white == [True, True, True, False, True, False]


def test_a_support_may_be_a_wall() -> None:
    disc = replace(nt60(2).disc((1, 1)), position=(ZERO, ZERO))
    wall = Contact(disc.id, "wall", (ONE, ZERO))
    ax = draw_scene(Scene((disc,), (wall,), ("wall",)))
    (surface,) = [line for line in ax.lines if line.get_label() == "_wall"]
    # The normal points from the wall to the disc around (0, 0), so the wall is at x = -1.
    assert surface.get_xdata().tolist() == [-1, -1]


def test_tension_is_told_from_compression() -> None:
    solution = solve(tbs(1))
    forces = solution.force_array.copy()
    forces[0] = -forces[0]
    ax = draw_network(replace(solution, forces=forces))
    colours = [tuple(c) for c in lines(ax, "closed").get_color()]
    assert colours[0] not in colours[1:]
    assert len(set(colours[1:])) == 1
    assert "tension" in legend_texts(ax)
    assert min(lines(ax, "closed").get_linewidth()) > 0


def test_an_unstable_pile_shows_its_collapse() -> None:
    solution = solve(nt60(4).without([(4, 1)]))
    ax = draw_network(solution)
    assert ax.get_title() == "own scene, 9 discs: unstable"
    (arrows,) = labelled(ax, "collapse")
    assert isinstance(arrows, Quiver)
    motion = solution.collapse.array().reshape(-1, 2)
    moving = motion[(motion != 0).any(axis=1)]
    drawn = np.stack([arrows.U, arrows.V], axis=1)
    # The same motion up to one positive factor.
    assert drawn / np.linalg.norm(drawn) == pytest.approx(moving / np.linalg.norm(moving))
    assert not any(labelled(ax, state) for state in STATES)


def test_an_unresolved_scene_says_so() -> None:
    solution = Unresolved(nt60(3), solve(nt60(3)).record)
    assert draw_network(solution).get_title() == "NT60, $N = 3$: unresolved"


def test_the_title_names_what_is_not_default() -> None:
    scene = nt60(4, push="20 - 1/3*sqrt(3)", floor_compliance="1/2", corner_stones="resting")
    assert draw_scene(scene).get_title() == (
        r"NT60, $N = 4$, push $(20 - 1/3\sqrt{3})\,w\tau$, "
        r"floor compliance $1/2\,\tau$, corner stones resting"
    )


def test_indices_stand_on_their_discs() -> None:
    scene = tss(4)
    texts = {text.get_text(): text.get_position() for text in draw_scene(scene).texts}
    assert len(texts) == 10
    assert texts["(4,1)"] == pytest.approx((-3 * 3**0.5, 0))
    assert not draw_scene(scene, labels=False).texts


def test_given_axes_are_used() -> None:
    ax = Figure().add_subplot()
    assert draw_network(solve(nt60(2)), ax) is ax
    assert draw_scene(nt60(2), Figure().add_subplot()).get_aspect() == 1


def test_stress_axes_lie_along_the_eigenvectors() -> None:
    # Eigenvalues -3 along (1, 1) and -1 along (1, -1); then pure tension of 2 along y.
    tensors = [[[-2, -1], [-1, -2]], [[0, 0], [0, 2]]]
    ax = draw_stress_axes([[0, 0], [4, 0]], tensors)
    spans = [b - a for a, b in lines(ax, "compression").get_segments()]
    assert [abs(float(np.hypot(*span))) for span in spans] == pytest.approx([2, 2 / 3])
    assert spans[0][0] == pytest.approx(spans[0][1])
    assert spans[1][0] == pytest.approx(-spans[1][1])
    ((bottom, top),) = lines(ax, "tension").get_segments()
    assert abs(top - bottom) == pytest.approx([0, 4 / 3])
    assert (top + bottom) / 2 == pytest.approx([4, 0])


def test_the_bar_of_stress_is_as_long_as_its_number_says() -> None:
    ax = draw_stress_axes([[0, 0]], [[[-3, 0], [0, -1]]])  # an axis of 3 is one diameter long
    (bar,) = [line for line in ax.lines if line.get_label() == "_scale"]
    assert np.ptp(bar.get_xdata()) == pytest.approx(2 * 2 / 3)
    assert ax.texts[0].get_text() == "2 $w/R$"


def test_log_stress_axes() -> None:
    ax = draw_stress_axes([[0, 0]], [[[-3, 0], [0, -1]]], log=True)
    lengths = [float(np.hypot(*(b - a))) for a, b in lines(ax, "compression").get_segments()]
    assert lengths == pytest.approx([2, 2 * np.log(2) / np.log(4)])


@pytest.mark.parametrize(
    ("positions", "tensors"),
    [
        ([0, 0], [[[1, 0], [0, 1]]]),
        ([[0, 0]], [[1, 0], [0, 1]]),
        ([[0, 0]], [[[1, 2], [0, 1]]]),
        ([[0, 0]], [[[np.nan, 0], [0, 1]]]),
        (np.empty((0, 2)), np.empty((0, 2, 2))),
    ],
    ids=["flat positions", "one tensor too flat", "not symmetric", "nan", "nothing"],
)
def test_stress_axes_refuse(positions: object, tensors: object) -> None:
    with pytest.raises(InputError, match="expected"):
        draw_stress_axes(positions, tensors)


def test_a_profile_has_one_line_with_markers_a_series() -> None:
    x, series = [-1, 0, 1], {"$N = 5$": [1, 3, 1], "$N = 6$": [2, 2, 2]}
    ax = draw_profile(x, series)
    assert {line.get_label(): line.get_ydata().tolist() for line in ax.lines} == series
    assert len({line.get_marker() for line in ax.lines} - {"None"}) == 2
    assert ax.get_xlabel() == "$x$  ($R$)"
    assert ax.get_ylabel() == "force on the base  ($w$)"
    assert ax.get_ylim()[0] == 0


@pytest.mark.parametrize(
    ("x", "series"),
    [([0, 1], {}), ([0, 1], {"a": [1]}), ([[0]], {"a": [[1]]}), ([], {"a": []})],
    ids=["no series", "lengths differ", "not a row", "empty"],
)
def test_profiles_refuse(x: object, series: dict[str, object]) -> None:
    with pytest.raises(InputError, match="expected"):
        draw_profile(x, series)


@pytest.mark.parametrize(
    ("ending", "start"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")]
)
def test_files_are_written(tmp_path: Path, ending: str, start: bytes) -> None:
    ax = draw_network(solve(nt60(3)))
    for picture, name in ((ax, "axes"), (ax.get_figure(), "figure")):
        path = tmp_path / f"{name}.{ending}"
        save(picture, path)
        content = path.read_bytes()
        assert content.startswith(start)
        assert len(content) > 1000


@pytest.mark.parametrize("name", ["pile.xyz", "pile", "pile.", ".png"])
def test_an_ending_that_cannot_be_written_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"png.*svg"):
        save(draw_scene(tbs(1)), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_place_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.png").mkdir()
    for name in ("missing/pile.png", "file/pile.png", "folder.png"):
        with pytest.raises(InputError, match="a writable path"):
            save(draw_scene(tbs(1)), tmp_path / name)


def test_other_pictures_and_resolutions_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="Axes"):
        save("pile", tmp_path / "pile.png")
    for dpi in (0, -1, float("nan")):
        with pytest.raises(InputError, match="dpi"):
            save(draw_scene(tbs(1)), tmp_path / "pile.png", dpi)


def test_the_core_does_not_import_matplotlib_and_pictures_need_no_pyplot() -> None:
    program = (
        "import sys, lcp_piles; assert 'matplotlib' not in sys.modules\n"
        "from lcp_piles.pictures.plotting import draw_scene; draw_scene(lcp_piles.tbs(1))\n"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    root = Path(__file__).parents[1]
    subprocess.run([sys.executable, "-c", program], check=True, cwd=root)
