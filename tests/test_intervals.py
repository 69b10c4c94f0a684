"""The proof without digits: bounds hold the exact values, and what is not proved is named."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from lcp_piles import (
    Contact,
    Disc,
    Scene,
    SolveError,
    nt30,
    nt60,
    pile,
    prove_contacts,
    solve,
    tbs,
    tss,
)
from lcp_piles.methods import bounds as intervals
from lcp_piles.methods.regular_set import Guess

SCENES = {
    "nt30": nt30(6),
    "nt30 pushed": nt30(6, push=20),
    "nt30 far pushed, with mechanisms": nt30(6, push="200"),
    "nt30 with a mechanism": nt30(8),
    "nt60": nt60(8),
    "tss, mechanisms": tss(13),
    "tbs": tbs(12),
    "soft floor": pile("nt30", 5, floor_compliance="7/3"),
}


def _holds(exact, bounded) -> bool:
    """Whether every exact entry is within its bounds, compared exactly."""
    return all(
        abs(x - Fraction(m)) <= Fraction(r)
        for x, m, r in zip(exact, bounded.middle.tolist(), bounded.radius.tolist(), strict=True)
    )


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_bounds_hold_the_exact_forces_and_the_set_is_the_exact_one(scene) -> None:
    proof, exact = prove_contacts(scene), solve(scene)
    assert proof.proved
    assert proof.loaded.tolist() == [state == "closed" for state in exact.states]
    assert _holds(exact.forces, proof.forces)
    assert proof.forces.radius.max() < 1e-11
    for k in np.flatnonzero(exact.gap_unique).tolist():
        error = abs(exact.gaps[k] - Fraction(float(proof.gaps.middle[k])))
        assert error <= Fraction(float(proof.gaps.radius[k]))


def test_exact_ties_are_named_and_not_claimed() -> None:
    """NT60 of three layers has two osculatory contacts (exact solution, horizontal base row)."""
    scene = nt60(3)
    proof, exact = prove_contacts(scene), solve(scene)
    assert not proof.proved
    assert [exact.states[k] for k in proof.unproved] == ["osculatory", "osculatory"]
    assert exact.count("osculatory") == 2


@pytest.mark.parametrize("seed", range(6))
def test_a_wrong_guess_is_never_proved(seed: int, monkeypatch) -> None:
    """Contacts flipped at random: either bounds hold for the true set, or nothing is claimed."""
    scene = nt30(5)
    true = solve(scene)
    rng = np.random.default_rng(seed)
    honest = intervals.float_guess

    def corrupted(system):
        guess = honest(system)
        flip = rng.random(len(guess.closed)) < 0.1
        flip[0] = True
        return Guess(guess.closed ^ flip, guess.distance)

    monkeypatch.setattr(intervals, "float_guess", corrupted)
    try:
        proof = prove_contacts(scene)
    except SolveError:
        return
    assert not proof.proved or proof.loaded.tolist() == [s == "closed" for s in true.states]
    assert not proof.proved


def test_rigid_and_negative_floors_are_refused_with_the_remedy() -> None:
    for compliance in (0, "-1/2"):
        with pytest.raises(SolveError, match="elastic"):
            prove_contacts(nt30(4, floor_compliance=compliance))


def _rational_packing(size):
    """Three discs in grooves; one side of each has a normal with a denominator of about `size`."""
    k = int(size**0.5)
    a, b, c = 2 * k * (k - 1), 2 * k - 1, 2 * k * k - 2 * k + 1  # a^2 + b^2 = c^2
    low, high = (Fraction(b, c), Fraction(a, c)), (Fraction(-3, 5), Fraction(4, 5))
    discs = [Disc(i, (4 * i, 0), (0, -1), (None, None)) for i in range(3)]
    contacts = [
        Contact(i, f"{side} {i}", n) for i in range(3) for side, n in (("l", low), ("r", high))
    ]
    names = tuple(c.b for c in contacts)
    return Scene(tuple(discs), tuple(contacts), names)


@pytest.mark.parametrize("size", [10**6, 10**8])
def test_normals_of_long_denominators_are_proved_too(size: int) -> None:
    """Rows of the integer matrix are as long as the denominators; those of floats are not."""
    scene = _rational_packing(size)
    proof, exact = prove_contacts(scene), solve(scene)
    assert proof.proved
    assert proof.loaded.all()
    assert _holds(exact.forces, proof.forces)
    assert proof.forces.radius.max() < 1e-12


def test_a_proof_is_shown_in_one_line() -> None:
    """113 of the 129 contacts of the paper's pile carry a force."""
    assert repr(prove_contacts(nt30(6))) == "<ContactProof proved, 113 of 129 loaded>"
    tied = prove_contacts(nt60(3))
    assert repr(tied).startswith(f"<ContactProof {len(tied.unproved)} contacts not proved, ")


@pytest.mark.parametrize(
    "scene", [nt30(2, push=10**400), pile("nt30", 2, floor_compliance=10**400)]
)
def test_numbers_beyond_the_range_of_floats_have_no_bounds(scene) -> None:
    with pytest.raises(SolveError, match="beyond the range of floating point: use solve"):
        prove_contacts(scene)


def test_springs_without_a_proved_bound_bound_nothing(monkeypatch) -> None:
    real = intervals.springs
    monkeypatch.setattr(intervals, "springs", lambda B, C: replace(real(B, C), least=0.0))
    with pytest.raises(SolveError, match="too weakly for bounds: use solve"):
        prove_contacts(nt30(3))
