"""Given forces against ours: what is found and concluded, and that their form does not matter."""

from dataclasses import replace
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    Scene,
    check,
    deform,
    first_order,
    nt30,
    nt60,
    solve,
    tbs,
    tss,
)
from lcp_piles.checking.conclusions import conclusions
from lcp_piles.checking.given import GivenForce

PILE = solve(nt30(4, push="1/2"))
POSITIONS = {d.id: [float(x) for x in d.position] for d in PILE.scene.discs}
FREE = (None, None)
# A ball in a groove of two rigid walls that stands on a rigid floor too: one force too many.
GROOVE = solve(
    Scene(
        [Disc("ball", (0, 0), (0, -1), FREE)],
        [
            Contact("ball", "left", ("3/5", "4/5"), 0),
            Contact("ball", "right", ("-3/5", "4/5"), 0),
            Contact("ball", "floor", (0, 1), 0),
        ],
        supports=("left", "right", "floor"),
    )
)


def pairs(solution, forces) -> dict:
    ends = ((c.a, c.b) for c in solution.scene.contacts)
    return dict(zip(ends, forces, strict=True))


def noisy(seed: int, size: float) -> np.ndarray:
    forces = PILE.force_array
    return forces + size * np.random.default_rng(seed).normal(size=len(forces)) * (forces > 0)


def place_of(contact, which: str) -> list[float]:
    a = np.array(POSITIONS[contact.a])
    normal = np.array([float(n) for n in contact.normal])
    return (a - normal if which == "point" else a - 2 * normal).tolist()


@st.composite
def forms(draw, forces) -> tuple[list[GivenForce], dict]:
    """The same forces in another form: order, ends turned round, sign, units, names or places."""
    radius, weight = (draw(st.sampled_from([1.0, 9.81e-3, 0.25, 1e6])) for _ in range(2))
    sign = draw(st.sampled_from([1, -1]))
    random = Random(draw(st.integers(0, 2**32)))
    as_vector = draw(st.booleans())
    entries = []
    for contact, force in zip(PILE.scene.contacts, forces.tolist(), strict=True):
        turned = random.random() < 0.5
        normal = [float(n) for n in contact.normal]
        on_first = [(-1 if turned else 1) * sign * force * weight * n for n in normal]
        value = {"vector": (*on_first, 0.0)} if as_vector else {"force": sign * force * weight}
        how = random.choice(["names", "centres"] if as_vector else ["names", "centres", "point"])
        if how == "point":
            point = tuple(radius * x for x in place_of(contact, "point"))
            entries.append(GivenForce(**value, point=point))
            continue
        if how == "names" or isinstance(contact.b, str):
            ends = {"a": contact.a, "b": contact.b}
            if turned:
                ends = {"a": contact.b, "b": contact.a}
        else:
            a = tuple(radius * x for x in POSITIONS[contact.a])
            b = tuple(radius * x for x in place_of(contact, "centre"))
            ends = {"at_a": b, "at_b": a} if turned else {"at_a": a, "at_b": b}
        entries.append(GivenForce(**value, **ends))
    random.shuffle(entries)
    return entries, {"radius": radius, "weight": weight}


@settings(max_examples=40, deadline=None)
@given(data=st.data(), seed=st.integers(0, 9), size=st.sampled_from([0.0, 1e-4, 0.05]))
def test_form_order_sign_and_units_leave_the_check_alone(data, seed, size) -> None:
    forces = noisy(seed, size)
    plain = check(PILE, forces)
    entries, units = data.draw(forms(forces))
    other = check(PILE, entries, **units)
    assert other.verdict == plain.verdict
    assert np.allclose(other.given, plain.given, rtol=1e-12, atol=1e-15)
    assert list(other.wrong) == list(plain.wrong)
    assert other.largest == pytest.approx(plain.largest, rel=1e-9, abs=1e-14)
    assert other.largest_residual == pytest.approx(plain.largest_residual, rel=1e-9, abs=1e-13)
    if other.own_residual is not None:
        assert np.allclose(other.own_residual, plain.residual, atol=1e-12)
        assert other.tangential < 1e-14


def test_norms_worst_and_residual_by_hand() -> None:
    """Two stones carry the apex of NT60 with 1/sqrt(3) each; one force is 0.1 too large."""
    third = 3**-0.5
    found = check(nt60(2), {((1, 1), (2, 1)): third + 0.1, ((2, 2), (1, 1)): third})
    assert found.verdict == "differ"
    assert found.largest == pytest.approx(0.1)
    assert found.relative == pytest.approx(0.1 / (2 * third**2) ** 0.5)
    assert found.reference.name(found.worst[0]) == "(1,1)-(2,1)"
    assert found.largest_residual == pytest.approx(0.1)  # along the one normal
    assert found.residual[0] == pytest.approx([0.05, 0.1 * 3**0.5 / 2])
    assert "they do not balance the loads: 0.1 w is left on (1,1)" in conclusions(found)[1]


def test_contacts_named_wrongly() -> None:
    """A force on an open contact, and none on a closed one; osculatory ones are free."""
    forces = PILE.force_array.copy()
    opened = PILE.states.index("open")
    closed = int(np.argmax(forces))
    forces[opened], forces[closed] = 0.2, 0.0
    found = check(PILE, forces)
    assert sorted(found.wrong) == sorted([opened, closed])
    assert list(check(PILE, PILE.force_array + 1e-9).wrong) == []  # noise below the tolerance
    touching = solve(tss(4))
    free = [k for k, state in enumerate(touching.states) if state != "closed"]
    assert not all(touching.gap_unique[k] and touching.states[k] == "open" for k in free)
    loaded = touching.force_array.copy()
    loaded[free] = 0.1
    named = check(touching, loaded)
    sure = [k for k in free if touching.states[k] == "open" and touching.gap_unique[k]]
    assert list(named.wrong) == sure


def test_a_contact_that_is_none_makes_them_of_another_scene() -> None:
    forces = pairs(PILE, PILE.force_array)
    found = check(PILE, forces | {((1, 1), (4, 4)): 0.5})
    assert found.others == (("(1,1)-(4,4)", 0.5),)
    assert found.verdict == "differ"
    assert "of another scene" in conclusions(found)[-1]
    assert check(PILE, forces | {((1, 1), (4, 4)): 1e-9}).verdict == "agree"
    assert check(PILE, forces | {((4, 1), (4, 10)): 5.0}).verdict == "agree"  # two held stones


def test_rigid_contacts_that_share_the_load_have_other_solutions() -> None:
    """A weight of 1 on two walls at 4/5 and a floor: 8/5 f + g = 1 with f, g >= 0."""
    assert GROOVE.forces_unique is False
    for f in (0.0, 0.2, 0.625):
        found = check(GROOVE, [f, f, 1 - 1.6 * f])
        assert found.agrees
        assert found.verdict == "another solution" or found.largest <= found.allowed
    off = check(GROOVE, [0.2, 0.2, 0.7])
    assert off.verdict == "differ"
    assert any("one of several solutions" in text for text in conclusions(off))
    pulling = check(GROOVE, [1.0, 1.0, -0.6])
    assert pulling.verdict == "differ"  # it balances, but pulls at the floor


def test_an_elastic_contact_has_one_force_where_rigid_ones_share() -> None:
    """The floor of the groove made soft: its force is proved to be unique, so 0.5 is wrong."""
    contacts = list(GROOVE.scene.contacts)
    contacts[2] = replace(contacts[2], compliance=1)
    soft = solve(replace(GROOVE.scene, contacts=contacts))
    force = float(soft.forces[2])
    assert force == 0  # rigid walls leave it nothing
    assert check(soft, [0.3125, 0.3125, 0.5]).verdict == "differ"


def test_a_saddle_and_gaps_that_are_not_unique_are_said() -> None:
    saddle = solve(tss(4))
    assert saddle.stability.verdict == "saddle"
    text = " ".join(conclusions(check(saddle, saddle.force_array * 1.1)))
    assert "is a saddle: a real pile slides off it" in text
    assert f"{saddle.gap_unique.count(False)} gaps are not unique" in text
    stable = " ".join(conclusions(check(PILE, PILE.force_array * 1.1)))
    assert "saddle" not in stable
    assert "not unique" not in stable


def test_a_wrong_unit_is_seen() -> None:
    found = check(PILE, 9.81 * PILE.force_array)
    assert found.scale == pytest.approx(9.81)
    assert any("they are all 9.81 times ours" in text for text in conclusions(found))
    assert not any("times ours" in text for text in conclusions(check(PILE, noisy(1, 0.05))))


def test_what_cannot_stand_is_not_balanced_by_any_forces() -> None:
    """The bound of the residual from the collapse holds for whatever forces that only push."""
    scene = nt60(3).without([(3, 1)])
    rng = np.random.default_rng(5)
    for _ in range(20):
        found = check(scene, rng.exponential(size=len(scene.contacts)))
        assert found.verdict == "nothing to compare"
        (text,) = conclusions(found)
        assert "no forces balance the loads of this scene, which is proved" in text
        assert found.largest_residual >= float(text.split("contacts, ")[1].split(" w")[0])


def test_finite_stiffness_is_taken_out() -> None:
    """The nonlinear equilibrium in floats, by `deform`: off by tau from ours, by tau^2 after."""
    rest, off = [], []
    for tau in ("0.001", "0.0005"):
        pile = deform(first_order(PILE), float(tau))
        assert pile.converged
        found = check(PILE, pile.forces, tau=tau, tolerance=1e-4)
        assert found.verdict == "agree"
        assert check(PILE, pile.forces, tolerance=1e-4).verdict == "differ"
        rest.append(found.largest)
        off.append(found.off_rigid)
    assert off[0] / off[1] == pytest.approx(2, abs=0.1)
    assert rest[0] / rest[1] == pytest.approx(4, abs=0.4)
    assert rest[0] < off[0] / 50


def test_stiffness_that_cannot_be_taken_out_is_said() -> None:
    slides = check(tss(4), solve(tss(4)).force_array, tau="1/1000")
    assert any("no equilibrium of slightly deformable discs" in t for t in conclusions(slides))
    soft = check(PILE, PILE.force_array, tau=10)
    assert any("the network changes at tau = " in text for text in conclusions(soft))


def test_floating_point_solutions_prove_nothing() -> None:
    found = check(solve(nt60(3), "newton"), solve(nt60(3)).force_array)
    assert found.verdict == "agree"
    assert "proves nothing" in conclusions(found)[1]


def test_a_support_without_any_force_is_left_out_and_named() -> None:
    """What a dump of pairs looks like: no floor in it."""
    forces = {ends: f for ends, f in pairs(PILE, PILE.force_array).items() if ends[1] != "floor"}
    found = check(PILE, forces)
    assert found.verdict == "agree"
    assert found.largest_residual < 1e-12
    floor = sum(contact.b == "floor" for contact in PILE.scene.contacts)
    assert f"no forces at floor: the {floor} contacts there are left out" in conclusions(found)[1]
    assert check(PILE, forces | {((4, 4), "floor"): 1.0}).verdict == "differ"


def test_supports_are_numbered_from_minus_one_down() -> None:
    forces = [(c.a, -1 if c.b == "floor" else c.b) for c in PILE.scene.contacts]
    assert check(PILE, dict(zip(forces, PILE.force_array, strict=True))).largest == 0


@pytest.mark.parametrize(
    ("forces", "said"),
    [
        ({((1, 1), (9, 9)): 1}, r"the force of \(1,1\)-\(9,9\) is '\(9,9\)', expected a disc"),
        ({((1, 1), (2, 1)): float("nan")}, "expected a finite number"),
        ({((1, 1), (2, 1)): "much"}, "expected a number or a vector"),
        ({"apex": 1}, "the key of a force is 'apex'"),
        ([1, 2], "the number of forces is 2, expected"),
        ([GivenForce(1.0, at_a=(50.0, 0), at_b=(0, 0))], "radii from the nearest disc"),
        ([GivenForce(1.0, point=(50.0, 0))], "radii from the nearest contact"),
        ([GivenForce(1.0, point=(0.0,))], "expected 2 coordinates"),
        (
            [
                GivenForce(1.0, a=(1, 1), b=(2, 2)),
                GivenForce(2.0, a=(2, 2), b=(1, 1), where="row 2"),
            ],
            r"row 2 is '2 on \(1,1\)-\(2,2\)', expected the same force",
        ),
    ],
)
def test_bad_forces_are_named(forces, said) -> None:
    with pytest.raises(InputError, match=said):
        check(PILE, forces)


def test_a_pair_that_stands_twice_alike_counts_once() -> None:
    twice = [GivenForce(f, a=a, b=b) for (a, b), f in pairs(PILE, PILE.force_array).items()]
    twice += [replace(force, a=force.b, b=force.a) for force in twice]
    assert check(PILE, twice).largest == 0


@pytest.mark.parametrize("bad", [{"radius": 0}, {"weight": -1}, {"tolerance": -1e-9}])
def test_bad_units_are_named(bad) -> None:
    with pytest.raises(InputError, match=f"the {next(iter(bad))} is "):
        check(PILE, PILE.force_array, **bad)


@pytest.mark.parametrize("arguments", [{}, {"force": 1.0, "a": 1}, {"force": 1.0, "at_a": (0, 0)}])
def test_an_entry_has_a_force_and_ends(arguments) -> None:
    with pytest.raises(InputError, match="an entry of the forces is 'without"):
        GivenForce(**arguments)


def test_two_discs_that_read_alike_cannot_be_told_by_name() -> None:
    discs = [Disc(1, (0, 0), (0, -1), FREE), Disc("1", (0, 2), (0, -1), FREE)]
    scene = Scene(discs, [Contact("1", 1, (0, 1)), Contact(1, "floor", (0, 1))])
    with pytest.raises(InputError, match="a name that only one disc has"):
        check(scene, {(1, "floor"): 2})
    assert check(
        scene, [GivenForce(1, at_a=(0, 0), at_b=(0, 2)), GivenForce(2, point=(0, -1))]
    ).agrees


def test_places_mean_nothing_without_geometry() -> None:
    scene = replace(tbs(2), geometric=False)
    with pytest.raises(InputError, match="the scene has no places"):
        check(scene, [GivenForce(1.0, point=(0.0, 0.0))])


def test_three_axes() -> None:
    scene = Scene(
        [Disc("ball", (0, 0, 0), (0, 0, -1), (None, None, None))],
        [Contact("ball", "floor", (0, 0, 1)), Contact("ball", "wall", (1, 0, 0))],
        supports=("floor", "wall"),
    )
    entries = [GivenForce(None, (0.0, 0.0, 2.0), a="ball", b="floor")]
    found = check(scene, entries, weight=2.0)
    assert found.verdict == "agree"
    assert found.own_residual.tolist() == [[0, 0, 0]]
