"""Forces and discs from tables and dumps: true files of LAMMPS, Yade's formats, and bad files."""

import csv
import json
from pathlib import Path
from time import process_time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import FileFormatError, InputError, check, export, nt30, nt60, read_forces, solve
from lcp_piles.cli.parser import main
from lcp_piles.files.column_rows import read_rows
from lcp_piles.files.read_forces import read_places

DATA = Path(__file__).parent / "data"
PILE = solve(nt30(3, push="20"))


@pytest.mark.parametrize("ending", [".csv", ".local"])
def test_what_is_exported_is_read_back_to_the_last_bit(ending, tmp_path: Path) -> None:
    export(PILE, tmp_path / f"pile{ending}")
    export(PILE, tmp_path / "pile.lammpstrj")
    discs = tmp_path / "pile.lammpstrj" if ending == ".local" else None
    forces = read_forces(tmp_path / f"pile{ending}", discs=discs)
    found = check(PILE, forces)
    assert found.largest == 0
    assert found.present.all()


def test_a_dump_of_lammps_is_read_as_it_stands() -> None:
    """Made by LAMMPS itself (`settle.py`): 170 pairs of 100 discs, the numbers by awk."""
    rows = read_rows(DATA / "settled-100-pairs.dump")
    assert rows.names == ("c_ends[1]", "c_ends[2]", "c_push[2]")
    columns = {"a": "c_ends[1]", "b": "c_ends[2]", "force": "c_push[2]"}
    forces = read_forces(DATA / "settled-100-pairs.dump", columns)
    assert len(forces) == 170
    assert (forces[3].a, forces[3].b, forces[3].force) == ("10", "4", 7.0284257778513428)
    assert forces[3].where.endswith("settled-100-pairs.dump, line 13")
    places = read_places(DATA / "settled-100.dump")
    assert len(places) == 100
    assert places["2"] == (1.6044251813891195, 0.5596004903977157)


def test_only_the_last_snapshot_counts(tmp_path: Path) -> None:
    """With the sections that LAMMPS may add, and another number of rows each time."""
    head = "ITEM: UNITS\nlj\nITEM: TIME\n0.5\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ENTRIES\n{}\n"
    box = "ITEM: BOX BOUNDS pp ff pp\n0 1\n0 1\n0 1\nITEM: ENTRIES id1 id2 fn\n"
    text = head.format(0, 2) + box + "1 2 0.5\n2 3 0.6\n"
    text += head.format(100, 1) + box + "4 5 7e-1 \n"
    (tmp_path / "f.local").write_text(text + head.format(200, 0) + box)
    assert read_forces(tmp_path / "f.local") == []
    (tmp_path / "f.local").write_text(text)
    (force,) = read_forces(tmp_path / "f.local")
    assert (force.a, force.b, force.force) == ("4", "5", 0.7)


# The same three discs, as `dump atom` and `dump custom id xu yu radius` of LAMMPS wrote them.
SCALED = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS ff ff pp
-1.0000000000000000e+00 9.0000000000000000e+00
0.0000000000000000e+00 4.0000000000000000e+00
-5.0000000000000000e-01 5.0000000000000000e-01
ITEM: ATOMS id type xs ys zs
1 1 0.15 0.25 0.5
2 1 0.325 0.375 0.5
3 1 0.8 0.875 0.5
"""
UNWRAPPED = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS ff ff pp
-1.0000000000000000e+00 9.0000000000000000e+00
0.0000000000000000e+00 4.0000000000000000e+00
-5.0000000000000000e-01 5.0000000000000000e-01
ITEM: ATOMS id xu yu radius
1 0.5 1 0.5
2 2.25 1.5 0.5
3 7 3.5 0.5
"""


@pytest.mark.parametrize("text", [SCALED, UNWRAPPED], ids=["scaled", "unwrapped"])
def test_places_in_parts_of_the_box_and_beyond_it(text, tmp_path: Path) -> None:
    (tmp_path / "atoms.dump").write_text(text)
    places = read_places(tmp_path / "atoms.dump")
    expected = {"1": (0.5, 1), "2": (2.25, 1.5), "3": (7, 3.5)}
    assert places.keys() == expected.keys()
    for id, place in expected.items():
        assert places[id][:2] == pytest.approx(place, abs=1e-15)


@pytest.mark.parametrize(
    "box", ["ITEM: BOX BOUNDS xy xz yz\n0 1 0\n0 1 0\n0 1 0\n", "", "ITEM: BOX BOUNDS\n0 1\n"]
)
def test_scaled_places_need_a_box_with_right_angles(box, tmp_path: Path) -> None:
    head, rows = "ITEM: NUMBER OF ATOMS\n1\n", "ITEM: ATOMS id xs ys zs\n1 0.5 0.5 0.5\n"
    (tmp_path / "atoms.dump").write_text(head + box + rows)
    with pytest.raises(FileFormatError, match=r"atoms\.dump"):
        read_places(tmp_path / "atoms.dump")


YADE = {  # as py/export.py of Yade writes them: %g, set apart by tabs
    "#format x_y_z_r\n1\t2\t0\t0.5\n3\t2\t0\t0.5\n": ("0", "1"),
    "#format x_y_z_r\n# two balls\n1\t2\t0\t0.5\n3\t2\t0\t0.5\n": ("0", "1"),
    "#format x_y_z_r_matId\n1\t2\t0\t0.5\t0\n3\t2\t0\t0.5\t0\n": ("0", "1"),
    "#format id_x_y_z_r_matId\n7\t1\t2\t0\t0.5\t0\n9\t3\t2\t0\t0.5\t0\n": ("7", "9"),
    "#format x_y_z_r_attrs\n# id mass\n1\t2\t0\t0.5\t7\t1\n3\t2\t0\t0.5\t9\t1\n": ("7", "9"),
}


@pytest.mark.parametrize("text", YADE)
def test_discs_as_yade_exports_them(text, tmp_path: Path) -> None:
    (tmp_path / "discs.txt").write_text(text)
    assert read_places(tmp_path / "discs.txt") == dict(
        zip(YADE[text], [(1.0, 2.0, 0.0), (3.0, 2.0, 0.0)], strict=True)
    )


TABLES = {
    "commas": ("a,b,force\np,q,1\n", {}),
    "semicolons": ("a;b;force\np;q;1\n", {}),
    "blanks": ("  a   b force\n  p  q\t1e0  \n\n", {}),
    "a header behind a mark": ("# id1 id2 fn\np q 1\n", {}),
    "comments too": ("# made by me\n# today, twice\na,b,force\n# now\np,q,1\n", {}),
    "quotes": ('"a","b","force"\r\n"p","q","1"\r\n', {}),
    "other names": ("one,two,N (mN)\np,q,1\n", {"a": "one", "b": "two", "force": "N (mN)"}),
    "no header": ("5,6,1\n5,7,2\n", {"a": "1", "b": "2", "force": "3"}),
    "more columns": ("a,b,i,j,x,y,force,state\np,q,0,1,5,5,1,closed\n", {}),
}


@pytest.mark.parametrize(("text", "columns"), TABLES.values(), ids=TABLES.keys())
def test_tables_as_people_write_them(text, columns, tmp_path: Path) -> None:
    (tmp_path / "forces.txt").write_text(text)
    forces = read_forces(tmp_path / "forces.txt", columns)
    first, *others = forces
    ends = ("5", "6") if columns.get("a") == "1" else ("p", "q")
    assert (first.a, first.b, first.force) == (*ends, 1.0)
    assert len(others) == (ends == ("5", "6"))
    assert first.point is None


def test_ends_by_their_centres_vectors_and_points(tmp_path: Path) -> None:
    file = tmp_path / "forces.csv"
    file.write_text("x1,y1,b,fx,fy\n0,1,floor,0,2.5\n")
    (force,) = read_forces(file)
    assert (force.at_a, force.b, force.vector) == ((0.0, 1.0), "floor", (0.0, 2.5))
    file.write_text("x,y,z,force\n0,1,0,2.5\n")
    (force,) = read_forces(file)
    assert (force.point, force.force) == ((0.0, 1.0, 0.0), 2.5)


BAD = {
    "empty": ("", "forces.csv is 'empty'"),
    "blank": ("\n  \n", "forces.csv is 'empty'"),
    "comments": ("# a b force\n# nothing\n", "forces.csv is 'comments only'"),
    "no forces": ("a,b\n1,2\n", "forces.csv, its columns is 'a, b', expected a column of forces"),
    "no ends": ("force\n1\n", "forces.csv, line 2 is 'without its ends'"),
    "a cell short": ("a,b,force\n1,2\n", "cells in .*forces.csv, line 2 is 2, expected 3: a, b"),
    "a cell too many": ("a,b,force\n\n1,2,3,4\n", "forces.csv, line 3 is 4, expected 3"),
    "text": ("a,b,force\n1,2,much\n", "forces.csv, line 2 is 'much', expected a finite number"),
    "code": ("a,b,force\n1,2,1_0\n", "line 2 is '1_0', expected a finite number"),
    "not finite": ("a,b,force\n1,2,nan\n", "line 2 is 'nan', expected a finite number"),
    "infinite": ("a,b,force\n1,2,1e999\n", "line 2 is '1e999', expected a finite number"),
    "a name twice": ("a,b,a,force\n1,2,3,4\n", "is 'a', expected one of the columns .*, once"),
    "a long line": ("a,b,force\n" + "1" * 70_000 + "\n", "forces.csv, line 2 is .*65536 bytes"),
    "no newline at all": ("1" * 10**7, "forces.csv, line 1 is .*65536 bytes"),
    "a lone quote": ('a,b,force\n"1,2,3\n', "line 2"),
    "no snapshot": ("ITEM: TIMESTEP\n0\n", "is 'without a whole snapshot'"),
    "a table without its size": ("ITEM: ENTRIES a b force\n1 2 3\n", "line 1 is 'ITEM: ENTRIES"),
    "no size": ("ITEM: NUMBER OF ENTRIES\nmany\n", "line 2 is 'many', expected a number of rows"),
    "a size below zero": ("ITEM: NUMBER OF ENTRIES\n-1\n", "line 2 is '-1'"),
    "a size without end": ("ITEM: NUMBER OF ENTRIES\n" + "9" * 999, "line 2 is '9999.*a number of"),
    "cut short": (
        "ITEM: NUMBER OF ENTRIES\n999999999999\nITEM: ENTRIES a b force\n1 2 3\n",
        "number of rows below .*forces.csv, line 3 is 1, expected 999999999999",
    ),
    "a row short": (
        "ITEM: NUMBER OF ENTRIES\n2\nITEM: ENTRIES a b force\n1 2 3\n1 2\n",
        "cells in .*forces.csv, line 5 is 2",
    ),
    "another dump": ("ITEM: NUMBER OF GRID\n1\nITEM: GRID CELLS\n1\n", "line 3 is 'ITEM: GRID"),
    "rows too many": (
        "ITEM: NUMBER OF ENTRIES\n1\nITEM: ENTRIES a b force\n1 2 3\n1 3 3\n",
        "line 5 is '1 3 3', expected a line of a snapshot",
    ),
}


@pytest.mark.parametrize(("text", "said"), BAD.values(), ids=BAD.keys())
def test_a_bad_file_is_refused_by_line_at_once(text, said, tmp_path: Path, capsys) -> None:
    file = tmp_path / "forces.csv"
    file.write_text(text)
    start = process_time()
    with pytest.raises(InputError, match=said):
        read_forces(file)
    assert process_time() - start < 1
    assert main(["check", str(file), "--scene", "nt60", "--layers", "2"]) == 1
    assert capsys.readouterr().err.startswith(("lcp-piles: ", "[ "))


@pytest.mark.parametrize("content", [b"a,b\xff", b"\x00\x00", b"PK\x03\x04\xff", b"\x1f\x8b\x08"])
def test_what_is_no_text_is_refused(content, tmp_path: Path) -> None:
    (tmp_path / "forces.csv").write_bytes(content)
    with pytest.raises(FileFormatError):
        read_forces(tmp_path / "forces.csv")


@pytest.mark.parametrize("name", ["/dev/zero", "/", "/nowhere/forces.csv"])
def test_what_is_no_file_is_not_read(name) -> None:
    with pytest.raises(FileFormatError, match="the file is "):
        read_forces(name)


ANY_TEXT = st.text(alphabet='ITEM: NUBROFESab,;#"xyforce019.-+en\n\t', max_size=120)


@settings(max_examples=150, deadline=None)
@given(text=ANY_TEXT)
def test_any_text_is_read_or_refused_by_the_name_of_the_file(tmp_path_factory, text) -> None:
    file = tmp_path_factory.mktemp("any") / "forces.csv"
    file.write_text(text)
    refused = [str(error) for error in errors_of(lambda: read_forces(file))]
    assert all("forces.csv" in error for error in refused)


def errors_of(call) -> list[InputError]:
    try:
        call()
    except InputError as error:
        return [error]
    return []


def test_columns_are_named_or_refused(tmp_path: Path) -> None:
    (tmp_path / "forces.csv").write_text("a,b,force\n1,2,3\n")
    with pytest.raises(InputError, match="the meaning of a column is 'colour'"):
        read_forces(tmp_path / "forces.csv", {"colour": "a"})
    with pytest.raises(InputError, match="is 'pull', expected one of the columns a, b, force"):
        read_forces(tmp_path / "forces.csv", {"force": "pull"})
    (tmp_path / "discs.csv").write_text("id,x,y\n1,0,0\n1,1,1\n")
    with pytest.raises(FileFormatError, match=r"discs.csv, line 3 is '1', expected an id that"):
        read_forces(tmp_path / "forces.csv", discs=tmp_path / "discs.csv")


@pytest.fixture(name="table")
def _table(tmp_path: Path) -> Path:
    """Forces of NT60 of three layers in newtons, discs of 2 mm that weigh 3 mN, shuffled, as
    tension, by numbers of their own; and where these discs are, in metres."""
    pile = solve(nt60(3))
    number = {disc.id: 90 - k for k, disc in enumerate(pile.scene.discs)}
    rows = [
        (number.get(c.b, "floor"), number[c.a], repr(-3e-3 * force))
        for c, force in zip(pile.scene.contacts, pile.force_array.tolist(), strict=True)
    ]
    with (tmp_path / "forces.csv").open("w", newline="") as file:
        csv.writer(file).writerows([("one", "two", "fn"), *rows[::-1]])
    with (tmp_path / "discs.csv").open("w", newline="") as file:
        places = [(number[d.id], *(2e-3 * float(x) for x in d.position)) for d in pile.scene.discs]
        csv.writer(file).writerows([("id", "x", "y"), *places])
    return tmp_path / "forces.csv"


def words(table: Path, *more: str) -> list[str]:
    columns = ("--columns", "a=one,b=two", "--discs", str(table.with_name("discs.csv")))
    units = ("--disc-radius", "0.002", "--disc-weight", "3e-3")
    return ["check", str(table), "--scene", "nt60", "--layers", "3", *columns, *units, *more]


def test_the_command_in_si_units(table, capsys) -> None:
    out = table.with_name("check.json")
    status = main(words(table, "--json", str(out), "--plot", str(table.with_name("p.png"))))
    said = capsys.readouterr().out
    assert status == 0
    assert "10 of 10 contacts, compression negative" in said
    assert "the forces agree: every one is within 0.001 of the largest" in said
    content = json.loads(out.read_text())
    assert (content["format"], content["verdict"]) == ("lcp-piles-check/1", "agree")
    assert content["flipped"] is True
    assert content["largest_difference"] < 1e-12
    assert len(content["contacts"]) == 10
    assert table.with_name("p.png").read_bytes().startswith(b"\x89PNG")


def test_the_command_tells_what_differs(table, capsys) -> None:
    """At another push, and with a saddle; the table of all contacts as CSV."""
    out = table.with_name("all.csv")
    assert main(words(table, "--push", "1", "--csv", str(out))) == 4
    said = capsys.readouterr().out
    assert "the forces differ: not all are within 0.001" in said
    assert "(3,2)-floor" in said
    with out.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 10
    sizes = [abs(float(row["difference"])) for row in rows]
    assert sizes == sorted(sizes, reverse=True)
    assert np.isclose(sizes[0], max(abs(float(r["given"]) - float(r["ours"])) for r in rows))
    assert main(words(table, "--push", "1", "--tolerance", "10")) == 0


def test_stiffness_on_the_command_line(tmp_path: Path, capsys) -> None:
    export(solve(nt60(4)), tmp_path / "forces.csv")
    asked = ("--scene", "nt60", "--layers", "4", "--stiffness", "1/100", "--tolerance", "1e-5")
    status = main(["check", str(tmp_path / "forces.csv"), *asked])
    assert status == 4  # these are rigid, and stiff discs have others
    assert "of tau = 1/100, to first order: without it 0 w" in capsys.readouterr().out


def test_a_scene_that_cannot_stand_has_a_status_of_its_own(tmp_path: Path, capsys) -> None:
    (tmp_path / "forces.csv").write_text('a,b,force\n"(1,1)","(2,1)",1\n')
    scene = str(DATA / "result-1-unstable.json")
    out = tmp_path / "check.json"
    status = main(["check", str(tmp_path / "forces.csv"), "--scene", scene, "--json", str(out)])
    assert status == 3
    assert "no forces balance the loads of this scene, which is proved" in capsys.readouterr().out
    assert json.loads(out.read_text())["largest_difference"] is None


@pytest.mark.parametrize(
    ("more", "status", "said"),
    [
        (("--columns", "one"), 2, "'one' is not of the form WHAT=NAME"),
        (("--columns", "a=seven"), 1, "is 'seven', expected one of the columns one, two, fn"),
        (("--columns", "colour=one"), 1, "the meaning of a column is 'colour'"),
        (("--disc-radius", "0"), 2, "not a positive number"),
        (("--disc-weight", "-1"), 2, "not a positive number"),
        (("--tolerance", "-1"), 2, "not a number of at least 0"),
        (("--stiffness", "0"), 2, "not a positive number"),
        (("--disc-radius", "1"), 1, "and itself', expected two different ends"),
        (("--disc-radius", "1e-9"), 1, "radii from the nearest disc"),
        (("--discs", "/nowhere"), 1, "/nowhere"),
        (("--json", "x.csv"), 2, "ends in .json"),
        (("--scene", "nt45"), 2, "neither a kind"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else None,
)
def test_bad_words(more, status, said, table, capsys) -> None:
    assert main(words(table, *more)) == status
    assert said in capsys.readouterr().err
