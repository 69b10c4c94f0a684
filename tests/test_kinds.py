"""Kinds of scenes as values: what they say of themselves is true of the scenes they build."""

import json
from contextlib import suppress
from dataclasses import fields
from fractions import Fraction

import pytest

import lcp_piles
from lcp_piles import KINDS, InputError, nt30, pile, solve, surd, tbs
from lcp_piles.mechanics.system import contact_system
from lcp_piles.scenes.kind import Kind, Parameter, has_unique_forces, origin_of
from lcp_piles.scenes.symmetry import mirror

EVERY = pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS.keys())
OTHERS = {  # values of parameters that are not the defaults, as text
    "push": ["7/3*sqrt(3) - 20"],
    "floor_compliance": ["-1/2", "1/3"],
    "wall_compliance": ["0"],
    "weight": ["2*sqrt(3)"],
}


def scenes(kind: Kind):
    """Small scenes of a kind, at the defaults and with every parameter changed in turn."""
    extents = [p.name for p in kind.parameters if p.default is None]
    for size in range(1, 9):
        for p in kind.parameters:
            for other in OTHERS.get(p.name, p.choices):
                given = {name: size - k for k, name in enumerate(extents)} | {p.name: other}
                try:
                    kind.values(given)
                except InputError:
                    continue  # too small, or a number that only other kinds take
                yield kind.scene(**given)
        with suppress(InputError):
            yield kind.scene(**dict.fromkeys(extents, size))


@EVERY
def test_the_size_is_told_beforehand(kind):
    checked = 0
    for scene in scenes(kind):
        size = kind.size(**dict(scene.origin.parameters))
        assert size == (len(scene.discs), len(scene.contacts)), scene
        checked += 1
    assert checked >= 8


@EVERY
def test_the_mirror_is_a_symmetry(kind):
    """Of piles whatever their parameters; silos and slabs may lean or have walls that differ."""
    images = [mirror(scene) is not None for scene in scenes(kind)]
    assert all(images) or (any(images) and kind.name in ("silo", "slab"))


@EVERY
def test_parameters_go_to_text_and_back(kind):
    for scene in scenes(kind):
        for parameter, (name, value) in zip(kind.parameters, scene.origin.parameters, strict=True):
            assert parameter.name == name
            written = parameter.write(value)
            assert json.loads(json.dumps(written)) == written
            assert parameter.check(written) == value
            assert parameter.read(str(written)) == value
            assert not parameter.choices or value in parameter.choices


@EVERY
def test_an_origin_rebuilds_its_scene(kind):
    for scene in scenes(kind):
        assert origin_of(scene).scene() == scene
    with pytest.raises(InputError, match="made by the builder of a kind, unchanged"):
        origin_of(scene.without([scene.discs[0].id]))


@EVERY
def test_a_step_of_the_push_keeps_the_gauge_rational(kind):
    """Between two pushes one unit apart the gaps differ by a multiple of one root, so that the
    path needs no second right-hand side."""
    names = {p.name for p in kind.parameters}
    assert (kind.push is not None) == ("corner_stones" in names)
    if kind.push is None:
        return
    start = kind.scene(layers=4)
    pushed = start.origin.scene(**{kind.push.parameter: kind.push.unit})
    one, other = (contact_system(scene).gap for scene in (start, pushed))
    moved = [x - y for x, y in zip(other, one, strict=True)]
    assert any(moved)
    assert all(x.is_rational for x in moved)


def test_uniqueness_is_claimed_for_unchanged_piles_only():
    """-2/3 is the bound of notes/paper.md; a pile with other contacts is another scene."""
    soft = {"-1/2": True, "-13/20": True, "-2/3": False, "-2": False}
    for kind in ("nt30", "nt60", "tss"):
        for compliance, unique in soft.items():
            assert has_unique_forces(pile(kind, 3, floor_compliance=compliance)) is unique
    assert not has_unique_forces(nt30(3, floor_compliance="-1/2").without([(1, 1)]))
    assert has_unique_forces(nt30(3, floor_compliance=0).without([(1, 1)]))
    assert KINDS["tss"].unique_above == Fraction(-2, 3)


def test_no_default_stands_twice():
    """The functions take their defaults from the parameters: both ways give the same scene."""
    for name, kind in KINDS.items():
        extents = {p.name: 3 for p in kind.parameters if p.default is None}
        function = getattr(lcp_piles, name)
        assert function(*extents.values()).origin == kind.scene(**extents).origin
    assert nt30(3).origin.changed[0][0].name == "layers"
    assert len(nt30(3).origin.changed) == 1
    assert [p.name for p, _ in nt30(3, corner_stones="resting").origin.changed] == [
        "layers",
        "corner_stones",
    ]


def test_what_is_missing_or_unknown_is_named():
    with pytest.raises(InputError, match="layers of nt30 is 'missing', expected rows of discs"):
        KINDS["nt30"].scene()
    with pytest.raises(InputError, match="parameter of tbs is 'push', expected one of layers"):
        KINDS["tbs"].scene(layers=3, push=0)
    for text in ("3.5", "", "-3", "٣", "1e3", "9" * 10):
        with pytest.raises(InputError, match="layers of nt30 is"):
            KINDS["nt30"].parameter("layers").read(text)


def test_a_new_kind_is_one_value():
    """A pile that another file describes: nothing outside knows its name."""
    layers = KINDS["tbs"].parameter("layers")
    kind = Kind(
        name="heap",
        title="Heap",
        help="TBS under another name",
        parameters=(layers, Parameter("n", int, int, 0, "nothing", "n {}")),
        build=lambda layers, n: tbs(layers),
        size=lambda layers, n: (0, 0),
    )
    scene = kind.scene(layers=2, n="7")
    assert repr(scene).startswith("<Scene Heap, layers 2, n 7: ")
    assert solve(scene).force((1, 1), (2, 1)) == surd("1/13").sympy()  # as TBS by hand
    assert {field.name for field in fields(Kind)} >= {"push", "unique_above"}
