"""What holds of every pile: random kinds, sizes, pushes, floors and initial gaps."""

from dataclasses import replace

import pytest
from helpers import equilibrium_faults, image_contacts, piles, rough_piles, solved_from
from hypothesis import given, settings
from hypothesis import strategies as st

from lcp_piles import Scene, nt60, solve, surd, verify
from lcp_piles.numbers.vectors import exact_vector

METHODS = pytest.mark.parametrize("method", ["proved", "lemke"])


def values(vector):
    return list(vector)


@METHODS
@settings(max_examples=30)
@given(scene=st.one_of(piles(), rough_piles()))
def test_exact_equilibrium_signs_and_complementarity(method, scene):
    solution = solve(scene, method)
    assert solution.status == "solved"
    assert solution.exact
    assert equilibrium_faults(scene, solution) == []
    assert verify(scene, solution).ok
    assert solution.forces_unique is True


@given(st.one_of(piles(), rough_piles()))
def test_both_methods_find_the_same(scene):
    one, other = solve(scene, "proved"), solve(scene, "lemke")
    assert values(one.forces) == values(other.forces)
    assert one.states == other.states
    assert one.gap_unique == other.gap_unique
    assert one.stability == other.stability
    for k, unique in enumerate(one.gap_unique):
        assert not unique or one.gaps[k] == other.gaps[k]


@settings(max_examples=25)
@given(st.one_of(piles(), rough_piles()), st.randoms(use_true_random=False))
def test_any_proposal_of_floating_point_ends_in_the_same_solution(scene, random):
    exact, other = solve(scene, "lemke"), solved_from(scene, random)
    assert values(exact.forces) == values(other.forces)
    assert exact.states == other.states
    assert exact.stability == other.stability


@METHODS
@settings(max_examples=15)
@given(scene=st.one_of(piles(), rough_piles(symmetric=True)))
def test_the_half_is_the_whole_and_the_whole_is_symmetric(method, scene):
    half, whole = solve(scene, method), solve(scene, method, whole=True)
    assert half.record.part == "even"
    assert whole.record.part == "whole"
    assert values(half.forces) == values(whole.forces)
    assert half.states == whole.states
    assert half.stability == whole.stability
    assert half.gap_unique == whole.gap_unique
    for solution in (half, whole):
        images = image_contacts(scene)
        assert [solution.forces[k] for k in images] == values(solution.forces)
        assert [solution.states[k] for k in images] == list(solution.states)


def scaled(scene, s):
    """Loads, initial gaps and prescribed motions all times s."""
    discs = tuple(
        replace(
            disc,
            load=tuple(s * p for p in disc.load),
            held=tuple(None if h is None else s * h for h in disc.held),
        )
        for disc in scene.discs
    )
    contacts = tuple(replace(contact, gap=s * contact.gap) for contact in scene.contacts)
    return Scene(discs, contacts)


@settings(max_examples=20)
@given(
    st.one_of(piles(), rough_piles()),
    st.sampled_from([surd("1/1000"), surd("22/7"), surd("sqrt(3)"), surd("1 + sqrt(3)")]),
)
def test_scaling_the_weight_scales_all(scene, s):
    small, large = solve(scene), solve(scaled(scene, s))
    assert [s * f for f in small.forces] == values(large.forces)
    assert small.states == large.states
    assert small.stability == large.stability
    for k, unique in enumerate(small.gap_unique):
        assert not unique or s * small.gaps[k] == large.gaps[k]


@settings(max_examples=20)
@given(st.one_of(piles(), rough_piles()), st.randoms(use_true_random=False))
def test_names_and_order_mean_nothing(scene, random):
    """Discs and contacts shuffled, discs renamed, and some contacts told from their other end."""
    names = [(k,) for k in range(len(scene.discs))]
    random.shuffle(names)
    name = {disc.id: new for disc, new in zip(scene.discs, names, strict=True)}
    discs = [replace(disc, id=name[disc.id]) for disc in scene.discs]
    random.shuffle(discs)
    order = list(range(len(scene.contacts)))
    random.shuffle(order)
    contacts = []
    for k in order:
        old = scene.contacts[k]
        if isinstance(old.b, str):
            contacts.append(replace(old, a=name[old.a]))
        elif random.random() < 0.5:
            contacts.append(replace(old, a=name[old.a], b=name[old.b]))
        else:
            normal = tuple(-x for x in old.normal)
            contacts.append(replace(old, a=name[old.b], b=name[old.a], normal=normal))
    one, other = solve(scene), solve(Scene(tuple(discs), tuple(contacts)))
    assert [one.forces[k] for k in order] == values(other.forces)
    assert [one.states[k] for k in order] == list(other.states)
    assert [one.gap_unique[k] for k in order] == list(other.gap_unique)
    assert one.stability == other.stability


# --- the check itself: verify() refuses whatever is tampered with ---


def changed(vector, k, amount):
    entries = list(vector)
    entries[k] += amount
    return exact_vector(entries)


@settings(max_examples=20)
@given(st.one_of(piles(), rough_piles()), st.data())
def test_verify_refuses_tampered_solutions(scene, data):
    good = solve(scene)
    amount = data.draw(st.sampled_from([surd("1/1000000"), surd(-1), surd("sqrt(3) - 2")]))
    k = data.draw(st.integers(0, len(scene.contacts) - 1))
    # A displacement that no contact feels would not be found out, and need not be.
    felt = {end for contact in scene.contacts for end in (contact.a, contact.b)}
    discs = [k for k, disc in enumerate(scene.discs) if disc.id in felt]
    axis = 2 * data.draw(st.sampled_from(discs)) + data.draw(st.sampled_from([0, 1]))
    other = {"closed": "open", "open": "osculatory", "osculatory": "closed"}
    states = list(good.states)
    states[k] = other[states[k]]
    assert verify(scene, good).ok
    for bad in (
        replace(good, forces=changed(good.forces, k, amount)),
        replace(good, gaps=changed(good.gaps, k, amount)),
        replace(good, displacements=changed(good.displacements, axis, amount)),
        replace(good, states=tuple(states)),
    ):
        check = verify(scene, bad)
        assert check.exact
        assert not check.ok
        assert check.faults


def test_verify_names_what_is_wrong():
    scene = nt60(2)
    good = solve(scene)

    def faults(**changes):
        return " ".join(verify(scene, replace(good, **changes)).faults)

    assert "disc (1, 1): axis 1 is not balanced" in faults(forces=changed(good.forces, 0, surd(1)))
    assert "Hooke's law fails" in faults(gaps=changed(good.gaps, 0, surd(1)))
    assert "neither force nor gap is zero" in faults(gaps=changed(good.gaps, 0, surd(1)))
    assert "the force is negative" in faults(forces=changed(good.forces, 0, surd(-9)))
    assert "the gap is negative" in faults(gaps=changed(good.gaps, 0, surd(-9)))
    assert "is not where it is held" in faults(
        displacements=changed(good.displacements, 2, surd(1))
    )
    assert "called open, but it is closed" in faults(states=("open",) * len(good.states))


def test_verify_refuses_the_solution_of_another_scene():
    with_push = nt60(3, push="1/1000000")
    assert not verify(with_push, solve(nt60(3))).ok
    assert not verify(nt60(3, floor_compliance=0), solve(nt60(3))).ok
