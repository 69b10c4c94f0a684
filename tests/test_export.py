"""Solutions in the formats of other programs, read back by what reads them there."""

import csv
import importlib
import sys
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import networkx
import numpy as np
import pandas
import pytest
from hypothesis import given, settings

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    MissingExtraError,
    NotSolvedError,
    Scene,
    data_frame,
    export,
    graph,
    nt30,
    nt60,
    save,
    save_scene,
    solve,
    surd,
    table,
    tss,
)
from lcp_piles.cli.parser import main
from lcp_piles.files.export import FORMATS
from tests.helpers import piles

PILE = solve(nt30(3, push="20"))
FLOAT = solve(nt60(3), "newton")
UNSTABLE = solve(nt60(3).without([(3, 1)]))
ONE_AXIS = solve(Scene([Disc("a", [1], [-1], [None])], [Contact("a", "floor", [1], "1/2")]))
SPACE = solve(
    Scene(
        [
            Disc("left wall", (0, 0, 2), (0, 0, -1), (None, None, None)),
            Disc(7, (0, 0, 0), (0, 0, -1), ("1/3", None, None)),
        ],
        [
            Contact("left wall", 7, (0, 0, 1)),
            Contact(7, "floor", (0, 0, 1), "1/2", "1/7"),
            Contact("left wall", "side", (1, 0, 0), gap=3),
        ],
        supports=("floor", "side"),
    )
)
SOLVED = {"pile": PILE, "floats": FLOAT, "one axis": ONE_AXIS, "space": SPACE}


@settings(max_examples=15, deadline=None)
@given(scene=piles())
def test_exact_numbers_of_a_table_are_those_of_the_solution(scene) -> None:
    solution = solve(scene)
    if solution.status != "solved":
        return
    found = table(solution)
    assert [surd(x) for x in found["force_exact"]] == list(solution.forces)
    assert [surd(x) for x in found["gap_exact"]] == list(solution.gaps)
    assert found["force"].tolist() == solution.force_array.tolist()
    assert found["state"].tolist() == list(solution.states)
    discs = table(solution, "discs")
    motion = zip(discs["dx_exact"], discs["dy_exact"], strict=True)
    assert [surd(x) for pair in motion for x in pair] == list(solution.displacements)


def test_a_table_balances_the_loads() -> None:
    """The forces along the normals, summed by the disc numbers i and j, are minus the loads."""
    found, discs = table(PILE), table(PILE, "discs")
    rest = np.stack([discs["load_x"], discs["load_y"]], axis=1)
    push = found["force"][:, None] * np.stack([found["normal_x"], found["normal_y"]], axis=1)
    np.add.at(rest, found["i"], push)
    between = found["j"] >= 0
    np.subtract.at(rest, found["j"][between], push[between])
    free = np.isnan(discs["held_x"])
    assert free.sum() == len(discs) - 2
    assert abs(rest[free]).max() < 1e-12


def test_contact_points_are_halfway_between_centres_or_on_the_support() -> None:
    found, discs = table(PILE), table(PILE, "discs")
    for row in found:
        x, y = discs[row["i"]]["x"], discs[row["i"]]["y"]
        if row["j"] >= 0:
            x, y = (x + discs[row["j"]]["x"]) / 2, (y + discs[row["j"]]["y"]) / 2
        else:
            y -= 1
        assert np.allclose((row["x"], row["y"]), (x, y), atol=1e-14)


def test_tables_of_floating_point_solutions_claim_nothing_exact() -> None:
    found = table(FLOAT)
    assert set(found["force_exact"]) == set(found["gap_exact"]) == {""}
    assert not found["gap_unique"].any()
    assert found["force"].tolist() == FLOAT.force_array.tolist()


def test_a_data_frame_is_the_table() -> None:
    frame = data_frame(PILE)
    assert isinstance(frame, pandas.DataFrame)
    assert frame["force"].tolist() == PILE.force_array.tolist()
    assert (frame.groupby("state")["force"].sum()["open"]) == 0
    assert len(data_frame(PILE, "discs")) == len(PILE.scene.discs)


def test_a_graph_has_the_contacts_for_edges() -> None:
    """Without the open contacts, NT60 of two layers on its two stones is a path of three discs."""
    pile = solve(nt60(2))
    found = graph(pile)
    assert networkx.shortest_path(found, (2, 1), (2, 2)) == [(2, 1), (1, 1), (2, 2)]
    assert abs(found.edges[(1, 1), (2, 1)]["force"] - 3**-0.5) < 1e-15
    wide = graph(PILE)
    assert set(wide) == {disc.id for disc in PILE.scene.discs} | {"floor"}
    assert wide.number_of_edges() == len(PILE.scene.contacts)
    for a, b, edge in wide.edges(data=True):
        k = PILE.contact_index(a, b)
        assert edge["towards"] == PILE.scene.contacts[k].a
        assert edge["force"] == PILE.force_array[k]


@pytest.mark.parametrize(
    ("call", "library", "extra"),
    [(data_frame, "pandas", "tables"), (graph, "networkx", "graph")],
    ids=["tables", "graph"],
)
def test_a_missing_library_is_named_with_the_remedy(call, library, extra, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingExtraError, match=rf"{library} is not installed.*\[{extra}\]"):
        call(PILE)


def test_the_extras_are_those_of_the_project() -> None:
    tomllib = importlib.import_module("tomllib")
    text = (Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8")
    extras = tomllib.loads(text)["project"]["optional-dependencies"]
    assert {*extras["tables"], *extras["graph"]} <= set(extras["test"])
    assert (extras["tables"], extras["graph"]) == (["pandas>=2.2.2"], ["networkx>=3.3"])


@pytest.mark.parametrize("name", SOLVED)
def test_csv_reads_back_the_same(name, tmp_path: Path) -> None:
    solution = SOLVED[name]
    for ending, rows in ((".csv", "contacts"), (".discs.csv", "discs")):
        export(solution, tmp_path / f"pile{ending}")
        with (tmp_path / f"pile{ending}").open(newline="") as file:
            read = list(csv.DictReader(file))
        expected = table(solution, rows)
        assert list(read[0]) == list(expected.dtype.names)
        for column in expected.dtype.names:
            for line, value in zip(read, expected[column].tolist(), strict=True):
                if isinstance(value, float):
                    assert float(line[column] or "nan") == value or value != value
                else:
                    assert line[column] == str(value)


@pytest.mark.parametrize("name", SOLVED)
def test_vtk_reads_the_same_numbers(name, tmp_path: Path) -> None:
    """By VTK itself, the library of ParaView: forces, ends of contacts, radii, to the last bit."""
    vtk = pytest.importorskip("vtk")
    support = pytest.importorskip("vtk.util.numpy_support")
    solution = SOLVED[name]
    scene = solution.scene
    export(solution, tmp_path / "pile.vtp")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "pile.vtp"))
    reader.Update()
    found = reader.GetOutput()

    def array(data, name: str) -> np.ndarray:
        return support.vtk_to_numpy(data.GetArray(name))

    discs, contacts = len(scene.discs), len(scene.contacts)
    assert (found.GetNumberOfVerts(), found.GetNumberOfLines()) == (discs, contacts)
    cells, points = found.GetCellData(), found.GetPointData()
    assert array(cells, "force")[discs:].tolist() == solution.force_array.tolist()
    assert array(cells, "gap")[discs:].tolist() == solution.gap_array.tolist()
    states = ["open", "closed", "osculatory"]
    assert [states[s] for s in array(cells, "state")[discs:]] == list(solution.states)
    assert array(points, "radius").tolist() == [1.0] * discs + [0.0] * 2 * contacts
    moved = array(points, "displacement")[:discs, : scene.dimension]
    assert moved.tolist() == solution.displacement_array.tolist()
    for k in range(contacts):
        cell = found.GetCell(discs + k)
        assert cell.GetNumberOfPoints() == 2
        ends = [np.array(cell.GetPoints().GetPoint(e)) for e in (0, 1)]
        normal = np.array([*map(float, scene.contacts[k].normal), 0, 0])[:3]
        length = 2 if scene.ends[1][k] >= 0 else 1
        assert np.allclose(ends[0] - ends[1], length * normal, atol=1e-14)
        for end in (0, 1):
            at = cell.GetPointId(end)
            assert array(points, "force")[at] == solution.force_array[k]


@pytest.mark.parametrize("name", SOLVED)
def test_the_xml_has_the_same_numbers_for_whoever_parses_it(name, tmp_path: Path) -> None:
    """As VTK's documentation of the format has it: arrays by name in sections, cells by offsets."""
    solution = SOLVED[name]
    export(solution, tmp_path / "pile.vtp")
    piece = ElementTree.parse(tmp_path / "pile.vtp").getroot().find("PolyData/Piece")
    arrays = {
        (section.tag, array.get("Name")): [float(x) for x in array.text.split()]
        for section in piece
        for array in section
    }
    discs, contacts = len(solution.scene.discs), len(solution.scene.contacts)
    points = discs + 2 * contacts
    assert [piece.get(f"NumberOf{x}") for x in ("Points", "Verts", "Lines", "Strips", "Polys")] == [
        str(n) for n in (points, discs, contacts, 0, 0)
    ]
    assert arrays["CellData", "force"] == [0.0] * discs + solution.force_array.tolist()
    assert arrays["PointData", "force"][discs::2] == solution.force_array.tolist()
    assert arrays["Lines", "connectivity"] == [*range(discs, points)]
    assert arrays["Lines", "offsets"] == [*range(2, 2 * contacts + 1, 2)]
    assert len(arrays["Points", "points"]) == 3 * points


def lammps_rows(file: Path) -> tuple[list[str], list[dict[str, float]]]:
    """The header lines, and the rows by the names of their columns."""
    lines = file.read_text().splitlines()
    names = lines[8].split()[2:]
    rows = [dict(zip(names, map(float, line.split()), strict=True)) for line in lines[9:]]
    assert int(lines[3]) == len(rows)
    return lines[:9], rows


@pytest.mark.parametrize("name", SOLVED)
def test_lammps_dumps_have_every_number(name, tmp_path: Path) -> None:
    solution = SOLVED[name]
    scene = solution.scene
    export(solution, tmp_path / "pile.lammpstrj")
    export(solution, tmp_path / "pile.local")
    head, atoms = lammps_rows(tmp_path / "pile.lammpstrj")
    assert head[0] == "ITEM: TIMESTEP"
    assert head[2] == "ITEM: NUMBER OF ATOMS"
    assert head[8].startswith("ITEM: ATOMS id type x y z ")
    for disc, row, moved in zip(scene.discs, atoms, solution.displacement_array, strict=True):
        place = [float(x) for x in disc.position]
        assert [row["x"], row["y"], row["z"]][: len(place)] == place
        assert [row["ux"], row["uy"], row["uz"]][: len(place)] == moved.tolist()
        assert row["type"] == (2 if any(h is not None for h in disc.held) else 1)
        low, high = (float(x) for x in head[5].split())
        assert low < row["x"] < high
    _, entries = lammps_rows(tmp_path / "pile.local")
    for contact, row, force in zip(scene.contacts, entries, solution.force_array, strict=True):
        assert scene.discs[int(row["id1"]) - 1].id == contact.a
        if row["id2"] > 0:
            assert scene.discs[int(row["id2"]) - 1].id == contact.b
        else:
            assert scene.supports[-int(row["id2"]) - 1] == contact.b
        assert row["force"] == force
        assert row["fx"] == float(contact.normal[0]) * force


def test_the_ending_json_is_the_result_file(tmp_path: Path) -> None:
    export(PILE, tmp_path / "one.json")
    save(PILE, tmp_path / "two.json")
    assert (tmp_path / "one.json").read_text() == (tmp_path / "two.json").read_text()


@pytest.mark.parametrize("name", ["pile.png", "pile", "pile.xlsx", "csv", ".json.gz", "a.csv/"])
def test_another_ending_is_an_error(name, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"ends in one of \.discs\.csv, \.csv, \.vtp, "):
        export(PILE, f"{tmp_path}/{name}")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["pile.csv", "pile.vtp", "pile.JSON.txt", "scene.yaml"])
def test_no_json_under_another_name(name, tmp_path: Path, capsys) -> None:
    for call in (lambda: save(PILE, tmp_path / name), lambda: save_scene(nt30(3), tmp_path / name)):
        with pytest.raises(InputError, match=r"a name that ends in \.json; `export`"):
            call()
    words = ("nt30", "--layers", "2", "--json", str(tmp_path / name))
    assert main(["solve", *words]) == main(["push", *words]) == 2
    assert "a name that ends in .json" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_csv_has_no_other_name(tmp_path: Path, capsys) -> None:
    words = ("fields", "nt60", "--layers", "2", "--show", "stress")
    assert main([*words, "--csv", str(tmp_path / "pile.json")]) == 2
    assert "a name that ends in .csv" in capsys.readouterr().err


@pytest.mark.parametrize("ending", [ending for ending in FORMATS if ending != ".json"])
def test_what_has_no_forces_is_not_exported(ending, tmp_path: Path) -> None:
    with pytest.raises(NotSolvedError, match="collapse"):
        export(UNSTABLE, tmp_path / f"pile{ending}")
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_table_is_an_error() -> None:
    with pytest.raises(InputError, match="one of contacts, discs"):
        table(PILE, "walls")


def test_forces_beyond_floats_stay_exact_in_tables_and_are_refused_for_paraview() -> None:
    scene = tss(2)
    discs = tuple(replace(d, load=tuple(x * 10**400 for x in d.load)) for d in scene.discs)
    soft = tuple(replace(c, compliance=10**400) for c in scene.contacts)
    solution = solve(replace(scene, discs=discs, contacts=soft))
    found = table(solution)
    assert [surd(x) for x in found["force_exact"]] == list(solution.forces)
    with pytest.raises(InputError, match="of the solution is 'beyond the range of floats'"):
        FORMATS[".vtp"].text(solution)


def test_the_command_writes_every_format(tmp_path: Path, capsys) -> None:
    files = [tmp_path / f"pile{ending}" for ending in FORMATS]
    words = [word for file in files for word in ("--out", str(file))]
    assert main(["solve", "nt60", "--layers", "3", *words]) == 0
    assert capsys.readouterr().err.count("wrote") == len(files)
    for file, format in zip(files, FORMATS.values(), strict=True):
        text = file.read_text()
        if file.suffix != ".json":  # which has the time
            assert text == format.text(solve(nt60(3)))
    assert main(["solve", "nt60", "--layers", "3", "--out", "pile.png"]) == 2
    assert "ends in one of" in capsys.readouterr().err
