"""Every script of the gallery runs, draws, and finds the number expected.

Expected numbers are not taken from the script's own way: the function of each script says where
its number is from.

| script | number | from |
|---|---|---|
| nt30, nt60, tss, tbs, bumpy_base, table1, push_sequence | contacts, forces, pushes | the paper |
| base_pressure, push, flowchart, ensemble, obstacle, check | forces, counts | another method |
| stress, size, silo, packing, friction, stiffness, tetrahedron | forces | by hand |
| parametric, nash | the solution | by hand |
| pyramid | the load in the middle | an independent solution |
| collapse | the motion | the geometry of the contacts alone |
| speed | the errors | the recorded rows, read once more |
"""

from __future__ import annotations

import csv
import runpy
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from lcp_piles import Uniform, base_pressure, drawn, nt30, solve, surd, tbs, tss
from lcp_piles.paper.figures_table1 import printed

ROOT = Path(__file__).parents[1]
SCRIPTS = sorted((ROOT / "docs" / "gallery").rglob("plot_*.py"))
NAMES = [script.stem.removeprefix("plot_") for script in SCRIPTS]
MOST_LINES = 40

Found = dict[str, Any]


def nt30_(found: Found) -> None:
    """The paper (section 5): downward contacts are missing outermost only, one on each side."""
    assert found["missing"] == [((5, 1), (6, 3)), ((5, 13), (6, 14))]


def nt60_(found: Found) -> None:
    """The paper: all horizontal contacts are absent, as Hong has it."""
    assert found["pressed"] == []


def tss_(found: Found) -> None:
    """The paper: for even N disc (2,1) stands on e; f = 1 - e = d - a by its balance."""
    assert found["e"] == 1
    assert found["a"] == found["d"] > 0


def tbs_(found: Found) -> None:
    """The paper: no contact downwards is missing, and some on the flanks are."""
    assert found["vertical"] == []
    assert len(found["is_open"]) > 0
    assert not [c for c in found["is_open"] if 5 < c.a[1] < c.a[0] - 4]


def stress_(found: Found) -> None:
    """Two forces 1/sqrt(3) at 60 degrees, one radius from the centre."""
    assert found["apex"] == ((surd("-1/6*sqrt(3)"), 0), (0, surd("-1/2*sqrt(3)")))


def base_pressure_(found: Found) -> None:
    """51 discs less two held ones, which carry themselves; the depth by Newton's method."""
    assert found["total"] == pytest.approx(51 - 2, rel=1e-14)
    floats = base_pressure(solve(nt30(6, floor_compliance="-1/2"), "newton"))
    forces = [float(place.normal) for place in floats]
    assert float(found["depth"]) == pytest.approx(max(forces[3:7]) - forces[6], rel=1e-9)


def bumpy_base_(found: Found) -> None:
    """The paper: the shear vanishes at the axis."""
    assert found["shear"] == 0


def push_(found: Found) -> None:
    """The force of the pile at one large push, solved from nothing by Lemke's method."""
    far = solve(nt30(6, push=1000, floor_compliance="-1/2"), "lemke")
    assert found["last"] == base_pressure(far)[6].normal


def push_sequence_(found: Found) -> None:
    """The fourth entry of the paper's Table 1."""
    assert found["fourth"] == surd(printed()[3]) * surd("sqrt(3)")


def table1_(found: Found) -> None:
    """All 23 values of the paper, and on its floor only."""
    assert found["equal"] == {"0": 0, "1": 0, "-1/2": 23}


def flowchart_(found: Found) -> None:
    """Lemke's method on the same pile."""
    assert list(found["found"]) == list(solve(tss(6, floor_compliance="-1/2"), "lemke").forces)


def size_(found: Found) -> None:
    """The apex on two contacts at 30 degrees from the horizontal: each carries 1/2 / sin 30."""
    assert surd(found["forces"]["a"]) == 1


def silo_(found: Found) -> None:
    """Rows of 4 and 3 discs in turns all press on the floor; bumpy walls take what is added."""
    smooth, bumpy = found["loads"].values()
    assert smooth == pytest.approx([3.5 * height for height in found["heights"]], rel=1e-12)
    assert bumpy[-1] == pytest.approx(bumpy[-2], rel=1e-3)


def pyramid_(found: Found) -> None:
    """An independent solution of this pile."""
    assert found["middle"] == Fraction(135, 124)


def tetrahedron_(found: Found) -> None:
    """35 spheres on 21 places, equal by this sum if by any."""
    assert found["loads"] == {surd("35/21")}


def packing_(found: Found) -> None:
    """All five discs stand on the floor."""
    assert found["proof"].proved
    assert found["on_floor"] == pytest.approx(5, abs=1e-12)


def friction_(found: Found) -> None:
    """Between the held stones the base row can be pressed as strongly as one likes."""
    assert found["unbounded"] == [((4, j), (4, j + 1)) for j in (1, 2, 3)]


def stiffness_(found: Found) -> None:
    """By hand: 1/sqrt(3) + tau/18, and what is left over falls with the square."""
    assert found["rate"] == Fraction(1, 18)
    rest = abs(np.array(found["full"]) - found["first"])
    order = np.log(rest[4] / rest[2]) / np.log(found["compliances"][4] / found["compliances"][2])
    assert order == pytest.approx(2, abs=0.05)


def ensemble_(found: Found) -> None:
    """The same samples by Newton's method in floating point, one by one."""
    scenes = [drawn(tbs(6), Uniform(5), seed=1, k=k) for k in range(100)]
    counts = [solve(scene, "newton", whole=True).count("closed") for scene in scenes]
    assert float(found["closed"]) == pytest.approx(np.mean(counts))


def check_(found: Found) -> None:
    """What the first order expects, to within terms of second order."""
    assert found["found"].verdict == "differ"
    assert found["found"].largest == pytest.approx(found["expected"], rel=0.01)


def obstacle_(found: Found) -> None:
    """The same membrane by projected Gauss-Seidel, a chessboard at a time."""
    n, height, weight = (found[name] for name in ("n", "height", "weight"))
    z = np.pad(np.zeros((n, n)), 1, constant_values=height)
    black = np.add.outer(np.arange(n), np.arange(n)) % 2 == 0
    for _ in range(600):
        for colour in (black, ~black):
            around = z[:-2, 1:-1] + z[2:, 1:-1] + z[1:-1, :-2] + z[1:-1, 2:]
            z[1:-1, 1:-1][colour] = np.maximum((around - weight) / 4, 0)[colour]
    assert found["proof"].proved
    assert np.array_equal(found["touches"], z[1:-1, 1:-1] == 0)
    assert found["z"] == pytest.approx(z[1:-1, 1:-1], abs=1e-9)


def parametric_(found: Found) -> None:
    """f_i = k_i max(0, t - s_i)."""
    assert found["path"].breakpoints == (1, 4, 5)
    assert found["path"].z(8) == (7, 8, 12)


def nash_(found: Found) -> None:
    """Each mix makes both strategies of the other earn the same: 2 p - (1 - p) = (1 - p) - p."""
    assert found["game"].x == found["game"].y == (Fraction(2, 5), Fraction(3, 5))
    assert found["game"].payoffs == (Fraction(1, 5), Fraction(-1, 5))


def collapse_(found: Found) -> None:
    """The motion presses on no contact, and the loads gain by it."""
    scene = found["found"].scene
    moves = found["found"].collapse.array().reshape(-1, 2)
    assert all(not moves[k].any() for k, disc in enumerate(scene.discs) if disc.fixed)
    numbers = {disc.id: k for k, disc in enumerate(scene.discs)}
    for c in scene.contacts:
        other = moves[numbers[c.b]] if c.b in numbers else np.zeros(2)
        assert (moves[numbers[c.a]] - other) @ [float(n) for n in c.normal] > -1e-12
    assert found["work"] > 0


def speed_(found: Found) -> None:
    """In the recorded rows only exact methods have no error."""
    with (ROOT / "benchmarks/comparison/results/methods.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["scene"] == "nt30 20"]
    exact = {row["method"] for row in rows if row["relative"] and float(row["relative"]) == 0}
    assert found["proved"].error == 0
    assert "proved" in exact
    assert {row["group"] for row in rows if row["method"] in exact} == {"exact"}


@pytest.mark.parametrize("script", SCRIPTS, ids=NAMES)
def test_gallery(script: Path) -> None:
    lines = script.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= MOST_LINES
    assert set(lines[2]) == {"="}
    assert len(lines[2]) == len(lines[1])
    found = runpy.run_path(str(script))
    picture = found["picture"]
    figure = picture.get_figure(root=True) if isinstance(picture, Axes) else picture
    assert isinstance(figure, Figure)
    figure.draw_without_rendering()
    assert figure.axes
    assert all(ax.has_data() for ax in figure.axes)
    globals()[script.stem.removeprefix("plot_") + "_"](found)


def test_there_are_as_many_expectations_as_scripts() -> None:
    expected = [name for name, value in globals().items() if name.endswith("_") and callable(value)]
    assert sorted(expected) == sorted(name + "_" for name in NAMES)
