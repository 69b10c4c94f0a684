"""Scenes as a person writes them: plain numbers, any ids, supports by name, and what is refused."""

import copy
import pickle
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import flint
import numpy as np
import pytest
import sympy

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    floats_exactly,
    nt30,
    nt60,
    solve,
    surd,
    tbs,
    verify,
)
from lcp_piles.scenes.symmetry import mirror

FREE = (None, None)
UP = (0, 1)


def on_floor(**change) -> Scene:
    """One disc of weight 1 on a floor; its contact as changed."""
    contact = {"a": 1, "b": "floor", "normal": UP} | change
    return Scene([Disc(1, (0, 0), (0, -1), FREE)], [Contact(**contact)])


def tower(one, two) -> Scene:
    """Two discs of weight 1 with these ids, the first on the second, that on the floor."""
    discs = [Disc(one, (0, 2), (0, -1), FREE), Disc(two, (0, 0), (0, -1), FREE)]
    return Scene(discs, [Contact(one, two, UP), Contact(two, "floor", UP)])


# --- numbers ---

HALVES = [Fraction(1, 2), "1/2", "0.5", Decimal("0.5"), sympy.Rational(1, 2), flint.fmpq(1, 2)]


@pytest.mark.parametrize("half", HALVES, ids=lambda x: type(x).__name__)
def test_plain_numbers_are_taken_everywhere(half):
    """A disc of weight 1 on a floor of compliance 1/2 with a gap of 1/2: it sinks by 1."""
    disc = Disc((0,), (half, 0), (0, -1), (None, None))
    contact = Contact((0,), "floor", [0, 1], compliance=half, gap=half)
    solution = solve(Scene([disc], [contact]))
    assert solution.displacement((0,)) == (0, -1)
    assert replace(disc, held=(half, None)).held == (surd("1/2"), None)


def test_the_simplest_disc_can_be_written_down():
    disc = Disc((0,), (0, 1), (0, -1), (None, 0))
    assert disc.load == (surd(0), surd(-1))
    assert disc.held == (None, surd(0))
    assert Disc(0, np.array([0, 1]), (sympy.sqrt(3), flint.fmpz(-1)), FREE).load[0] == surd(
        "sqrt(3)"
    )
    # Held upright and free sideways, nothing pushes it anywhere.
    scene = Scene([disc], [Contact((0,), "floor", (0, 1), compliance=1)])
    assert solve(scene).displacement((0,)) == (0, 0)


@pytest.mark.parametrize(
    ("build", "what"),
    [
        (lambda x: Disc(1, (x, 0), (0, -1), FREE), "position of disc 1"),
        (lambda x: Disc(1, (0, 0), (0, x), FREE), "load of disc 1"),
        (lambda x: Disc(1, (0, 0), (0, -1), (x, None)), "held of disc 1"),
        (lambda x: Contact(1, "floor", (0, x)), "normal of contact 1-floor"),
        (lambda x: Contact(1, "floor", UP, x), "compliance of contact 1-floor"),
        (lambda x: Contact(1, "floor", UP, gap=x), "gap of contact 1-floor"),
    ],
)
@pytest.mark.parametrize("float_", [0.5, np.float64(0.5), np.float32(0.5)])
def test_a_float_is_refused_with_the_way_to_pass_it(build, what, float_):
    with pytest.raises(InputError, match=rf"^{what} is .*0\.5.*floats_exactly\((np\.\w+\()?0\.5"):
        build(float_)
    (exactly,) = floats_exactly([float(float_)])
    build(exactly)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Disc(1, "01", (0, -1), FREE), "position of disc 1 is '01', expected a tuple"),
        (lambda: Disc(1, 0, (0, -1), FREE), "position of disc 1 is 0, expected a tuple"),
        (lambda: Disc(1, (0, None), (0, -1), FREE), "position of disc 1 is None"),
        (lambda: Contact(1, "floor", UP, "sqrt(3)"), "compliance of .* a rational number"),
        (lambda: Contact(1, "floor", UP, bilateral=1), "bilateral of contact 1-floor is 1"),
        (lambda: Scene("ab", []), "discs is 'ab', expected a sequence of Disc"),
        (lambda: Scene([(0, 0)], []), r"an entry of discs is \(0, 0\), expected a Disc"),
        (lambda: replace(tbs(1), supports="floor"), "supports is 'floor'"),
        (lambda: replace(tbs(1), supports=("a", "a")), "expected different names"),
        (lambda: replace(tbs(1), supports=("",)), "expected different names"),
        (lambda: replace(tbs(1), geometric=0), "geometric is 0, expected True or False"),
    ],
)
def test_values_of_a_wrong_type_are_refused(build, message):
    with pytest.raises(InputError, match=message):
        build()


# --- ids and supports ---


@pytest.mark.parametrize("ids", [("a", "b"), (0, 1), (("row", 1), ("row", 2)), ((1,), 1)])
def test_a_disc_on_a_disc_puts_both_weights_on_the_floor(ids):
    scene = tower(*ids)
    solution = solve(scene)
    assert solution.force(ids[1], "floor") == 2
    assert solution.force(*ids) == 1
    assert verify(scene, solution).ok


def test_names_that_nobody_declared_are_errors():
    with pytest.raises(InputError, match=r"a contact is \(1, 'flor'\).*its supports \(floor\)"):
        on_floor(b="flor")
    with pytest.raises(InputError, match=r"a contact is \('floor', 1\), expected discs"):
        on_floor(a="floor", b=1)
    with pytest.raises(InputError, match="support is 'floor', expected a name that no disc has"):
        tower("floor", "b")
    wall = Contact(1, "wall", (1, 0))
    disc = Disc(1, (0, 0), (-1, 0), FREE)
    assert solve(Scene([disc], [wall], supports=["wall"])).force(1, "wall") == 1


@pytest.mark.parametrize("id", [True, 0.5, None, "", (), (1, ("a",)), (1, True), 2**63, b"a"])
def test_other_ids_are_refused(id):
    with pytest.raises(InputError, match=r"the id of a disc is .* or a tuple of such"):
        Disc(id, (0, 0), (0, -1), FREE)


def test_numpy_ids_become_plain_ones():
    id = Disc((np.int64(3), np.str_("a")), (0, 0), (0, -1), FREE).id
    assert id == (3, "a")
    assert [type(part) for part in id] == [int, str]


# --- contacts ---


def test_contacts_that_make_no_sense_are_refused_by_name():
    scene = nt60(3)
    first = scene.contacts[0]
    turned = replace(first, a=first.b, b=first.a, normal=tuple(-n for n in first.normal))
    for again in (first, turned):
        with pytest.raises(InputError, match=r"entries for contact .*\((1,1|2,1)\)-.* is 2"):
            replace(scene, contacts=(*scene.contacts, again))
    floor = scene.contacts[-1]
    with pytest.raises(InputError, match=r"entries for contact \(3,2\)-floor is 2"):
        replace(scene, contacts=(*scene.contacts, replace(floor, normal=(1, 0))))
    with pytest.raises(InputError, match=r"\(\(1, 1\), \(1, 1\)\), expected one between two diff"):
        replace(scene, contacts=(replace(first, b=first.a),))


@pytest.mark.parametrize(
    "normal",
    [(0, -1), (1, 0), ("3/5", "4/5"), ("1/2*sqrt(2)", "1/2*sqrt(2)"), ("-1/5", "2/5*sqrt(6)")],
)
def test_a_normal_has_to_point_along_the_line_of_centres(normal):
    """A normal opposite to the centres gave an unstable scene without a word."""
    scene = tower("a", "b")
    bad = (replace(scene.contacts[0], normal=normal), scene.contacts[1])
    with pytest.raises(InputError, match=r"the normal of contact a-b is .*\(0, 2\).*geometric"):
        replace(scene, contacts=bad)
    abstract = replace(scene, contacts=bad, geometric=False)
    assert abstract.contacts == bad


@pytest.mark.parametrize(("m", "accepted"), [(199, False), (201, True), (10**6, True)])
@pytest.mark.parametrize("scale", [1, 10**-9, 10**400, Fraction(1, 10**400)])
def test_a_rounded_normal_may_be_off_by_a_hundredth(m, accepted, scale):
    """(2m, m^2 - 1)/(m^2 + 1) is at the angle 2 atan(1/m) = 0.01 + ... from the vertical at
    m = 200: the sine is 2m/(m^2 + 1), 0.01005 at m = 199 and 0.00995 at m = 201."""
    assert (2 * m / (m * m + 1) < 0.01) == accepted
    scale = Fraction(scale)
    normal = (Fraction(2 * m, m * m + 1), Fraction(m * m - 1, m * m + 1))
    discs = [Disc("a", (7, 2 * scale), (0, -1), FREE), Disc("b", (7, 0), (0, -1), FREE)]
    contacts = [Contact("a", "b", normal)]
    if accepted:
        assert Scene(discs, contacts).geometric
    else:
        with pytest.raises(InputError, match="the normal of contact a-b"):
            Scene(discs, contacts)


def test_centres_that_floats_cannot_tell_apart_are_compared_exactly():
    far = 10**30
    discs = [Disc(k, (far + 2 * k, -far), (0, -1), FREE) for k in (0, 1)]
    assert Scene(discs, [Contact(1, 0, (1, 0))]).geometric
    with pytest.raises(InputError, match="the normal of contact 1-0"):
        Scene(discs, [Contact(1, 0, (-1, 0))])
    with pytest.raises(InputError, match="the normal of contact 1-0"):
        Scene([discs[0], replace(discs[0], id=1)], [Contact(1, 0, (1, 0))])  # at one place


def test_one_to_three_axes():
    for n in (1, 2, 3):
        nothing = (0,) * n
        scene = Scene([Disc(0, nothing, nothing, nothing)], [])
        assert scene.dimension == n
    for n in (0, 4):
        with pytest.raises(InputError, match=f"the dimension is {n}, expected 1 to 3 axes"):
            Scene([Disc(0, (0,) * n, (0,) * n, (0,) * n)], [])


def test_the_rigid_patch_that_methods_disagreed_on_can_be_written_down():
    root = "sqrt(3)"
    places = {(1, 1): (-4, 0), (1, 2): (-2, 0), (2, 1): (-3, root), (2, 2): (-1, root)}
    places |= {(2, 3): (1, root)}
    held = {(1, 1), (2, 3)}
    discs = [Disc(k, x, (0, -1), (0, 0) if k in held else FREE) for k, x in places.items()]
    half, steep = "1/2", "1/2*sqrt(3)"
    contacts = [
        Contact((1, 2), (1, 1), (1, 0), 0, "-1 + sqrt(3)"),
        Contact((2, 1), (1, 1), (half, steep), 0, 0),
        Contact((1, 2), (2, 2), ("-1/2", "-1/2*sqrt(3)"), 0, "3/2 - 2/3*sqrt(3)"),
        Contact((2, 1), (1, 2), ("-1/2", steep), 0, "2/3", bilateral=True),
        Contact((1, 2), "floor", UP, 0, "3/5"),
        Contact((2, 2), (2, 1), (1, 0), 0, "1/2 - 2/3*sqrt(3)"),
        Contact((2, 3), (2, 2), (1, 0), 0, "-5/6", bilateral=True),
    ]
    assert len(Scene(discs, contacts).contacts) == 7


# --- variants ---


def test_a_variant_has_no_origin_and_a_copy_has():
    scene = nt30(3, push=20)
    assert dict(scene.origin.parameters)["push"] == 20
    assert scene.origin.scene() == scene
    for same in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        assert same == scene
        assert same.origin == scene.origin
    assert replace(scene, contacts=scene.contacts[1:]).origin is None
    assert replace(scene).origin is None
    assert scene.without([(1, 1)]).origin is None
    with pytest.raises(ValueError, match="origin"):
        replace(scene, origin=scene.origin)


def test_what_is_shown_of_a_scene_is_short():
    assert repr(nt30(6, push="20")) == "<Scene NT30, layers 6, push 20: 51 discs, 129 contacts>"
    assert repr(tbs(2)) == "<Scene TBS, layers 2: 10 discs, 9 contacts>"
    assert repr(tower("a", "b")) == "<Scene: 2 discs, 2 contacts>"
    assert len(repr(nt30(3, push=surd("1/" + "7" * 5000)))) < 100
    disc, contact = nt30(6).discs[0], nt30(6).contacts[0]
    assert eval(repr(disc)) == disc
    assert eval(repr(contact)) == contact


# --- the mirror ---


def sphere_in_a_groove(names, compliances=(1, 1)) -> Scene:
    """A disc between two walls that are mirror images, the first on the left."""
    walls = [
        Contact(0, name, (x, "4/5"), c)
        for name, x, c in zip(names, ("3/5", "-3/5"), compliances, strict=True)
    ]
    return Scene([Disc(0, (0, 0), (0, -1), FREE)], walls, tuple(dict.fromkeys(names)))


def test_a_wall_has_the_wall_on_the_other_side_for_its_image():
    image = mirror(sphere_in_a_groove(["left", "right"]))
    assert image is not None
    assert image.contacts.tolist() == [1, 0]
    assert mirror(sphere_in_a_groove(["left", "right"], (1, 2))) is None


def test_a_support_has_one_image_and_not_a_part_of_two():
    """Two discs on one floor, then the right one on another: no support is the floor's image."""
    discs = [Disc(k, (x, 0), (0, -1), FREE) for k, x in enumerate((-3, 3, 0))]

    def on(*floors):
        contacts = [Contact(k, name, UP) for k, name in enumerate(floors)]
        return mirror(Scene(discs, contacts, ("floor", "table")))

    assert on("floor", "floor", "floor").contacts.tolist() == [1, 0, 2]
    assert on("floor", "floor", "table").contacts.tolist() == [1, 0, 2]
    assert on("floor", "table", "floor") is None
    assert on("floor", "table").contacts.tolist() == [1, 0]


def test_two_supports_of_one_disc_in_one_direction_keep_the_symmetry():
    disc = Disc(0, (0, 0), (0, -1), FREE)
    scene = Scene([disc], [Contact(0, "floor", UP), Contact(0, "table", UP)], ("floor", "table"))
    assert mirror(scene).contacts.tolist() == [0, 1]
    solution = solve(scene)
    assert solution.record.part == "even"
    assert [str(f) for f in solution.forces] == ["1/2", "1/2"]
