"""The default method: whatever floating point proposes, the exact answer comes out."""

from dataclasses import replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest
from flint import fmpz
from random_scenes import NORMALS, ROOT, SUPPORTS, custom

from lcp_piles import (
    Contact,
    Disc,
    Scene,
    nt30,
    nt60,
    pile,
    prove_contacts,
    solve,
    tbs,
    tss,
    verify,
)
from lcp_piles.linear.integer_product import times
from lcp_piles.mechanics.contact_lcp import contact_lcp
from lcp_piles.mechanics.motions import Motions
from lcp_piles.mechanics.system import contact_system
from lcp_piles.methods import proved
from lcp_piles.methods.regular_set import Guess, _along, regular_set
from lcp_piles.numbers.vectors import ExactVector

SCENES = {
    "tbs 8": tbs(8),
    "tss 7": tss(7),
    "tss 12": tss(12),
    "nt30 7": nt30(7),
    "nt30 5 pushed": nt30(5, push=20),
    "nt30 6 far pushed": nt30(6, push="200"),
    "nt30 4 pulled": nt30(4, push="-7/3"),
    "nt60 3, osculatory": nt60(3),
    "nt60 9": nt60(9),
    "rigid floor": pile("nt30", 5, floor_compliance=0),
    "the paper's floor": pile("nt30", 6, floor_compliance="-1/2"),
    "resting stones": pile("tss", 6, corner_stones="resting"),
}


def _same(one, other) -> None:
    assert one.status == other.status
    assert list(one.forces) == list(other.forces)
    assert one.states == other.states
    assert one.gap_unique == other.gap_unique
    assert one.stability == other.stability


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_the_default_equals_cold_lemke(scene) -> None:
    _same(solve(scene), solve(scene, "lemke"))


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_the_guess_is_usually_right_and_says_how_it_was_proved(scene) -> None:
    record = solve(scene).record
    assert record.guess_errors is not None
    assert "floating point proposed" in record.proof


def _flipped(part: float, seed: int):
    def corrupt(guess: Guess) -> Guess:
        rng = np.random.default_rng(seed)
        flip = rng.random(len(guess.closed)) < part
        return Guess(guess.closed ^ flip, rng.random(len(guess.closed)))

    return corrupt


CORRUPTIONS = {
    "a tenth flipped": _flipped(0.1, 1),
    "half flipped": _flipped(0.5, 2),
    "all closed": lambda guess: Guess(np.ones_like(guess.closed), guess.distance),
    "all open": lambda guess: Guess(np.zeros_like(guess.closed), guess.distance),
    "the opposite": lambda guess: Guess(~guess.closed, -guess.distance),
    "distances that are NaN": lambda guess: Guess(
        np.zeros_like(guess.closed), np.full(len(guess.closed), np.nan)
    ),
}


@pytest.mark.parametrize("corrupt", CORRUPTIONS.values(), ids=CORRUPTIONS.keys())
@pytest.mark.parametrize(
    "name", ["tbs 8", "tss 7", "nt30 5 pushed", "nt60 3, osculatory", "rigid floor"]
)
def test_a_corrupted_guess_still_ends_in_the_exact_answer(name, corrupt, monkeypatch) -> None:
    scene = SCENES[name]
    expected = solve(scene, "lemke")
    honest = proved.float_guess(contact_system(scene))
    monkeypatch.setattr(proved, "float_guess", lambda system: corrupt(honest))
    got = solve(scene)
    _same(got, expected)


def test_newton_that_returns_nan_is_not_believed(monkeypatch) -> None:
    scene = nt30(5)
    expected = solve(scene, "lemke")
    real = proved.newton

    def broken(system):
        result = real(system)
        result.forces[:] = np.nan
        result.gaps[:] = np.nan
        return result

    monkeypatch.setattr(proved, "full_steps", lambda system: None)
    monkeypatch.setattr(proved, "newton", broken)
    _same(solve(scene), expected)


@pytest.mark.parametrize(("residual", "kept"), [(8e-13, True), (1e-7, True), (0.04, False)])
def test_a_guess_just_short_of_convergence_is_kept_and_a_runaway_is_not(
    residual, kept, monkeypatch
) -> None:
    system = contact_system(nt30(5))
    result = proved.newton(system)
    short = replace(result, converged=False, residual=residual)
    monkeypatch.setattr(proved, "full_steps", lambda system: None)
    monkeypatch.setattr(proved, "newton", lambda system: short)
    guess = proved.float_guess(system)
    assert np.array_equal(guess.closed, result.forces > 0) == kept
    assert guess.closed.all() == (not kept)


def test_a_singular_float_system_is_no_crash() -> None:
    """With this floor the bilateral system of four layers cancels to a singular one."""
    solution = solve(nt30(4, floor_compliance=-1))
    assert solution.status in ("solved", "unresolved")


def test_repair_pivots_are_few_for_a_nearly_right_guess(monkeypatch) -> None:
    scene = tbs(12)
    honest = proved.float_guess(contact_system(scene))
    wrong = honest.closed.copy()
    wrong[np.flatnonzero(~wrong)[0]] = True
    guess = Guess(wrong, honest.distance)
    monkeypatch.setattr(proved, "float_guess", lambda system: guess)
    record = solve(scene).record
    assert record.guess_errors == 1
    assert 1 <= record.pivots <= 4
    assert record.pivots < solve(scene, "lemke").record.pivots


def test_compliances_without_a_common_multiple_are_solved_too() -> None:
    """Random rationals: no integer stiffness fits 62 bits, so every force is its own unknown."""
    rng = np.random.default_rng(5)
    whole = nt30(4)
    numbers = rng.integers(10**6, 2 * 10**6, size=len(whole.contacts)).tolist()
    contacts = tuple(
        replace(c, compliance=Fraction(x, 10**6))
        for c, x in zip(whole.contacts, numbers, strict=True)
    )
    scene = replace(whole, contacts=contacts)
    assert contact_system(scene).stiffness is None
    solution = solve(scene)
    _same(solution, solve(scene, "lemke"))
    assert np.abs(solution.force_array - solve(scene, "newton").force_array).max() < 1e-11


@pytest.mark.parametrize("power", [6, 9, 12])
def test_stiffness_ratios_to_a_million_millions(power: int) -> None:
    whole = nt30(3)
    contacts = tuple(
        replace(c, compliance=Fraction(10) ** (power if k % 2 else -power))
        for k, c in enumerate(whole.contacts)
    )
    scene = replace(whole, contacts=contacts)
    _same(solve(scene), solve(scene, "lemke"))


def loose(width: int, height: int, seed: int, loads: int = 0) -> Scene:
    """A lattice between walls whose contacts all have gaps; the lowest rows are pulled down."""
    random = Random(seed)
    places = [(2 * i + row % 2, row) for row in range(height) for i in range(width)]
    ends = {0: "left wall", 2 * width - 1: "right wall"}
    contacts = []
    for a in places:
        for (right, up), normal in NORMALS.items():
            b = (a[0] + right, a[1] + up)
            if b in places:
                contacts.append(Contact(a, b, normal, gap=Fraction(random.randint(0, 100), 7)))
        walls = [name for x, name in ends.items() if x == a[0]] + ["floor"] * (a[1] == 0)
        contacts += [Contact(a, name, SUPPORTS[name], gap=1) for name in walls]
    discs = [
        Disc(p, (p[0], ROOT * p[1]), (0, -1 if p[1] < loads else 0), (None, None)) for p in places
    ]
    return custom(discs, contacts)


@pytest.mark.parametrize("loads", [0, 4])
def test_discs_that_nothing_holds_are_left_where_floating_point_has_them(loads) -> None:
    """No pivots, and none are needed: every gap is one of many."""
    scene = loose(9, 8, seed=1, loads=loads)
    solution = solve(scene)
    assert solution.status == "solved"
    assert solution.record.pivots == 0
    assert solution.stability.mechanisms >= 2 * 9 * (8 - loads)
    assert verify(scene, solution).ok
    assert prove_contacts(scene).proved == ("osculatory" not in solution.states)


@pytest.mark.parametrize("seed", range(4))
def test_mechanisms_with_gaps_need_no_pivots(seed) -> None:
    """Initial gaps of up to 100 w tau tear the pile into parts that float between each other."""
    random = Random(seed)
    whole = tbs(10)
    contacts = [replace(c, gap=Fraction(random.randint(-1000, 1000), 10)) for c in whole.contacts]
    scene = Scene(whole.discs, tuple(contacts), whole.supports)
    solution = solve(scene)
    assert solution.stability.free > 0
    assert solution.record.pivots == 0
    assert solution.record.guess_errors == 0
    assert prove_contacts(scene).proved
    _same(solution, solve(scene, "lemke"))


def test_the_shift_along_mechanisms_rests_the_closed_contacts() -> None:
    system = contact_system(loose(5, 4, seed=2, loads=2))
    found = regular_set(system, proved.float_guess(system))
    assert found.shift is not None
    rates = np.array([int(x) for x in times(system.B, found.shift)], dtype=object)
    assert not rates[found.held.closed].any()
    assert rates[~found.held.closed].any()
    state = found.state()
    moved = state.displacements
    strain = ExactVector(
        {r: times(system.B, column) for r, column in moved.numerators.items()}, moved.denominator
    )
    for k in np.flatnonzero(~found.held.closed).tolist():
        assert state.gaps[k] == strain[k] + system.gap[k]  # the shift is in the displacements


def test_whoever_waits_is_told_what_is_done(monkeypatch) -> None:
    scene = tbs(6)
    system = contact_system(scene)
    steps = [
        f"{system.dof} degrees of freedom, {system.contacts} contacts to decide",
        "exact solve of the proposed contact set",
        "states, stability and verification",
    ]
    told: list[str] = []
    solve(scene, progress=told.append)
    assert told == steps
    honest = proved.float_guess(system)
    all_closed = Guess(np.ones_like(honest.closed), honest.distance)
    monkeypatch.setattr(proved, "float_guess", lambda system: all_closed)
    told.clear()
    solve(scene, progress=told.append)
    pulling = sum(sign < 0 for sign in contact_lcp(system).problem.q.signs())
    steps.insert(2, f"{pulling} wrong signs: exact pivots repair the contact set")
    assert told == steps


def test_displacements_along_a_motion_are_as_near_as_their_bits() -> None:
    """A motion of 3 and 5 at two freedoms, of which the first is to be 0.7 and -1e-7."""
    system = contact_system(tss(3))
    motion = [fmpz(3), fmpz(5)] + [fmpz(0)] * (system.dof - 2)
    free = Motions(system, np.zeros(system.contacts, dtype=bool), [motion], [0])
    for wanted in (0.7, -1e-7):
        U = np.zeros(system.dof)
        U[0] = wanted * system.freedom_scale[0]
        shift, unit = _along(free, U)
        assert float(Fraction(int(shift[0]), int(unit))) == pytest.approx(wanted, rel=1e-9)
        assert shift[1] * 3 == shift[0] * 5
        assert not any(shift[2:])
    assert _along(replace(free, basis=[], pinned=[]), U) == (None, 1)
