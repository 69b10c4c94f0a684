"""Friction: networks that Coulomb's law admits, and bounds of their forces.

Every network is checked here in plain Surds from the geometry alone; expected values come from
closed forms, from an independent exact solver (PPL), or from the symmetry of the pile.
"""

import pickle
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from itertools import pairwise
from math import lcm

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    contact_bounds,
    force_bounds,
    nt30,
    nt60,
    pile,
    solve,
    surd,
    tbs,
    tss,
)
from lcp_piles.friction.equations import friction_problem
from lcp_piles.friction.force_bounds import InadmissibleError
from lcp_piles.friction.functionals import average_stress, combined, force_on

ZERO = surd(0)


def balance(scene, network):
    """Left-over force (x, y) and torque (anticlockwise) of every disc, without its load."""
    total = {disc.id: [ZERO, ZERO, ZERO] for disc in scene.discs}
    for contact, f, s in zip(scene.contacts, network.normal, network.tangential, strict=True):
        n, t = contact.normal, (-contact.normal[1], contact.normal[0])
        push = [f * n[axis] + s * t[axis] for axis in (0, 1)]
        for disc, sign in ((contact.a, 1), (contact.b, -1)):
            if disc in total:
                # The contact is at -n from the centre of a, at +n from that of b.
                arm = [-sign * x for x in n]
                mine = [sign * x for x in push]
                total[disc][0] += mine[0]
                total[disc][1] += mine[1]
                total[disc][2] += arm[0] * mine[1] - arm[1] * mine[0]
    return total


def assert_admissible(scene, network, mu, rough=(), loaded=True):
    for contact, f, s in zip(scene.contacts, network.normal, network.tangential, strict=True):
        smooth = contact.b in scene.supports and contact.b not in rough
        assert f >= 0
        assert abs(s) <= (ZERO if smooth else surd(mu) * f)
    for id, (x, y, torque) in balance(scene, network).items():
        disc = scene.disc(id)
        for force, load, held in zip((x, y), disc.load, disc.held, strict=True):
            assert held is not None or force + (load if loaded else ZERO) == 0
        assert disc.fixed or torque == 0


def value(what, network, scene):
    total = ZERO
    for ends, weight in what.items():
        k = next(k for k, c in enumerate(scene.contacts) if {c.a, c.b} == set(ends))
        n, t = weight if isinstance(weight, tuple) else (weight, 0)
        total += surd(n) * network.normal[k] + surd(t) * network.tangential[k]
    return total


def assert_bounds(scene, mu, what, rough=()):
    found = force_bounds(scene, mu, what, rough)
    for bound, sign in ((found.least, -1), (found.largest, 1)):
        assert_admissible(scene, bound.network, mu, rough)
        if bound.value is None:
            assert_admissible(scene, bound.ray, mu, rough, loaded=False)
            assert sign * value(what, bound.ray, scene) > 0
        else:
            assert bound.ray is None
            assert value(what, bound.network, scene) == bound.value
    return found.least.value, found.largest.value


def centre(kind, layers):
    base = {"nt30": 3 * layers - 2, "tss": layers}[kind]
    return {((layers, base // 2 + 1), "floor"): 1}


@pytest.mark.parametrize(
    ("kind", "layers", "mu", "rough", "least", "largest"),
    [
        ("nt30", 4, 0, (), "1", "11/2"),
        ("nt30", 4, "1/10*sqrt(3)", (), "0", "31995041471/4077740898"),
        ("tss", 4, "1/10*sqrt(3)", ("floor",), "1990/1663", "1992752/467467"),
    ],
)
def test_the_interval_of_the_force_under_the_apex(kind, layers, mu, rough, least, largest):
    ends = assert_bounds(pile(kind, layers), mu, centre(kind, layers), rough)
    assert ends == (surd(least), surd(largest))
    assert centre("nt30", 4) == {((4, 6), "floor"): 1}
    assert centre("tss", 4) == {((4, 3), "floor"): 1}


def test_a_rational_friction_needs_a_field_of_roots():
    least, largest = assert_bounds(nt30(4), "3/10", centre("nt30", 4))
    assert least == 0
    assert not largest.is_rational
    assert round(float(largest), 12) == 8.482103899055


def test_one_disc_on_a_slope():
    # A disc between a slope of 30 degrees and a smooth wall: N = 2/sqrt(3), wall 1/sqrt(3) without
    # friction. With it on the slope alone torque forbids any tangential force.
    disc = Disc("disc", (0, 0), (0, -1), (None, None))
    slope = Contact("disc", "slope", ("-1/2", "1/2*sqrt(3)"))
    wall = Contact("disc", "wall", (1, 0))
    scene = Scene([disc], [slope, wall], supports=("slope", "wall"))
    for rough in ((), ("slope",)):
        ends = assert_bounds(scene, "1/3", {("disc", "wall"): 1}, rough)
        assert ends == (surd("sqrt(3)/3"), surd("sqrt(3)/3"))
    low, high = assert_bounds(scene, "1/3", {("disc", "wall"): 1}, ("slope", "wall"))
    assert low < surd("sqrt(3)/3") < high


def test_bounds_widen_with_friction_and_hold_the_elastic_solution():
    scene = nt30(4)
    elastic = solve(scene)
    k = elastic.contact_index((4, 6), "floor")
    ends = [
        force_bounds(scene, mu, centre("nt30", 4)) for mu in (0, "1/100", "1/10*sqrt(3)", "3/10")
    ]
    for one, two in pairwise(ends):
        assert two.least.value <= one.least.value
        assert one.largest.value < two.largest.value
    assert ends[0].least.value <= elastic.forces[k] <= ends[0].largest.value


def test_base_row_thrusts_of_nt30_have_no_largest_value():
    bounds = contact_bounds(nt30(3), "1/10*sqrt(3)")
    scene = bounds.scene
    free = {(c.a, c.b) for c, x in zip(scene.contacts, bounds.largest, strict=True) if x is None}
    assert free == {((3, j), (3, j + 1)) for j in range(1, 7)}
    assert bounds.exact_pivots >= 0
    low, high = assert_bounds(scene, "1/10*sqrt(3)", {((3, 3), (3, 4)): 1})
    assert low is not None
    assert high is None


@pytest.mark.parametrize("kind", ["nt30", "nt60", "tss", "tbs"])
def test_bounds_of_all_contacts_are_those_of_each(kind):
    scene = pile(kind, 3)
    mu = "1/4"
    bounds = contact_bounds(scene, mu)
    for k, contact in enumerate(scene.contacts):
        ends = assert_bounds(scene, mu, {(contact.a, contact.b): 1})
        assert ends == (bounds.least[k], bounds.largest[k])


def test_an_executor_and_progress():
    said = []
    serial = contact_bounds(nt60(4), "1/5", progress=lambda done, todo: said.append((done, todo)))
    assert said[-1][0] == said[-1][1]
    assert [done for done, _ in said] == sorted({done for done, _ in said})
    with ThreadPoolExecutor(2) as executor:
        shared = contact_bounds(nt60(4), "1/5", executor=executor)
    assert (shared.least, shared.largest) == (serial.least, serial.largest)
    problem = friction_problem(nt60(4), "1/5")
    again = pickle.loads(pickle.dumps(problem))
    assert list(again.constraints.b) == list(problem.constraints.b)


def test_a_pile_that_slides_says_along_which_motion():
    # Two free discs on a rough floor, a third on top: needs tan 15 degrees = 2 - sqrt(3).
    root = "sqrt(3)"
    discs = [
        Disc(1, (-1, 0), (0, -1), (None, None)),
        Disc(2, (1, 0), (0, -1), (None, None)),
        Disc(3, (0, root), (0, -1), (None, None)),
    ]
    contacts = [
        Contact(3, 1, ("1/2", "1/2*sqrt(3)")),
        Contact(3, 2, ("-1/2", "1/2*sqrt(3)")),
        Contact(2, 1, (1, 0)),
        Contact(1, "floor", (0, 1)),
        Contact(2, "floor", (0, 1)),
    ]
    scene = Scene(discs, contacts)
    assert_bounds(scene, "2 - sqrt(3)", {(1, 2): 1}, ("floor",))
    less = surd("2 - sqrt(3)") - Fraction(1, 10**30)
    with pytest.raises(InadmissibleError) as caught:
        force_bounds(scene, less, {(1, 2): 1}, ("floor",))
    motion = list(caught.value.motion)
    moves = {disc.id: motion[3 * k : 3 * k + 3] for k, disc in enumerate(discs)}
    assert sum((-moves[id][1] for id in moves), ZERO) > 0  # weights sink
    for contact in contacts:
        n, t = contact.normal, (-contact.normal[1], contact.normal[0])
        a, b = moves[contact.a], moves.get(contact.b, [ZERO] * 3)
        apart = sum((n[axis] * (a[axis] - b[axis]) for axis in (0, 1)), ZERO)
        along = sum((t[axis] * (a[axis] - b[axis]) for axis in (0, 1)), ZERO) + a[2] + b[2]
        assert apart >= less * abs(along)
    again = pickle.loads(pickle.dumps(caught.value))
    assert list(again.motion) == motion


def test_functionals():
    scene = nt30(4)
    dip = combined([(1, {((4, 6), "floor"): 1}), (-1, {((4, 5), "floor"): 1})])
    low, high = assert_bounds(scene, 0, dip)
    assert low == -high  # mirror images
    # Whatever the forces: the free discs stand on the floor and on the contacts of the held ones.
    whole = tbs(2)
    held = [disc.id for disc in whole.discs if disc.fixed]
    carried = combined([(1, force_on(whole, id, 1)) for id in held])
    assert assert_bounds(whole, "1/4", carried) == (surd(-3), surd(-3))
    # sigma_xy = sigma_yx where torques balance.
    difference = combined([(1, average_stress(whole, 0, 1)), (-1, average_stress(whole, 1, 0))])
    assert assert_bounds(whole, "1/4", difference) == (ZERO, ZERO)
    low, high = assert_bounds(whole, "1/4", average_stress(whole, 1, 1))
    assert low < high < 0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: force_bounds(nt30(2), "-1/2", {}), "mu"),
        (lambda: force_bounds(nt30(2), 0.5, {}), "floats_exactly"),
        (lambda: force_bounds(nt30(2), 0, {((1, 1), (9, 9)): 1}), "contact"),
        (lambda: force_bounds(nt30(2), 0, ((1, 1), (2, 2))), "mapping"),
        (lambda: force_bounds(nt30(2), 0, {}, "floor"), "rough"),
        (lambda: force_bounds(tbs(2), 0, {}, ("floor",)), "rough support"),
        (lambda: force_bounds(nt30(2, floor_compliance="-1/2"), 0, {}), "held closed"),
        (lambda: average_stress(tbs(1), 0, 2), "axes of a stress"),
    ],
)
def test_what_means_nothing_is_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_tilted_piles_on_a_rough_floor_stay_rational():
    problem = friction_problem(tss(4), "1/10*sqrt(3)", ("floor",))
    assert problem.constraints.scaled.group == (1,)
    assert friction_problem(nt30(4), "1/10*sqrt(3)").constraints.scaled.group == (1,)
    assert friction_problem(nt30(4), "1/10*sqrt(3)", ("floor",)).constraints.scaled.group == (1, 3)


@given(st.integers(0, 4), st.integers(0, 10**6), st.data())
@settings(max_examples=15, deadline=None)
def test_random_functionals(extra, seed, data):
    scene = pile(data.draw(st.sampled_from(["nt30", "nt60", "tss", "tbs"])), 3)
    ends = data.draw(st.lists(st.sampled_from([(c.a, c.b) for c in scene.contacts]), min_size=1))
    weight = st.tuples(st.integers(-3, 3), st.integers(-3, 3))
    mu = data.draw(st.sampled_from(["0", "1/10*sqrt(3)", "1/2*sqrt(3)", "3/10"]))
    rough = data.draw(st.sampled_from([(), ("floor",)])) if scene.supports else ()
    assert_bounds(scene, mu, {pair: data.draw(weight) for pair in ends}, rough)


@pytest.mark.parametrize("layers", [4, 5, 6, 7, pytest.param(8, marks=pytest.mark.slow)])
def test_the_parma_polyhedra_library_agrees(layers):
    ppl = pytest.importorskip("ppl")
    scene, mu, root = tss(layers), surd("1/10*sqrt(3)"), surd("sqrt(3)")
    # The equations once more, from the geometry: f_t mu-times the difference of two unknowns, rows
    # of x and of torques times sqrt(3), which makes all of them rational.
    rows = {(disc.id, axis): {} for disc in scene.discs if not disc.fixed for axis in range(3)}
    for k, contact in enumerate(scene.contacts):
        n, t = contact.normal, (-contact.normal[1], contact.normal[0])
        for j, side in ((2 * k, 1), (2 * k + 1, -1)):
            force = [n[axis] + side * mu * t[axis] for axis in (0, 1)]
            for disc, sign in ((contact.a, 1), (contact.b, -1)):
                if (disc, 0) in rows:
                    rows[disc, 0][j] = (sign * root * force[0]).rational()
                    rows[disc, 1][j] = (sign * force[1]).rational()
                    rows[disc, 2][j] = (side * root * mu).rational()
    x = [ppl.Variable(j) for j in range(2 * len(scene.contacts))]
    system = ppl.Constraint_System()
    for (_, axis), row in rows.items():
        common = lcm(*(value.denominator for value in row.values()))
        left = ppl.Linear_Expression(0)
        for j, value in row.items():
            left = left + int(value * common) * x[j]
        system.insert(left == (common if axis == 1 else 0))
    for variable in x:
        system.insert(variable >= 0)
    what = centre("tss", layers)
    k = next(k for k, c in enumerate(scene.contacts) if (c.a, c.b) in what)
    found = force_bounds(scene, mu, what, ("floor",))
    for mode, bound in (("minimization", found.least), ("maximization", found.largest)):
        programme = ppl.MIP_Problem(len(x), system, x[2 * k] + x[2 * k + 1])
        programme.set_optimization_mode(mode)
        optimum = programme.optimal_value()
        assert bound.value == Fraction(int(optimum.numerator), int(optimum.denominator))


def test_the_dip_is_not_determined_by_balance_even_without_friction():
    # NT30 6: the force under the apex less that two discs to the left, (6,8) and (6,6). Elasticity
    # chooses one value, and friction opens the interval further.
    scene = nt30(6)
    dip = combined([(1, {((6, 8), "floor"): 1}), (-1, {((6, 6), "floor"): 1})])
    assert assert_bounds(scene, 0, dip) == (surd("-19/2"), surd("23/2"))
    elastic = solve(scene)
    chosen = elastic.force((6, 8), "floor") - elastic.force((6, 6), "floor")
    assert -9.5 < float(chosen) < 11.5
    low, high = assert_bounds(scene, "1/10*sqrt(3)", dip)
    assert low < surd("-19/2")
    assert high > surd("23/2")


@pytest.mark.parametrize("mu", ["0", "1/10*sqrt(3)", "1/2*sqrt(3)", "3/10"])
def test_bounds_of_small_piles_are_all_proved(mu):
    # Proof or error is what `contact_bounds` does; the benchmark goes to larger piles.
    for kind in ("tbs", "tss", "nt60", "nt30"):
        bounds = contact_bounds(pile(kind, 2), mu)
        for low, high in zip(bounds.least, bounds.largest, strict=True):
            assert low >= 0
            assert high is None or low <= high
