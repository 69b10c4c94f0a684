"""The four piles: geometry disc by disc, small piles worked by hand, Hong's closed form."""

from dataclasses import replace
from fractions import Fraction
from itertools import combinations

import pytest
import sympy
from helpers import ZERO, along

from lcp_piles import InputError, LcpPilesError, Scene, nt30, nt60, pile, solve, surd, tbs, tss

SCENES = {
    **{f"nt60-{n}": (nt60, n) for n in (2, 3, 6)},
    **{f"nt30-{n}": (nt30, n) for n in (2, 3, 4)},
    **{f"tss-{n}": (tss, n) for n in (2, 3, 6)},
    **{f"tbs-{n}": (tbs, n) for n in (1, 2, 4)},
}


@pytest.fixture(params=SCENES)
def scene(request):
    build, layers = SCENES[request.param]
    return build(layers)


def separation(scene, a, b):
    return [x - y for x, y in zip(scene.disc(a).position, scene.disc(b).position, strict=True)]


def test_contacts_are_the_pairs_that_touch(scene):
    """Discs of radius 1 touch at distance 2; two that cannot move are no contact."""
    touching = set()
    for one, other in combinations(scene.discs, 2):
        away = separation(scene, one.id, other.id)
        square = along(away, away)
        assert square >= 4  # no two discs overlap
        if square == 4 and not (one.fixed and other.fixed):
            touching.add(frozenset((one.id, other.id)))
    pairs = [frozenset((c.a, c.b)) for c in scene.contacts if not isinstance(c.b, str)]
    assert len(pairs) == len(set(pairs))
    assert set(pairs) == touching


def test_normals_point_from_b_to_a(scene):
    for contact in scene.contacts:
        if contact.b == "floor":
            assert contact.normal == (0, 1)
        else:
            away = separation(scene, contact.a, contact.b)
            assert [2 * n for n in contact.normal] == away
        assert contact.gap == 0
        assert contact.compliance == 1


def test_rows_are_centred_and_as_long_as_they_should_be(scene):
    layers = dict(scene.origin.parameters)["layers"]
    rows = layers + 2 if scene.origin.kind.name == "tbs" else layers
    steps = {"nt60": (2, "sqrt(3)"), "nt30": (2, "sqrt(3)")}.get(
        scene.origin.kind.name, ("2*sqrt(3)", 1)
    )
    wide, high = map(surd, steps)
    for i in range(1, rows + 1):
        row = [disc for disc in scene.discs if disc.id[0] == i]
        assert [disc.id for disc in row] == [(i, j) for j in range(1, len(row) + 1)]
        assert len(row) == (3 * i - 2 if scene.origin.kind.name == "nt30" else i)
        for j, disc in enumerate(row):
            assert disc.position == (
                wide * (Fraction(2 * j + 1 - len(row), 2)),
                high * (layers - i),
            )


def test_what_is_held_and_what_stands_on_the_floor(scene):
    layers = dict(scene.origin.parameters)["layers"]
    held = {disc.id for disc in scene.discs if disc.fixed}
    floor = [contact.a for contact in scene.contacts if contact.b == "floor"]
    if scene.origin.kind.name == "tbs":
        assert held == {disc.id for disc in scene.discs if disc.id[0] > layers}
        assert floor == []
    else:
        base = [disc.id for disc in scene.discs if disc.id[0] == layers]
        assert held == {base[0], base[-1]}
        assert floor == base[1:-1]
    for disc in scene.discs:
        assert disc.fixed or disc.held == (None, None)
        assert disc.fixed or disc.load == (0, -1)


@pytest.mark.parametrize("build", [nt60, nt30, tss])
def test_push_and_resting_corner_stones(build):
    scene = build(3, push="20 - sqrt(3)", floor_compliance="1/3", corner_stones="resting")
    base = [disc for disc in scene.discs if disc.id[0] == 3]
    push = surd("20 - sqrt(3)")
    assert base[0].held == (push, None)  # the left one moves to the right, towards the axis
    assert base[-1].held == (-push, None)
    floor = [contact for contact in scene.contacts if contact.b == "floor"]
    assert [contact.a for contact in floor] == [disc.id for disc in base]
    assert {contact.compliance for contact in floor} == {Fraction(1, 3)}
    assert not any(contact.bilateral for contact in scene.contacts)


def test_the_floor_of_negative_compliance_is_held_closed():
    scene = nt30(3, floor_compliance="-1/2")
    assert all(c.bilateral == (c.b == "floor") for c in scene.contacts)
    assert not scene.definite
    assert nt30(3, floor_compliance=0).definite


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: nt60(0), "layers of nt60 is 0, expected a number from 2"),
        (lambda: tss(-1), "layers of tss is -1"),
        (lambda: nt30(1), "layers of nt30 is 1"),
        (lambda: tbs(0), "layers of tbs is 0, expected a number from 1"),
        (lambda: nt30(2.0), r"layers of nt30 is 2\.0, expected a whole number"),
        (lambda: nt30(True), "layers of nt30 is True"),
        (lambda: nt30("3"), "layers of nt30 is '3'"),
        (lambda: nt30(10**5000), "expected a number from 2"),
        (lambda: nt60(3, push=0.5), r"0\.5, expected an exact number.*floats_exactly"),
        (lambda: nt60(3, push=float("nan")), "is nan"),
        (lambda: nt60(3, floor_compliance=0.5), r"is 0\.5"),
        (lambda: nt60(3, floor_compliance="sqrt(3)"), "floor compliance.*a rational number"),
        (lambda: nt60(3, corner_stones="free"), "corner_stones is 'free', expected \"held\""),
        (lambda: pile("nt45", 3), "kind of pile is 'nt45', expected one of nt30"),
        (lambda: pile("tbs", 3, push=1), "push is 1, expected nothing for tbs"),
        (lambda: pile("tbs", 3, colour=1), "parameter is 'colour'"),
        (lambda: nt60(3).without([(9, 9)]), r"disc is \(9, 9\), expected one of the 6 discs"),
    ],
)
def test_bad_parameters(call, message):
    with pytest.raises(InputError, match=message) as caught:
        call()
    assert isinstance(caught.value, LcpPilesError)


def test_defaults_may_be_spelled_out_for_tbs():
    assert pile("tbs", 2, push=0, floor_compliance="1", corner_stones="held") == tbs(2)


# --- by hand ---


@pytest.mark.parametrize("method", ["proved", "lemke"])
def test_nt30_of_two_layers_by_hand(method):
    """The apex stands on (2,2) and (2,3), which the corner stones keep from sliding apart.

    Forces, alike on both sides: a under the apex, h to the corner stone, m between (2,2) and
    (2,3), v on the floor. Balance of the apex and of (2,2):
        2 a sqrt(3)/2 = 1,   a sqrt(3)/2 + 1 = v,   h = a/2 + m,
    and m = 0, because h > 0 moves (2,2) outwards by h and so opens the gap to (2,3) by 2 h.
    """
    a, h, v = sympy.symbols("a h v")
    root = sympy.sqrt(3)
    by_hand = sympy.solve([a * root - 1, a * root / 2 + 1 - v, h - a / 2], [a, h, v])
    assert by_hand == {a: root / 3, h: root / 6, v: sympy.Rational(3, 2)}
    solution = solve(nt30(2), method)
    assert solution.force((1, 1), (2, 2)) == by_hand[a]
    assert solution.force((2, 1), (2, 2)) == by_hand[h]
    assert solution.force((2, 2), "floor") == by_hand[v]
    assert solution.force((2, 2), (2, 3)) == 0
    assert solution.gap((2, 2), (2, 3)) == 2 * by_hand[h]
    assert solution.displacement((2, 2)) == (-by_hand[h], -by_hand[v])
    assert solution.state((2, 2), (2, 3)) == "open"
    # The apex sinks by the sinking of (2,2), and by what a and the outward motion ask for:
    # 0 = n . (u_apex - u_22) + a with n = (1, sqrt(3))/2.
    sink = sympy.Symbol("sink")
    contact = (by_hand[h] + root * (sink + by_hand[v])) / 2 + by_hand[a]
    assert solution.displacement((1, 1)) == (0, sympy.solve(contact, sink)[0])


@pytest.mark.parametrize("method", ["proved", "lemke"])
def test_tbs_of_two_layers_by_hand(method):
    """Three free discs on fixed ones, nothing opens.

    Forces: a of the apex on (2,1), v of the apex on (3,2) below it; s of (2,1) on (3,1), t on
    (3,2), p on (4,2) below it. With the apex moved by (0, y), disc (2,1) by (x, z), Hooke's law is
        a = -(-sqrt(3) x + y - z)/2,  v = -y,  s = -(sqrt(3) x + z)/2,  t = -(-sqrt(3) x + z)/2,
        p = -z.
    Balance: a + v = 1;  a + t = s (sideways);  (s + t - a)/2 + p = 1.
    """
    x, y, z = sympy.symbols("x y z")
    root = sympy.sqrt(3)
    a, v = -(-root * x + y - z) / 2, -y
    s, t, p = -(root * x + z) / 2, -(-root * x + z) / 2, -z
    moved = sympy.solve([a + v - 1, a + t - s, (s + t - a) / 2 + p - 1], [x, y, z])
    by_hand = [sympy.nsimplify(force.subs(moved)) for force in (a, v, s, t, p)]
    assert by_hand == [sympy.Rational(n, 13) for n in (1, 12, 5, 4, 9)]
    solution = solve(tbs(2), method)
    ends = [((1, 1), (2, 1)), ((1, 1), (3, 2))]
    ends += [((2, 1), (3, 1)), ((2, 1), (3, 2)), ((2, 1), (4, 2))]
    assert [solution.force(*pair) for pair in ends] == by_hand
    assert solution.displacement((2, 1)) == (moved[x], moved[z])
    assert solution.count("closed") == 9


# --- Hong 1993 ---


def hong(layers):
    """Forces of the NT60 pile whose horizontal contacts above the base row carry nothing.

    Each disc passes its own weight in equal halves down the two rows of contacts at 60 degrees, and
    what comes down a row goes on along it: under disc (i, j) the contact down to the right carries
    the j discs of its row so far, the other one the i - j + 1 of its own, 1/sqrt(3) each. On the
    base row the weight is then the same for all, (N - 1)/2 and their own. Sideways disc (N, j) is
    pushed by ((j - 1) - (N - j))/(2 sqrt(3)), outwards on both sides, and the horizontal contacts
    hand that on to the corner stones: each carries what has gathered between it and the middle.
    """
    share = 1 / sympy.sqrt(3)
    forces = {}
    for i in range(1, layers):
        for j in range(1, i + 1):
            forces[(i, j), (i + 1, j)] = (i - j + 1) * share
            forces[(i, j), (i + 1, j + 1)] = j * share
            if j < i:
                forces[(i, j), (i, j + 1)] = 0
    outward = {j: (2 * j - layers - 1) * share / 2 for j in range(1, layers + 1)}
    for j in range(1, layers):
        left_of, right_of = range(2, j + 1), range(j + 1, layers)
        gathered = (
            sum(outward[k] for k in left_of if outward[k] > 0)
            if 2 * j >= layers
            else -sum(outward[k] for k in right_of if outward[k] < 0)
        )
        forces[(layers, j), (layers, j + 1)] = gathered
    return forces, sympy.Rational(layers + 1, 2)


HONG_FLOORS = [(0, "held"), (0, "resting"), (1, "resting"), ("1/3", "resting"), (7, "resting")]


@pytest.mark.parametrize(("floor", "corner_stones"), HONG_FLOORS)
@pytest.mark.parametrize("layers", [2, 3, 4, 5, 6, 7])
def test_nt60_is_hongs_pile(layers, floor, corner_stones):
    """On a rigid floor, or where the corner stones sink into the soft one like the others."""
    solution = solve(nt60(layers, floor_compliance=floor, corner_stones=corner_stones))
    forces, floor_force = hong(layers)
    for contact in solution.scene.contacts:
        expected = floor_force if contact.b == "floor" else forces[contact.a, contact.b]
        assert solution.force(contact.a, contact.b) == expected, contact


@pytest.mark.parametrize(("floor", "corner_stones"), HONG_FLOORS)
def test_from_eight_layers_on_a_pile_of_less_energy_beats_hongs(floor, corner_stones):
    """The thrust of the base row shortens it most beside the corner stones, which pushes the discs
    on it together. Hong's forces balance still, but those of a pile are the balanced ones of least
    energy, and these here have less."""
    solution = solve(nt60(8, floor_compliance=floor, corner_stones=corner_stones))
    forces, floor_force = hong(8)
    scene = solution.scene
    rest = {disc.id: [x.sympy() for x in disc.load] for disc in scene.discs}
    energies = [sympy.Integer(0), sympy.Integer(0)]
    for contact in scene.contacts:
        f = floor_force if contact.b == "floor" else forces[contact.a, contact.b]
        c = sympy.Rational(contact.compliance)
        energies[0] += c * f**2
        energies[1] += c * solution.force(contact.a, contact.b) ** 2
        for end, sign in ((contact.a, 1), (contact.b, -1)):
            if end != "floor":
                for axis in (0, 1):
                    rest[end][axis] += sign * contact.normal[axis].sympy() * f
    free = [(disc, axis) for disc in scene.discs for axis in (0, 1) if disc.held[axis] is None]
    assert all(sympy.expand(rest[disc.id][axis]) == 0 for disc, axis in free)
    assert sympy.expand(energies[0] - energies[1]) > 0
    assert solution.force((7, 1), (7, 2)) > 0


@pytest.mark.parametrize("layers", [3, 8, 12])
def test_on_a_base_row_that_cannot_move_every_nt60_pile_is_hongs(layers):
    whole = nt60(layers)
    discs = [replace(d, held=(ZERO, ZERO)) if d.id[0] == layers else d for d in whole.discs]
    contacts = [c for c in whole.contacts if c.a[0] < layers]
    solution = solve(Scene(tuple(discs), tuple(contacts)))
    forces, _ = hong(layers)
    assert all(solution.force(c.a, c.b) == forces[c.a, c.b] for c in contacts)


@pytest.mark.parametrize("layers", [4, 5, 8])
def test_nt60_on_a_soft_floor_between_held_stones_is_not_hongs(layers):
    """The stones do not sink, and horizontal contacts above the base row close."""
    solution = solve(nt60(layers))
    above = [c for c in solution.scene.contacts if c.b != "floor" and c.a[0] == c.b[0] < layers]
    assert any(solution.force(c.a, c.b) > 0 for c in above)
