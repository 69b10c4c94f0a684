"""Packings from tables and dumps of discs, and the commands that take them."""

import csv
import json
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from packed import settled

from lcp_piles import (
    FileFormatError,
    InputError,
    Packing,
    check,
    load_scene,
    prove_packing,
    read_forces,
    read_packing,
    verify,
)
from lcp_piles.checking.conclusions import conclusions
from lcp_piles.checking.given import GivenForce
from lcp_piles.cli.parser import main
from lcp_piles.files.read_forces import read_places
from lcp_piles.files.read_result import load

DATA = Path(__file__).parent / "data"
DUMP = str(DATA / "settled-100.dump")
BOX = ("--floor", "0", "--left", "0", "--right", "9", "--contact-stiffness", "1e4")
WALLS = {"floor": 0.0, "left": 0.0, "right": 9.0}
HEAP = "x,y,radius\n0,1,1\n2,1,1\n1,2.7,1\n"


def same(one: Packing, two: Packing) -> bool:
    names = ("loads", "held", "a", "b", "support", "stiffness")
    return (
        all(np.array_equal(getattr(one, n), getattr(two, n)) for n in names)
        and np.array_equal(one.gaps.high, two.gaps.high)
        and np.array_equal(one.gaps.low, two.gaps.low)
        and one.supports == two.supports
    )


def test_a_dump_of_lammps_is_the_packing_that_it_holds() -> None:
    """Against a reading of the same file by numpy's loadtxt."""
    found = read_packing(DUMP, supports=WALLS, stiffness=1e4)
    assert same(found, settled())
    assert found.ids[:3] == ("1", "2", "3")


@pytest.mark.parametrize(
    "text",
    [
        HEAP,
        "x;y;radius\n0;1;1\n2;1;1\n1;2.7;1\n",
        "#format x_y_z_r\n0\t1\t5\t1\n2\t1\t5\t1\n1\t2.7\t5\t1\n",  # Yade, all at one z
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS ff ff pp\n0 1\n0 1\n0 1\n"
        "ITEM: ATOMS x y z radius vx\n0 1 0 1 9\n2 1 0 1 9\n1 2.7 0 1 9\n",
    ],
    ids=["csv", "semicolons", "yade", "lammps"],
)
def test_one_heap_in_every_format(text, tmp_path: Path) -> None:
    (tmp_path / "heap.txt").write_text(text)
    (tmp_path / "heap.csv").write_text(HEAP)
    how = {"supports": {"floor": 0}, "stiffness": 100}
    heap = read_packing(tmp_path / "heap.txt", **how)
    assert same(heap, read_packing(tmp_path / "heap.csv", **how))
    assert heap.dimension == 2
    assert heap.ids == (0, 1, 2)


def test_weights_masses_and_other_names(tmp_path: Path) -> None:
    file = tmp_path / "discs.csv"
    file.write_text("name,x,y,size,mass\np,0,1,1,2\nq,3,1,1,4\n")
    found = read_packing(file, {"id": "name", "radius": "size"}, gravity=9.81)
    assert found.ids == ("p", "q")
    assert found.loads.tolist() == [[0, -9.81 * 2], [0, -9.81 * 4]]
    assert read_packing(file, {"radius": "size", "weight": "size"}).loads[0].tolist() == [0, -1]


def test_spheres_have_three_axes(tmp_path: Path) -> None:
    (tmp_path / "s.csv").write_text("x,y,z,r\n0,0,1,1\n5,5,1.5,1\n")
    assert read_packing(tmp_path / "s.csv", supports={"floor": 0}).dimension == 3


@settings(max_examples=8, deadline=None)
@given(order=st.permutations(range(100)), scale=st.sampled_from([2.0**-10, 1.0, 512.0]))
def test_rows_in_any_order_and_any_unit_of_length_prove_the_same(
    tmp_path_factory, order, scale
) -> None:
    """With the stiffness in the new unit, a power of two of the old one, forces are the same."""
    rows = np.loadtxt(DUMP, skiprows=9)[list(order)]
    file = tmp_path_factory.mktemp("order") / "discs.csv"
    with file.open("w", newline="") as stream:
        out = csv.writer(stream)
        out.writerow(("id", "x", "y", "radius", "weight"))
        out.writerows([int(i), *(scale * v for v in xyr), m] for i, *xyr, m in rows.tolist())
    expected = forces_of(read_packing(DUMP, supports=WALLS, stiffness=1e4))
    walls = WALLS | {"right": 9.0 * scale}
    found = forces_of(read_packing(file, supports=walls, stiffness=1e4 / scale))
    assert found.keys() == expected.keys()
    assert max(abs(found[pair] - expected[pair]) for pair in expected) < 1e-9


def forces_of(packing: Packing) -> dict[frozenset, float]:
    """Proved forces by the names of the ends."""
    proof = prove_packing(packing)
    assert proof.proved
    ends = [frozenset(packing.contact_ends(k)) for k in range(len(packing.a))]
    return dict(zip(ends, proof.forces.middle.tolist(), strict=True))


BAD = {
    "no radius": ("x,y\n0,1\n", "discs.csv, its columns is 'x, y', expected a column of radius"),
    "no discs": ("x,y,r\n", "discs.csv is 'without discs'"),
    "no numbers": ("x,y,r\n0,1,big\n", "discs.csv, line 2 is 'big', expected a finite number"),
    "not finite": ("x,y,r\n0,inf,1\n", "discs.csv, line 2 is 'inf'"),
    "a radius below zero": ("x,y,r\n0,1,-1\n", "the radius of disc 0 is -1.0"),
    "a name twice": ("id,x,y,r\na,0,1,1\na,5,1,1\n", "the ids is 'a list with repeats'"),
    "two at one place": ("x,y,r\n0,1,1\n0,1,1\n", "the distance of discs 0-1"),
    "empty": ("", "is 'empty', expected a table|JSON, whole and valid"),
}


@pytest.mark.parametrize(("text", "said"), BAD.values(), ids=BAD.keys())
def test_bad_tables_are_refused_at_once(text, said, tmp_path: Path, capsys) -> None:
    (tmp_path / "discs.csv").write_text(text)
    start = process_time()
    with pytest.raises(InputError, match=said):
        read_packing(tmp_path / "discs.csv")
    assert process_time() - start < 1
    assert main(["solve", str(tmp_path / "discs.csv")]) == 1
    assert capsys.readouterr().err.startswith("lcp-piles: ")


def test_a_kind_of_column_that_is_none() -> None:
    with pytest.raises(InputError, match="the meaning of a column is 'colour'"):
        read_packing(DUMP, {"colour": "x"})
    with pytest.raises(FileFormatError, match="is 'size', expected one of the columns id, x, y"):
        read_packing(DUMP, {"radius": "size"})


def test_solve_proves_a_packing_as_it_stands(tmp_path: Path, capsys) -> None:
    """The states and forces that LAMMPS has itself, in the table that is written."""
    table, picture = tmp_path / "forces.csv", tmp_path / "packing.png"
    words = ["solve", DUMP, *BOX, "--out", str(table), "--plot", str(picture)]
    assert main(words) == 0
    said = capsys.readouterr().out
    for piece in ("packing of 100 discs, 205 contacts; walls: floor, left, right", "proved"):
        assert piece in said
    assert picture.read_bytes().startswith(b"\x89PNG")
    with table.open(newline="") as file:
        ours = {frozenset((r["a"], r["b"])): r for r in csv.DictReader(file)}
    theirs = np.loadtxt(DATA / "settled-100-pairs.dump", skiprows=9)
    largest = theirs[:, 2].max()
    closed = {
        p for p, r in ours.items() if r["state"] == "closed" and not p & {"floor", "left", "right"}
    }
    assert closed == {frozenset((str(int(i)), str(int(j)))) for i, j, _ in theirs}
    for i, j, force in theirs:
        row = ours[frozenset((str(int(i)), str(int(j))))]
        assert abs(float(row["force"]) - force) < 1e-5 * largest
        assert float(row["force_error"]) < 1e-12


def test_prove_takes_the_same_file(capsys) -> None:
    assert main(["prove", DUMP, *BOX]) == 0
    assert "every force within " in capsys.readouterr().out


def test_a_packing_without_walls_falls(capsys) -> None:
    assert main(["prove", DUMP, "--floor", "0"]) == 3
    assert "unstable: no forces balance the load" in capsys.readouterr().out


def test_an_exact_scene_next_to_a_packing_is_a_file_that_other_commands_take(
    tmp_path: Path, capsys
) -> None:
    (tmp_path / "heap.csv").write_text(HEAP)
    walls = ("--floor", "0", "--wall", "left=-1,0:1,0", "--right", "3.0")
    out = tmp_path / "near.json"
    words = ["solve", str(tmp_path / "heap.csv"), *walls, "--contact-stiffness", "100"]
    assert main([*words, "--exact", "1e-6", "--json", str(out)]) == 0
    said = capsys.readouterr().out
    assert "normals are rational, within " in said
    assert "no force differs by more than " in said
    solution = load(out)
    assert verify(solution.scene, solution).ok
    assert load_scene(out) == solution.scene
    assert main(["fields", str(out), "--show", "coordination"]) == 0


def test_negative_numbers_and_a_period(tmp_path: Path) -> None:
    (tmp_path / "row.csv").write_text("x,y,r\n0,-4,1\n2,-4,1\n4,-4,1\n")
    row = str(tmp_path / "row.csv")
    assert main(["prove", row, "--floor", "-5", "--period", "6", "--touching", "0.001"]) in (0, 1)


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (("solve", DUMP, "--layers", "3"), 2, "--layers: "),
        (("solve", DUMP, "--floor", "bumpy"), 2, "--floor: the number is 'bumpy'"),
        (("solve", DUMP, "--floor", "1e999"), 2, "beyond the range of floats"),
        (("solve", DUMP, "--wall", "slope"), 2, "not of the form NAME=POINT:NORMAL"),
        (("solve", DUMP, "--wall", "slope=0,0:0,0"), 2, "expected a vector that is not zero"),
        (("solve", DUMP, "--wall", "slope=0:0,1"), 1, "2 components throughout"),
        (("solve", DUMP, "--front", "0"), 1, "the wall front"),
        (("solve", DUMP, "--floor", "0", "--json", "a.json"), 2, "--exact ANGLE makes one"),
        (("solve", DUMP, "--floor", "0", "--out", "a.vtp"), 2, "only .csv without --exact"),
        (("solve", DUMP, "--stiffness", "1/10"), 2, "--contact-stiffness is"),
        (("solve", DUMP, "--disc-columns", "radius=size"), 1, "is 'size', expected one of"),
        (("solve", DUMP, "--exact", "0"), 1, "angle"),
        (("solve", "nt30", "--layers", "3", "--left", "0"), 2, "--left: nt30 is no table"),
        (("solve", "nt30", "--layers", "3", "--exact", "1e-9"), 2, "solved exactly anyway"),
        (("fields", DUMP, "--show", "stress"), 2, "makes an exact scene of it"),
        (("bounds", DUMP, "--friction", "1/10"), 2, "makes an exact scene of it"),
        (("solve", "/dev/zero", "--floor", "0"), 1, "expected a regular file"),
    ],
    ids=lambda value: " ".join(value[2:]) if isinstance(value, tuple) else None,
)
def test_bad_words(words, status, said, capsys) -> None:
    assert main(list(words)) == status
    assert said in capsys.readouterr().err


PAIRS = ("--columns", "a=c_ends[1],b=c_ends[2],force=c_push[2]")
FORCES = str(DATA / "settled-100-pairs.dump")


def test_check_holds_the_forces_of_lammps_against_the_proof(tmp_path: Path, capsys) -> None:
    """LAMMPS settled these discs: its forces are those of the packing to nearly all digits."""
    words = ["check", FORCES, *PAIRS, "--scene", DUMP, *BOX, "--tolerance", "1e-9"]
    out = tmp_path / "check.json"
    assert main([*words, "--json", str(out)]) == 0
    said = capsys.readouterr().out
    assert "170 of 205 contacts" in said
    assert "the forces agree: every one is within 1e-09 of the largest" in said
    assert "no forces at floor, left, right: the 30 contacts there are left out" in said
    assert json.loads(out.read_text())["packing"] == "<Packing: 100 discs, 205 contacts>"


def test_check_finds_what_is_wrong_in_a_packing(tmp_path: Path, capsys) -> None:
    """One force twice as large, one pair without force, one force between far discs."""
    columns = {"a": "c_ends[1]", "b": "c_ends[2]", "force": "c_push[2]"}
    theirs = read_forces(FORCES, columns)
    places = read_places(DUMP)
    inside = [f for f in theirs if all(2 < min(places[end][:2]) < 6 for end in (f.a, f.b))]
    double, missing = inside[0], inside[-1]
    bent = [replace(f, force=2 * f.force) if f is double else f for f in theirs]
    bent.remove(missing)
    bent.append(GivenForce(3.0, a="1", b="100"))
    found = check(read_packing(DUMP, supports=WALLS, stiffness=1e4), bent)
    assert found.verdict == "differ"
    names = [{f.a, f.b} for f in (double, missing)]
    assert [set(found.reference.ends(k)) for k in found.worst[:2]] in (names, names[::-1])
    assert [set(found.reference.ends(k)) for k in found.wrong] == names[1:]
    assert found.others == (("1-100", 3.0),)
    text = " ".join(conclusions(found))
    assert "they do not balance the loads" in text
    assert "of another scene" in text
    assert " w " not in text


def test_check_by_places_and_in_si_units() -> None:
    """Everything in millimetres and grams: radius and weight are those units in ours."""
    columns = {"a": "c_ends[1]", "b": "c_ends[2]", "force": "c_push[2]"}
    theirs = read_forces(FORCES, columns, discs=DUMP)
    assert theirs[0].a is None
    scaled = [
        replace(
            f,
            force=-2.5 * f.force,
            at_a=tuple(1e3 * x for x in f.at_a),
            at_b=tuple(1e3 * x for x in f.at_b),
        )
        for f in theirs
    ]
    packing = read_packing(DUMP, supports=WALLS, stiffness=1e4)
    found = check(packing, scaled, radius=1e3, weight=2.5)
    assert found.verdict == "agree"
    assert found.flipped


def test_a_packing_that_cannot_stand_is_said(capsys) -> None:
    assert main(["check", FORCES, *PAIRS, "--scene", DUMP, "--floor", "0"]) == 3
    assert "no forces balance the loads of this scene, which is proved" in capsys.readouterr().out


def test_stiffness_is_nothing_for_a_packing(capsys) -> None:
    words = ["check", FORCES, *PAIRS, "--scene", DUMP, *BOX]
    assert main([*words, "--stiffness", "1/10"]) == 1
    assert "nothing for a packing, which has its own stiffness" in capsys.readouterr().err


def test_a_check_of_a_packing_is_drawn() -> None:
    from lcp_piles.pictures import draw_check

    columns = {"a": "c_ends[1]", "b": "c_ends[2]", "force": "c_push[2]"}
    found = check(
        read_packing(DUMP, supports=WALLS, stiffness=1e4), read_forces(FORCES, columns)[:-5]
    )
    ax = draw_check(found)
    assert ax.get_title() == "packing, 100 discs: given forces minus ours"
    lines = {c.get_label(): len(c.get_paths()) for c in ax.collections}
    assert lines["named wrongly"] == len(found.wrong) == 5
    assert lines["differences"] >= 5
